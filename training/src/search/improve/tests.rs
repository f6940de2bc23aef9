//! Searches on a repertoire whose only skill is quickly found.

use super::*;
use crate::exercise::skill::tests::{TUCK, skills};

fn plan(out: &Path, evaluations: usize, resume: bool) -> SearchPlan<'_> {
    SearchPlan {
        evaluations,
        starts: 2,
        seed: 3,
        sigma: 0.2,
        out,
        resume,
    }
}

fn tuck(plan: SearchPlan<'_>) -> Result<Option<FoundNumbers>> {
    let (_folder, skills) = skills(TUCK);
    let skill = Skill::find(&skills, "tuck").unwrap();
    improve(skill, plan, |_| ControlFlow::Continue(()))
}

#[test]
fn a_search_that_was_ended_goes_on_to_the_same_file() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("tuck.ron");
    let journal = beside(&out);
    let read = || {
        (
            std::fs::read(&out).unwrap(),
            std::fs::read(&journal).unwrap(),
        )
    };
    let whole = tuck(plan(&out, 18, false)).unwrap().unwrap();
    let files = read();
    assert_eq!(whole.evaluations, 25);
    assert!(whole.best.cost < whole.start.cost, "{whole:?}");
    let text = String::from_utf8(files.0.clone()).unwrap();
    let header = "// Optimised by CMA-ES over 2 starts in varied worlds, seed 3, ";
    assert!(text.starts_with(header), "{text}");
    // Ended in the middle of the second generation, before the output was written.
    let lines: Vec<usize> = files
        .1
        .iter()
        .enumerate()
        .filter(|(_, b)| **b == b'\n')
        .map(|(i, _)| i)
        .collect();
    assert_eq!(lines.len(), 6);
    std::fs::write(&journal, &files.1[..lines[3] + 20]).unwrap();
    std::fs::remove_file(&out).unwrap();
    assert_eq!(tuck(plan(&out, 18, true)).unwrap().unwrap(), whole);
    assert_eq!(read(), files);
    // Nothing is left to do; and a longer search is the same up to there.
    assert_eq!(tuck(plan(&out, 18, true)).unwrap().unwrap(), whole);
    assert_eq!(read(), files);
    tuck(plan(&out, 26, true)).unwrap();
    assert!(read().1.starts_with(&files.1) && read().1.len() > files.1.len());
    let other = SearchPlan {
        sigma: 0.1,
        ..plan(&out, 18, true)
    };
    let told = tuck(other).unwrap_err().to_string();
    assert!(told.contains("sigma is 0.2; accepted: 0.1"), "{told}");
}

#[test]
fn the_output_may_be_the_controllers_own_file() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("tuck.ron");
    tuck(plan(&out, 1, false)).unwrap();
    let repertoire = folder.path().join("repertoire.ron");
    let text = r#"(name: "x", fallback: "rest", controllers: [File("tuck.ron"), File("skills/rest.ron")])"#;
    std::fs::write(&repertoire, text).unwrap();
    let model = aplomb_framework::character::Model::load("humanoid").unwrap();
    let registry = aplomb_controllers::registry();
    let search = |evaluations, resume| {
        let all = Skill::all(repertoire.to_str().unwrap(), &registry, &model).unwrap();
        let watch = |_| ControlFlow::Continue(());
        improve(&all[0], plan(&out, evaluations, resume), watch)
    };
    let first = search(9, false).unwrap().unwrap();
    let again = search(9, true).unwrap().unwrap();
    assert_eq!(first, again);
    // Somebody else's change of it is noticed.
    let text = std::fs::read_to_string(&out).unwrap();
    std::fs::write(&out, text.replace("patience: 1", "patience: 2")).unwrap();
    let all = Skill::all(repertoire.to_str().unwrap(), &registry, &model).unwrap();
    let elsewhere = folder.path().join("else.ron");
    std::fs::copy(beside(&out), beside(&elsewhere)).unwrap();
    let told = improve(&all[0], plan(&elsewhere, 9, true), |_| {
        ControlFlow::Continue(())
    });
    let told = told.unwrap_err().to_string();
    assert!(told.contains("controller is another; accepted: "), "{told}");
}

#[test]
fn starts_that_never_come_are_said_so() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("x.ron");
    let (_folder, skills) = skills(TUCK);
    let skill = Skill::find(&skills, "never").unwrap();
    let ended = improve(skill, plan(&out, 1, false), |_| ControlFlow::Break(()));
    assert_eq!(ended.unwrap(), None);
    let told = improve(skill, plan(&out, 1, false), |_| ControlFlow::Continue(()));
    let told = told.unwrap_err().to_string();
    assert!(
        told.contains("never: precondition is met in none"),
        "{told}"
    );
}

#[test]
fn what_cannot_be_searched_is_refused_before_anything_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("x.ron");
    let (_folder, skills) = skills(TUCK);
    let rest = Skill::find(&skills, "rest").unwrap();
    let told = improve(rest, plan(&out, 1, false), |_| ControlFlow::Continue(()));
    let told = told.unwrap_err().to_string();
    assert_eq!(
        told,
        "rest: kind is rest; accepted: pose, step, fall, balance, stance"
    );
    assert!(!beside(&out).exists());
}
