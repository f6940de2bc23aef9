//! A recorded run: every step's state, centre of mass, centre of pressure and active controller,
//! and all events.
//!
//! simulation → rows → [`Trajectory`] → file, drawings, [`Digest`].

use std::sync::Arc;

use serde::{Deserialize, Serialize};
use xxhash_rust::xxh3::Xxh3;

use crate::character::Model;
use crate::events::Event;
use crate::sensing::Sensors;
use crate::world::Prop;

/// What is known of one character of a recording.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Cast {
    /// The character file's text.
    pub model: String,
    /// Names of the pool's controllers; rows refer to them by place.
    pub controllers: Vec<String>,
}

/// What is known of the run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Header {
    /// Name of the scenario.
    pub scenario: String,
    /// Its seed.
    pub seed: u64,
    /// s between rows.
    pub dt: f64,
    /// The characters.
    pub cast: Vec<Cast>,
    /// The props.
    pub props: Vec<Prop>,
}

/// Numbers of a character's row beside q and q̇: com (2), com velocity (2), ground reaction force
/// (2), CoP, rear and front of the base of support, reference CoM, active controller.
const EXTRA: usize = 11;

/// A recorded run. Rows hold single-precision numbers, the engine's precision.
///
/// ```
/// # use aplomb_framework::prelude::*;
/// # use aplomb_framework::Supervisor;
/// # #[derive(Debug, Clone)]
/// # struct Limp(Contract);
/// # impl Controller for Limp {
/// #     fn contract(&self) -> &Contract { &self.0 }
/// #     fn enter(&mut self, _: &Sensors) {}
/// #     fn act(&mut self, _: &Sensors, torques: &mut [f64]) { torques.fill(0.0); }
/// #     fn clone_box(&self) -> Box<dyn Controller> { Box::new(self.clone()) }
/// # }
/// # let contract = ron::from_str(r#"(name: "limp", weight: 1, precondition: Always)"#)?;
/// # let limp: Box<dyn Controller> = Box::new(Limp(contract)); // no torques
/// # let (model, scenario) = (Model::load("humanoid")?, Scenario::standing("humanoid", 1.0));
/// # let supervisor = Supervisor::new("faint", vec![limp], "limp")?;
/// # let mut simulation = Simulation::with_cast(&scenario, vec![(model, supervisor)])?;
/// simulation.record("faint", 0);
/// simulation.run(0.5);
/// let trajectory = simulation.into_recording().expect("it was recorded");
/// let [first, last] = [0, trajectory.len() - 1].map(|step| trajectory.moment(step, 0));
/// assert!(last.com[1] < first.com[1]); // it sinks
/// assert_eq!(trajectory.controller(0, 0), "limp");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Trajectory {
    /// The run.
    pub header: Header,
    /// The characters, read from the header.
    pub models: Vec<Arc<Model>>,
    /// In the order of time.
    pub events: Vec<Event>,
    /// One after the other, each of `width` numbers.
    pub(crate) rows: Vec<f32>,
    pub(crate) width: usize,
}

/// One character at one instant of a recording. SI units, world frame.
#[derive(Debug, Clone, Copy)]
pub struct Moment<'a> {
    /// Positions, length [`Model::dof`].
    pub q: &'a [f32],
    /// Velocities.
    pub qdot: &'a [f32],
    /// Centre of mass.
    pub com: [f32; 2],
    /// Its velocity.
    pub com_velocity: [f32; 2],
    /// Ground reaction force on the feet.
    pub force: [f32; 2],
    /// Centre of pressure, x.
    pub cop: Option<f32>,
    /// Base of support, x.
    pub support: Option<[f32; 2]>,
    /// The centre of mass that the controller aims at, x.
    pub reference: Option<f32>,
    /// Place of the active controller in its pool.
    pub active: usize,
}

/// Numbers of a row: every character's, then (x, y, angle) of every prop.
pub fn row_width<'a>(models: impl IntoIterator<Item = &'a Arc<Model>>, props: usize) -> usize {
    let numbers = |m: &Arc<Model>| 2 * m.dof() + EXTRA;
    models.into_iter().map(numbers).sum::<usize>() + 3 * props
}

/// Appends a character's numbers to a row.
pub fn push_character(row: &mut Vec<f32>, now: &Sensors, reference: Option<f64>, active: usize) {
    let number = |x: Option<f64>| x.map_or(f32::NAN, |x| x as f32);
    let s = &now.state;
    row.extend(s.q.iter().chain(&s.qdot).map(|x| *x as f32));
    row.extend(
        [now.com, now.com_velocity, now.ground_reaction_force]
            .as_flattened()
            .iter()
            .map(|x| *x as f32),
    );
    row.push(number(now.cop));
    row.push(number(now.base_of_support.map(|b| b[0])));
    row.push(number(now.base_of_support.map(|b| b[1])));
    row.push(number(reference));
    row.push(active as f32);
}

/// Hash over every step's row.
#[derive(Clone)]
pub struct Digest(Xxh3);

