use aplomb_training::anticipation::basis::Basis;

use super::*;
use crate::render::seen::{Sight, assert_seen};
use crate::render::style::{FORCE, INK};
use crate::render::tests::recording;

/// Places of the centre of pressure and of the reference in a row of a recording, from its end.
const COP: usize = 5;

fn cmrt(value: f64) -> Cmrt {
    Cmrt {
        value,
        length: 1.8,
        times: vec![0.3, 0.7, 1.1, 1.5],
        displacements: vec![-0.01, 0.002 * value, 0.03, 0.01],
    }
}

const COURSE: [(usize, f64); 4] = [(1, 19.5), (11, 6.0), (21, 4.0), (31, 4.0)];

/// A motion from 0.1 s on; the recording's controller is replaced at 1 s.
fn drawn_with(
    recording: &Trajectory,
    change: impl FnOnce(&mut LearnedTrajectory<'_>),
) -> Result<Vec<Drawing>> {
    let rollout = |objective| Rollout {
        recording,
        objective,
        cop_norm: 3.5,
    };
    let cmrt = cmrt(1.0);
    let mut of = LearnedTrajectory {
        controller: "balance",
        begin: 0.1,
        phases: [0.8, 1.2, 1.8],
        cmrt: &cmrt,
        course: &COURSE,
        without: rollout(19.5),
        with: rollout(4.0),
    };
    change(&mut of);
    learned(&of)
}

fn checked(drawings: Vec<Drawing>) -> Vec<Drawing> {
    for Drawing { name, svg } in &drawings {
        let seen = assert_seen(svg, &sights(name));
        let crowded = seen.crowded();
        assert!(crowded.is_empty(), "{name}: {crowded:?}");
    }
    drawings
}

/// What each drawing must show, whatever its numbers are.
fn sights(name: &str) -> Vec<Sight<'static>> {
    let texts: &[&str] = match name {
        "cop" => &[
            "without anticipation",
            "with anticipation",
            "(m)",
            "(s)",
            "base of support",
        ],
        "cmrt" => &["preparation", "task", "decay", "knots", "(m)", "(s)"],
        "convergence" => &["best objective", "evaluations", "best so far"],
        "family" => &["ma<s>s", "(m)", "(s)"],
        "components" => &["component 1", "mean", "displacement (m)", "time (s)"],
        _ => &[
            "variance explained (%)",
            "principal component",
            "each alone",
        ],
    };
    let mut sights: Vec<_> = texts.iter().map(|t| Sight::Text(t, 1)).collect();
    match name {
        "cmrt" => sights.push(Sight::Curve(INK, 300, 400.0)),
        "components" => sights.push(Sight::Curve("#d55e00", 300, 200.0)),
        _ => {}
    }
    sights
}

/// The centre of pressure is a curve in either panel, the course a curve of its steps.
#[test]
fn a_motion_has_curves() {
    let figures = drawn(&recording(2500, |_, _| {}), |_| {});
    let cop = assert_seen(&figures[0].svg, &[Sight::Curve(FORCE, 100, 100.0)]);
    let long = cop.coloured(FORCE);
    let long = long.iter().filter(|o| o.points >= 100);
    let tops: Vec<f32> = long.map(|o| o.extent.top()).collect();
    let panels = tops.iter().map(|y| usize::from(*y > 220.0));
    assert_eq!(
        panels.collect::<std::collections::BTreeSet<_>>().len(),
        2,
        "{tops:?}"
    );
    let steps = 2 * COURSE.len() - 1;
    assert_seen(&figures[2].svg, &[Sight::Curve("#0072b2", steps, 300.0)]);
}

