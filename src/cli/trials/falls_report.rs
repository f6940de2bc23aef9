//! The falls of trials, as JSON and as text.
//!
//! [`FallTally`] both ways → medians.

use std::io::Write;

use anyhow::Result;
use serde::Serialize;

use super::tally::FallTally;
use crate::cli::statistics::{median, percentile};

/// Names are a contract with other people's scripts.
#[derive(Debug, Serialize)]
pub(super) struct FallsReport {
    forward: Forward,
    backward: Backward,
    /// Of both.
    #[serde(flatten)]
    impact: ImpactReport,
}

/// What head and trunk had to take in falls.
#[derive(Debug, Serialize)]
struct ImpactReport {
    /// Falls in which the head touched anything before the character lay still.
    head_hits: u64,
    /// Of the head just before it touched, in the falls in which it did, m/s.
    median_head_hit_speed: Option<f64>,
    /// The same: what 95 of 100 do not exceed.
    p95_head_hit_speed: Option<f64>,
    /// Of the largest filtered force on the head in the falls in which it touched, N.
    median_head_hit_force: Option<f64>,
    /// Of the largest filtered force on trunk and root together in each fall, N.
    median_trunk_force: Option<f64>,
}

/// Falls forward.
#[derive(Debug, Serialize)]
struct Forward {
    count: u64,
    hands_first: u64,
    #[serde(flatten)]
    impact: ImpactReport,
}

/// Falls backward.
#[derive(Debug, Serialize)]
struct Backward {
    count: u64,
    hands_or_seat_first: u64,
    #[serde(flatten)]
    impact: ImpactReport,
}

impl ImpactReport {
    fn new(falls: &FallTally) -> Self {
        let hits = &falls.head_hits;
        let speeds: Vec<f64> = hits.iter().map(|h| h.speed).collect();
        let forces: Vec<f64> = hits.iter().map(|h| h.force).collect();
        Self {
            head_hits: hits.len() as u64,
            median_head_hit_speed: median(&speeds),
            p95_head_hit_speed: percentile(&speeds, 95),
            median_head_hit_force: median(&forces),
            median_trunk_force: median(&falls.trunk_forces),
        }
    }

    fn head(&self) -> String {
        match (self.median_head_hit_speed, self.p95_head_hit_speed) {
            (Some(median), Some(p95)) => format!(
                "head touched in {} at {median:.2} m/s (median; 95 % up to {p95:.2})",
                self.head_hits
            ),
            _ => "head never touched".to_owned(),
        }
    }

    /// In words; nothing if there were no falls.
    fn print_forces(&self, out: &mut dyn Write) -> Result<()> {
        let Some(trunk) = self.median_trunk_force else {
            return Ok(());
        };
        let blank = "";
        write!(out, "{blank:21}hit with {trunk:.0} N on trunk and root")?;
        if let Some(head) = self.median_head_hit_force {
            write!(out, ", {head:.0} N on the head where it touched")?;
        }
        writeln!(out, " (medians of the peaks, filtered over 10 ms)")?;
        Ok(())
    }
}

impl FallsReport {
    /// Of the falls of all trials.
    pub(super) fn new(forward: &FallTally, backward: &FallTally) -> Self {
        let mut both = forward.clone();
        both.merge(backward.clone());
        Self {
            forward: Forward {
                count: forward.count,
                hands_first: forward.broken_well,
                impact: ImpactReport::new(forward),
            },
            backward: Backward {
                count: backward.count,
                hands_or_seat_first: backward.broken_well,
                impact: ImpactReport::new(backward),
            },
            impact: ImpactReport::new(&both),
        }
    }

    /// As text; nothing if there were no falls.
    pub(super) fn print(&self, out: &mut dyn Write) -> Result<()> {
        let Self {
            forward, backward, ..
        } = self;
        if forward.count + backward.count == 0 {
            return Ok(());
        }
        writeln!(
            out,
            "falls forward        {}: hands first in {}, {}",
            forward.count,
            forward.hands_first,
            forward.impact.head()
        )?;
        forward.impact.print_forces(out)?;
        writeln!(
            out,
            "falls backward       {}: hands or seat first in {}, {}",
            backward.count,
            backward.hands_or_seat_first,
            backward.impact.head()
        )?;
        backward.impact.print_forces(out)
    }
}
