//! A protective step: a foot is put where the fall can be caught, as often as it takes, and the other
//! foot is brought beside it.
//!
//! Phases: *swing* (a foot moves to where the capture point will be when it lands), *catch* (both
//! feet carry, the centre of mass comes over the foot that landed), *close* (the foot that is left
//! behind is brought beside the other), then both feet carry and the pose is straightened until
//! the post-condition holds. From *catch* and *close* a new *swing* begins when the capture
//! point leaves the support. The foot placement is that of the linear inverted pendulum (Pratt et
//! al. 2006): with the centre of pressure p at the support's edge the capture point ξ runs away
//! as ξ(t) = p + (ξ₀ − p) e^(ω₀ t). All phases are under momentum control.
//!
//! Fails when the capture point runs further than a leg reaches, when the foot catches on the
//! ground, or when the trunk has tipped over; its expected performance says so.

use std::sync::Arc;

use aplomb_framework::Result;
use aplomb_framework::contract::Contract;
use aplomb_framework::controller::Controller;
use aplomb_framework::model::Model;
use aplomb_framework::registry::Spec;
use aplomb_framework::sensors::Sensors;
use serde::{Deserialize, Serialize};

use crate::balance::com_height;
use crate::gains::Gains;
use crate::momentum::{Formulation, Momentum, Reference, Swing, sole_centre};
use crate::servo::{Servo, smoothstep};
use crate::target::{NamedAngles, bounded, overlay};

/// How a foot is put down in one direction.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Placement {
    /// s that a protective swing takes.
    pub swing_time: f64,
    /// Part of the way from the edge of the support to the predicted capture point.
    pub reach: f64,
    /// m by which the sole's middle lands beyond that.
    pub beyond: f64,
    /// Highest point of the swing, m.
    pub lift: f64,
    /// Pitch of the root while the step is under way, rad.
    pub lean: f64,
}

/// Parameters of [`Step`] in a file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StepSpec {
    /// Gains and weights of momentum control.
    pub gains: Gains,
    /// Reference pose, rad; joints that are not named are 0.
    pub pose: NamedAngles,
    /// W: weights of joints within the tracking; those not named have 1.
    pub joint_weights: NamedAngles,
    /// Steps forward.
    pub forward: Placement,
    /// Steps backward.
    pub backward: Placement,
    /// Longest step, m.
    pub longest: f64,
    /// 1/s²
    pub swing_stiffness: f64,
    /// Weight of the swinging foot's motion.
    pub swing_weight: f64,
    /// s that the closing step takes.
    pub close_time: f64,
    /// Highest point of the closing step, m.
    pub close_lift: f64,
    /// m by which the capture point may be off the foot that carries when closing begins.
    pub close_within: f64,
    /// m by which the capture point may leave the support before the next step.
    pub margin: f64,
    /// How fast the reference centre of mass moves over the foot, m/s.
    pub glide: f64,
    /// m by which bending the trunk may extend the support.
    pub bend: f64,
    /// How fast the reference rises from where the centre of mass was found, m/s.
    pub climb: f64,
}

/// s after which catching aims twice as far as the foot.
const LEANING: f64 = 0.5;

/// s of catching after which the stance is too wide.
const STUCK: f64 = 1.2;
/// s that drawing a foot nearer takes.
const DRAW: f64 = 0.3;
/// m by which each further step is longer than the one before.
const LONGER: f64 = 0.06;
/// m inside the ends of a sole that the capture point has to be for the other foot to leave.
const INSIDE: f64 = 0.04;

#[derive(Debug, Clone, Copy, PartialEq)]
enum Phase {
    /// A foot moves to catch the fall.
    Swing { foot: usize, forward: bool },
    /// Both feet carry; the centre of mass comes over `over`.
    Catch { over: usize },
    /// `foot` is brought beside `over`.
    Close { foot: usize, over: usize },
    /// `foot` is drawn half of the way to the other, out of a split too wide to come over a foot.
    Draw { foot: usize, to: f64 },
    /// Both feet carry side by side.
    Settle,
}

/// The controller.
#[derive(Debug, Clone)]
pub struct Step {
    contract: Contract,
    spec: StepSpec,
    momentum: Momentum,
    reference: Reference,
    /// Height of the centre of mass in the reference pose, m.
    height: f64,
    /// Length of a leg with half of the pelvis, for the height of a wide stance, m.
    leg: f64,
    servo: Servo,
    phase: Phase,
    /// When the phase began, s.
    since: f64,
    /// Where the swinging sole began, m.
    from: [f64; 2],
    /// Where the centre of mass is to come, world x, m.
    over: f64,
    /// Protective swings so far.
    swings: u32,
    time: f64,
}

