//! The JSON of runs: events, ends, peak torques. Other people's scripts read these names.

use std::collections::BTreeMap;

use aplomb::framework::scenario::Scenario;
use aplomb::framework::simulation::{Outcome, Simulation};
use aplomb::framework::supervisor::Bid;
use aplomb::framework::trajectory::{Event, EventKind};
use serde::Serialize;

/// One run.
#[derive(Debug, Serialize)]
pub(super) struct RunJson {
    scenario: String,
    character: String,
    seed: u64,
    dt: f64,
    duration: f64,
    wall_s: f64,
    digest: String,
    events: Vec<EventJson>,
    end: EndJson,
    /// Of every character, where there are several.
    #[serde(skip_serializing_if = "Option::is_none")]
    ends: Option<Vec<EndJson>>,
    peak_torque: BTreeMap<String, f64>,
    /// The first expectation of the scenario that was not met.
    unmet: Option<String>,
}

/// How a character ended.
#[derive(Debug, Serialize)]
struct EndJson {
    standing: bool,
    active: String,
    posture: &'static str,
    com: [f64; 2],
    com_velocity: [f64; 2],
}

/// An event.
#[derive(Debug, Serialize)]
struct EventJson {
    t: f64,
    #[serde(flatten)]
    kind: KindJson,
    /// Where there are several.
    #[serde(skip_serializing_if = "Option::is_none")]
    character: Option<usize>,
}

#[derive(Debug, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
enum KindJson {
    Push {
        link: String,
        /// Horizontal, N·s.
        impulse: f64,
    },
    Command {
        text: String,
        accepted: bool,
    },
    Switch {
        from: Option<String>,
        to: String,
        why: String,
        #[serde(skip_serializing_if = "Option::is_none")]
        bids: Option<Vec<Bid>>,
    },
    Refused {
        command: String,
        controller: Option<String>,
        clause: String,
        value: Option<f64>,
    },
    Fell,
    Stood,
    Other {
        text: String,
    },
}

impl KindJson {
    fn new(kind: &EventKind, explain: bool) -> Self {
        match kind.clone() {
            EventKind::Push { link, impulse } => Self::Push {
                link,
                impulse: impulse[0],
            },
            EventKind::Command { text, accepted } => Self::Command { text, accepted },
            EventKind::Switch {
                from,
                to,
                why,
                bids,
            } => Self::Switch {
                from,
                to,
                why,
                bids: explain.then_some(bids),
            },
            EventKind::Refused {
                command,
                controller,
                clause,
                value,
            } => Self::Refused {
                command,
                controller,
                clause,
                value,
            },
            EventKind::Fell => Self::Fell,
            EventKind::Stood => Self::Stood,
            other => Self::Other {
                text: format!("{other:?}"),
            },
        }
    }
}

impl From<Outcome> for EndJson {
    fn from(outcome: Outcome) -> Self {
        Self {
            standing: outcome.standing,
            active: outcome.active,
            posture: outcome.posture.name(),
            com: outcome.com,
            com_velocity: outcome.com_velocity,
        }
    }
}

impl RunJson {
    /// Of a finished run that took `wall_s` s; with `explain`, switches carry all bids.
    pub(super) fn new(
        simulation: &Simulation,
        scenario: &Scenario,
        wall_s: f64,
        explain: bool,
    ) -> Self {
        let count = simulation.actors().len();
        let several = count > 1;
        let event = |e: &Event| EventJson {
            t: e.time,
            kind: KindJson::new(&e.kind, explain),
            character: several.then_some(e.character),
        };
        let ends = || (0..count).map(|i| simulation.outcome(i).into());
        let model = simulation.world().characters()[0].body.model();
        let joints = model.joints().map(|j| j.name.clone());
        let peaks = simulation.actors()[0].peak_torque.iter().copied();
        Self {
            scenario: scenario.name.clone(),
            character: model.name.clone(),
            seed: scenario.seed,
            dt: scenario.settings.dt,
            duration: scenario.duration,
            wall_s,
            digest: simulation.digest(),
            events: simulation.events().iter().map(event).collect(),
            end: simulation.outcome(0).into(),
            ends: several.then(|| ends().collect()),
            peak_torque: joints.zip(peaks).collect(),
            unmet: simulation.disappointment(&scenario.expect),
        }
    }
}
