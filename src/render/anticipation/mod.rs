//! Figures of learned anticipation, as SVG (figures 1 to 3 and 5 to 7 of the 2017 paper).
//!
//! [`LearnedTrajectory`]: recordings without and with a trajectory, the course of its search → the centre of
//! pressure, the trajectory, the convergence. [`Basis`] → its family, its components, the variance that
//! they explain. Numbers that are not finite are left out.

mod components;
mod convergence;
mod family;
mod grades;
mod phases;
mod pressure;
mod reference;
mod samples;
mod variance;

use anyhow::{Result, ensure};
use aplomb_controllers::kinds::cmrt::Cmrt;
use aplomb_framework::run::Trajectory;
use aplomb_training::anticipation::basis::Basis;

/// A picture and what to call it.
#[derive(Debug, Clone)]
pub struct Drawing {
    /// One word, for a file's name.
    pub name: &'static str,
    /// An SVG document on white.
    pub svg: String,
}

/// A motion's run and how it was judged.
#[derive(Debug, Clone, Copy)]
pub struct Rollout<'a> {
    /// Of the clip's first character.
    pub recording: &'a Trajectory,
    /// What the search minimises.
    pub objective: f64,
    /// 2-norm of the centre of pressure's error, m, over steps of 1 ms.
    pub cop_norm: f64,
}

/// A trajectory that was learned for the first motion of a clip.
#[derive(Debug, Clone, Copy)]
pub struct LearnedTrajectory<'a> {
    /// The controller that moves.
    pub controller: &'a str,
    /// s of the recordings at which the motion begins.
    pub begin: f64,
    /// s from there on to the ends of preparation, task and decay.
    pub phases: [f64; 3],
    /// The trajectory.
    pub cmrt: &'a Cmrt,
    /// (evaluations, best objective) in the course of the search.
    pub course: &'a [(usize, f64)],
    /// With the reference over the middle of the base of support.
    pub without: Rollout<'a>,
    /// With the trajectory.
    pub with: Rollout<'a>,
}

/// The centre of pressure without and with the trajectory (`cop`), the trajectory (`cmrt`), and how it was
/// found (`convergence`), if its search has a course.
///
/// # Errors
/// An empty recording, phases out of order, an invalid trajectory, a course out of order.
pub fn learned(learned: &LearnedTrajectory<'_>) -> Result<Vec<Drawing>> {
    let [preparation, task, decay] = learned.phases;
    ensure!(
        learned.begin >= 0.0 && learned.begin.is_finite(),
        "begin is {}; accepted: 0 s and more",
        learned.begin
    );
    ensure!(
        0.0 <= preparation && preparation <= task && task <= decay && 0.0 < decay && decay < 1e6,
        "phases end at {:?} s; accepted: times in order",
        learned.phases
    );
    learned
        .cmrt
        .validate()
        .map_err(|e| e.at("the trajectory"))?;
    let mut drawings = vec![
        Drawing {
            name: "cop",
            svg: pressure::figure(learned)?,
        },
        Drawing {
            name: "cmrt",
            svg: reference::figure(learned)?,
        },
    ];
    if !learned.course.is_empty() {
        let svg = convergence::figure(learned.course, learned.without.objective)?;
        let name = "convergence";
        drawings.push(Drawing { name, svg });
    }
    Ok(drawings)
}

/// The trajectories of a basis (`family`), its principal components (`components`) and the variance that
/// each explains (`variance`).
///
/// # Errors
/// No trajectories or invalid ones, vectors of unequal length, parts of the variance that are none.
pub fn basis(basis: &Basis) -> Result<Vec<Drawing>> {
    Ok(vec![
        Drawing {
            name: "family",
            svg: family::figure(basis)?,
        },
        Drawing {
            name: "components",
            svg: components::figure(basis)?,
        },
        Drawing {
            name: "variance",
            svg: variance::figure(basis)?,
        },
    ])
}

#[cfg(test)]
mod tests;