impl Spec for StepSpec {
    const KIND: &'static str = "step";

    fn build(self, contract: Contract, model: &Arc<Model>) -> Result<Box<dyn Controller>> {
        let place = contract.name.clone();
        self.gains.validate(&place)?;
        for (name, p) in [("forward", &self.forward), ("backward", &self.backward)] {
            let at = format!("{place}: {name}");
            bounded(&at, "swing_time", p.swing_time, 0.1, 1.0)?;
            bounded(&at, "reach", p.reach, 0.0, 3.0)?;
            bounded(&at, "beyond", p.beyond, -0.5, 0.5)?;
            bounded(&at, "lift", p.lift, 0.0, 0.5)?;
            bounded(&at, "lean", p.lean, -1.0, 1.0)?;
        }
        for (field, value, low, high) in [
            ("longest", self.longest, 0.0, 3.0),
            ("swing_stiffness", self.swing_stiffness, 1.0, 1e4),
            ("swing_weight", self.swing_weight, 1e-6, 1e6),
            ("close_time", self.close_time, 0.1, 2.0),
            ("close_lift", self.close_lift, 0.0, 0.5),
            ("close_within", self.close_within, 0.0, 0.5),
            ("margin", self.margin, -0.1, 0.5),
            ("glide", self.glide, 0.01, 10.0),
            ("bend", self.bend, 0.0, 2.0),
            ("climb", self.climb, 0.01, 10.0),
        ] {
            bounded(&place, field, value, low, high)?;
        }
        bounded(
            &place,
            "feet of the character",
            model.feet.len() as f64,
            2.0,
            2.0,
        )?;
        let mut pose = vec![0.0; model.joint_count()];
        overlay(model, &self.pose, "pose", [-7.0, 7.0], &mut pose)?;
        let mut weights = vec![1.0; model.joint_count()];
        overlay(
            model,
            &self.joint_weights,
            "joint_weights",
            [1e-3, 1e3],
            &mut weights,
        )?;
        let height = com_height(model, &pose);
        Ok(Box::new(Step {
            momentum: Momentum::new(model, Formulation::Inequality, self.gains.clone(), weights),
            height,
            leg: model.standing_height(),
            reference: Reference {
                com: [0.0; 2],
                com_velocity: [0.0; 2],
                rates: vec![0.0; pose.len()],
                pose,
                pitch: 0.0,
                swing: None,
            },
            servo: Servo::new(model, 0.5, 1.0),
            phase: Phase::Settle,
            since: 0.0,
            from: [0.0; 2],
            over: 0.0,
            swings: 0,
            time: 0.0,
            spec: self,
            contract,
        }))
    }
}

impl Step {
    fn sole(now: &Sensors, foot: usize) -> [f64; 2] {
        let f = &now.model.feet[foot];
        now.kinematics.point(f.link, sole_centre(f))
    }

    /// Rear and front end of a foot's sole, world x, m.
    fn ends(now: &Sensors, foot: usize) -> [f64; 2] {
        let f = &now.model.feet[foot];
        let [a, b] = [f.heel, f.toe].map(|p| now.kinematics.point(f.link, p)[0]);
        [a.min(b), a.max(b)]
    }

    fn begin(&mut self, now: &Sensors, phase: Phase) {
        self.phase = phase;
        self.since = now.time;
        if let Phase::Swing { foot, .. } | Phase::Close { foot, .. } | Phase::Draw { foot, .. } =
            phase
        {
            self.from = Self::sole(now, foot);
        }
    }

    /// Begins a step towards where the capture point has gone.
    fn begin_swing(&mut self, now: &Sensors) {
        let [a, b] = [Self::sole(now, 0)[0], Self::sole(now, 1)[0]];
        let forward = now.capture_point > 0.5 * (a + b);
        // The foot that is behind; of two that are beside each other, the one that carries less.
        let ahead = if forward { a - b } else { b - a };
        let load = now.feet[0].force[1] - now.feet[1].force[1];
        let unloaded = usize::from(load > 0.0);
        let foot = match (now.feet[0].touching(), now.feet[1].touching()) {
            (true, false) if ahead > -0.3 => 1,
            (false, true) if ahead < 0.3 => 0,
            _ if ahead > 0.05 => 1,
            _ if ahead < -0.05 => 0,
            _ => unloaded,
        };
        self.swings += 1;
        self.begin(now, Phase::Swing { foot, forward });
    }

