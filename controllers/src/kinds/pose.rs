//! Pose control as data (2001 paper, "Pose and continuous control"): a finite state machine of target poses, each
//! held for a time or until something happens, so that a skill can be a file.
//!
//! Targets ease from one pose to the next; feedback rules add features of the situation to joint
//! targets (continuous control). Fails as its contract says, when a state ends short of what it
//! expects, or when the last pose does not bring the post-condition about within a second.

use std::collections::BTreeMap;
use std::sync::Arc;

use aplomb_framework::character::Model;
use aplomb_framework::control::{Condition, Contract, Controller, Progress, Spec};
use aplomb_framework::events::Unmet;
use aplomb_framework::input::{Error, Result, check};
use aplomb_framework::sensing::{Feature, Sensors};
use serde::{Deserialize, Serialize};

use crate::servo::{Servo, smoothstep};
use crate::target::{NamedAngles, joints_named, mirrored, overlay, set_apart};

/// What `next` and `then` call the end of the machine.
pub const END: &str = "end";

/// At most this many states.
pub const MOST_STATES: usize = 64;

/// s that the last pose is held for the post-condition to come about.
const GRACE: f64 = 1.0;

/// A state of the machine.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PoseState {
    /// What other states call it; none by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Target angles, rad; joints that are not named keep the last state's.
    #[serde(default)]
    pub pose: NamedAngles,
    /// How far the right limbs are ahead of the left, by stem, rad: half each way from the pose.
    #[serde(default, skip_serializing_if = "NamedAngles::is_empty")]
    pub apart: NamedAngles,
    /// s after which the next state begins.
    pub duration: f64,
    /// Part of the duration over which the targets ease in; then they hold.
    #[serde(default = "most", skip_serializing_if = "is_most")]
    pub ease: f64,
    /// Ends the state early when it holds.
    #[serde(default = "never", skip_serializing_if = "Condition::is_never")]
    pub until: Condition,
    /// What must hold when the state's time is up, or the controller has failed.
    #[serde(default = "always", skip_serializing_if = "Condition::is_always")]
    pub expects: Condition,
    /// Stiffness relative to the nominal servos.
    #[serde(default = "one", skip_serializing_if = "is_one")]
    pub stiffness: f64,
    /// Name of the state that follows when the time is up, or `end`; the next one if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub next: Option<String>,
    /// Name of the state that follows when `until` ends this one; as `next` if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub then: Option<String>,
}

fn most() -> f64 {
    0.7
}

fn one() -> f64 {
    1.0
}

fn never() -> Condition {
    Condition::Never
}

fn always() -> Condition {
    Condition::Always
}

fn is_most(x: &f64) -> bool {
    *x == most()
}

fn is_one(x: &f64) -> bool {
    *x == one()
}

/// Adds gain × feature to a joint's target.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Feedback {
    /// Joint or stem.
    pub joint: String,
    /// What is fed back; where it has no value the rule rests.
    pub feature: Feature,
    /// rad a unit of the feature.
    pub gain: f64,
}

/// Parameters of [`PoseController`] in a file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PoseSpec {
    /// Conditions that states refer to by name: `until: Named("squatting")`.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub conditions: BTreeMap<String, Condition>,
    /// The machine; it begins with the first.
    pub states: Vec<PoseState>,
    /// Rules that act in all states.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub feedback: Vec<Feedback>,
    /// Swaps left and right.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub mirror: bool,
    /// Damping relative to the nominal servos.
    #[serde(default = "one", skip_serializing_if = "is_one")]
    pub damping: f64,
    /// A parameter of the command that scales all targets; none by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scaled_by: Option<String>,
    /// A parameter of the command that scales all durations; none by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub slowed_by: Option<String>,
}

#[derive(Debug, Clone)]
struct Key {
    /// For messages: the state's name in quotes, or its place.
    name: String,
    pose: Vec<f64>,
    duration: f64,
    ease: f64,
    until: Condition,
    expects: Condition,
    stiffness: f64,
    next: usize,
    then: usize,
}

