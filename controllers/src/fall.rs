//! Protective falling, after the 2001 paper ("Falling"): the hands reach for the ground and
//! absorb the shock, elbows yield, knees and trunk fold, the head is kept up.
//!
//! Which way is decided when it takes over, by where the capture point lies, and again if the trunk
//! turns over on the way. Three phases each way: reaching while in the air, yielding once hands
//! or seat touch, then lowering what is still propped up. Ends lying at rest.
//!
//! Fails to protect when something hits the character on the way down, or when the fall is faster
//! than the arms. Poses and gains: the output of a search (`aplomb train poses fall`) over pushes that
//! little withstands, with its seed and cost in `skills/fall.ron`; the poses to lie in are by hand.

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

/// s after the landing for which the limbs hold before they lower what is still up.
const HOLDS: f64 = 0.6;

/// One way of falling.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Way {
    /// Pose until something but the feet touches, rad.
    pub reach: NamedAngles,
    /// Pose from then on.
    pub give: NamedAngles,
    /// Pose to lie in.
    pub lie: NamedAngles,
    /// s that lowering to it takes.
    pub lower: f64,
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
    /// To reach, to give, to lie.
    pose: [Vec<f64>; 3],
    stiffness: [f64; 3],
    /// s to ease into each.
    ramp: [f64; 3],
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
    phase: usize,
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
            bounded(name, "lower", way.lower, 0.0, 10.0)?;
            Ok::<_, aplomb_framework::Error>(Poses {
                pose: [pose(&way.reach)?, pose(&way.give)?, pose(&way.lie)?],
                stiffness: [way.reach_stiffness, way.give_stiffness, way.give_stiffness],
                ramp: [way.ramp, way.ramp, way.lower],
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
            phase: 0,
            contract,
        }))
    }
}

impl Fall {
    fn begin_phase(&mut self, now: &Sensors, phase: usize) {
        self.phase = phase;
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
        self.begin_phase(now, 0);
    }

    fn act(&mut self, now: &Sensors, torques: &mut [f64]) {
        let pitch = now.trunk_pitch();
        if self.phase == 0 && now.is_down() {
            self.begin_phase(now, 1);
        } else if self.phase == 0 && pitch.abs() > 0.8 && (pitch < 0.0) != self.is_forward {
            self.is_forward = !self.is_forward;
            self.begin_phase(now, 0);
        } else if self.phase == 1 && now.time - self.since > HOLDS {
            self.is_forward = pitch < 0.0; // it may have rolled over since
            self.begin_phase(now, 2);
        }
        let way = if self.is_forward {
            &self.forward
        } else {
            &self.backward
        };
        let eased = smoothstep((now.time - self.since) / way.ramp[self.phase].max(1e-3));
        let ends = self.from.iter().zip(&way.pose[self.phase]);
        for (target, (from, to)) in self.target.iter_mut().zip(ends) {
            *target = from + eased * (to - from);
        }
        self.servo
            .track(now, &self.target, way.stiffness[self.phase], torques);
    }

    fn clone_box(&self) -> Box<dyn Controller> {
        Box::new(self.clone())
    }
}
