//! How a supervisor explains itself: the bids, and what was decided why.
//!
//! supervisor → [`Decision`] → events.

use serde::{Deserialize, Serialize, Serializer};

/// Why control changed hands.
#[derive(Debug, Clone, PartialEq)]
pub enum Why {
    /// Nothing was active yet.
    Start,
    /// The former controller reached its post-condition.
    Succeeded,
    /// The former controller failed; the clause or reason.
    Failed(String),
    /// A command called.
    Command,
}

/// What one controller said in an arbitration.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Bid {
    /// Its name.
    pub controller: String,
    /// Its suitability; 0 if it refused. In text formats a whole number is written as one.
    #[serde(serialize_with = "shortly")]
    pub suitability: f64,
    /// Why it bid 0.
    pub refusal: Option<String>,
}

fn shortly<S: Serializer>(bid: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    let whole = bid.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(bid);
    if whole && serializer.is_human_readable() {
        serializer.serialize_u32(*bid as u32)
    } else {
        serializer.serialize_f64(*bid)
    }
}

/// What a supervisor decided, with the time in s.
#[derive(Debug, Clone, PartialEq)]
pub enum Decision {
    /// Control changed hands.
    Switch {
        /// s
        time: f64,
        /// The former controller; none at the start.
        from: Option<String>,
        /// The new one.
        to: String,
        /// Why.
        why: Why,
        /// What each controller of the pool said.
        bids: Vec<Bid>,
    },
    /// A commanded controller's pre-condition does not hold.
    Refused {
        /// s
        time: f64,
        /// The command.
        command: String,
        /// The controller that answers to it.
        controller: String,
        /// The clause that refused.
        clause: String,
        /// The value that it refused.
        value: Option<f64>,
    },
    /// The command called its controller.
    Obeyed {
        /// s
        time: f64,
        /// The command.
        command: String,
    },
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_bids_are_written_as_whole_numbers_and_all_round_trip() {
        for (suitability, text) in [(10.0, "10"), (7.25, "7.25"), (0.0, "0")] {
            let bid = Bid {
                controller: "balance".to_owned(),
                suitability,
                refusal: None,
            };
            let written = ron::to_string(&bid).unwrap();
            assert!(
                written.contains(&format!("suitability:{text},")),
                "{written}"
            );
            assert_eq!(ron::from_str::<Bid>(&written).unwrap(), bid);
            let bytes = postcard::to_stdvec(&bid).unwrap();
            assert_eq!(postcard::from_bytes::<Bid>(&bytes).unwrap(), bid);
        }
    }
}
