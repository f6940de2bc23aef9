//! Starts and scores on any number of threads.

use super::*;
use crate::exercise::skill::tests::{TUCK, shipped, skills};
use aplomb_framework::control::repertoire;

fn runs(exercise: &Exercise) -> &[Simulation] {
    match &exercise.begun {
        Begun::Runs(starts) => &starts.runs,
        Begun::Pushes(_) => &[],
    }
}

fn digests(exercise: &Exercise) -> Vec<String> {
    runs(exercise).iter().map(Simulation::digest).collect()
}

/// Digests of the starts, and the score, on so many threads.
fn exercised(threads: usize, skill: &Skill, drill: Drill) -> (Vec<String>, Score) {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    pool.unwrap().install(|| {
        let exercise = Exercise::new(skill, drill, |_| ControlFlow::Continue(())).unwrap();
        (digests(&exercise), exercise.judge(&skill.supervisor))
    })
}

fn tuck(threads: usize, text: &str) -> (Vec<String>, Score) {
    let (_folder, skills) = skills(text);
    let skill = Skill::find(&skills, "tuck").unwrap();
    exercised(threads, skill, Drill::training(3, 5))
}

#[test]
fn starts_and_scores_are_the_same_on_any_number_of_threads() {
    let (starts, score) = tuck(1, TUCK);
    assert_eq!(starts.len(), 3);
    assert_eq!(tuck(2, TUCK), (starts.clone(), score));
    assert!(score.reached > 0 && score.cost < 2.0, "{score:?}");
    // Other numbers of the controller: the same starts.
    let (same, other) = tuck(2, &TUCK.replace(r#""hip": 0.5"#, r#""hip": 0.7"#));
    assert_eq!(same, starts);
    assert_ne!(other, score);
}

#[test]
fn skills_that_are_exercised_together_start_as_each_does_alone() {
    let (_folder, skills) = skills(TUCK);
    let [tuck, never] = ["tuck", "never"].map(|name| Skill::find(&skills, name).unwrap());
    let drill = Drill::training(3, 5);
    let together = Exercise::all(&[never, tuck], drill, |_| ControlFlow::Continue(())).unwrap();
    assert_eq!(together[0].starts(), 0);
    assert_eq!(digests(&together[1]), exercised(1, tuck, drill).0);
}

#[test]
fn a_fall_is_scored_by_how_it_lands() {
    let model = Model::load("humanoid").unwrap();
    let registry = aplomb_controllers::registry();
    let fall = &shipped("fall");
    let drill = Drill::training(6, 2);
    let (starts, score) = exercised(1, fall, drill);
    assert_eq!(starts.len(), 6);
    assert_eq!(exercised(2, fall, drill), (starts, score));
    assert!((4..=6).contains(&score.reached), "{score:?}");
    let exercise = Exercise::new(fall, drill, |_| ControlFlow::Continue(())).unwrap();
    let limp = repertoire::load("limp", &registry, &model).unwrap();
    let limp = exercise.judge(&limp);
    assert!(limp.reached < score.reached, "{limp:?} {score:?}");
    assert!(limp.cost > score.cost + 1.0, "{limp:?} {score:?}");
}

#[test]
fn who_is_seldom_asked_also_starts_as_its_rollouts_do() {
    let skill = shipped("rise_hands_and_feet");
    let exercise = Exercise::new(&skill, Drill::cell(Worlds::VARIED, 8, 1), |_| {
        ControlFlow::Continue(())
    })
    .unwrap();
    assert_eq!(exercise.starts(), 8);
    assert!(exercise.own_starts() > 0);
    for start in runs(&exercise) {
        let mut run = start.clone();
        run.step();
        assert!(skill.contract.precondition.holds(run.sensors(0)));
    }
}

#[test]
fn standing_is_scored_by_the_pushes_that_it_withstands() {
    let balance = &shipped("balance");
    let drill = Drill::training(4, 0);
    let exercise = Exercise::new(balance, drill, |_| ControlFlow::Continue(())).unwrap();
    assert_eq!((exercise.starts(), exercise.own_starts()), (4, 0));
    let score = exercise.judge(&balance.supervisor);
    assert!(score.reached >= 1 && score.cost < 1.0, "{score:?}");
    // Whoever lacks the controller withstands nothing.
    let (_folder, others) = skills(TUCK);
    let none = exercise.judge(&others[0].supervisor);
    assert_eq!(none, Score::WORST);
}
