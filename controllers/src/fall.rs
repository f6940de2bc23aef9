//! Protective falling, after the 2001 paper (section 6.2): the hands reach for the ground and
//! absorb the shock, elbows yield, knees and trunk fold, the head is kept up.
//!
//! Which way is decided when it takes over, by the velocity of the centre of mass, and again if the
//! trunk turns over on the way. Two phases each way: reaching while in the air, yielding once hands
//! or seat touch. Ends at rest.
//!
//! Fails to protect when something hits the character on the way down, or when the fall is faster
//! than the arms. Poses and gains: the file, from the project's search over pushes.

use std::sync::Arc;

use aplomb_framework::Result;
use aplomb_framework::contract::Contract;
use aplomb_framework::controller::Controller;
use aplomb_framework::model::Model;
use aplomb_framework::registry::Spec;
use aplomb_framework::sensors::Sensors;
use serde::{Deserialize, Serialize};

use crate::servo::{Servo, smoothstep};
use crate::target::{NamedAngles, bounded, overlay};

/// s after the landing for which the limbs hold before they relax.
const HOLDS: f64 = 0.6;
/// s that relaxing takes.
const RELAXES: f64 = 1.0;
/// Part of the stiffness that is left then.
const LIMP: f64 = 0.05;

/// One way of falling.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Way {
    /// Pose until something but the feet touches, rad.
    pub reach: NamedAngles,
    /// Pose from then on.
    pub give: NamedAngles,
    /// Stiffness while reaching, relative to the nominal servos.
    pub reach_stiffness: f64,
    /// Stiffness while yielding.
    pub give_stiffness: f64,
    /// Time to ease from one pose to the next, s.
    pub ramp: f64,
}

/// Parameters of [`Fall`] in a file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FallSpec {
    /// Onto the hands and the front.
    pub forward: Way,
    /// Onto the seat and the back.
    pub backward: Way,
    /// Damping relative to the nominal servos.
    pub damping: f64,
}

#[derive(Debug, Clone)]
struct Poses {
    reach: Vec<f64>,
    give: Vec<f64>,
    stiffness: [f64; 2],
    ramp: f64,
}

/// The controller.
#[derive(Debug, Clone)]
pub struct Fall {
    contract: Contract,
    servo: Servo,
    forward: Poses,
    backward: Poses,
    is_forward: bool,
    /// When the phase began, s, and the pose at that time.
    since: f64,
    from: Vec<f64>,
    target: Vec<f64>,
    landed: bool,
}

impl Spec for FallSpec {
    const KIND: &'static str = "fall";

    fn build(self, contract: Contract, model: &Arc<Model>) -> Result<Box<dyn Controller>> {
        bounded(&contract.name, "damping", self.damping, 0.0, 1.0)?;
        let poses = |name: &str, way: &Way| {
            let pose = |named: &NamedAngles| {
                let mut all = vec![0.0; model.joint_count()];
                overlay(model, named, name, [-7.0, 7.0], &mut all).map(|()| all)
            };
            bounded(name, "reach_stiffness", way.reach_stiffness, 0.0, 3.0)?;
            bounded(name, "give_stiffness", way.give_stiffness, 0.0, 3.0)?;
            bounded(name, "ramp", way.ramp, 0.0, 5.0)?;
            Ok::<_, aplomb_framework::Error>(Poses {
                reach: pose(&way.reach)?,
                give: pose(&way.give)?,
                stiffness: [way.reach_stiffness, way.give_stiffness],
                ramp: way.ramp,
            })
        };
        Ok(Box::new(Fall {
            forward: poses("forward", &self.forward)?,
            backward: poses("backward", &self.backward)?,
            servo: Servo::new(model, 1.0, self.damping),
            is_forward: true,
            since: 0.0,
            from: vec![0.0; model.joint_count()],
            target: vec![0.0; model.joint_count()],
            landed: false,
            contract,
        }))
    }
}

impl Fall {
    fn begin_phase(&mut self, now: &Sensors) {
        self.since = now.time;
        self.from.copy_from_slice(now.state.angles());
    }

    /// Whether the fall goes forward: by where the capture point lies, or by the trunk once it
    /// leans far enough to leave no doubt.
    fn goes_forward(now: &Sensors) -> bool {
        let pitch = now.trunk_pitch();
        if pitch.abs() > 0.8 {
            return pitch < 0.0;
        }
        match now.support_centre() {
            Some(centre) => now.capture_point > centre,
            None => now.com_velocity[0] > 0.0,
        }
    }
}

impl Controller for Fall {
    fn contract(&self) -> &Contract {
        &self.contract
    }

    fn enter(&mut self, now: &Sensors) {
        self.is_forward = Self::goes_forward(now);
        self.landed = false;
        self.begin_phase(now);
    }

    fn act(&mut self, now: &Sensors, torques: &mut [f64]) {
        if !self.landed && !now.only_feet_support() && now.contacts.iter().any(|c| c.supported) {
            self.landed = true;
            self.begin_phase(now);
        }
        let pitch = now.trunk_pitch();
        if !self.landed && pitch.abs() > 0.8 && (pitch < 0.0) != self.is_forward {
            self.is_forward = !self.is_forward;
            self.begin_phase(now);
        }
        let poses = if self.is_forward {
            &self.forward
        } else {
            &self.backward
        };
        let phase = usize::from(self.landed);
        let pose = if self.landed {
            &poses.give
        } else {
            &poses.reach
        };
        let eased = smoothstep((now.time - self.since) / poses.ramp.max(1e-3));
        for ((target, from), to) in self.target.iter_mut().zip(&self.from).zip(pose) {
            *target = from + eased * (to - from);
        }
        let mut stiffness = poses.stiffness[phase];
        if self.landed {
            // What is left of the fall is over: relax.
            let relaxed = smoothstep((now.time - self.since - HOLDS) / RELAXES);
            stiffness *= 1.0 - relaxed * (1.0 - LIMP);
        }
        self.servo.track(now, &self.target, stiffness, torques);
    }

    fn clone_box(&self) -> Box<dyn Controller> {
        Box::new(self.clone())
    }
}
