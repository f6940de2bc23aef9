//! Somebody drags a link or a prop by a spring.
//!
//! [`Pull`], where the body is → force on that body alone, for one step.

use rapier2d::prelude::*;

use crate::character::Point;
use crate::math::hypot;
use crate::world::engine::World;
use crate::world::pull::{Dragged, Pull};
use crate::world::vector::vector;

/// Stiffness of the spring for each kg that is dragged, N/m.
const STIFFNESS: f64 = 60.0;
/// Damping ratio of the spring with all that is dragged.
const DAMPING: f64 = 0.7;
/// The strongest pull, in weights of what is dragged.
const STRONGEST: f64 = 3.0;
/// Part of a body's speed that damping may take in a step: more would make a light hand tremble.
const STEADY: f64 = 0.1;

impl World {
    /// Begins to drag, drags on, or (none) lets go.
    pub fn set_pull(&mut self, pull: Option<Pull>) {
        self.pull = pull;
    }

    /// What is dragged, if anything is.
    #[must_use]
    pub fn pull(&self) -> Option<&Pull> {
        self.pull.as_ref()
    }

    /// Where a point of a body is in the world, m.
    #[must_use]
    pub fn place_of(&self, dragged: Dragged, point: Point) -> Point {
        let at = self.bodies[self.dragged(dragged).0]
            .position()
            .transform_point(vector(point));
        [f64::from(at.x), f64::from(at.y)]
    }

    /// A body and the mass of all that hangs together with it, kg.
    fn dragged(&self, dragged: Dragged) -> (RigidBodyHandle, f64) {
        match dragged {
            Dragged::Link { character, link } => {
                let body = &self.characters[character].body;
                (body.link(link), body.model().total_mass())
            }
            Dragged::Prop(prop) => {
                let handle = self.props[prop].body;
                (handle, f64::from(self.bodies[handle].mass()))
            }
        }
    }

    /// Adds the spring's force for one step.
    pub(super) fn drag(&mut self) {
        let Some(pull) = self.pull else { return };
        let (handle, mass) = self.dragged(pull.dragged);
        let (dt, gravity) = (self.settings.dt, self.settings.gravity);
        let body = &mut self.bodies[handle];
        let at = body.position().transform_point(vector(pull.point));
        let velocity = body.velocity_at_point(at);
        let stiffness = STIFFNESS * mass;
        let damping =
            (2.0 * DAMPING * mass * STIFFNESS.sqrt()).min(STEADY * f64::from(body.mass()) / dt);
        let [to_x, to_y] = pull.to;
        let mut force = [
            stiffness * (to_x - f64::from(at.x)) - damping * f64::from(velocity.x),
            stiffness * (to_y - f64::from(at.y)) - damping * f64::from(velocity.y),
        ];
        let size = hypot(force[0], force[1]);
        let strongest = STRONGEST * mass * gravity.max(1.0);
        if size > strongest {
            force = force.map(|f| f * strongest / size);
        }
        body.add_force_at_point(vector(force), at, true);
        self.pull = Some(Pull { force, ..pull });
    }

    /// Takes the spring's force off again: it acts for one step.
    pub(super) fn undo_drag(&mut self) {
        let Some(pull) = self.pull else { return };
        let (handle, _) = self.dragged(pull.dragged);
        let body = &mut self.bodies[handle];
        body.reset_forces(false);
        body.reset_torques(false);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::character::{Model, State};
    use crate::world::Settings;

    /// A limp humanoid, dragged up by a link for 10 s; of the last 5 s the mean vertical force of the
    /// spring and its mean change from a step to the next, N. The limbs swing on: the joints have
    /// no friction.
    fn dragged_up(link: &str) -> (World, [f64; 2]) {
        let model = Model::load("humanoid").unwrap();
        let mut world = World::new(Settings::default());
        let it = world.spawn(&model, &State::standing(&model));
        let link = model.link_index(link).unwrap();
        let dragged = Dragged::Link {
            character: it,
            link,
        };
        world.set_pull(Some(Pull::new(dragged, [0.0; 2], [0.0, 2.5])));
        let (mut mean, mut trembling, mut before) = (0.0, 0.0, [0.0; 2]);
        for step in 0..10_000 {
            world.sense(it);
            world.actuate(it, &vec![0.0; model.joint_count()]);
            world.step();
            let force = world.pull().unwrap().force;
            if step >= 5000 {
                mean += force[1] / 5000.0;
                trembling += hypot(force[0] - before[0], force[1] - before[1]) / 5000.0;
            }
            before = force;
        }
        (world, [mean, trembling])
    }

    #[test]
    fn who_is_dragged_up_hangs_under_a_hand_that_does_not_tremble() {
        for link in ["torso", "forearm_r", "foot_l", "head"] {
            let (world, [mean, trembling]) = dragged_up(link);
            let pull = *world.pull().unwrap();
            let at = world.place_of(pull.dragged, pull.point);
            let weight = 9.81 * world.characters()[0].body.model().total_mass();
            assert!((at[1] - 2.5).abs() < 0.5, "{link} at {at:?}");
            let bears = (mean - weight).abs() < 0.1 * weight;
            assert!(bears, "{link}: {mean} N on the mean");
            assert!(trembling < 0.01 * weight, "{link}: {trembling} N a step");
        }
    }

    #[test]
    fn who_is_let_go_of_falls() {
        let (mut world, _) = dragged_up("torso");
        let before = world.sense(0).com[1];
        world.set_pull(None);
        for _ in 0..500 {
            world.step();
        }
        assert!(world.sense(0).com[1] < before - 0.5);
    }
}
