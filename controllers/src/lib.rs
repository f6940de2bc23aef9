//! The motor skills of Aplomb, one file each, and the repertoires that put them together.
//!
//! | file | kind | what it does |
//! |---|---|---|
//! | [`balance`](kinds::balance) | `balance` | stands by momentum control |
//! | [`stance`](kinds::stance) | `stance` | stands as an inverted pendulum |
//! | [`cmrt`](kinds::cmrt) | `cmrt` | bends, catches, punches, pushes: balance that anticipates a task |
//! | [`step`](kinds::step) | `step` | puts a foot where the fall is caught, the other beside it; stands up from a crouch |
//! | [`fall`](kinds::fall) | `fall` | breaks falls with the hands, folds knees and trunk |
//! | [`rest`](kinds::rest) | `rest` | lets go; the fallback |
//! | [`pose`](kinds::pose) | `pose` | a state machine of target poses, as data |
//!
//! They share [`momentum`] (momentum control with its gains, its quadratic program and solver), [`servo`]
//! (joint servos) and [`target`] (poses by joint name).

#![cfg_attr(
    test,
    allow(
        clippy::disallowed_methods,
        reason = "tests compare with the standard library's functions"
    )
)]

pub mod kinds;
pub mod momentum;
pub mod servo;
pub mod target;

use aplomb_framework::control::Registry;

/// All the kinds of controllers and all shipped files.
#[must_use]
pub fn registry() -> Registry {
    let registry = Registry::new()
        .with::<kinds::balance::BalanceSpec>()
        .with::<kinds::cmrt::CmrtSpec>()
        .with::<kinds::stance::StanceSpec>()
        .with::<kinds::step::StepSpec>()
        .with::<kinds::fall::FallSpec>()
        .with::<kinds::rest::RestSpec>()
        .with::<kinds::pose::PoseSpec>();
    FILES
        .iter()
        .fold(registry, |r, (name, text)| r.with_file(name, text))
}

/// A file of this crate under its own name.
macro_rules! shipped {
    ($($name:literal),* $(,)?) => {
        &[$(($name, include_str!(concat!("../", $name)))),*]
    };
}

const FILES: &[(&str, &str)] = shipped![
    "clips/bend.ron",
    "clips/catch.ron",
    "clips/dodge_tire.ron",
    "clips/duck_twice.ron",
    "clips/hit_tire.ron",
    "clips/kick.ron",
    "clips/pull_box.ron",
    "clips/punch.ron",
    "clips/push.ron",
    "learned/balance.boundary.ron",
    "learned/fall.boundary.ron",
    "learned/protective_step.boundary.ron",
    "learned/rise_hands_and_feet.boundary.ron",
    "learned/rise_kneeling.boundary.ron",
    "learned/rise_prone.boundary.ron",
    "learned/rise_sitting.boundary.ron",
    "learned/rise_supine.boundary.ron",
    "learned/roll.boundary.ron",
    "skills/bow.ron",
    "skills/free_arms.ron",
    "skills/lower.ron",
    "skills/rise_hands_and_feet.ron",
    "skills/rise_kneeling.ron",
    "skills/rise_prone.ron",
    "skills/rise_sitting.ron",
    "skills/rise_supine.ron",
    "skills/roll.ron",
    "skills/roll_backward.ron",
    "repertoires/humanoid.ron",
    "repertoires/learned.ron",
    "repertoires/limp.ron",
    "repertoires/lion.ron",
    "repertoires/paper.ron",
    "repertoires/sumo.ron",
    "skills/balance.ron",
    "skills/balance_equality.ron",
    "skills/fall.ron",
    "skills/protective_step.ron",
    "skills/rest.ron",
    "skills/stance.ron",
    "skills/stand_up.ron",
];
