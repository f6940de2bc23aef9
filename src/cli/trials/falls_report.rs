//! The falls of trials, as JSON and as text.
//!
//! [`Falls`] both ways → medians.

use std::io::Write;

use anyhow::Result;
use serde::Serialize;

use super::tally::Falls;
use crate::cli::statistics::median;

/// Names are a contract with other people's scripts.
#[derive(Debug, Serialize)]
pub(super) struct FallsReport {
    forward: Forward,
    backward: Backward,
    #[serde(flatten)]
    impact: Impact,
}

/// What head and trunk had to take in falls.
#[derive(Debug, Serialize)]
struct Impact {
    /// m/s, of all falls; 0 for those in which the head did not touch.
    median_head_impact_speed: Option<f64>,
    /// m/s, of the falls in which the head touched.
    median_head_hit_speed: Option<f64>,
    /// Falls in which the head touched.
    head_hits: u64,
    /// Of the largest filtered force on the head in each fall, N.
    median_head_force: Option<f64>,
    /// Of the largest filtered force on trunk and root together, N.
    median_trunk_force: Option<f64>,
}

#[derive(Debug, Serialize)]
struct Forward {
    count: u64,
    hands_first: u64,
    #[serde(flatten)]
    impact: Impact,
}

#[derive(Debug, Serialize)]
struct Backward {
    count: u64,
    hands_or_seat_first: u64,
    #[serde(flatten)]
    impact: Impact,
}

impl Impact {
    fn new(falls: &Falls) -> Self {
        let hits = &falls.head_speeds;
        let mut all = hits.clone();
        all.resize((falls.count as usize).max(hits.len()), 0.0);
        Self {
            median_head_impact_speed: median(&all),
            median_head_hit_speed: median(hits),
            head_hits: hits.len() as u64,
            median_head_force: median(&falls.head_forces),
            median_trunk_force: median(&falls.trunk_forces),
        }
    }

    fn head(&self) -> String {
        match (self.median_head_impact_speed, self.median_head_hit_speed) {
            (Some(all), Some(hits)) => format!(
                "head touched in {} at {hits:.2} m/s (median; {all:.2} over all falls)",
                self.head_hits
            ),
            _ => "head never touched".to_owned(),
        }
    }

    /// In words; nothing if there were no falls.
    fn print_forces(&self, out: &mut dyn Write) -> Result<()> {
        if let (Some(head), Some(trunk)) = (self.median_head_force, self.median_trunk_force) {
            let blank = "";
            writeln!(
                out,
                "{blank:21}hit with {head:.0} N on the head, {trunk:.0} N on trunk and root (medians over all falls of the peaks, filtered over 10 ms)"
            )?;
        }
        Ok(())
    }
}

impl FallsReport {
    /// Of the falls of all trials.
    pub(super) fn new(forward: &Falls, backward: &Falls) -> Self {
        let mut both = forward.clone();
        both.merge(backward.clone());
        Self {
            forward: Forward {
                count: forward.count,
                hands_first: forward.broken_well,
                impact: Impact::new(forward),
            },
            backward: Backward {
                count: backward.count,
                hands_or_seat_first: backward.broken_well,
                impact: Impact::new(backward),
            },
            impact: Impact::new(&both),
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
