//! What a controller promises: pre-condition, post-condition, expected performance and weight.
//! (Faloutsos, van de Panne, Terzopoulos 2001, "Pre-conditions", "Post-conditions", "Expected performance".)

use serde::{Deserialize, Serialize};

use crate::character::Model;
use crate::control::command::{Answer, Command};
use crate::control::condition::{Condition, is_infinite};
use crate::events::{Role, Unmet};
use crate::input::{Error, FieldPath, Result, check, shortened};
use crate::sensing::Sensors;

/// How an active controller is getting on.
#[derive(Debug, Clone, PartialEq)]
pub enum Progress {
    /// As expected.
    Running,
    /// Its post-condition holds.
    Succeeded,
    /// It cannot meet its post-condition any more; what does not hold.
    Failed(Unmet),
}

/// A controller's contract, as data.
///
/// ```
/// # use aplomb_framework::prelude::*;
/// let text = r#"(name: "nod", weight: 3, precondition: Posture([standing]))"#;
/// let mut contract: Contract = ron::from_str(text)?;
/// let model = Model::load("humanoid")?;
/// contract.resolve(&model)?; // looks up joints, checks numbers
/// let mut now = Sensors::new(&model, 9.81);
/// assert_eq!(contract.suitability(&now), 0.0); // in the air
/// now.posture = Posture::Standing;
/// assert_eq!(contract.suitability(&now), 3.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Contract {
    /// Unique in its repertoire.
    pub name: String,
    /// What it is for, for those who count and judge.
    #[serde(default, skip_serializing_if = "Role::is_other")]
    pub role: Role,
    /// Suitability = weight × pre-condition. 0: only on command.
    pub weight: u32,
    /// Whether suitability is weight × probability of success where the pre-condition holds, as
    /// far as the pre-condition was learned, instead of weight × 1.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub confident: bool,
    /// Where the controller can take over.
    pub precondition: Condition,
    /// Where it has succeeded; `Never` stays on until it fails or something else is commanded.
    #[serde(default = "never", skip_serializing_if = "Condition::is_never")]
    pub postcondition: Condition,
    /// What holds as long as all goes well. Not held while active: failing, arbitrate now.
    #[serde(default = "always", skip_serializing_if = "Condition::is_always")]
    pub expected: Condition,
    /// s for which the post-condition must hold without a break.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub hold: f64,
    /// s after which a controller that has not succeeded has failed.
    #[serde(default = "forever", skip_serializing_if = "is_infinite")]
    pub patience: f64,
    /// s of [stillness](Sensors::is_still) after which it has failed: nothing more will come of it.
    #[serde(default = "forever", skip_serializing_if = "is_infinite")]
    pub stalls: f64,
    /// The commands that it answers to; its own name if none are listed.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub commands: Vec<Answer>,
}

fn never() -> Condition {
    Condition::Never
}

fn always() -> Condition {
    Condition::Always
}

fn forever() -> f64 {
    f64::INFINITY
}

fn is_zero(x: &f64) -> bool {
    *x == 0.0
}

