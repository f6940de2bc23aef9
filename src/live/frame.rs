//! What a watcher sees of a step.
//!
//! [`Session`], [`View`] → a frame as JSON, at most some 2 kB for one character.

use aplomb_framework::character::Point;
use aplomb_framework::control::{Controller, Supervisor};
use aplomb_framework::events::Refusal;
use aplomb_framework::input::Result;
use aplomb_framework::run::Simulation;
use aplomb_framework::scenario::ScheduledInput;
use aplomb_framework::sensing::{Feature, Sensors};
use aplomb_framework::world::Pull;
use serde::Serialize;

use crate::live::clauses;
use crate::live::session::Session;

/// In the place of a refusing clause.
const ON_COMMAND: i32 = -1;
const RECOVERING: i32 = -2;
const DECLINES: i32 = -3;

/// What one watcher wants to see beside the stage.
#[derive(Debug, Clone, Default)]
pub struct View {
    features: Vec<Feature>,
    /// Places of a character and of a controller in its pool.
    pub(super) inspect: Option<(usize, usize)>,
    /// Frames that were left out for this watcher, who was slow.
    pub dropped: u64,
}

impl View {
    /// Wants nothing beside the stage any more: the scene has other features and controllers.
    pub(super) fn forget(&mut self) {
        (self.features, self.inspect) = (Vec::new(), None);
    }

    pub(super) fn watch(&mut self, names: &[String], now: &Simulation) -> Result<()> {
        let model = now.world().characters()[0].body.model();
        let feature = |name: &String| {
            let mut feature: Feature = name.parse()?;
            feature.resolve(model)?;
            Ok(feature)
        };
        self.features = names.iter().map(feature).collect::<Result<_>>()?;
        Ok(())
    }
}

/// mm, mrad, mm/s: as much as anybody sees.
fn short(x: f64) -> f64 {
    (x * 1e3).round() / 1e3
}

/// 0.1 N, 0.1 N·m.
fn shorter(x: f64) -> f64 {
    (x * 10.0).round() / 10.0
}

fn point(p: Point) -> Point {
    p.map(short)
}

#[derive(Serialize)]
struct Frame<'a> {
    is: &'a str,
    n: u64,
    t: f64,
    first: u64,
    end: u64,
    past: bool,
    paused: bool,
    speed: f64,
    rtf: f64,
    steps_per_s: f64,
    dropped: u64,
    c: Vec<CharacterFrame>,
    p: Vec<f64>,
    drag: Option<DragFrame>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    watch: Vec<f64>,
    inspect: Option<InspectFrame>,
}

#[derive(Serialize)]
struct CharacterFrame {
    l: Vec<f64>,
    com: Point,
    v: Point,
    cop: Option<f64>,
    support: Option<Point>,
    ground: f64,
    capture: f64,
    reference: Option<f64>,
    active: Option<usize>,
    posture: &'static str,
    standing: bool,
    bids: Vec<(f64, Option<i32>, Option<f64>)>,
    touch: Vec<[f64; 4]>,
    torque: Vec<f64>,
}

#[derive(Serialize)]
struct DragFrame {
    at: Point,
    to: Point,
    force: Point,
}

#[derive(Serialize)]
struct InspectFrame {
    character: usize,
    controller: usize,
    /// s since it took over; none while another is active.
    elapsed: Option<f64>,
    probability: f64,
    pre: Vec<(u8, Option<f64>)>,
    post: Vec<(u8, Option<f64>)>,
    expected: Vec<(u8, Option<f64>)>,
}

impl Session {
    /// This step as a watcher sees it.
    #[must_use]
    pub fn frame(&self, view: &View) -> String {
        let world = self.now.world();
        let watch = view.features.iter();
        let frame = Frame {
            is: "frame",
            n: self.step,
            t: short(self.now.time()),
            first: 0,
            end: self.end,
            past: self.is_past(),
            paused: self.paused,
            speed: self.speed,
            rtf: (self.pace[0] * 100.0).round() / 100.0,
            steps_per_s: self.pace[1].round(),
            dropped: view.dropped,
            c: (0..self.now.actors().len())
                .map(|i| self.character(i))
                .collect(),
            p: world
                .prop_poses()
                .flatten()
                .map(|x| short(f64::from(x)))
                .collect(),
            drag: self.drag(),
            watch: watch.map(|f| short(f.value(self.now.sensors(0)))).collect(),
            inspect: view.inspect.and_then(|(c, k)| self.inspected(c, k)),
        };
        serde_json::to_string(&frame).unwrap_or_default()
    }

