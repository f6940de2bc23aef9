//! What a watcher is told once: who is there, what it is drawn as, what it promises, what can be set.
//!
//! [`Session`] → JSON.

use aplomb_framework::character::{Model, Point, Shape};
use aplomb_framework::control::{Answer, Contract, Controller};
use aplomb_framework::run::Simulation;
use aplomb_framework::scenario::Scenario;
use aplomb_framework::sensing::Feature;
use aplomb_framework::world::Prop;
use serde::Serialize;

use crate::figure::{FigurePart, figure};
use crate::live::clauses::Node;
use crate::live::session::Session;
use crate::scenarios;

/// Settings of every scenario that a slider moves, with its ends and whether the run begins anew.
const SETTINGS: [(&str, f64, f64, bool); 4] = [
    ("friction", 0.05, 1.5, false),
    ("gravity", 0.0, 20.0, false),
    ("mass", 0.5, 2.0, true),
    ("torque", 0.2, 2.0, true),
];

#[derive(Serialize)]
struct Hello<'a> {
    is: &'a str,
    version: &'a str,
    native: bool,
    scenario: ScenarioHello<'a>,
    dt: f64,
    characters: Vec<CharacterHello>,
    props: Vec<PropHello>,
    shipped: Shipped<'a>,
    features: Vec<FeatureHello>,
}

#[derive(Serialize)]
struct FeatureHello {
    name: String,
    unit: &'static str,
    meaning: &'static str,
}

#[derive(Serialize)]
struct ScenarioHello<'a> {
    name: &'a str,
    seed: u64,
    duration: f64,
    parameters: Vec<ParameterHello>,
}

#[derive(Serialize)]
struct ParameterHello {
    name: String,
    value: f64,
    min: f64,
    max: f64,
    restarts: bool,
}

#[derive(Serialize)]
struct CharacterHello {
    name: String,
    repertoire: String,
    links: Vec<LinkHello>,
    figure: Vec<FigurePart>,
    feet: Vec<usize>,
    trunk: usize,
    joints: Vec<JointHello>,
    controllers: Vec<ControllerHello>,
}

#[derive(Serialize)]
struct LinkHello {
    name: String,
    com: Point,
    grab: Vec<Point>,
    radius: f64,
}

#[derive(Serialize)]
struct JointHello {
    name: String,
    link: usize,
    range: Point,
    torque: [f64; 2],
}

#[derive(Serialize)]
struct ControllerHello {
    name: String,
    role: aplomb_framework::events::Role,
    weight: u32,
    learned: bool,
    patience: Option<f64>,
    stalls: Option<f64>,
    commands: Vec<Answer>,
    precondition: Node,
    postcondition: Node,
    expected: Node,
}

/// A prop as it is drawn: a ball about its origin by its radius alone, others by an outline that the
/// radius rounds.
#[derive(Serialize)]
pub(super) struct PropHello {
    name: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    outline: Option<Vec<Point>>,
    radius: f64,
}

#[derive(Serialize)]
struct Shipped<'a> {
    scenarios: Vec<&'a str>,
    characters: Vec<&'a str>,
    repertoires: Vec<&'a str>,
}

impl Session {
    /// What a watcher is told first, and again when the scene changes. `native` is whether it runs
    /// outside of the watcher's page.
    #[must_use]
    pub fn hello(&self, native: bool) -> String {
        let scenario = &self.scene.scenario;
        let hello = Hello {
            is: "hello",
            version: env!("CARGO_PKG_VERSION"),
            native,
            scenario: ScenarioHello {
                name: &scenario.name,
                seed: scenario.seed,
                duration: scenario.duration,
                parameters: parameters(scenario, &self.now),
            },
            dt: scenario.settings.dt,
            characters: (0..self.now.actors().len())
                .map(|i| self.character_hello(i))
                .collect(),
            props: props(&self.now, 0),
            shipped: Shipped {
                scenarios: scenarios::shipped().into_iter().map(|(n, _)| n).collect(),
                characters: Model::built_in().into_iter().map(|(n, _)| n).collect(),
                repertoires: self.registry.repertoires().collect(),
            },
            features: features(self.now.world().characters()[0].body.model()),
        };
        serde_json::to_string(&hello).unwrap_or_default()
    }

