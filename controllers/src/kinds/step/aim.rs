//! Where a step's phases aim: the swinging foot, and the centre of mass.
//!
//! sensors + phase → the reference of momentum control.

use aplomb_framework::math::{exp, square};
use aplomb_framework::sensing::Sensors;

use crate::kinds::step::controller::{DRAW, LEANING, LONGER, Phase, Step};
use crate::kinds::step::soles::{ends, sole};
use crate::kinds::step::spec::Placement;
use crate::momentum::{Swing, glided};
use crate::servo::smoothstep;

/// The furthest that an arm swings either way, rad.
const ARM: f64 = 0.8;
/// The furthest that the head turns against the trunk, rad.
const HEAD: f64 = 0.8;

impl Step {
    /// How a foot is put down in a direction.
    pub(super) fn placement(&self, forward: bool) -> &Placement {
        if forward {
            &self.spec.forward
        } else {
            &self.spec.backward
        }
    }

    /// Where the sole's middle of a swinging foot is to land, world x, m.
    fn landing(&self, now: &Sensors, foot: usize, forward: bool) -> f64 {
        let p = self.placement(forward);
        let [rear, front] = ends(now, 1 - foot);
        let edge = if forward { front } else { rear };
        let left = (p.swing_time - (now.time - self.since)).max(0.0);
        let run = ((now.capture_point - edge) * exp(now.pendulum_rate() * left)).clamp(-2.0, 2.0);
        let sign = if forward { 1.0 } else { -1.0 };
        let stance = sole(now, 1 - foot)[0];
        // Who has to step again has stepped too short.
        let longer = LONGER * f64::from(self.swings.saturating_sub(1).min(5));
        let x = edge + p.reach * run + sign * (p.beyond + longer);
        stance + (x - stance).clamp(-self.spec.longest, self.spec.longest)
    }

    /// The swing's reference on the way from where it began to `to`.
    fn swing(&self, now: &Sensors, foot: usize, to: f64, time: f64, lift: f64) -> Swing {
        let s = (now.time - self.since) / time;
        // It leaves the ground before it goes anywhere.
        let lifting = self.spec.lifting;
        let along = (s - lifting) / (1.0 - lifting);
        let eased = smoothstep(along);
        let rate = if (0.0..1.0).contains(&along) {
            6.0 * along * (1.0 - along) / ((1.0 - lifting) * time)
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

    /// A reference that asks for no more acceleration than the pressure under the carrying feet can
    /// give, and that of bending: what is braked by bending the trunk has to be paid back.
    fn attainable(&self, now: &Sensors) -> f64 {
        let g = &self.spec.gains;
        let c = now.com[0];
        let (rear, front) = match self.phase {
            Phase::Swing { foot, .. } | Phase::Close { foot, .. } | Phase::Draw { foot, .. } => {
                ends(now, 1 - foot).into()
            }
            Phase::Catch { .. } | Phase::Settle => now
                .base_of_support
                .unwrap_or([f64::NEG_INFINITY, f64::INFINITY])
                .into(),
        };
        let (rear, front) = (rear - self.spec.bend, front + self.spec.bend);
        let wish = g.kl * (self.over - c) - g.dl * now.com_velocity[0];
        let rate = square(now.pendulum_rate());
        let given = wish.max(rate * (c - front)).min(rate * (c - rear));
        c + given / g.kl.max(1.0)
    }

    /// Sets the reference for the phase.
    pub(super) fn aim(&mut self, now: &Sensors) {
        let passed = self.upright.passed(now);
        let [a, b] = [sole(now, 0)[0], sole(now, 1)[0]];
        let (goal, swing, lean) = match self.phase {
            Phase::Swing { foot, forward } => {
                let p = self.placement(forward);
                let to = self.landing(now, foot, forward);
                let swing = self.swing(now, foot, to, p.swing_time, p.lift);
                ([a, b][1 - foot], Some(swing), p.lean)
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
        self.over = glided(self.over, goal, step);
        // A wide stance is a low one.
        let spread = 0.5 * (a - b);
        let drop = self.leg - (self.leg * self.leg - spread * spread).max(0.0).sqrt();
        let top = now.ground + self.upright.height - drop;
        let x = self.attainable(now);
        let reference = &mut self.upright.reference;
        reference.com = [x, top.min(reference.com[1] + self.spec.climb * passed)];
        reference.com_velocity[0] = now.com_velocity[0];
        reference.pitch = lean;
        // Arms swing against the legs; the head may stay upright.
        let angles = now.state.angles();
        for limb in &self.arms {
            let ahead = angles[limb.opposite_hip] - angles[limb.hip];
            let swing = (0.5 * self.spec.arm_swing * ahead).clamp(-ARM, ARM);
            reference.pose[limb.shoulder] = limb.hangs + swing;
        }
        if let (true, Some(neck)) = (self.spec.gaze, now.model.head.checked_sub(1)) {
            reference.pose[neck] = (-now.trunk_pitch()).clamp(-HEAD, HEAD);
        }
        reference.swing = swing;
    }
}