    /// The spring; while time stands still, the one that will pull.
    fn drag(&self) -> Option<DragFrame> {
        let world = self.now.world();
        let pull = match self.history.drag_at(self.step) {
            Some(
                input @ ScheduledInput::Drag {
                    what, point, to, ..
                },
            ) => {
                let dragged = what
                    .resolved(&self.now.sensors(input.character()).model)
                    .ok()?;
                let mut next = Pull::new(dragged, *point, *to);
                next.force = world.pull().map_or([0.0; 2], |now| now.force);
                next
            }
            Some(_) => return None,
            None => *world.pull()?,
        };
        Some(DragFrame {
            at: point(world.place_of(pull.dragged, pull.point)),
            to: point(pull.to),
            force: pull.force.map(shorter),
        })
    }

    fn character(&self, place: usize) -> CharacterFrame {
        let (now, actor) = (self.now.sensors(place), &self.now.actors()[place]);
        let links = now.kinematics.links.iter();
        let joints = now.model.joints().zip(now.state.rates());
        let limits = joints.map(|(joint, rate)| joint.muscles.range(*rate));
        CharacterFrame {
            l: links
                .flat_map(|l| [l.origin[0], l.origin[1], l.angle])
                .map(short)
                .collect(),
            com: point(now.com),
            v: point(now.com_velocity),
            cop: now.cop.map(short),
            support: now.base_of_support.map(point),
            ground: short(now.ground),
            capture: short(now.capture_point),
            reference: actor.supervisor.reference_com().map(short),
            active: actor.supervisor.active_index(),
            posture: now.posture.name(),
            standing: self.now.outcome(place).standing,
            bids: bids(&actor.supervisor, now),
            touch: touches(now),
            torque: actor
                .torques
                .iter()
                .zip(limits)
                .map(|(torque, [least, greatest])| shorter(torque.clamp(least, greatest)))
                .collect(),
        }
    }

    fn inspected(&self, character: usize, controller: usize) -> Option<InspectFrame> {
        let now = self.now.sensors(character);
        let supervisor = &self.now.actors().get(character)?.supervisor;
        let contract = supervisor.controllers().nth(controller)?.contract();
        let active = supervisor.active_index() == Some(controller);
        let elapsed = supervisor.active_for(now).filter(|_| active);
        let states = |c| {
            let states = clauses::states(c, now);
            let states = states.into_iter();
            states.map(|(holds, v)| (holds, v.map(short))).collect()
        };
        Some(InspectFrame {
            character,
            controller,
            elapsed: elapsed.map(short),
            probability: short(contract.precondition.probability(now)),
            pre: states(&contract.precondition),
            post: states(&contract.postcondition),
            expected: states(&contract.expected),
        })
    }
}

/// Of every controller its suitability, and the clause that refuses with its value.
fn bids(supervisor: &Supervisor, now: &Sensors) -> Vec<(f64, Option<i32>, Option<f64>)> {
    let bids = supervisor.bids(now);
    let bid = |(bid, controller): (&aplomb_framework::events::Bid, &dyn Controller)| {
        let (node, value) = match &bid.refusal {
            None => (None, None),
            Some(Refusal::OnCommandOnly) => (Some(ON_COMMAND), None),
            Some(Refusal::Recovering) => (Some(RECOVERING), None),
            Some(_) => {
                let precondition = &controller.contract().precondition;
                match clauses::refusing(precondition, now) {
                    Some((node, value)) => (i32::try_from(node).ok(), value.map(short)),
                    None => (Some(DECLINES), None),
                }
            }
        };
        (short(bid.suitability), node, value)
    };
    bids.iter().zip(supervisor.controllers()).map(bid).collect()
}

/// Where the character is touched, and by what force.
fn touches(now: &Sensors) -> Vec<[f64; 4]> {
    let touch = |contact: &aplomb_framework::sensing::LinkContact| {
        let [x, y] = contact.at?;
        let [fx, fy] = contact.force;
        Some([short(x), short(y), fx.round(), fy.round()])
    };
    now.contacts.iter().filter_map(touch).collect()
}