    fn character_hello(&self, place: usize) -> CharacterHello {
        let model = self.now.world().characters()[place].body.model();
        let supervisor = &self.now.actors()[place].supervisor;
        let links = model.links.iter().map(|link| {
            let outline = link.shape.outline();
            LinkHello {
                name: link.name.clone(),
                com: link.com,
                grab: outline.corners,
                radius: outline.radius,
            }
        });
        let joints = model.links.iter().enumerate().filter_map(|(i, link)| {
            let joint = link.joint.as_ref()?;
            Some(JointHello {
                name: joint.name.clone(),
                link: i,
                range: joint.range,
                torque: joint.muscles.limits(),
            })
        });
        CharacterHello {
            name: model.name.clone(),
            repertoire: supervisor.contract().name.clone(),
            links: links.collect(),
            figure: figure(model),
            feet: model.feet.iter().map(|f| f.link).collect(),
            trunk: model.trunk,
            joints: joints.collect(),
            controllers: supervisor
                .controllers()
                .map(|c| controller(c.contract()))
                .collect(),
        }
    }

    /// The props from a place on: those that have appeared.
    #[must_use]
    pub fn props(&self, from: usize) -> String {
        #[derive(Serialize)]
        struct Props<'a> {
            is: &'a str,
            from: usize,
            list: Vec<PropHello>,
        }
        let list = props(&self.now, from);
        let is = "props";
        serde_json::to_string(&Props { is, from, list }).unwrap_or_default()
    }
}

fn controller(contract: &Contract) -> ControllerHello {
    ControllerHello {
        name: contract.name.clone(),
        role: contract.role,
        weight: contract.weight,
        learned: contract.precondition.is_learned(),
        patience: contract.patience.is_finite().then_some(contract.patience),
        stalls: contract.stalls.is_finite().then_some(contract.stalls),
        commands: contract.commands.clone(),
        precondition: Node::of(&contract.precondition),
        postcondition: Node::of(&contract.postcondition),
        expected: Node::of(&contract.expected),
    }
}

fn props(run: &Simulation, from: usize) -> Vec<PropHello> {
    let shown = |prop: &Prop| {
        let outline = prop.shape.outline();
        let round =
            matches!(prop.shape, Shape::Capsule { from, to, .. } if from == to && to == [0.0; 2]);
        PropHello {
            name: prop.name.clone(),
            outline: (!round).then_some(outline.corners),
            radius: outline.radius,
        }
    };
    run.world().props().skip(from).map(shown).collect()
}

fn parameters(scenario: &Scenario, run: &Simulation) -> Vec<ParameterHello> {
    let own = scenario.parameters.iter().map(|(name, p)| ParameterHello {
        name: name.clone(),
        value: p.value,
        min: p.min,
        max: p.max,
        restarts: true,
    });
    let settings = run.world().settings();
    let common = SETTINGS
        .iter()
        .filter(|s| !scenario.parameters.contains_key(s.0));
    let common = common.map(|(name, min, max, restarts)| {
        let value = match *name {
            "friction" => settings.friction,
            "gravity" => settings.gravity,
            "mass" => settings.mass,
            _ => settings.torque,
        };
        ParameterHello {
            name: (*name).to_owned(),
            value,
            min: *min,
            max: *max,
            restarts: *restarts,
        }
    });
    own.chain(common).collect()
}

/// What can be watched: the vocabulary, and the angle and rate of every joint.
fn features(model: &Model) -> Vec<FeatureHello> {
    let hello = |(name, unit, meaning): (&str, &'static str, &'static str)| FeatureHello {
        name: name.to_owned(),
        unit,
        meaning,
    };
    let plain = Feature::vocabulary().map(hello);
    let joints = model.joints().flat_map(|j| {
        let (angle, rate) = (format!("angle.{}", j.name), format!("velocity.{}", j.name));
        [
            (angle, "rad", "angle of the joint"),
            (rate, "rad/s", "angular velocity of the joint"),
        ]
    });
    plain
        .chain(joints.map(|(name, unit, meaning)| hello((&name, unit, meaning))))
        .collect()
}
