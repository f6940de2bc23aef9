//! The JSON of runs: events, ends, peak torques. Other people's scripts read these names.

use std::collections::BTreeMap;

use aplomb::framework::events::{Bid, Event, EventKind, Found, Reason, Unmet};
use aplomb::framework::run::{Outcome, Simulation};
use aplomb::framework::scenario::Scenario;
use serde::Serialize;
use serde_json::{Map, Value};

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
    /// Least and greatest pitch of the trunk, rad, leaning back positive.
    trunk_pitch: [f64; 2],
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
    kind: Map<String, Value>,
    /// Where there are several.
    #[serde(skip_serializing_if = "Option::is_none")]
    character: Option<usize>,
}

/// An event's name and fields, in the names of the JSON: `why` for a switch's reason, `clause` and
/// `value` for what did not hold, `impulse` for the horizontal part. Bids only if they are wanted.
fn fields(kind: &EventKind, explain: bool) -> Map<String, Value> {
    let mut fields = Map::new();
    fields.insert("kind".to_owned(), kind.name().into());
    let tagged = serde_json::to_value(kind).unwrap_or_default();
    let inner = tagged.as_object().and_then(|o| o.values().next());
    for (name, value) in inner.and_then(Value::as_object).into_iter().flatten() {
        match name.as_str() {
            "impulse" | "bids" | "reason" | "unmet" => {}
            _ => drop(fields.insert(name.clone(), value.clone())),
        }
    }
    match kind {
        EventKind::Push { impulse, .. } => {
            fields.insert("impulse".to_owned(), impulse[0].into());
        }
        EventKind::Switch { reason, bids, .. } => {
            fields.insert("why".to_owned(), reason.to_string().into());
            if let Reason::Failed(unmet) = reason {
                clause(&mut fields, unmet);
            }
            if explain {
                fields.insert("bids".to_owned(), bids.iter().map(bid).collect());
            }
        }
        EventKind::Refused { unmet, .. } => clause(&mut fields, unmet),
        _ => {}
    }
    fields
}

fn clause(fields: &mut Map<String, Value>, unmet: &Unmet) {
    let text = match unmet.found {
        Found::Value(_) => unmet.clause.clone(),
        _ => unmet.to_string(),
    };
    fields.insert("clause".to_owned(), text.into());
    fields.insert("value".to_owned(), unmet.value().into());
}

fn bid(bid: &Bid) -> Value {
    let mut value = serde_json::to_value(bid).unwrap_or_default();
    value["refusal"] = bid.refusal.as_ref().map(ToString::to_string).into();
    value
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
            kind: fields(&e.kind, explain),
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
            trunk_pitch: simulation.actors()[0].trunk_pitch,
            unmet: simulation.unmet(&scenario.expect),
        }
    }
}
