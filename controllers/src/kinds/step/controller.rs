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

use aplomb_framework::character::Model;
use aplomb_framework::control::{Contract, Controller, Spec};
use aplomb_framework::input::Result;
use aplomb_framework::sensing::Sensors;

use crate::kinds::step::soles::{beyond, carried, ends, nearer, sole};
use crate::kinds::step::spec::StepSpec;
use crate::momentum::{Formulation, Upright};

/// s after which catching aims twice as far as the foot.
pub(super) const LEANING: f64 = 0.5;

/// s of catching after which the stance is too wide.
const STUCK: f64 = 1.2;
/// s that drawing a foot nearer takes.
pub(super) const DRAW: f64 = 0.3;
/// m by which each further step is longer than the one before.
pub(super) const LONGER: f64 = 0.06;
/// m inside the ends of a sole that the capture point has to be for the other foot to leave.
const INSIDE: f64 = 0.04;

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Phase {
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
    pub(super) contract: Contract,
    pub(super) spec: StepSpec,
    pub(super) upright: Upright,
    /// Length of a leg with half of the pelvis, for the height of a wide stance, m.
    pub(super) leg: f64,
    pub(super) phase: Phase,
    /// When the phase began, s.
    pub(super) since: f64,
    /// Where the swinging sole began, m.
    pub(super) from: [f64; 2],
    /// Where the centre of mass is to come, world x, m.
    pub(super) over: f64,
    /// Protective swings so far.
    pub(super) swings: u32,
    pub(super) arms: Vec<Arm>,
}

/// The joints of an arm that swings with the legs.
#[derive(Debug, Clone, Copy)]
pub(super) struct Arm {
    pub(super) shoulder: usize,
    /// Of the same side, and of the other.
    pub(super) hip: usize,
    pub(super) opposite_hip: usize,
    /// The shoulder's angle in the reference pose, rad.
    pub(super) hangs: f64,
}

/// Those whose shoulder and hip have the usual names.
fn arms(model: &Model, pose: &[f64]) -> Vec<Arm> {
    let joint = |stem: &str, side: &str| model.joint_index(&format!("{stem}_{side}")).ok();
    let arm = |[side, other]: [&str; 2]| {
        let shoulder = joint("shoulder", side)?;
        Some(Arm {
            shoulder,
            hip: joint("hip", side)?,
            opposite_hip: joint("hip", other)?,
            hangs: pose[shoulder],
        })
    };
    [["r", "l"], ["l", "r"]]
        .into_iter()
        .filter_map(arm)
        .collect()
}

impl Spec for StepSpec {
    const KIND: &'static str = "step";

    fn build(self, contract: Contract, model: &Arc<Model>) -> Result<Box<dyn Controller>> {
        let upright = Upright::new(
            model,
            Formulation::Inequality,
            self.gains.clone(),
            &self.pose,
            &self.joint_weights,
        )?;
        self.check(model)?;
        Ok(Box::new(Step {
            arms: arms(model, &upright.reference.pose),
            upright,
            leg: model.standing_height(),
            phase: Phase::Settle,
            since: 0.0,
            from: [0.0; 2],
            over: 0.0,
            swings: 0,
            spec: self,
            contract,
        }))
    }
}

impl Step {
    fn begin(&mut self, now: &Sensors, phase: Phase) {
        self.phase = phase;
        self.since = now.time;
        if let Phase::Swing { foot, .. } | Phase::Close { foot, .. } | Phase::Draw { foot, .. } =
            phase
        {
            self.from = sole(now, foot);
        }
    }

    /// Begins a step towards where the capture point has gone.
    fn begin_swing(&mut self, now: &Sensors) {
        let [a, b] = [sole(now, 0)[0], sole(now, 1)[0]];
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

    /// Moves from phase to phase.
    fn advance(&mut self, now: &Sensors) {
        let elapsed = now.time - self.since;
        // Balanced over the very end of the support is no place to stay.
        let part = (elapsed / LEANING).min(1.0);
        let margin = self.spec.margin - part * (self.spec.margin + INSIDE);
        let strayed = carried(now).is_some_and(|span| beyond(now.capture_point, span, margin));
        match self.phase {
            Phase::Swing { foot, forward } => {
                let p = self.placement(forward);
                let landed = now.feet[foot].touching() && elapsed > 0.6 * p.swing_time;
                if landed {
                    self.begin(now, Phase::Catch { over: foot });
                }
            }
            Phase::Catch { over } => {
                if self.swings == 0 && elapsed < self.spec.reaction {
                    return;
                }
                if strayed {
                    self.begin_swing(now);
                    return;
                }
                let other = 1 - over;
                let [a, b] = [sole(now, over)[0], sole(now, other)[0]];
                if elapsed > STUCK && now.feet[over].touching() {
                    let to = b + 0.5 * (a - b);
                    self.begin(now, Phase::Draw { foot: other, to });
                    return;
                }
                let off = (now.capture_point - a).abs();
                // The longer it takes, the less exactly: in the end the sole is enough.
                let [rear, front] = ends(now, over);
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
                if beyond(now.capture_point, ends(now, over), self.spec.margin) {
                    self.begin_swing(now);
                } else if elapsed > 0.7 * self.spec.close_time && now.feet[foot].touching() {
                    let apart = sole(now, foot)[0] - sole(now, over)[0];
                    if apart.abs() < 0.04 {
                        self.begin(now, Phase::Settle);
                    } else {
                        self.begin(now, Phase::Catch { over });
                    }
                }
            }
            Phase::Draw { foot, .. } => {
                if elapsed > 0.7 * DRAW && now.feet[foot].touching() {
                    self.begin(now, Phase::Catch { over: nearer(now) });
                }
            }
            Phase::Settle => {
                if strayed {
                    self.begin_swing(now);
                }
            }
        }
    }
}

impl Controller for Step {
    fn contract(&self) -> &Contract {
        &self.contract
    }

    fn enter(&mut self, now: &Sensors) {
        self.upright.enter(now);
        self.over = now.com[0];
        self.swings = 0;
        let support = now.base_of_support;
        let leaves = support.is_none_or(|support| beyond(now.capture_point, support, 0.0));
        if leaves && self.spec.reaction <= 0.0 {
            self.begin_swing(now);
        } else {
            self.begin(now, Phase::Catch { over: nearer(now) });
        }
    }

    fn act(&mut self, now: &Sensors, torques: &mut [f64]) {
        self.advance(now);
        self.aim(now);
        self.upright.act(now, torques);
    }

    fn clone_box(&self) -> Box<dyn Controller> {
        Box::new(self.clone())
    }

    fn reference_com(&self) -> Option<f64> {
        Some(self.over)
    }
}