/// The controller.
#[derive(Debug, Clone)]
pub struct PoseController {
    contract: Contract,
    keys: Vec<Key>,
    feedback: Vec<(usize, Feature, f64)>,
    servo: Servo,
    scaled_by: Option<String>,
    slowed_by: Option<String>,
    scale: f64,
    slowness: f64,
    key: usize,
    since: f64,
    from: Vec<f64>,
    target: Vec<f64>,
    /// When the last state ended, s.
    ended: Option<f64>,
    /// Why it has failed, if it has.
    missed: Option<Unmet>,
}

impl Spec for PoseSpec {
    const KIND: &'static str = "pose";

    fn build(self, contract: Contract, model: &Arc<Model>) -> Result<Box<dyn Controller>> {
        let count = self.states.len();
        check::count("states", count, 1..=MOST_STATES, "states")?;
        check::within("damping", self.damping, 0.0..=1.0)?;
        self.check_names()?;
        let joints = model.joint_count();
        let mut pose = vec![0.0; joints];
        let mut keys = Vec::with_capacity(count);
        for (i, state) in self.states.iter().enumerate() {
            let of = |e: Error| e.inside(("states", i));
            let posed = overlay(model, &state.pose, &mut pose);
            posed.map_err(|e| of(e.inside("pose")))?;
            let mut key = self.key(i, state, model).map_err(of)?;
            key.pose.clone_from(&pose);
            let apart = set_apart(model, &state.apart, &mut key.pose);
            apart.map_err(|e| of(e.inside("apart")))?;
            if self.mirror {
                key.pose = mirrored(model, &key.pose);
            }
            keys.push(key);
        }
        let mut feedback = Vec::new();
        for (i, rule) in self.feedback.iter().enumerate() {
            let of = |e: Error| e.inside(("feedback", i));
            check::within("gain", rule.gain, -100.0..=100.0).map_err(of)?;
            let mut feature = rule.feature.clone();
            let named = feature.resolve(model);
            named.map_err(|e| of(e.inside("feature")))?;
            let named = joints_named(model, &rule.joint);
            for joint in named.map_err(|e| of(e.inside("joint")))? {
                let joint = if self.mirror {
                    model.mirrored_joint(joint)
                } else {
                    joint
                };
                feedback.push((joint, feature.clone(), rule.gain));
            }
        }
        contract.check_parameter("scaled_by", self.scaled_by.as_ref())?;
        contract.check_parameter("slowed_by", self.slowed_by.as_ref())?;
        Ok(Box::new(PoseController {
            servo: Servo::new(model, 1.0, self.damping),
            scale: 1.0,
            slowness: 1.0,
            scaled_by: self.scaled_by,
            slowed_by: self.slowed_by,
            keys,
            feedback,
            key: 0,
            since: 0.0,
            from: vec![0.0; joints],
            target: vec![0.0; joints],
            ended: None,
            missed: None,
            contract,
        }))
    }
}

impl PoseSpec {
    /// A state, still without its pose.
    fn key(&self, i: usize, state: &PoseState, model: &Model) -> Result<Key> {
        check::within("duration", state.duration, 0.0..=3600.0)?;
        check::within("ease", state.ease, 0.0..=1.0)?;
        check::within("stiffness", state.stiffness, 0.0..=3.0)?;
        let resolved = |field: &str, condition: &Condition| {
            let found = condition.named(&self.conditions).and_then(|mut condition| {
                condition.resolve(model)?;
                Ok(condition)
            });
            found.map_err(|e| e.inside(field))
        };
        let follower = |field: &str, name: &Option<String>, otherwise: usize| {
            let found = self.follower(name.as_deref(), otherwise);
            found.map_err(|e| e.inside(field))
        };
        let next = follower("next", &state.next, i + 1)?;
        let name = state.name.as_ref();
        Ok(Key {
            name: name.map_or_else(|| format!("state {i}"), |n| format!("'{n}'")),
            pose: Vec::new(),
            duration: state.duration,
            ease: state.ease,
            until: resolved("until", &state.until)?,
            expects: resolved("expects", &state.expects)?,
            stiffness: state.stiffness,
            next,
            then: follower("then", &state.then, next)?,
        })
    }