impl std::fmt::Debug for Digest {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Digest({})", self.text())
    }
}

impl Default for Digest {
    fn default() -> Self {
        Self(Xxh3::new())
    }
}

impl Digest {
    /// Takes in one row.
    pub fn row(&mut self, row: &[f32]) {
        for x in row {
            self.0.update(&x.to_bits().to_le_bytes());
        }
    }

    /// 32 hexadecimal digits.
    #[must_use]
    pub fn text(&self) -> String {
        format!("{:032x}", self.0.digest128())
    }
}

impl Trajectory {
    /// An empty recording.
    #[must_use]
    pub fn new(header: Header, models: Vec<Arc<Model>>) -> Self {
        let width = row_width(&models, header.props.len());
        Self {
            header,
            models,
            events: Vec::new(),
            rows: Vec::new(),
            width,
        }
    }

    /// Appends a step's row: every character's numbers, then (x, y, angle) of every prop.
    ///
    /// # Panics
    /// If the row has another length than the header implies.
    pub fn push_row(&mut self, row: &[f32]) {
        assert_eq!(row.len(), self.width, "row of another run");
        self.rows.extend_from_slice(row);
    }

    /// Appends a step's row that may lack the last props: those that have not appeared yet.
    pub(crate) fn push_beginning(&mut self, row: &[f32]) {
        self.rows.extend_from_slice(row);
        let missing = self.width.saturating_sub(row.len());
        self.rows.extend(std::iter::repeat_n(f32::NAN, missing));
    }

    /// Number of recorded steps.
    #[must_use]
    pub fn len(&self) -> usize {
        self.rows.len() / self.width.max(1)
    }

    /// Whether nothing was recorded.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// s from the first to the last step.
    #[must_use]
    pub fn duration(&self) -> f64 {
        self.len().saturating_sub(1) as f64 * self.header.dt
    }

    /// A part of the recording, with the events in it; its time begins at 0.
    #[must_use]
    pub fn stretch(&self, steps: std::ops::Range<usize>) -> Self {
        let to = steps.end.min(self.len());
        let from = steps.start.min(to);
        let dt = self.header.dt;
        let [begins, ends] = [from, to].map(|step| (step as f64 - 0.5) * dt);
        let within = self
            .events
            .iter()
            .filter(|e| e.time > begins && e.time < ends);
        let later = |e: &Event| Event {
            time: e.time - from as f64 * dt,
            ..e.clone()
        };
        Self {
            header: self.header.clone(),
            models: self.models.clone(),
            events: within.map(later).collect(),
            rows: self.rows[from * self.width..to * self.width].to_vec(),
            width: self.width,
        }
    }

    /// The step nearest to a time.
    #[must_use]
    pub fn step_at(&self, time: f64) -> usize {
        ((time / self.header.dt).round().max(0.0) as usize).min(self.len().saturating_sub(1))
    }

    fn row(&self, step: usize) -> &[f32] {
        &self.rows[step * self.width..(step + 1) * self.width]
    }

    /// A character at a step.
    #[must_use]
    pub fn moment(&self, step: usize, character: usize) -> Moment<'_> {
        let start = row_width(&self.models[..character], 0);
        let dof = self.models[character].dof();
        let row = &self.row(step)[start..];
        let (q, rest) = row.split_at(dof);
        let (qdot, x) = rest.split_at(dof);
        let some = |x: f32| (!x.is_nan()).then_some(x);
        Moment {
            q,
            qdot,
            com: [x[0], x[1]],
            com_velocity: [x[2], x[3]],
            force: [x[4], x[5]],
            cop: some(x[6]),
            support: some(x[7]).zip(some(x[8])).map(|(a, b)| [a, b]),
            reference: some(x[9]),
            active: x[10] as usize,
        }
    }

    /// (x, y, angle) of a prop at a step; not numbers before it has appeared.
    #[must_use]
    pub fn prop(&self, step: usize, prop: usize) -> [f32; 3] {
        let start = row_width(&self.models, prop);
        let row = &self.row(step)[start..start + 3];
        [row[0], row[1], row[2]]
    }

    /// Name of the controller that was active.
    #[must_use]
    pub fn controller(&self, step: usize, character: usize) -> &str {
        let active = self.moment(step, character).active;
        self.header.cast[character]
            .controllers
            .get(active)
            .map_or("", String::as_str)
    }

    /// The digest of all rows: the same as the run's that was recorded.
    #[must_use]
    pub fn digest(&self) -> String {
        let mut digest = Digest::default();
        for step in 0..self.len() {
            let mut row = self.row(step);
            // Props that had not appeared were no part of the step.
            while let [rest @ .., x, y, angle] = row
                && rest.len() >= row_width(&self.models, 0)
                && [x, y, angle].iter().all(|n| n.is_nan())
            {
                row = rest;
            }
            digest.row(row);
        }
        digest.text()
    }
}

#[cfg(test)]
pub(crate) mod tests;
