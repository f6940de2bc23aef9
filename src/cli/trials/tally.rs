//! Sums over trials that do not depend on the order in which the trials finish.
//!
//! [`FinishedTrial`] → [`Tally`]; tallies of several threads → one.

use std::collections::BTreeMap;

use aplomb::framework::events::{EventKind, Reason, Role};
use serde::Serialize;
use xxhash_rust::xxh3::xxh3_128;

use super::falls::{FallRecord, HeadHit};
use super::plan::FinishedTrial;

/// s; shorter activations are told, unless a failure or a command ended them.
const SHORT: f64 = 0.05;

/// What one controller did.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub(super) struct Activations {
    pub(super) activations: u64,
    pub(super) succeeded: u64,
    pub(super) failed: u64,
}

/// A trial that does not stand at its end.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct FailedTrial {
    pub(super) index: u64,
    pub(super) link: Option<String>,
    pub(super) impulse: Option<f64>,
    pub(super) posture: &'static str,
    /// The active controller.
    pub(super) active: String,
}

/// Falls in one direction.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct FallTally {
    pub(super) count: u64,
    /// See [`FallRecord::broken_well`].
    pub(super) broken_well: u64,
    /// Of the falls in which the head touched.
    pub(super) head_hits: Vec<HeadHit>,
    /// N, see [`FallRecord::trunk_force`].
    pub(super) trunk_forces: Vec<f64>,
}

/// The sums.
#[derive(Debug, Default)]
pub(super) struct Tally {
    count: u64,
    pub(super) standing: u64,
    pub(super) fell: u64,
    pub(super) stepped: u64,
    pub(super) steps: u64,
    /// s, of the trials that got up (again).
    pub(super) times_to_stand: Vec<f64>,
    /// From one controller to another.
    pub(super) switches: u64,
    pub(super) short_activations: u64,
    pub(super) controllers: BTreeMap<String, Activations>,
    failures: Vec<FailedTrial>,
    /// Sum of the hashes of the trials' indices and digests.
    digest: u128,
    pub(super) forward: FallTally,
    pub(super) backward: FallTally,
}

impl Tally {
    /// Nothing yet, for these controllers.
    pub(super) fn new(pool: &[String]) -> Self {
        let none = |name: &String| (name.clone(), Activations::default());
        Self {
            controllers: pool.iter().map(none).collect(),
            ..Self::default()
        }
    }

    /// Number of trials.
    pub(super) fn count(&self) -> u64 {
        self.count
    }

    /// Of all trials, as 32 hexadecimal digits. Each trial's digest goes in with its index, so that
    /// neither the order nor the number of threads changes it.
    pub(super) fn digest(&self) -> String {
        format!("{:032x}", self.digest)
    }

    /// In the order of their indices.
    pub(super) fn failures(&mut self) -> &[FailedTrial] {
        self.failures.sort_by_key(|f| f.index);
        &self.failures
    }

    /// Takes in a trial.
    pub(super) fn take(&mut self, trial: &FinishedTrial) {
        self.count += 1;
        let hash = xxh3_128(format!("{} {}", trial.index, trial.digest).as_bytes());
        self.digest = self.digest.wrapping_add(hash);
        self.steps += trial.steps;
        self.standing += u64::from(trial.standing);
        self.fell += u64::from(!trial.falls.is_empty());
        self.times_to_stand.extend(trial.time_to_stand);
        for fall in &trial.falls {
            self.of(fall.forward).take(fall);
        }
        if !trial.standing {
            self.failures.push(FailedTrial {
                index: trial.index,
                link: trial.push.as_ref().map(|p| p.0.clone()),
                impulse: trial.push.as_ref().map(|p| p.1),
                posture: trial.posture,
                active: trial.active.clone(),
            });
        }
        self.take_switches(trial);
    }

    fn of(&mut self, forward: bool) -> &mut FallTally {
        if forward {
            &mut self.forward
        } else {
            &mut self.backward
        }
    }

    fn take_switches(&mut self, trial: &FinishedTrial) {
        // Only one is active at a time.
        let mut since: Option<f64> = None;
        let mut stepped = false;
        for event in &trial.events {
            let EventKind::Switch {
                from,
                to,
                role,
                reason,
                ..
            } = &event.kind
            else {
                continue;
            };
            self.controllers.entry(to.clone()).or_default().activations += 1;
            stepped |= *role == Role::Step;
            let began = since.replace(event.time);
            let Some(from) = from else { continue };
            self.switches += u64::from(from != to);
            let failed = matches!(reason, Reason::Failed(_));
            let former = self.controllers.entry(from.clone()).or_default();
            former.succeeded += u64::from(*reason == Reason::Succeeded);
            former.failed += u64::from(failed);
            let lasted = began.map(|t| event.time - t);
            let short = lasted.is_some_and(|s| s < SHORT - 1e-9);
            self.short_activations += u64::from(short && !failed && *reason != Reason::Command);
        }
        self.stepped += u64::from(stepped);
    }

