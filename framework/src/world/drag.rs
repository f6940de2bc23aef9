//! Somebody drags a link or a prop by a spring.
//!
//! [`Pull`], where the body is → force on that body alone, for one step.

use rapier2d::prelude::*;

use crate::character::Point;
use crate::math::hypot;
use crate::world::body::vector;
use crate::world::engine::World;
use crate::world::pull::{Dragged, Pull};

/// Stiffness of the spring for each kg that is dragged, N/m.
const STIFFNESS: f64 = 60.0;
/// Damping ratio of the spring with all that is dragged.
const DAMPING: f64 = 0.7;
/// The strongest pull, in weights of what is dragged.
const STRONGEST: f64 = 3.0;
/// Part of a body's speed that damping may take in a step: more would make a light hand tremble.
const STEADY: f64 = 0.3;

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

    /// A limp humanoid, dragged up by a link for 3 s; the highest speed of any link in the last one.
    fn dragged_up(link: &str) -> (World, f64) {
        let model = Model::load("humanoid").unwrap();
        let mut world = World::new(Settings::default());
        let it = world.spawn(&model, &State::standing(&model));
        let link = model.link_index(link).unwrap();
        let dragged = Dragged::Link {
            character: it,
            link,
        };
        world.set_pull(Some(Pull::new(dragged, [0.0; 2], [0.0, 2.5])));
        let mut fastest = 0.0_f64;
        for step in 0..6000 {
            world.sense(it);
            world.actuate(it, &vec![0.0; model.joint_count()]);
            world.step();
            if step >= 5000 {
                let links = &world.characters()[it].sensors.kinematics.links;
                let speeds = links
                    .iter()
                    .map(|l| l.com_velocity[0].hypot(l.com_velocity[1]));
                fastest = speeds.fold(fastest, f64::max);
            }
        }
        (world, fastest)
    }

    #[test]
    fn who_is_dragged_up_hangs_still_under_the_hand() {
        for link in ["torso", "forearm_r", "foot_l", "head"] {
            let (world, fastest) = dragged_up(link);
            let pull = *world.pull().unwrap();
            let at = world.place_of(pull.dragged, pull.point);
            let weight = 9.81 * world.characters()[0].body.model().total_mass();
            assert!((at[1] - 2.5).abs() < 0.25, "{link} at {at:?}");
            assert!(
                (pull.force[1] - weight).abs() < 0.2 * weight,
                "{link}: {:?}",
                pull.force
            );
            assert!(fastest < 1.0, "{link} moves at {fastest}");
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
