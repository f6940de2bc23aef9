//! Bad arguments: exit code 2, one clear message with what is accepted.

use std::path::Path;

use crate::{refusal, refusals};

fn here() -> &'static Path {
    Path::new(".")
}

#[test]
fn times_and_impulses() {
    insta::assert_snapshot!(refusals(
        here(),
        &[
            &["run", "--push", "x"],
            &["run", "--push", "1:torso"],
            &["run", "--push", "nan:torso:4"],
            &["run", "--push", "-1:torso:4"],
            &["run", "--push", "1e9:torso:4"],
            &["run", "--push", "1:torso:inf"],
            &["run", "--push", "1:torso:1e9"],
            &["run", "--duration", "nan"],
            &["run", "--duration", "-1"],
            &["run", "--duration", "1e12"],
            &["run", "--seed", "-1"],
        ],
    ));
}

#[test]
fn names_that_nothing_answers_to() {
    insta::assert_snapshot!(refusals(
        here(),
        &[
            &["nonsense"],
            &["run", "stroy"],
            &["run", "--character", "humaniod"],
            &["run", "--push", "1:torsoo:5"],
            &["run", "--set", "frction=1"],
            &["run", "push", "--set", "impluse=1"],
        ],
    ));
}

#[test]
fn counts_and_choices_of_trials() {
    insta::assert_snapshot!(refusals(
        here(),
        &[
            &["trials", "--count", "-1"],
            &["trials", "--count", "0"],
            &["trials", "--count", "1e12"],
            &["trials", "--count", "1000000000000"],
            &["trials", "--count", "5", "--only", "5"],
            &["trials", "--record", "x.trajectory"],
            &["trials", "--max-impulse", "nan"],
            &["trials", "--max-impulse", "10", "--min-impulse", "20"],
            &["trials", "--max-angle", "4"],
            &["trials", "--fallen", "--max-angle", "0.1"],
            &["trials", "--jobs", "0"],
        ],
    ));
}

#[test]
fn settings_out_of_bounds() {
    insta::assert_snapshot!(refusals(
        here(),
        &[
            &["run", "--set", "friction"],
            &["run", "--set", "friction=nan"],
            &["run", "--set", "friction=-1"],
            &["run", "--set", "gravity=1e9"],
            &["run", "--set", "torque=0"],
            &["run", "--set", "mass=1e9"],
            &["run", "--set", "duration=1e9"],
        ],
    ));
}

#[test]
fn an_unknown_command_comes_with_the_nearest() {
    let error = refusal(here(), &["run", "--command", "0.5:blance"]);
    assert!(error.contains("--command \"0.5:blance\""), "{error}");
    assert!(error.contains("did you mean 'balance'?"), "{error}");
    let error = refusal(here(), &["run", "--command", "0.5:jmup"]);
    assert!(
        error.contains("text is 'jmup'; accepted: a command: "),
        "{error}"
    );
    let error = refusal(here(), &["run", "--command", "0.5:balance speed=3"]);
    assert!(error.contains("takes no parameters"), "{error}");
    let error = refusal(here(), &["run", "--command", "0.5:balance speed"]);
    assert!(error.contains("is no key=value"), "{error}");
}

#[test]
fn an_unknown_repertoire_comes_with_the_nearest() {
    let error = refusal(here(), &["run", "--repertoire", "humanod"]);
    assert!(error.contains("did you mean 'humanoid'?"), "{error}");
}