    /// Where the sole's middle of a swinging foot is to land, world x, m.
    fn landing(&self, now: &Sensors, foot: usize, forward: bool) -> f64 {
        let p = if forward {
            &self.spec.forward
        } else {
            &self.spec.backward
        };
        let [rear, front] = Self::ends(now, 1 - foot);
        let edge = if forward { front } else { rear };
        let left = (p.swing_time - (now.time - self.since)).max(0.0);
        let run =
            ((now.capture_point - edge) * (now.pendulum_rate() * left).exp()).clamp(-2.0, 2.0);
        let sign = if forward { 1.0 } else { -1.0 };
        let stance = Self::sole(now, 1 - foot)[0];
        // Who has to step again has stepped too short.
        let longer = LONGER * f64::from(self.swings.saturating_sub(1).min(5));
        let x = edge + p.reach * run + sign * (p.beyond + longer);
        stance + (x - stance).clamp(-self.spec.longest, self.spec.longest)
    }

    /// The swing's reference on the way from where it began to `to`.
    fn swing(&self, now: &Sensors, foot: usize, to: f64, time: f64, lift: f64) -> Swing {
        let s = (now.time - self.since) / time;
        let eased = smoothstep(s);
        let rate = if (0.0..1.0).contains(&s) {
            6.0 * s * (1.0 - s) / time
        } else {
            0.0
        };
        let from = self.from;
        // Up and down again, and on down until the ground is met.
        let start = (from[1] - now.ground).max(0.0) * (1.0 - eased);
        let (y, vy) = if s < 1.0 {
            let up = 4.0 * s * (1.0 - s);
            (lift * up + start, lift * 4.0 * (1.0 - 2.0 * s) / time)
        } else {
            (-0.3 * (s - 1.0) * time, -0.3)
        };
        Swing {
            foot,
            position: [from[0] + eased * (to - from[0]), now.ground + y],
            velocity: [rate * (to - from[0]), vy],
            angle: 0.0,
            stiffness: self.spec.swing_stiffness,
            weight: self.spec.swing_weight,
        }
    }

    /// Moves from phase to phase.
    fn advance(&mut self, now: &Sensors) {
        let elapsed = now.time - self.since;
        // Balanced over the very end of the support is no place to stay.
        let part = (elapsed / LEANING).min(1.0);
        let margin = self.spec.margin - part * (self.spec.margin + INSIDE);
        let strayed = now.base_of_support.is_some_and(|[rear, front]| {
            now.capture_point > front + margin || now.capture_point < rear - margin
        });
        match self.phase {
            Phase::Swing { foot, forward } => {
                let p = if forward {
                    &self.spec.forward
                } else {
                    &self.spec.backward
                };
                let landed = now.feet[foot].touching() && elapsed > 0.6 * p.swing_time;
                if landed {
                    self.begin(now, Phase::Catch { over: foot });
                }
            }
            Phase::Catch { over } => {
                if strayed {
                    self.begin_swing(now);
                    return;
                }
                let other = 1 - over;
                let [a, b] = [Self::sole(now, over)[0], Self::sole(now, other)[0]];
                if elapsed > STUCK && now.feet[over].touching() {
                    let to = b + 0.5 * (a - b);
                    self.begin(now, Phase::Draw { foot: other, to });
                    return;
                }
                let off = (now.capture_point - a).abs();
                // The longer it takes, the less exactly: in the end the sole is enough.
                let [rear, front] = Self::ends(now, over);
                let enough = (0.5 * (front - rear) - INSIDE).max(self.spec.close_within);
                let within = self.spec.close_within + part * (enough - self.spec.close_within);
                if off < within && now.feet[over].touching() {
                    if (a - b).abs() < 0.02 && now.feet[other].touching() {
                        self.begin(now, Phase::Settle);
                    } else {
                        self.begin(now, Phase::Close { foot: other, over });
                    }
                }
            }
            Phase::Close { foot, over } => {
                let [rear, front] = Self::ends(now, over);
                let m = self.spec.margin;
                if now.capture_point > front + m || now.capture_point < rear - m {
                    self.begin_swing(now);
                } else if elapsed > 0.7 * self.spec.close_time && now.feet[foot].touching() {
                    let apart = Self::sole(now, foot)[0] - Self::sole(now, over)[0];
                    if apart.abs() < 0.04 {
                        self.begin(now, Phase::Settle);
                    } else {
                        self.begin(now, Phase::Catch { over });
                    }
                }
            }
            Phase::Draw { foot, .. } => {
                if elapsed > 0.7 * DRAW && now.feet[foot].touching() {
                    let [a, b] = [Self::sole(now, 0)[0], Self::sole(now, 1)[0]];
                    let second = (now.capture_point - b).abs() < (now.capture_point - a).abs();
                    self.begin(
                        now,
                        Phase::Catch {
                            over: usize::from(second),
                        },
                    );
                }
            }
            Phase::Settle => {
                if strayed {
                    self.begin_swing(now);
                }
            }
        }
    }

