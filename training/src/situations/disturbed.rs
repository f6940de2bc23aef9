//! A character that a random disturbance has brought from a nominal start to some state.
//!
//! [`Disturbance`], world, random stream → start, force, offsets of the servos → run up to where a
//! controller is to take over.

use std::sync::Arc;

use aplomb_controllers::target::overlay;
use aplomb_framework::character::Model;
use aplomb_framework::control::{Controller, Supervisor};
use aplomb_framework::input::Result;
use aplomb_framework::math::{cos, sin};
use aplomb_framework::run::Simulation;
use aplomb_framework::scenario::{Scenario, Start};
use aplomb_framework::world::Settings;
use rand::Rng;
use rand_chacha::ChaCha8Rng;

use crate::situations::disturbance::{Disturbance, During, Nominal};
use crate::situations::held::Held;

/// s for which it is disturbed at least.
const SOONEST: f64 = 0.005;
/// s that its scenario may last.
const LONGEST: f64 = 60.0;

/// A disturbance with its character and the repertoire that may act meanwhile.
#[derive(Debug, Clone)]
pub struct Disturbed {
    /// The distribution.
    pub disturbance: Disturbance,
    /// The angles of each of its starts, rad.
    poses: Vec<Vec<f64>>,
    model: Arc<Model>,
    repertoire: Supervisor,
}

impl Disturbed {
    /// Of a character in its repertoire.
    ///
    /// # Errors
    /// Joints that the character does not have.
    pub fn new(
        disturbance: Disturbance,
        model: &Arc<Model>,
        repertoire: &Supervisor,
    ) -> Result<Self> {
        let pose = |start: &Nominal| {
            let mut pose = vec![0.0; model.joint_count()];
            overlay(model, &start.angles, &mut pose).map(|()| pose)
        };
        Ok(Self {
            poses: disturbance.starts.iter().map(pose).collect::<Result<_>>()?,
            disturbance,
            model: Arc::clone(model),
            repertoire: repertoire.clone(),
        })
    }

    /// The run of a random stream, in a world, up to its end.
    ///
    /// # Errors
    /// A character whose parts do not fit each other.
    pub fn run(&self, settings: Settings, rng: &mut ChaCha8Rng) -> Result<Simulation> {
        let d = &self.disturbance;
        let place = rng.gen_range(0..d.starts.len());
        let nominal = &d.starts[place];
        let mut scenario = Scenario::standing(&self.model.name, LONGEST);
        scenario.settings = settings;
        let joints = || self.model.joints();
        let target: Vec<f64> = joints()
            .zip(&self.poses[place])
            .map(|(joint, angle)| {
                let strayed = angle + nominal.spread * rng.gen_range(-1.0..=1.0);
                strayed.clamp(joint.range[0], joint.range[1])
            })
            .collect();
        scenario.characters[0].start = Start {
            x: 0.0,
            lift: rng.gen_range(nominal.lift[0]..=nominal.lift[1]),
            pitch: nominal.pitch + rng.gen_range(-1.0..=1.0) * nominal.tilt,
            angles: joints()
                .map(|j| j.name.clone())
                .zip(target.iter().copied())
                .collect(),
        };
        let offset: Vec<f64> = target
            .iter()
            .map(|a| a + d.offset * rng.gen_range(-1.0..=1.0))
            .collect();
        let supervisor = match d.during[rng.gen_range(0..d.during.len())] {
            During::Repertoire => self.repertoire.clone(),
            During::Servos => {
                let held: Box<dyn Controller> =
                    Box::new(Held::new("held", &self.model, offset, 1.0));
                Supervisor::new("held", vec![held], "held")?
            }
        };
        let cast = vec![(Arc::clone(&self.model), supervisor)];
        let mut run = Simulation::with_cast(&scenario, cast)?;
        let link = &d.force.links[rng.gen_range(0..d.force.links.len())];
        let magnitude = d.force.most * rng.gen_range(0.0..=1.0);
        let rise = d.force.rise * rng.gen_range(-1.0..=1.0);
        let sign = if rng.gen_range(0..2) == 0 { 1.0 } else { -1.0 };
        let time = rng.gen_range(d.force.time[0]..=d.force.time[1]);
        let impulse = magnitude * time;
        run.shove(
            0,
            link,
            [sign * impulse * cos(rise), impulse * sin(rise)],
            time,
        )?;
        run.run((time + rng.gen_range(d.pause[0]..=d.pause[1])).max(SOONEST));
        Ok(run)
    }
}
