//! What happens in a run.
//!
//! Text, JSON and pictures follow from what stands here: a kind that is added to [`EventKind`], with
//! its lines in [`EventKind::name`], [`EventKind::label`] and `Display`, is told everywhere.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::events::bid::Bid;
use crate::events::role::Role;
use crate::events::unmet::Unmet;
use crate::math::hypot;

/// Something that happened, with the time in s and the character it happened to.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Event {
    /// s
    pub time: f64,
    /// Place among the world's characters.
    pub character: usize,
    /// What.
    pub kind: EventKind,
}

/// The kinds of events.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum EventKind {
    /// A push began.
    Push {
        /// The link that is pushed.
        link: String,
        /// N·s
        impulse: [f64; 2],
    },
    /// A command was given.
    Command {
        /// As given.
        text: String,
        /// Whether a controller answers to it and took it up.
        accepted: bool,
    },
    /// Control changed hands.
    Switch {
        /// The former controller.
        from: Option<String>,
        /// The new one.
        to: String,
        /// What the new one is for.
        role: Role,
        /// Why.
        reason: Reason,
        /// What each controller of the pool said.
        bids: Vec<Bid>,
    },
    /// A command was refused.
    Refused {
        /// The command.
        command: String,
        /// The controller that answers to it, if one does.
        controller: Option<String>,
        /// The clause that refused, or what is wrong with the command.
        unmet: Unmet,
    },
    /// A hand took hold of a prop.
    Grasped {
        /// The hand's link.
        link: String,
        /// The prop.
        prop: String,
    },
    /// A prop slipped from a hand that could not hold its load.
    Slipped {
        /// The hand's link.
        link: String,
        /// The prop.
        prop: String,
    },
    /// A hinge of a prop broke under its load.
    Broke {
        /// The prop.
        prop: String,
        /// The other prop; none is the world.
        from: Option<String>,
    },
    /// Something other than feet supports it, for the first time since it stood or the run began.
    Fell,
    /// Standing again, after a fall.
    Stood,
    /// Somebody threw or dropped a prop into the world.
    Thrown {
        /// The prop.
        prop: String,
    },
    /// Somebody began to drag a link or a prop.
    Dragged {
        /// Its name.
        body: String,
    },
    /// Somebody let go of what was dragged.
    Released,
    /// A setting of the world changed.
    Set {
        /// Which: `friction`, `gravity`.
        name: String,
        /// To what, in its unit.
        value: f64,
    },
}

/// Why control changed hands.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Reason {
    /// Nothing was active yet.
    Start,
    /// The former controller reached its post-condition.
    Succeeded,
    /// The former controller failed; what did not hold.
    Failed(Unmet),
    /// A command called.
    Command,
}

impl Reason {
    /// `start`, `succeeded`, `failed` or `command`.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Start => "start",
            Self::Succeeded => "succeeded",
            Self::Failed(_) => "failed",
            Self::Command => "command",
        }
    }
}

/// Its name; of a failure also what did not hold.
impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Failed(unmet) => write!(f, "failed: {unmet}"),
            other => f.write_str(other.name()),
        }
    }
}

impl EventKind {
    /// As in JSON.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Push { .. } => "push",
            Self::Command { .. } => "command",
            Self::Switch { .. } => "switch",
            Self::Refused { .. } => "refused",
            Self::Grasped { .. } => "grasped",
            Self::Slipped { .. } => "slipped",
            Self::Broke { .. } => "broke",
            Self::Fell => "fell",
            Self::Stood => "stood",
            Self::Thrown { .. } => "thrown",
            Self::Dragged { .. } => "dragged",
            Self::Released => "released",
            Self::Set { .. } => "set",
        }
    }

    /// In a few words, for pictures; none for what pictures show in another way.
    #[must_use]
    pub fn label(&self) -> Option<String> {
        Some(match self {
            Self::Push { impulse, .. } => {
                let amount = hypot(impulse[0], impulse[1]);
                if amount.is_finite() {
                    format!("push {amount:.0} N·s")
                } else {
                    "push".to_owned()
                }
            }
            Self::Command {
                text,
                accepted: true,
            } => format!("“{text}”"),
            Self::Command { text, .. } => format!("“{text}” not taken up"),
            Self::Grasped { prop, .. } => format!("grasps {prop}"),
            Self::Slipped { prop, .. } => format!("{prop} slips"),
            Self::Broke { prop, .. } => format!("{prop} breaks off"),
            Self::Fell => "fell".to_owned(),
            Self::Stood => "stood".to_owned(),
            Self::Thrown { prop } => format!("{prop} thrown"),
            Self::Dragged { body } => format!("{body} dragged"),
            Self::Released => "released".to_owned(),
            Self::Set { name, value } if value.is_finite() => format!("{name} {value}"),
            Self::Set { name, .. } => format!("{name} changed"),
            Self::Switch { .. } | Self::Refused { .. } => return None,
        })
    }
}

/// One line, as the program prints it.
impl fmt::Display for EventKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = self.name();
        match self {
            Self::Push { link, impulse } => write!(f, "{name:8} {link} {:+} N·s", impulse[0]),
            Self::Command { text, accepted } => {
                let answer = if *accepted {
                    "taken up"
                } else {
                    "not taken up"
                };
                write!(f, "{name:8} {text}: {answer}")
            }
            Self::Switch {
                from, to, reason, ..
            } => match from {
                Some(from) => write!(f, "{name:8} {from} → {to} ({reason})"),
                None => write!(f, "{name:8} → {to} ({reason})"),
            },
            Self::Refused {
                controller, unmet, ..
            } => match controller {
                Some(controller) => write!(f, "{name:8} by {controller}: {unmet}"),
                None => write!(f, "{name:8} {unmet}"),
            },
            Self::Grasped { link, prop } | Self::Slipped { link, prop } => {
                write!(f, "{name:8} {prop} ({link})")
            }
            Self::Broke { prop, from } => {
                let from = from.as_deref().unwrap_or("the world");
                write!(f, "{name:8} {prop} from {from}")
            }
            Self::Thrown { prop: thing } | Self::Dragged { body: thing } => {
                write!(f, "{name:8} {thing}")
            }
            Self::Set { name: what, value } => write!(f, "{name:8} {what} {value}"),
            Self::Fell | Self::Stood | Self::Released => f.write_str(name),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn events_are_told_in_a_line() {
        let unmet = Unmet::plain("x");
        for (kind, line, label) in [
            (
                EventKind::Push {
                    link: "torso".into(),
                    impulse: [-40.0, 0.0],
                },
                "push     torso -40 N·s",
                Some("push 40 N·s"),
            ),
            (
                EventKind::Refused {
                    command: "bow".into(),
                    controller: Some("bow".into()),
                    unmet: unmet.clone(),
                },
                "refused  by bow: x",
                None,
            ),
            (
                EventKind::Switch {
                    from: Some("balance".into()),
                    to: "fall".into(),
                    role: Role::Fall,
                    reason: Reason::Failed(unmet),
                    bids: Vec::new(),
                },
                "switch   balance → fall (failed: x)",
                None,
            ),
            (
                EventKind::Broke {
                    prop: "bag".into(),
                    from: None,
                },
                "broke    bag from the world",
                Some("bag breaks off"),
            ),
        ] {
            assert_eq!(kind.to_string(), line);
            assert_eq!(kind.label().as_deref(), label);
        }
    }
}
