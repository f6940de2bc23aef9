//! What each controller of a pool says in an arbitration.

use std::fmt;

use serde::{Deserialize, Serialize, Serializer};

use crate::events::unmet::Unmet;

/// What one controller said in an arbitration.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Bid {
    /// Its name.
    pub controller: String,
    /// Its suitability; 0 if it refused. In text formats a whole number is written as one.
    #[serde(serialize_with = "shortly")]
    pub suitability: f64,
    /// Why it bid 0.
    pub refusal: Option<Refusal>,
}

/// Why a controller bids 0.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Refusal {
    /// Its weight is 0.
    OnCommandOnly,
    /// It has failed a moment ago.
    Recovering,
    /// A clause of its pre-condition does not hold.
    Precondition(Unmet),
    /// It says no more than that.
    Declines,
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OnCommandOnly => f.write_str("only on command"),
            Self::Recovering => f.write_str("has just failed"),
            Self::Precondition(unmet) => unmet.fmt(f),
            Self::Declines => f.write_str("declines"),
        }
    }
}

fn shortly<S: Serializer>(bid: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    let whole = bid.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(bid);
    if whole && serializer.is_human_readable() {
        serializer.serialize_u32(*bid as u32)
    } else {
        serializer.serialize_f64(*bid)
    }
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