    /// Refuses a name that stands twice, or that is the end's.
    fn check_names(&self) -> Result<()> {
        for (i, state) in self.states.iter().enumerate() {
            let Some(name) = state.name.as_deref() else {
                continue;
            };
            let before = &self.states[..i];
            if name == END || before.iter().any(|s| s.name.as_deref() == Some(name)) {
                let accepted = "a name that no other state has, and not 'end'";
                let refused = Error::refused("name", format!("'{name}'"), accepted);
                return Err(refused.inside(("states", i)));
            }
        }
        Ok(())
    }

    /// Place of the state of this name, or `otherwise`; the number of states is the end.
    fn follower(&self, name: Option<&str>, otherwise: usize) -> Result<usize> {
        let Some(name) = name else {
            return Ok(otherwise);
        };
        if name == END {
            return Ok(self.states.len());
        }
        let mut names = self.states.iter().map(|s| s.name.as_deref());
        let known = || self.states.iter().filter_map(|s| s.name.as_deref());
        let unknown = || Error::unknown("state", name, known().chain([END]));
        names.position(|n| n == Some(name)).ok_or_else(unknown)
    }
}

impl PoseController {
    fn begin(&mut self, now: &Sensors, key: usize) {
        if key < self.keys.len() {
            self.key = key;
            self.since = now.time;
            self.from.copy_from_slice(&self.target);
        } else {
            self.ended = Some(now.time);
        }
    }

    /// Begins the state that follows, if this one is over.
    fn advance(&mut self, now: &Sensors) {
        let key = &self.keys[self.key];
        if key.until.holds(now) {
            self.begin(now, key.then);
        } else if now.time - self.since >= key.duration * self.slowness {
            if let Some(refusal) = key.expects.first_failure(now) {
                let after = format!("after {}:", key.name);
                self.missed = Some(refusal.expected().after(&after));
            }
            self.begin(now, key.next);
        }
    }
}

impl Controller for PoseController {
    fn contract(&self) -> &Contract {
        &self.contract
    }

    fn enter(&mut self, now: &Sensors) {
        self.ended = None;
        self.missed = None;
        self.target.copy_from_slice(now.state.angles());
        self.begin(now, 0);
    }

    fn act(&mut self, now: &Sensors, torques: &mut [f64]) {
        if self.ended.is_none() {
            self.advance(now);
        }
        let key = &self.keys[self.key];
        let duration = key.duration * self.slowness;
        let eased = smoothstep((now.time - self.since) / (key.ease * duration).max(1e-3));
        for ((target, from), to) in self.target.iter_mut().zip(&self.from).zip(&key.pose) {
            *target = from + eased * (self.scale * to - from);
        }
        // Feedback moves the torques' targets, not the machine's.
        self.servo.track(now, &self.target, key.stiffness, torques);
        for (joint, feature, gain) in &self.feedback {
            let value = feature.value(now);
            if value.is_finite() {
                torques[*joint] += key.stiffness * self.servo.stiffness(*joint) * gain * value;
            }
        }
    }

    fn clone_box(&self) -> Box<dyn Controller> {
        Box::new(self.clone())
    }

    fn progress(&self, now: &Sensors, elapsed: f64, kept: Option<f64>) -> Progress {
        let contract = &self.contract;
        if let Some(refusal) = contract.expected.first_failure(now) {
            return Progress::Failed(refusal.expected());
        }
        if let Some(missed) = &self.missed {
            return Progress::Failed(missed.clone());
        }
        // Success before the last state has been gone through would cut the motion short.
        if self.ended.is_some() && kept.is_some_and(|k| k >= contract.hold) {
            return Progress::Succeeded;
        }
        if self
            .ended
            .is_some_and(|e| now.time - e > contract.hold + GRACE)
            && kept.is_none()
        {
            return Progress::Failed(Unmet::plain("its last pose did not bring it about"));
        }
        if elapsed > contract.patience {
            return Progress::Failed(contract.out_of_patience());
        }
        Progress::Running
    }

    fn obey(&mut self, command: &aplomb_framework::control::Command) -> Result<bool> {
        if !self.contract.answers(command)? {
            return Ok(false);
        }
        let parameter = |name: &Option<String>| {
            name.as_ref()
                .map_or(1.0, |n| self.contract.parameter(Some(command), n, 1.0))
        };
        (self.scale, self.slowness) = (parameter(&self.scaled_by), parameter(&self.slowed_by));
        Ok(true)
    }
}