    /// Both together.
    pub(super) fn merged(mut self, other: Self) -> Self {
        self.count += other.count;
        self.standing += other.standing;
        self.fell += other.fell;
        self.stepped += other.stepped;
        self.steps += other.steps;
        self.times_to_stand.extend(other.times_to_stand);
        self.switches += other.switches;
        self.short_activations += other.short_activations;
        for (name, theirs) in other.controllers {
            let ours = self.controllers.entry(name).or_default();
            ours.activations += theirs.activations;
            ours.succeeded += theirs.succeeded;
            ours.failed += theirs.failed;
        }
        self.digest = self.digest.wrapping_add(other.digest);
        self.failures.extend(other.failures);
        self.forward.merge(other.forward);
        self.backward.merge(other.backward);
        self
    }
}

impl FallTally {
    fn take(&mut self, fall: &FallRecord) {
        self.count += 1;
        self.broken_well += u64::from(fall.broken_well());
        self.head_hits.extend(fall.head_hit());
        self.trunk_forces.push(fall.trunk_force);
    }

    /// Both together.
    pub(super) fn merge(&mut self, other: Self) {
        self.count += other.count;
        self.broken_well += other.broken_well;
        self.head_hits.extend(other.head_hits);
        self.trunk_forces.extend(other.trunk_forces);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use aplomb::framework::events::{Event, Unmet};

    fn trial(index: u64, switches: &[(f64, &str, &str, Reason)]) -> FinishedTrial {
        let event = |(time, from, to, reason): &(f64, &str, &str, Reason)| Event {
            time: *time,
            character: 0,
            kind: EventKind::Switch {
                from: Some((*from).to_owned()).filter(|f| !f.is_empty()),
                to: (*to).to_owned(),
                role: match *to {
                    "side" => Role::Step,
                    _ => Role::Other,
                },
                reason: reason.clone(),
                bids: Vec::new(),
            },
        };
        FinishedTrial {
            index,
            push: None,
            standing: index.is_multiple_of(2),
            posture: "supine",
            active: "rest".to_owned(),
            time_to_stand: None,
            events: switches.iter().map(event).collect(),
            falls: Vec::new(),
            steps: 1000,
            digest: format!("digest of {index}"),
        }
    }

    fn failed() -> Reason {
        Reason::Failed(Unmet::plain("x"))
    }

    #[test]
    fn switches_are_counted_for_both_controllers() {
        let mut tally = Tally::new(&["rest".to_owned()]);
        tally.take(&trial(
            0,
            &[
                (0.0, "", "stance", Reason::Start),
                (1.0, "stance", "side", failed()),
                (1.02, "side", "stance", Reason::Succeeded),
                (1.03, "stance", "bow", Reason::Command),
            ],
        ));
        assert_eq!((tally.switches, tally.stepped), (3, 1));
        assert_eq!(tally.short_activations, 1);
        let stance = tally.controllers["stance"];
        assert_eq!((stance.activations, stance.failed), (2, 1));
        assert_eq!(tally.controllers["side"].succeeded, 1);
        assert_eq!(tally.controllers["rest"], Activations::default());
    }

    #[test]
    fn short_activations_are_those_that_neither_failure_nor_command_ended() {
        let mut tally = Tally::new(&[]);
        tally.take(&trial(
            0,
            &[
                (0.0, "", "stance", Reason::Start),
                (0.02, "stance", "bow", Reason::Command),
                // Commanded again: a new activation, but no switch to another controller.
                (0.04, "bow", "bow", Reason::Command),
                (0.06, "bow", "stance", Reason::Succeeded),
                (0.08, "stance", "fall", failed()),
                (0.13, "fall", "rest", Reason::Succeeded),
                (0.179, "rest", "stance", Reason::Succeeded),
            ],
        ));
        assert_eq!((tally.switches, tally.short_activations), (5, 2));
        assert_eq!(tally.controllers["bow"].activations, 2);
    }

    #[test]
    fn the_order_of_trials_does_not_matter() {
        let part = |indices: [u64; 2]| {
            let mut tally = Tally::new(&[]);
            for i in indices {
                tally.take(&trial(i, &[]));
            }
            tally
        };
        let mut a = part([0, 1]).merged(part([3, 5]));
        let mut b = part([5, 3]).merged(part([1, 0]));
        assert_eq!(a.failures(), b.failures());
        assert_eq!(a.digest(), b.digest());
        assert_ne!(a.digest(), part([0, 1]).digest());
        assert_eq!((a.count(), a.standing), (4, 1));
    }
}