fn drawn(recording: &Trajectory, change: impl FnOnce(&mut LearnedTrajectory<'_>)) -> Vec<Drawing> {
    checked(drawn_with(recording, change).unwrap())
}

#[test]
fn a_motion_has_three_figures_with_units() {
    let figures = drawn(&recording(2500, |_, _| {}), |_| {});
    let names: Vec<_> = figures.iter().map(|d| d.name).collect();
    assert_eq!(names, ["cop", "cmrt", "convergence"]);
    let shows = |k: usize, labels: &[&str]| {
        for label in labels {
            assert!(figures[k].svg.contains(label), "{k}: {label}");
        }
    };
    let cop = ["without anticipation", "with anticipation", "(m)", "(s)"];
    shows(0, &cop);
    shows(0, &["takes over", "objective 19.50", "base of support"]);
    assert!(!figures[0].svg.contains("2-norm"), "both were given up");
    shows(1, &["preparation", "task", "decay", "knots", "(m)", "(s)"]);
    shows(2, &["evaluations", "19.500", "4.000"]);
    assert!(!figures[2].svg.contains("logarithmic"));
}

#[test]
fn a_motion_that_comes_to_its_end_has_a_norm() {
    let figures = drawn(&recording(900, |_, _| {}), |_| {});
    assert!(figures[0].svg.contains("2-norm 3.50 m"));
    assert!(!figures[0].svg.contains("takes over"));
}

#[test]
fn numbers_that_are_not_finite_are_left_out() {
    let gaps = recording(2500, |i, row| {
        let cop = row.len() - COP;
        if i % 700 < 200 {
            row[cop..].fill(f32::NAN);
        }
    });
    drawn(&gaps, |of| {
        of.without.objective = f64::NAN;
        of.without.cop_norm = f64::INFINITY;
        of.course = &[(1, f64::INFINITY), (11, 4.0), (21, f64::NAN)];
    });
    drawn(&gaps, |of| of.course = &[(7, f64::NAN)]);
}

#[test]
fn over_a_decade_the_objective_is_logarithmic() {
    let run = recording(1500, |_, _| {});
    let figures = drawn(&run, |of| of.course = &[(1, 20.0), (11, 0.05)]);
    assert!(figures[2].svg.contains("logarithmic"));
    assert!(figures[2].svg.contains(">\n0.1\n<") || figures[2].svg.contains(">0.1<"));
    assert_eq!(drawn(&run, |of| of.course = &[]).len(), 2);
    drawn(&run, |of| of.course = &[(1, 0.0), (2, -1.0)]);
}

#[test]
fn what_is_no_motion_is_refused() {
    let run = recording(1500, |_, _| {});
    let refused =
        |change: fn(&mut LearnedTrajectory<'_>)| drawn_with(&run, change).unwrap_err().to_string();
    assert!(refused(|of| of.phases = [1.0, 0.5, 2.0]).starts_with("phases"));
    assert!(refused(|of| of.phases[2] = f64::NAN).starts_with("phases"));
    assert!(refused(|of| of.begin = f64::INFINITY).starts_with("begin"));
    assert!(refused(|of| of.course = &[(0, 1.0)]).starts_with("course"));
    assert!(refused(|of| of.course = &[(9, 1.0), (3, 1.0)]).starts_with("course"));
    let empty = recording(0, |_, _| {});
    let told = drawn_with(&empty, |_| {}).unwrap_err().to_string();
    assert!(told.contains("empty"), "{told}");
}

fn family(count: u32) -> Basis {
    let member = |i: u32| {
        let mut member = cmrt(f64::from(i));
        member.times[1] += 0.01 * f64::from(i % 3);
        member
    };
    Basis::new("x", "ma<s>s", 0, (0..count).map(member).collect(), 2).unwrap()
}

#[test]
fn a_basis_has_three_figures() {
    for count in [2, 7, 60] {
        let figures = checked(basis(&family(count)).unwrap());
        let names: Vec<_> = figures.iter().map(|d| d.name).collect();
        assert_eq!(names, ["family", "components", "variance"]);
        assert!(figures[0].svg.contains("ma&lt;s&gt;s"));
        assert!(figures[1].svg.contains("component 1") && figures[1].svg.contains("mean"));
        assert!(figures[2].svg.contains("variance explained (%)"));
        assert_eq!(figures[2].svg.contains("2 kept"), count > 2);
    }
}

#[test]
fn what_is_no_basis_is_refused() {
    let refused = |spoil: fn(&mut Basis)| {
        let mut bad = family(5);
        spoil(&mut bad);
        basis(&bad).unwrap_err().to_string()
    };
    assert!(refused(|b| b.family.clear()).starts_with("family"));
    assert!(refused(|b| b.family[1].times[0] = 9.0).contains("in order"));
    assert!(refused(|b| b.mean.clear()).starts_with("mean"));
    assert!(refused(|b| b.components.clear()).starts_with("components"));
    assert!(refused(|b| b.components[0].truncate(2)).starts_with("components"));
    assert!(refused(|b| b.explained.clear()).starts_with("explained"));
    assert!(refused(|b| b.explained[0] = f64::NAN).starts_with("explained"));
}
