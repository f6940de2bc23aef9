//! How well a standing controller takes pushes: a cost over pushes around its limit.
//!
//! supervisor, push → rollout → cost. Each push is a short rollout: 1 s of standing, the push, then up
//! to 7 s until the character has stood for a second or has come down.

use std::sync::Arc;

use aplomb_framework::character::{Joint, Model};
use aplomb_framework::control::Supervisor;
use aplomb_framework::input::Result;
use aplomb_framework::math::square;
use aplomb_framework::run::Simulation;
use aplomb_framework::scenario::Scenario;

use crate::situations::pushes::Site;

/// s after a push at which the pose should be as before.
const RECOVERED: f64 = 3.5;

/// A push over 0.1 s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StandingPush {
    /// Where it acts.
    pub site: Site,
    /// N·s, forward positive.
    pub impulse: f64,
    /// When it begins, s.
    pub at: f64,
    /// Friction of the ground.
    pub friction: f64,
}

/// So many pushes around the limits (N·s), one half forward, the other backward, in even steps, a
/// little different in time and friction so that no single lucky run decides.
#[must_use]
pub fn pushes(forward: [f64; 2], backward: [f64; 2], count: usize) -> Vec<StandingPush> {
    let mut all = Vec::with_capacity(count);
    let ways = [
        (1.0, forward, count.div_ceil(2)),
        (-1.0, backward, count / 2),
    ];
    for (sign, [low, high], count) in ways {
        let step = (high - low) / (count.max(2) - 1) as f64;
        for i in 0..count {
            let phase = [0.0, 0.0013, 0.0029, 0.0047][i % 4];
            let friction = [1.0, 1.0, 0.9, 1.1][i % 4];
            all.push(StandingPush {
                site: Site::Trunk,
                impulse: sign * (low + step * i as f64),
                at: 1.0 + phase,
                friction,
            });
        }
    }
    all
}

impl StandingPush {
    /// A rollout at the moment at which the push begins: the character has stood until then under
    /// the supervisor.
    fn begin(&self, model: &Arc<Model>, supervisor: &Supervisor) -> Result<Simulation> {
        let mut scenario = Scenario::standing(&model.name, 10.0);
        scenario.settings.friction = self.friction;
        let cast = vec![(Arc::clone(model), supervisor.clone())];
        let mut run = Simulation::with_cast(&scenario, cast)?;
        run.run(self.at);
        run.push(0, self.site.link(model), self.impulse)?;
        Ok(run)
    }

    /// What one rollout is charged, and whether it stood. One that cannot begin is charged as a
    /// fall at once.
    pub(crate) fn judge(&self, model: &Arc<Model>, supervisor: &Supervisor) -> (f64, bool) {
        let taken = take(model, supervisor, *self);
        taken.map_or((1.0, false), |taken| (taken.cost(), taken.stood))
    }
}

/// How one push went.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Taken {
    /// Whether it stood at the end, and only ever under the first controller.
    pub stood: bool,
    /// s from the push until it stood for a second or came down.
    pub after: f64,
    /// Root mean square of the joints' distance from their angles before the push, 3.5 s after it,
    /// rad; 0 if it came down.
    pub slouch: f64,
    /// Part of the time that not all feet touched.
    pub lifted: f64,
    /// Mean of the squared joint velocities until then, (rad/s)².
    pub motion: f64,
    /// The furthest that the trunk leant either way, rad.
    pub lean: f64,
    /// The furthest that a shoulder went from where it was, rad.
    pub raised: f64,
}

impl Taken {
    /// What it is charged: 1 for a push that is not stood (less the longer it lasted), and a little
    /// for slow recovery, for a pose that is not regained, a trunk that bends, arms that rise and for needless
    /// motion.
    #[must_use]
    pub fn cost(&self) -> f64 {
        if self.stood {
            let calm =
                0.3 * (self.lean - 0.2).clamp(0.0, 1.0) + 0.1 * (self.raised - 0.4).clamp(0.0, 2.0);
            0.2 * self.after / 7.0
                + 0.002 * self.motion.min(20.0)
                + 0.3 * self.slouch.min(1.0)
                + calm
        } else {
            1.0 - 0.3 * (self.after / 7.0).min(1.0)
        }
    }
}

/// One rollout under a supervisor of the standing controller and what takes over once it has failed.
///
/// # Errors
/// A supervisor for another character.
pub fn take(model: &Arc<Model>, supervisor: &Supervisor, push: StandingPush) -> Result<Taken> {
    let mut run = push.begin(model, supervisor)?;
    // The push acts from the next step on: this is how it stood before.
    let quiet = run.sensors(0).com_velocity[0].abs() < 0.05;
    let (mut motion, mut steps, mut slouch, mut lifted) = (0.0, 0.0, 0.0, 0.0);
    let before: Vec<f64> = run.sensors(0).state.angles().to_vec();
    let (mut lean, mut raised) = (0.0f64, 0.0f64);
    let named = |j: &Joint| j.name.starts_with("shoulder");
    let shoulders: Vec<bool> = model.joints().map(named).collect();
    let first = run.actors()[0].supervisor.active_index();
    while run.time() < push.at + 7.0 {
        run.step();
        let now = run.sensors(0);
        motion += now.state.rates().iter().map(|r| r * r).sum::<f64>();
        steps += 1.0;
        lean = lean.max(now.trunk_pitch().abs());
        let angles = now.state.angles().iter().zip(&before).zip(&shoulders);
        let moved = angles.map(|((a, b), shoulder)| if *shoulder { (a - b).abs() } else { 0.0 });
        raised = moved.fold(raised, f64::max);
        lifted += f64::from(u8::from(!now.feet.iter().all(|f| f.touching())));
        if run.actors()[0].supervisor.active_index() != first {
            break;
        }
        if now.time < push.at + RECOVERED {
            let apart = now
                .state
                .angles()
                .iter()
                .zip(&before)
                .map(|(a, b)| square(a - b));
            slouch = (apart.sum::<f64>() / before.len() as f64).sqrt();
        } else if run.outcome(0).standing {
            break;
        }
    }
    let stood =
        run.outcome(0).standing && run.actors()[0].supervisor.active_index() == first && quiet;
    Ok(Taken {
        stood,
        slouch,
        lean,
        raised,
        after: run.time() - push.at,
        motion: motion / steps,
        lifted: lifted / steps,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exercise::skill::tests::shipped;

    #[test]
    fn light_pushes_are_stood_and_heavy_ones_are_not() {
        let skill = shipped("balance");
        let alone = skill.supervisor.alone("balance").unwrap();
        let taken = |impulse| {
            let push = StandingPush {
                site: Site::Trunk,
                impulse,
                at: 1.0,
                friction: 1.0,
            };
            take(&skill.model, &alone, push).unwrap()
        };
        let (light, heavy) = (taken(15.0), taken(120.0));
        assert!(light.stood && !heavy.stood, "{light:?} {heavy:?}");
        assert!(light.cost() + 0.5 < heavy.cost(), "{light:?} {heavy:?}");
    }

    #[test]
    fn pushes_go_both_ways_evenly_from_the_weakest_to_the_strongest() {
        let impulses = |count| -> Vec<f64> {
            let all = pushes([30.0, 50.0], [20.0, 40.0], count);
            all.iter().map(|p| p.impulse).collect()
        };
        assert_eq!(impulses(5), [30.0, 40.0, 50.0, -20.0, -40.0]);
        assert_eq!(impulses(1), [30.0]);
    }
}
