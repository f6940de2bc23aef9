//! What a run has shown so far of the expectations that only its steps can tell.
//!
//! [`Expectation`], sensors and props of every step → [`Watch`] → nothing, or what was found
//! instead, in words.

use crate::control::Condition;
use crate::input::{Error, Result};
use crate::math::hypot;
use crate::scenario::{Expectation, Number, Quantity, Scenario};
use crate::sensing::Sensors;
use crate::world::World;

/// CoM speed below which a character is balanced at the end, m/s.
const STILL: f64 = 0.2;
/// s that a time may be missed by for the rounding of steps.
const ROUNDING: f64 = 1e-9;

/// An expectation and what the run has shown of it.
#[derive(Debug, Clone)]
pub(crate) struct Watch {
    /// As in the scenario.
    pub(crate) expectation: Expectation,
    asked: Asked,
    verdict: Verdict,
}

/// What is looked at, with places for names and values for parameters.
#[derive(Debug, Clone)]
enum Asked {
    Balanced {
        character: usize,
    },
    Holds {
        condition: Condition,
        at: f64,
        character: usize,
    },
    Reaches {
        condition: Condition,
        before: f64,
        character: usize,
    },
    Prop {
        prop: usize,
        what: Quantity,
        bounds: [f64; 2],
        at: f64,
    },
}

#[derive(Debug, Clone)]
enum Verdict {
    Open,
    Met,
    /// What was found instead.
    Missed(String),
}

impl Watch {
    /// None for an expectation that is told from the end and the events.
    ///
    /// # Errors
    /// Unknown parameters, joints and props, by the way from the expectation.
    pub(crate) fn new(
        expectation: &Expectation,
        scenario: &Scenario,
        world: &World,
    ) -> Result<Option<Self>> {
        let resolved = |condition: &Condition, character: usize| {
            let mut condition = condition.clone();
            let model = world.characters()[character].body.model();
            let resolved = condition.resolve(model).and_then(|()| {
                condition.each_feature(&mut |f| match f.prop() {
                    Some(prop) => scenario.prop_index(prop).map(drop),
                    None => Ok(()),
                })
            });
            resolved.map_err(|e| e.inside("condition"))?;
            Ok::<_, Error>(condition)
        };
        let number = |field: &str, n: &Number| scenario.number(n).map_err(|e| e.inside(field));
        let asked = match expectation {
            Expectation::Standing { .. }
            | Expectation::Active { .. }
            | Expectation::Posture { .. } => return Ok(None),
            Expectation::Balanced { character } => Asked::Balanced {
                character: *character,
            },
            Expectation::Holds {
                condition,
                at,
                character,
            } => Asked::Holds {
                condition: resolved(condition, *character)?,
                at: number("at", at)?,
                character: *character,
            },
            Expectation::Reaches {
                condition,
                before,
                character,
            } => Asked::Reaches {
                condition: resolved(condition, *character)?,
                before: number("before", before)?,
                character: *character,
            },
            Expectation::Prop {
                name,
                what,
                min,
                max,
                at,
            } => Asked::Prop {
                prop: scenario.prop_index(name).map_err(|e| e.inside("name"))?,
                what: *what,
                bounds: [number("min", min)?, number("max", max)?],
                at: number("at", at)?,
            },
        };
        Ok(Some(Self {
            expectation: expectation.clone(),
            asked,
            verdict: Verdict::Open,
        }))
    }

    /// Takes note of a step that was just sensed. Allocates only where something is missed.
    pub(crate) fn observe(&mut self, world: &World) {
        if !matches!(self.verdict, Verdict::Open) {
            return;
        }
        let now = |character: usize| &world.characters()[character].sensors;
        let due = |time: f64| world.time() + ROUNDING >= time;
        let found = match &self.asked {
            Asked::Balanced { character } => {
                let now = now(*character);
                let mut links = now.contacts.iter().enumerate();
                let other = links.find(|(i, c)| c.supported && !now.model.is_foot(*i));
                let Some((link, _)) = other else { return };
                Some(format!(
                    "character {character} is not balanced: its {} supported it at {:.3} s",
                    now.model.links[link].name, now.time
                ))
            }
            Asked::Holds { at, .. } | Asked::Prop { at, .. } if due(*at) => self.found(world),
            Asked::Holds { .. } | Asked::Prop { .. } => return,
            Asked::Reaches {
                condition,
                before,
                character,
            } => {
                let late = world.time() > before + ROUNDING;
                if !late && condition.holds(now(*character)) {
                    None
                } else if late || due(*before) {
                    self.found(world)
                } else {
                    return;
                }
            }
        };
        self.verdict = found.map_or(Verdict::Met, Verdict::Missed);
    }

    /// What is found now in the place of what is asked; none if that is found.
    fn found(&self, world: &World) -> Option<String> {
        let now = |character: usize| &world.characters()[character].sensors;
        match &self.asked {
            Asked::Balanced { character } => {
                let problem = unbalanced(now(*character))?;
                Some(format!("character {character} is not balanced: {problem}"))
            }
            Asked::Holds {
                condition,
                at,
                character,
            } => {
                let refusal = condition.first_failure(now(*character))?;
                Some(format!("character {character} at {at} s: not {refusal}"))
            }
            Asked::Reaches {
                condition,
                before,
                character,
            } => {
                let now = now(*character);
                let refusal = condition.first_failure(now)?;
                let until = before.min(now.time);
                Some(format!(
                    "character {character} until {until:.3} s: never {condition}; in the end not {refusal}"
                ))
            }
            Asked::Prop {
                prop,
                what,
                bounds: [min, max],
                at,
            } => {
                let (value, unit) = what.of(&world.prop_motion(*prop));
                let name = world.props().nth(*prop).map_or("", |p| &p.name);
                let what = what.name();
                (!(value >= *min && value <= *max)).then(|| {
                    format!(
                        "{what} of '{name}' at {at} s is {value:.3} {unit}; expected: {min} to {max}"
                    )
                })
            }
        }
    }

    /// What the run, if it ends now, has not shown; none if it has shown what is asked.
    pub(crate) fn unmet(&self, world: &World) -> Option<String> {
        match (&self.verdict, &self.asked) {
            (Verdict::Met, _) => None,
            (Verdict::Missed(found), _) => Some(found.clone()),
            (Verdict::Open, Asked::Holds { at, .. } | Asked::Prop { at, .. })
                if world.time() + ROUNDING < *at =>
            {
                let end = world.time();
                Some(format!(
                    "the run ended at {end:.3} s, before something expected at {at} s"
                ))
            }
            (Verdict::Open, _) => self.found(world),
        }
    }
}

/// What keeps a character from being balanced now.
fn unbalanced(now: &Sensors) -> Option<String> {
    let speed = hypot(now.com_velocity[0], now.com_velocity[1]);
    let com = now.com[0];
    match now.base_of_support {
        None => Some("no foot supports it at the end".to_owned()),
        Some([rear, front]) if com < rear || com > front => Some(format!(
            "its centre of mass is at {com:.3} m at the end, its base of support from {rear:.3} to {front:.3} m"
        )),
        Some(_) if speed >= STILL => Some(format!(
            "its centre of mass moves at {speed:.3} m/s at the end; accepted: below {STILL} m/s"
        )),
        Some(_) => None,
    }
}
