//! What contracts ask for, and scores on any number of threads.

use super::*;
use crate::exercise::skill::tests::{TUCK, shipped, skills};
use aplomb_framework::control::repertoire;
use aplomb_framework::sensing::Posture;

fn task(contract: &str) -> std::result::Result<Task, String> {
    let mut contract: Contract = ron::from_str(contract).unwrap();
    let model = Model::load("humanoid").unwrap();
    contract.resolve(&model).unwrap();
    Task::by_contract(&contract, &model).map_err(|e| e.to_string())
}

fn with(pre: &str, post: &str, weight: u32) -> std::result::Result<Task, String> {
    task(&format!(
        r#"(name: "x", weight: {weight}, precondition: {pre}, postcondition: {post})"#
    ))
}

#[test]
fn the_task_follows_from_the_contract() {
    let high = r#"All([Posture([standing]), Within(feature: "com_height", min: 0.75)])"#;
    let low = r#"Any([Posture([crouching]), Within(feature: "com_height", min: 0.75)])"#;
    let stand = "All([Posture([crouching, standing])])";
    assert_eq!(with(high, stand, 7), Ok(Task::Push));
    assert_eq!(with(low, stand, 7), Ok(Task::Rise(Goal::Stand)));
    assert_eq!(with(low, stand, 0), Ok(Task::Rise(Goal::Stand)));
    let prone = Task::Rise(Goal::Reach(Posture::Prone));
    assert_eq!(with(high, "Posture([prone, sitting])", 0), Ok(prone));
    let refusals = [(high, stand, 0), (low, "Never", 1), (low, "Always", 1)];
    for (pre, post, weight) in refusals {
        let told = with(pre, post, weight).unwrap_err();
        assert!(told.contains("accepted: "), "{told}");
    }
}

/// Digests of the starts, and the score, on so many threads.
fn exercised(threads: usize, skill: &Skill, drill: Drill) -> (Vec<String>, Score) {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    pool.unwrap().install(|| {
        let exercise = Exercise::new(skill, drill, |_| ControlFlow::Continue(())).unwrap();
        let digests = exercise
            .starts
            .runs
            .iter()
            .map(Simulation::digest)
            .collect();
        (digests, exercise.judge(&skill.supervisor))
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
    let starts = together[1].starts.runs.iter();
    let digests: Vec<String> = starts.map(Simulation::digest).collect();
    assert_eq!(digests, exercised(1, tuck, drill).0);
}

#[test]
fn a_fall_is_told_by_its_kind_and_scored_by_how_it_lands() {
    let model = Model::load("humanoid").unwrap();
    let registry = aplomb_controllers::registry();
    let fall = &shipped("fall");
    assert_eq!(Task::of(fall).unwrap(), Task::Fall);
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
    for start in &exercise.starts.runs {
        let mut run = start.clone();
        run.step();
        assert!(skill.contract.precondition.holds(run.sensors(0)));
    }
}
