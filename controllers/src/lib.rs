//! The motor skills of Aplomb, one file each, and the repertoires that put them together.
//!
//! | file | kind | what it does |
//! |---|---|---|
//! | [`balance`] | `balance` | stands by momentum control |
//! | [`stance`] | `stance` | stands as an inverted pendulum |
//! | [`cmrt`] | `cmrt` | bends, catches, punches, pushes: balance that anticipates a task |
//! | [`step`] | `step` | puts a foot where the fall is caught, the other beside it; stands up from a crouch |
//! | [`fall`] | `fall` | breaks falls with the hands, folds knees and trunk |
//! | [`rest`] | `rest` | lets go; the fallback |
//! | [`pose`] | `pose` | a state machine of target poses, as data |
//!
//! They share [`momentum`] (momentum control with its [`gains`]), [`problem`] and [`quadratic_program`] (its
//! program and solver), [`servo`] (joint servos) and [`target`] (poses by joint name); `upright` is what
//! balancing and stepping have in common.

pub mod balance;
pub mod cmrt;
pub mod fall;
pub mod gains;
pub mod momentum;
pub mod pose;
pub mod problem;
pub mod quadratic_program;
pub mod rest;
pub mod servo;
pub mod stance;
pub mod step;
pub mod target;
mod upright;

use aplomb_framework::registry::Registry;

/// All the kinds of controllers and all shipped files.
#[must_use]
pub fn registry() -> Registry {
    let registry = Registry::new()
        .with::<balance::BalanceSpec>()
        .with::<cmrt::CmrtSpec>()
        .with::<stance::StanceSpec>()
        .with::<step::StepSpec>()
        .with::<fall::FallSpec>()
        .with::<rest::RestSpec>()
        .with::<pose::PoseSpec>();
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
    "poses/bow.ron",
    "poses/free_arms.ron",
    "poses/lower.ron",
    "poses/rise_hands_and_feet.ron",
    "poses/rise_kneeling.ron",
    "poses/rise_prone.ron",
    "poses/rise_sitting.ron",
    "poses/rise_supine.ron",
    "poses/roll.ron",
    "poses/roll_backward.ron",
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
