//! What a watcher asks for.
//!
//! JSON → [`Request`], with every number within its bounds.

use aplomb_framework::character::{Point, Shape};
use aplomb_framework::input::{Error, Result, check};
use aplomb_framework::scenario::{Number, PropEntry};
use serde::Deserialize;

/// The largest message that is read, bytes.
pub const LARGEST_MESSAGE: usize = 4 << 10;
/// The largest message that opens a file, bytes.
pub const LARGEST_OPENED: usize = 512 << 10;
/// The strongest push, N·s each way.
const STRONGEST: f64 = 1000.0;
/// The furthest point that anything is dragged or thrown from, m.
const FURTHEST: f64 = 1000.0;
/// At most this many features are watched by one view.
const MOST_WATCHED: usize = 8;

/// A request, told apart by `do`.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(tag = "do", rename_all = "snake_case")]
pub enum Request {
    /// Goes on.
    Play,
    /// Stops.
    Pause,
    /// Stops after some steps more.
    Step {
        /// How many.
        #[serde(default = "one")]
        steps: u32,
    },
    /// Simulated seconds a second.
    Speed {
        /// 0.05 to 4.
        factor: f64,
    },
    /// Pushes a link.
    Push {
        /// Place of the character.
        #[serde(default)]
        character: usize,
        /// Name of the link.
        link: String,
        /// N·s, forward and up.
        impulse: Point,
    },
    /// Begins to drag, or drags on.
    Drag {
        /// What.
        #[serde(flatten)]
        body: DragBody,
        /// Where it is held, in its frame, m.
        point: Point,
        /// Where to, world, m.
        to: Point,
    },
    /// Lets go.
    Release,
    /// Throws or drops a new prop.
    Throw(Thrown),
    /// A command string.
    Command {
        /// Place of the character.
        #[serde(default)]
        character: usize,
        /// The text.
        text: String,
    },
    /// Sets a parameter of the scenario or a setting of the world.
    Set {
        /// Its name.
        name: String,
        /// Its value.
        value: f64,
    },
    /// Goes to a step and stops.
    Seek {
        /// Steps since the beginning.
        step: u64,
    },
    /// Forgets what came after the step that is shown.
    Branch,
    /// Begins anew.
    Reset,
    /// Begins with another scene.
    Load {
        /// A shipped scenario; standing if left out.
        scenario: Option<String>,
        /// A shipped character; the scenario's own if left out.
        character: Option<String>,
        /// A shipped repertoire; the character's own if left out.
        repertoire: Option<String>,
    },
    /// Begins with a file's text: a scenario, a character, a repertoire or a controller.
    Open {
        /// What messages call it.
        name: String,
        /// The file's text.
        text: String,
    },
    /// Which features this view's frames carry.
    Watch {
        /// Their names.
        features: Vec<String>,
    },
    /// Whose clauses this view's frames carry.
    Inspect {
        /// Place of the character.
        #[serde(default)]
        character: usize,
        /// Place of the controller in its pool; none.
        controller: Option<usize>,
    },
}

fn one() -> u32 {
    1
}

/// What is dragged.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct DragBody {
    /// Place of the character.
    #[serde(default)]
    pub character: usize,
    /// Name of its link.
    pub link: Option<String>,
    /// Or the place or name of a prop.
    pub prop: Option<String>,
}

/// A prop to be thrown.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Thrown {
    /// `ball` or `crate`.
    shape: ThrownShape,
    /// kg
    mass: f64,
    /// Radius, or half of a side, m.
    size: f64,
    /// m
    position: Point,
    /// m/s
    velocity: Point,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
enum ThrownShape {
    Ball,
    Crate,
}

impl Thrown {
    /// What it is called.
    pub(super) fn kind(&self) -> &'static str {
        match self.shape {
            ThrownShape::Ball => "ball",
            ThrownShape::Crate => "crate",
        }
    }

    /// As a prop of a scenario. A ball can be caught.
    pub(super) fn prop(&self, name: String) -> PropEntry {
        let (shape, restitution, grip) = match self.shape {
            ThrownShape::Ball => {
                let (from, to) = ([0.0; 2], [0.0; 2]);
                let radius = self.size;
                (Shape::Capsule { radius, from, to }, 0.3, 400.0)
            }
            ThrownShape::Crate => {
                let (half, centre) = ([self.size; 2], [0.0; 2]);
                (Shape::Box { half, centre }, 0.0, 0.0)
            }
        };
        let numbers = |p: Point| p.map(Number::Value);
        PropEntry {
            name,
            shape,
            mass: self.mass.into(),
            position: numbers(self.position),
            angle: 0.0.into(),
            velocity: numbers(self.velocity),
            friction: 0.6.into(),
            restitution: restitution.into(),
            grip: grip.into(),
        }
    }
}

