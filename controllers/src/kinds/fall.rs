//! Protective falling, after the 2001 paper ("Falling"): the hands reach for the ground and
//! absorb the shock, elbows yield, knees and trunk fold, the head is kept up.
//!
//! Which way is decided when it takes over, by where the capture point lies, and again if the trunk
//! turns over on the way. A fall that spins so fast backward that it would land on the head is met
//! with the hands over the head, as in a back handspring. Three phases each way: reaching while in
//! the air, yielding once hands or seat touch, then lowering what is still propped up. Ends lying
//! at rest.
//!
//! Fails to protect when something hits the character on the way down, or when the fall is faster
//! than the arms. Poses and gains: the output of a search (`aplomb train poses fall`) over pushes that
//! little withstands, with its seed and cost in `skills/fall.ron`; the poses to lie in are by hand.

use std::sync::Arc;

use aplomb_framework::character::Model;
use aplomb_framework::control::{Contract, Controller, Spec};
use aplomb_framework::input::{Error, Result, check};
use aplomb_framework::sensing::Sensors;
use serde::{Deserialize, Serialize};

use crate::servo::{Servo, smoothstep};
use crate::target::{NamedAngles, overlay, set_apart};

/// s after the landing for which the limbs hold before they lower what is still up.
const HOLDS: f64 = 0.6;
/// Height of the centre of mass on landing, m.
const LANDS: f64 = 0.4;
/// Pitch of the trunk that leaves no doubt which way it falls, rad.
const DOUBTLESS: f64 = 0.8;

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
    /// How far the right limbs are ahead of the left in all three, by stem, rad.
    #[serde(default, skip_serializing_if = "NamedAngles::is_empty")]
    pub apart: NamedAngles,
    /// s that lowering to it takes.
    pub lower: f64,
    /// Stiffness while reaching, relative to the nominal servos.
    pub reach_stiffness: f64,
    /// Stiffness while yielding.
    pub give_stiffness: f64,
    /// Time to ease from one pose to the next, s.
    pub ramp: f64,
}

/// How to fall backward over the head, and when.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Over {
    /// Pitch of the trunk on landing, as foreseen in the air, beyond which it falls this way, rad;
    /// π/2 is on the back, π on the head.
    pub beyond: f64,
    /// The poses to reach and to give. It then lies down forward or backward, as it has come to lie:
    /// this way's own `lie` and `lower` are not used.
    pub way: Way,
}

/// Parameters of [`Fall`] in a file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FallSpec {
    /// Onto the hands and the front.
    pub forward: Way,
    /// Onto the seat and the back.
    pub backward: Way,
    /// Backward over the head, onto the hands; as `backward` if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub over: Option<Over>,
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

/// Where it falls to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Direction {
    Forward,
    Backward,
    Over,
}

/// The controller.
#[derive(Debug, Clone)]
pub struct Fall {
    contract: Contract,
    servo: Servo,
    forward: Poses,
    backward: Poses,
    over: Option<(f64, Poses)>,
    direction: Direction,
    /// When the phase began, s, and the pose at that time.
    since: f64,
    from: Vec<f64>,
    target: Vec<f64>,
    phase: usize,
}

impl Way {
    fn poses(&self, model: &Model) -> Result<Poses> {
        check::within("reach_stiffness", self.reach_stiffness, 0.0..=3.0)?;
        check::within("give_stiffness", self.give_stiffness, 0.0..=3.0)?;
        check::within("ramp", self.ramp, 0.0..=5.0)?;
        check::within("lower", self.lower, 0.0..=10.0)?;
        let pose = |field: &str, named: &NamedAngles, apart: &NamedAngles| {
            let mut all = vec![0.0; model.joint_count()];
            overlay(model, named, &mut all).map_err(|e| e.inside(field))?;
            set_apart(model, apart, &mut all).map_err(|e| e.inside("apart"))?;
            Ok::<_, Error>(all)
        };
        Ok(Poses {
            pose: [
                pose("reach", &self.reach, &self.apart)?,
                pose("give", &self.give, &self.apart)?,
                pose("lie", &self.lie, &self.apart)?,
            ],
            stiffness: [
                self.reach_stiffness,
                self.give_stiffness,
                self.give_stiffness,
            ],
            ramp: [self.ramp, self.ramp, self.lower],
        })
    }
}

impl Spec for FallSpec {
    const KIND: &'static str = "fall";

    fn build(self, contract: Contract, model: &Arc<Model>) -> Result<Box<dyn Controller>> {
        check::within("damping", self.damping, 0.0..=1.0)?;
        let over = self.over.as_ref().map(|over| {
            check::within("beyond", over.beyond, 0.0..=7.0)?;
            let poses = over.way.poses(model).map_err(|e| e.inside("way"))?;
            Ok::<_, Error>((over.beyond, poses))
        });
        let poses = |field: &str, way: &Way| way.poses(model).map_err(|e| e.inside(field));
        Ok(Box::new(Fall {
            over: over.transpose().map_err(|e| e.inside("over"))?,
            forward: poses("forward", &self.forward)?,
            backward: poses("backward", &self.backward)?,
            servo: Servo::new(model, 1.0, self.damping),
            direction: Direction::Forward,
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

    /// Where the fall goes: by where the capture point lies, or by the trunk once it leans far enough
    /// to leave no doubt.
    fn direction(&self, now: &Sensors) -> Direction {
        let pitch = now.trunk_pitch();
        let forward = if pitch.abs() > DOUBTLESS {
            pitch < 0.0
        } else {
            match now.support_centre() {
                Some(centre) => now.capture_point > centre,
                None => now.com_velocity[0] > 0.0,
            }
        };
        match &self.over {
            _ if forward => Direction::Forward,
            Some((beyond, _)) if landing_pitch(now) > *beyond => Direction::Over,
            _ => Direction::Backward,
        }
    }
}

/// Pitch that the trunk will have when the centre of mass has come down to [`LANDS`], rad, if the whole
/// body goes on as it flies and turns.
fn landing_pitch(now: &Sensors) -> f64 {
    let (up, g) = (now.com_velocity[1], now.gravity.max(1e-6));
    let above = (now.com_height() - LANDS).max(0.0);
    let time = (up + (up * up + 2.0 * g * above).sqrt()) / g;
    now.trunk_pitch() + now.spin() * time
}

impl Controller for Fall {
    fn contract(&self) -> &Contract {
        &self.contract
    }

    fn enter(&mut self, now: &Sensors) {
        self.direction = self.direction(now);
        self.begin_phase(now, 0);
    }

    fn act(&mut self, now: &Sensors, torques: &mut [f64]) {
        let pitch = now.trunk_pitch();
        if self.phase == 0 && now.is_down() {
            self.begin_phase(now, 1);
        } else if self.phase == 0 && self.direction != Direction::Over {
            let direction = self.direction(now);
            let sure = pitch.abs() > DOUBTLESS || direction == Direction::Over;
            if sure && direction != self.direction {
                self.direction = direction;
                self.begin_phase(now, 0);
            }
        } else if self.phase == 1 && now.time - self.since > HOLDS {
            self.direction = if pitch < 0.0 {
                Direction::Forward // it may have rolled over since
            } else {
                Direction::Backward
            };
            self.begin_phase(now, 2);
        }
        let way = match (self.direction, &self.over) {
            (Direction::Forward, _) => &self.forward,
            (Direction::Over, Some((_, over))) => over,
            _ => &self.backward,
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
