//! A character's supervisor and what a run has shown of it: whether it stands, has fallen, stood up again.
//!
//! sensors, events of its supervisor → [`Actor`] → events, [`Outcome`].

use crate::character::Model;
use crate::control::{Controller, Supervisor};
use crate::events::{Event, EventKind};
use crate::sensing::{Posture, Sensors};

/// s for which a character must stand to be called standing.
pub const STANDING_FOR: f64 = 1.0;

/// A character's supervisor and what is known of its run so far.
#[derive(Debug, Clone)]
pub struct Actor {
    /// The supervisor of its repertoire.
    pub supervisor: Supervisor,
    /// As of the last step, N·m.
    pub torques: Vec<f64>,
    /// Largest torque of each joint so far, as applied, N·m.
    pub peak_torque: Vec<f64>,
    /// Least and greatest pitch of the trunk so far, rad; not a number before the first step.
    pub trunk_pitch: [f64; 2],
    /// Since when it has stood without a break, s.
    standing_since: Option<f64>,
    /// Whether it is down: something other than feet has supported it since it last stood.
    down: bool,
    /// When each posture was first seen, s.
    posture_seen: [Option<f64>; 8],
}

/// How a run ended for one character.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// Stood for the last second: only feet supported it, the centre of mass above 0.9 of its
    /// standing height, over the base of support, slower than 0.1 m/s.
    pub standing: bool,
    /// The active controller.
    pub active: String,
    /// Posture.
    pub posture: Posture,
    /// Centre of mass, m.
    pub com: [f64; 2],
    /// Its velocity, m/s.
    pub com_velocity: [f64; 2],
}

impl Actor {
    pub(crate) fn new(supervisor: Supervisor, model: &Model) -> Self {
        Self {
            supervisor,
            torques: vec![0.0; model.joint_count()],
            peak_torque: vec![0.0; model.joint_count()],
            trunk_pitch: [f64::NAN; 2],
            standing_since: None,
            down: false,
            posture_seen: [None; 8],
        }
    }

    /// Notes what the step showed.
    pub(crate) fn observe(&mut self, character: usize, now: &Sensors, events: &mut Vec<Event>) {
        let joints = now.model.joints().zip(now.state.rates());
        let peaks = self.peak_torque.iter_mut().zip(&self.torques);
        for ((peak, torque), (joint, rate)) in peaks.zip(joints) {
            let [least, greatest] = joint.muscles.range(*rate);
            *peak = peak.max(torque.clamp(least, greatest).abs());
        }
        let pitch = now.trunk_pitch();
        let [least, greatest] = self.trunk_pitch;
        self.trunk_pitch = [least.min(pitch), greatest.max(pitch)];
        self.posture_seen[now.posture as usize].get_or_insert(now.time);
        let time = now.time;
        let mut note = |kind| {
            events.push(Event {
                time,
                character,
                kind,
            });
        };
        for (_, kind) in self.supervisor.take_events() {
            note(kind);
        }
        if now.stands() {
            self.standing_since.get_or_insert(time);
        } else {
            self.standing_since = None;
        }
        if now.is_down() && !self.down {
            self.down = true;
            note(EventKind::Fell);
        } else if self.down && self.has_stood(time) {
            self.down = false;
            note(EventKind::Stood);
        }
    }

    /// Whether it has stood for long enough to be called standing.
    fn has_stood(&self, time: f64) -> bool {
        let enough = |since: f64| time - since >= STANDING_FOR - 1e-9;
        self.standing_since.is_some_and(enough)
    }

    /// How the run has ended if it ends at what is sensed now.
    pub(crate) fn outcome(&self, now: &Sensors) -> Outcome {
        Outcome {
            standing: self.has_stood(now.time),
            active: self.supervisor.active().unwrap_or_default().to_owned(),
            posture: now.posture,
            com: now.com,
            com_velocity: now.com_velocity,
        }
    }

    /// When it first took on a posture, s.
    pub(crate) fn first_in(&self, posture: Posture) -> Option<f64> {
        self.posture_seen[posture as usize]
    }
}