    /// A reference that asks for no more acceleration than the pressure under the carrying feet can
    /// give, and that of bending: what is braked by bending the trunk has to be paid back.
    fn attainable(&self, now: &Sensors) -> f64 {
        let g = &self.spec.gains;
        let c = now.com[0];
        let (rear, front) = match self.phase {
            Phase::Swing { foot, .. } | Phase::Close { foot, .. } | Phase::Draw { foot, .. } => {
                Self::ends(now, 1 - foot).into()
            }
            Phase::Catch { .. } | Phase::Settle => now
                .base_of_support
                .unwrap_or([f64::NEG_INFINITY, f64::INFINITY])
                .into(),
        };
        let (rear, front) = (rear - self.spec.bend, front + self.spec.bend);
        let wish = g.kl * (self.over - c) - g.dl * now.com_velocity[0];
        let rate = now.pendulum_rate().powi(2);
        let given = wish.max(rate * (c - front)).min(rate * (c - rear));
        c + given / g.kl.max(1.0)
    }

    /// Sets the reference for the phase.
    fn aim(&mut self, now: &Sensors) {
        let passed = (now.time - self.time).clamp(0.0, 0.1);
        let [a, b] = [Self::sole(now, 0)[0], Self::sole(now, 1)[0]];
        let (goal, swing, lean) = match self.phase {
            Phase::Swing { foot, forward } => {
                let p = if forward {
                    &self.spec.forward
                } else {
                    &self.spec.backward
                };
                let to = self.landing(now, foot, forward);
                let swing = self.swing(now, foot, to, p.swing_time, p.lift);
                (Self::sole(now, 1 - foot)[0], Some(swing), p.lean)
            }
            Phase::Catch { over } => {
                // The longer it takes, the harder it leans: a wide stance pulls back.
                let foot = [a, b][over];
                let lean = (now.time - self.since) / LEANING;
                (foot + lean * (foot - now.com[0]), None, 0.0)
            }
            Phase::Close { foot, over } => {
                let to = [a, b][over];
                let swing = self.swing(now, foot, to, self.spec.close_time, self.spec.close_lift);
                (to, Some(swing), 0.0)
            }
            Phase::Draw { foot, to } => {
                let swing = self.swing(now, foot, to, DRAW, self.spec.close_lift);
                ([a, b][1 - foot], Some(swing), 0.0)
            }
            Phase::Settle => (0.5 * (a + b), None, 0.0),
        };
        let step = self.spec.glide * passed;
        self.over += (goal - self.over).clamp(-step, step);
        // A wide stance is a low one.
        let spread = 0.5 * (a - b);
        let drop = self.leg - (self.leg * self.leg - spread * spread).max(0.0).sqrt();
        let top = now.ground + self.height - drop;
        let y = top.min(self.reference.com[1] + self.spec.climb * passed);
        self.reference.com = [self.attainable(now), y];
        self.reference.com_velocity[0] = now.com_velocity[0];
        self.reference.pitch = lean;
        self.reference.swing = swing;
    }
}

impl Controller for Step {
    fn contract(&self) -> &Contract {
        &self.contract
    }

    fn enter(&mut self, now: &Sensors) {
        self.momentum.reset();
        self.over = now.com[0];
        self.swings = 0;
        self.reference.com = now.com;
        self.time = now.time;
        let outside = now
            .base_of_support
            .is_none_or(|[rear, front]| now.capture_point > front || now.capture_point < rear);
        if outside {
            self.begin_swing(now);
        } else {
            let [a, b] = [Self::sole(now, 0)[0], Self::sole(now, 1)[0]];
            let over = usize::from((now.capture_point - b).abs() < (now.capture_point - a).abs());
            self.begin(now, Phase::Catch { over });
        }
    }

    fn act(&mut self, now: &Sensors, torques: &mut [f64]) {
        self.advance(now);
        self.aim(now);
        self.time = now.time;
        let on_ground = now.base_of_support.is_some();
        if !(on_ground && self.momentum.torques(now, &self.reference, torques)) {
            self.servo.track(now, &self.reference.pose, 1.0, torques);
        }
    }

    fn clone_box(&self) -> Box<dyn Controller> {
        Box::new(self.clone())
    }

    fn reference_com(&self) -> Option<f64> {
        Some(self.over)
    }
}
