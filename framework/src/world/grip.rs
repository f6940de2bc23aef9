//! Hands that hold: while they are closed, each takes the prop that it touches by a hinge.
//!
//! closed hands, contacts → hinges; loads of hinges → what slips.
//!
//! - A hand takes what its link touches within [`REACH`] of its tip, the nearest point first.
//! - The hinge is at the point of touch, as soft as flesh ([`FREQUENCY`], critically damped), so
//!   that nothing jumps and a catch is spread over some 10 ms.
//! - It slips when its force, low-pass filtered over 10 ms, exceeds the prop's grip. The hand then
//!   lets the prop be for [`SLIPPED`].
//! - While it is held, prop and holding link do not collide; other links and the prop do.

use rapier2d::prelude::*;

use crate::character::Model;
use crate::math::hypot;
use crate::world::body::Body;
use crate::world::contact::{each_point, other};
use crate::world::fastening::Fastening;
use crate::world::prop::Placed;
use crate::world::settings::Settings;

/// Distance from the hand's tip within which a touch is a grasp, m.
const REACH: f64 = 0.12;
/// s for which a hand does not take again what has slipped from it.
const SLIPPED: f64 = 0.5;
/// Natural frequency of a grip, Hz.
const FREQUENCY: f32 = 30.0;

/// A character's hands.
#[derive(Debug, Clone)]
pub(crate) struct Grips {
    closed: bool,
    /// One a hand, in the model's order.
    hands: Vec<Hold>,
}

/// What one hand holds.
#[derive(Debug, Clone, Default)]
struct Hold {
    /// Place of the prop, and the hinge.
    held: Option<(usize, Fastening)>,
    /// Place of the prop that has slipped from it last, and the step until which it lets it be.
    slipped: Option<(usize, u64)>,
}

/// What the engine knows of touches.
pub(crate) struct Touched<'a> {
    pub(crate) bodies: &'a RigidBodySet,
    pub(crate) colliders: &'a ColliderSet,
    pub(crate) narrow_phase: &'a NarrowPhase,
}

impl Grips {
    /// Open hands.
    pub(crate) fn new(model: &Model) -> Self {
        Self {
            closed: false,
            hands: vec![Hold::default(); model.hands.len()],
        }
    }

    /// Closes or opens the hands. Open hands let go at once.
    pub(crate) fn close(&mut self, closed: bool, joints: &mut ImpulseJointSet) {
        self.closed = closed;
        if closed {
            return;
        }
        for hand in &mut self.hands {
            if let Some((_, hinge)) = hand.held.take() {
                hinge.undo(joints);
            }
        }
    }

    /// Whether any hand holds the prop.
    pub(crate) fn holds(&self, prop: usize) -> bool {
        let held = |h: &Hold| h.held.as_ref().is_some_and(|(p, _)| *p == prop);
        self.hands.iter().any(held)
    }

    /// Closed and empty hands take what they touch; `taken` hears of link and prop.
    pub(crate) fn take(
        &mut self,
        body: &Body,
        props: &[Placed],
        step: u64,
        engine: &Touched<'_>,
        joints: &mut ImpulseJointSet,
        mut taken: impl FnMut(usize, usize),
    ) {
        if !self.closed {
            return;
        }
        let Touched {
            bodies,
            colliders,
            narrow_phase,
        } = engine;
        for (hand, hold) in body.model().hands.iter().zip(&mut self.hands) {
            if hold.held.is_some() {
                continue;
            }
            let own = body.collider(hand.link);
            let mut nearest: Option<(f64, usize, [f64; 2])> = None;
            for pair in narrow_phase.contact_pairs_with(own) {
                let thing = other(pair, own);
                let Some(prop) = props.iter().position(|p| p.collider == thing) else {
                    continue;
                };
                let shunned = |(p, until): (usize, u64)| p == prop && step < until;
                if props[prop].prop.grip <= 0.0 || hold.slipped.is_some_and(shunned) {
                    continue;
                }
                // Forces are of no interest here but for whether there are any.
                each_point(pair, own, colliders, 1.0, |p| {
                    let [x, y] = [p.in_body[0] - hand.tip[0], p.in_body[1] - hand.tip[1]];
                    let away = hypot(x, y);
                    if p.touches() && away <= nearest.map_or(REACH, |n| n.0) {
                        nearest = Some((away, prop, p.in_body));
                    }
                });
            }
            let Some((_, prop, at)) = nearest else {
                continue;
            };
            let (link, thing) = (body.link(hand.link), &props[prop]);
            let at = crate::world::vector::vector(at);
            let there = bodies[link].position().transform_point(at);
            let to = bodies[thing.body].position().inverse_transform_point(there);
            let flesh = SpringCoefficients::new(FREQUENCY, 1.0);
            let ends = [(link, at), (thing.body, to)];
            let hinge = Fastening::new(joints, ends, thing.prop.grip, Some(flesh));
            hold.held = Some((prop, hinge));
            taken(hand.link, prop);
        }
    }

    /// After a step: what has become too heavy slips; `slipped` hears of link and prop.
    pub(crate) fn slip(
        &mut self,
        body: &Body,
        step: u64,
        joints: &mut ImpulseJointSet,
        settings: &Settings,
        mut slipped: impl FnMut(usize, usize),
    ) {
        for (hand, part) in self.hands.iter_mut().zip(&body.model().hands) {
            let Some((prop, mut hinge)) = hand.held.take() else {
                continue;
            };
            if hinge.bears(joints, settings) {
                hand.held = Some((prop, hinge));
            } else {
                hinge.undo(joints);
                let steps = (SLIPPED / settings.dt).round() as u64;
                hand.slipped = Some((prop, step + steps));
                slipped(part.link, prop);
            }
        }
    }
}