impl Request {
    /// Reads a message.
    ///
    /// # Errors
    /// A message that is too large, no request, or out of bounds.
    pub fn parse(text: &str) -> Result<Self> {
        let refuse =
            |problem: String, accepted: &str| Err(Error::invalid("message", "", problem, accepted));
        let bytes = text.len();
        if bytes > LARGEST_OPENED {
            return refuse(format!("{bytes} bytes"), "at most 512 kB");
        }
        let request: Self = match serde_json::from_str(text) {
            Ok(request) => request,
            Err(e) => return refuse(format!("wrong: {e}"), "a request of the live protocol"),
        };
        if bytes > LARGEST_MESSAGE && !matches!(request, Self::Open { .. }) {
            return refuse(format!("{bytes} bytes"), "at most 4 kB");
        }
        request.check()?;
        Ok(request)
    }

    fn check(&self) -> Result<()> {
        let near = |p: Point| check::point(p, FURTHEST);
        match self {
            Self::Step { steps } => check::within("steps", f64::from(*steps), 1.0..=1000.0),
            Self::Speed { factor } => check::within("factor", *factor, 0.05..=4.0),
            Self::Push { impulse, .. } => {
                check::point(*impulse, STRONGEST).map_err(|e| e.inside("impulse"))
            }
            Self::Drag { point, to, .. } => {
                near(*point).map_err(|e| e.inside("point"))?;
                near(*to).map_err(|e| e.inside("to"))
            }
            Self::Throw(thrown) => {
                check::within("mass", thrown.mass, 0.01..=200.0)?;
                check::within("size", thrown.size, 0.02..=1.0)?;
                near(thrown.position).map_err(|e| e.inside("position"))?;
                check::point(thrown.velocity, 50.0).map_err(|e| e.inside("velocity"))
            }
            Self::Set { value, .. } => check::within("value", *value, -1e6..=1e6),
            Self::Watch { features } => {
                check::count("features", features.len(), 0..=MOST_WATCHED, "features")
            }
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn requests_are_read_and_what_is_out_of_bounds_is_refused() {
        for text in [
            r#"{"do":"play"}"#,
            r#"{"do":"step"}"#,
            r#"{"do":"drag","link":"torso","point":[0,0.2],"to":[1,1]}"#,
            r#"{"do":"drag","prop":"box","point":[0,0.2],"to":[1,1]}"#,
            r#"{"do":"throw","shape":"ball","mass":5,"size":0.1,"position":[1,1],"velocity":[-5,0]}"#,
            r#"{"do":"load","scenario":"story","character":null,"repertoire":null}"#,
            r#"{"do":"inspect","character":0,"controller":null}"#,
        ] {
            Request::parse(text).unwrap_or_else(|e| panic!("{text}: {e}"));
        }
        for (text, why) in [
            ("", "wrong"),
            ("{}", "do"),
            (r#"{"do":"dance"}"#, "dance"),
            (
                r#"{"do":"speed","factor":9}"#,
                "factor is 9; accepted: 0.05 to 4",
            ),
            (r#"{"do":"step","steps":0}"#, "steps is 0"),
            (
                r#"{"do":"push","link":"torso","impulse":[1e9,0]}"#,
                "impulse",
            ),
            (r#"{"do":"push","link":"torso","impulse":[1]}"#, "wrong"),
        ] {
            let told = Request::parse(text).unwrap_err().to_string();
            assert!(told.contains(why), "{text}: {told}");
        }
        let long = format!(
            r#"{{"do":"command","text":"{}"}}"#,
            "x".repeat(LARGEST_MESSAGE)
        );
        assert!(
            Request::parse(&long)
                .unwrap_err()
                .to_string()
                .contains("4 kB")
        );
    }
}
