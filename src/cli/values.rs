//! The values of options: bounded numbers, `T:LINK:IMPULSE`, `T:COMMAND`, `KEY=VALUE`.
//!
//! text → value, or what would be accepted.

use std::str::FromStr;

use aplomb::framework::control::Command;
use aplomb::framework::input::shortened;
use aplomb::framework::scenario::{LONGEST_RUN, Number, ScheduledInput};

/// The strongest push, N·s either way.
pub(super) const STRONGEST: f64 = 1e5;

/// A number between two bounds.
pub(super) fn number(
    low: f64,
    high: f64,
    unit: &'static str,
) -> impl Fn(&str) -> Result<f64, String> + Clone + Send + Sync + 'static {
    move |text| match text.parse::<f64>() {
        Ok(v) if v >= low && v <= high => Ok(v),
        _ => Err(format!("accepted: {low} to {high} {unit}")),
    }
}

/// A whole number between two bounds.
pub(super) fn whole(
    low: u64,
    high: u64,
) -> impl Fn(&str) -> Result<u64, String> + Clone + Send + Sync + 'static {
    move |text| match text.parse::<u64>() {
        Ok(v) if v >= low && v <= high => Ok(v),
        _ => Err(format!("accepted: a whole number from {low} to {high}")),
    }
}

/// A run's duration, s.
pub(super) fn duration(text: &str) -> Result<f64, String> {
    number(1e-3, LONGEST_RUN, "s")(text)
}

fn time(text: &str) -> Result<f64, String> {
    number(0.0, LONGEST_RUN, "s")(text).map_err(|e| format!("time '{}'; {e}", shortened(text)))
}

/// An impulse, N·s.
pub(super) fn impulse(text: &str) -> Result<f64, String> {
    number(-STRONGEST, STRONGEST, "N·s")(text)
        .map_err(|e| format!("impulse '{}'; {e}", shortened(text)))
}

/// A push: `T:LINK:IMPULSE`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct PushArgument {
    at: f64,
    link: String,
    impulse: f64,
}

impl FromStr for PushArgument {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parts: Vec<&str> = text.split(':').collect();
        let &[at, link, strength] = parts.as_slice() else {
            return Err("accepted: T:LINK:IMPULSE, for example 1:torso:-40".to_owned());
        };
        Ok(Self {
            at: time(at)?,
            link: link.to_owned(),
            impulse: impulse(strength)?,
        })
    }
}

/// A command at a time: `T:STRING`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct TimedCommand {
    at: f64,
    text: String,
}

impl FromStr for TimedCommand {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (at, command) = text
            .split_once(':')
            .ok_or("accepted: T:COMMAND, for example \"2:bow\"")?;
        let at = time(at)?;
        command.parse::<Command>().map_err(|e| e.to_string())?;
        let text = command.to_owned();
        Ok(Self { at, text })
    }
}

/// Something that an option asks for at a time.
pub(super) trait Timed {
    /// s
    fn at(&self) -> f64;
    /// As a scenario would have it, for the first character.
    fn happening(&self) -> ScheduledInput;
    /// The option as it was given.
    fn option(&self) -> String;
}

impl Timed for PushArgument {
    fn at(&self) -> f64 {
        self.at
    }

    fn happening(&self) -> ScheduledInput {
        ScheduledInput::push(self.at, &self.link, self.impulse)
    }

    fn option(&self) -> String {
        format!(
            "--push {}:{}:{}",
            self.at,
            shortened(&self.link),
            self.impulse
        )
    }
}

impl Timed for TimedCommand {
    fn at(&self) -> f64 {
        self.at
    }

    fn happening(&self) -> ScheduledInput {
        ScheduledInput::Command {
            at: Number::Value(self.at),
            text: self.text.clone(),
            character: 0,
        }
    }

    fn option(&self) -> String {
        format!("--command \"{}:{}\"", self.at, shortened(&self.text))
    }
}

/// A parameter's new value: `KEY=VALUE`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Setting {
    /// Name of the parameter.
    pub(super) key: String,
    /// Finite.
    pub(super) value: f64,
}

impl FromStr for Setting {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (key, value) = text
            .split_once('=')
            .ok_or("accepted: KEY=VALUE, for example friction=0.4")?;
        let value = value.parse::<f64>().ok().filter(|v| v.is_finite());
        let value = value.ok_or("accepted: KEY=VALUE with a finite number")?;
        let key = key.to_owned();
        Ok(Self { key, value })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_push_has_a_time_a_link_and_an_impulse() {
        let push: PushArgument = "1.5:torso:-40".parse().unwrap();
        assert_eq!((push.at, push.impulse), (1.5, -40.0));
        for bad in ["x", "1:torso", "1:torso:4:5", "-1:torso:4", "nan:torso:4"] {
            assert!(bad.parse::<PushArgument>().is_err(), "{bad}");
        }
        for bad in [
            "1:torso:nan",
            "1:torso:inf",
            "1:torso:1e9",
            "1e9:torso:1",
            "1::",
        ] {
            assert!(bad.parse::<PushArgument>().is_err(), "{bad}");
        }
    }

    #[test]
    fn malformed_commands_and_settings_are_refused() {
        assert!("0.5:bow depth=1".parse::<TimedCommand>().is_ok());
        for bad in ["bow", "x:bow", "1:", "1:bow depth", "1e9:bow"] {
            assert!(bad.parse::<TimedCommand>().is_err(), "{bad}");
        }
        assert!("a=1".parse::<Setting>().is_ok());
        for bad in ["a", "a=", "a=nan", "a=x"] {
            assert!(bad.parse::<Setting>().is_err(), "{bad}");
        }
    }
}