impl Contract {
    /// Looks up the joints of its conditions, checks its numbers, and makes it answer to its name
    /// if it lists no commands.
    ///
    /// # Errors
    /// Unknown joints; bounds, times or parameters that are no numbers or out of order.
    pub fn resolve(&mut self, model: &Model) -> Result<()> {
        for (field, condition) in [
            ("precondition", &mut self.precondition),
            ("postcondition", &mut self.postcondition),
            ("expected", &mut self.expected),
        ] {
            condition.resolve(model).map_err(|e| e.inside(field))?;
        }
        let command = self.name.parse::<Command>();
        if command.map_or(true, |c| c.name != self.name) {
            let problem = format!("'{}'", shortened(&self.name));
            let accepted = "a letter, then letters, digits and '_'";
            return Err(Error::refused("name", problem, accepted));
        }
        check::within("hold", self.hold, 0.0..=60.0)?;
        check::above("patience", self.patience, 0.0, f64::INFINITY)?;
        check::above("stalls", self.stalls, 0.0, f64::INFINITY)?;
        for (i, answer) in self.commands.iter().enumerate() {
            for (k, p) in answer.parameters.iter().enumerate() {
                let of = |e: Error| e.inside(("parameters", k)).inside(("commands", i));
                check::finite("min", p.min).map_err(of)?;
                check::finite("max", p.max).map_err(of)?;
                if p.min > p.max {
                    let accepted = format!("a number with min ≤ max, which is {}", p.max);
                    return Err(of(Error::refused("min", p.min, accepted)));
                }
                check::within("default", p.default, p.min..=p.max).map_err(of)?;
            }
        }
        if self.commands.is_empty() {
            let parameters = Vec::new();
            self.commands.push(Answer {
                name: self.name.clone(),
                parameters,
            });
        }
        Ok(())
    }

    /// Weight × pre-condition, or × probability of success if it is confident.
    #[must_use]
    pub fn suitability(&self, now: &Sensors) -> f64 {
        if self.weight == 0 || !self.precondition.holds(now) {
            return 0.0;
        }
        let weight = f64::from(self.weight);
        if self.confident {
            weight * self.precondition.probability(now)
        } else {
            weight
        }
    }

    /// How a controller is getting on, `elapsed` s after it took over. `kept` is for how many seconds
    /// the post-condition, or what else the controller counts as success, has held without a break.
    #[must_use]
    pub fn progress(&self, now: &Sensors, elapsed: f64, kept: Option<f64>) -> Progress {
        if kept.is_some_and(|k| k >= self.hold) {
            Progress::Succeeded
        } else if let Some(failure) = self.expected.first_failure(now) {
            Progress::Failed(failure.expected())
        } else if elapsed > self.patience {
            Progress::Failed(self.out_of_patience())
        } else {
            Progress::Running
        }
    }

    /// The failure of a controller whose patience is over.
    #[must_use]
    pub fn out_of_patience(&self) -> Unmet {
        Unmet::plain(format!("not done after {} s", self.patience))
    }

    /// The failure of a controller that has kept still for too long.
    #[must_use]
    pub fn stalled(&self) -> Unmet {
        Unmet::plain(format!("has kept still for {} s", self.stalls))
    }

    /// Whether it answers to a command.
    ///
    /// # Errors
    /// The command's name is known but a parameter is not, or is out of its range.
    pub fn answers(&self, command: &Command) -> Result<bool> {
        match self.answer(command) {
            Some(answer) => answer.check(command).map(|()| true),
            None => Ok(false),
        }
    }

    /// Checks that a name in the spec's `field` is that of a parameter of its commands.
    ///
    /// # Errors
    /// The nearest, and the parameters that there are.
    pub fn check_parameter(
        &self,
        field: impl Into<FieldPath>,
        name: Option<&String>,
    ) -> Result<()> {
        let parameters = self.commands.iter().flat_map(|a| &a.parameters);
        let mut known = parameters.map(|p| p.name.as_str());
        match name {
            Some(name) if !known.clone().any(|k| k == name) => {
                Err(Error::unknown("parameter", name, &mut known).inside(field))
            }
            _ => Ok(()),
        }
    }

    /// The entry of [`Self::commands`] with the command's name.
    #[must_use]
    pub fn answer(&self, command: &Command) -> Option<&Answer> {
        self.commands.iter().find(|a| a.name == command.name)
    }

    /// The value of a parameter: as commanded, else its default, else `otherwise`.
    #[must_use]
    pub fn parameter(&self, command: Option<&Command>, name: &str, otherwise: f64) -> f64 {
        command.and_then(|c| c.argument(name)).unwrap_or_else(|| {
            let all = self.commands.iter().flat_map(|a| &a.parameters);
            all.clone()
                .find(|p| p.name == name)
                .map_or(otherwise, |p| p.default)
        })
    }
}
