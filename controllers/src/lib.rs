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

pub mod idle;
pub mod kinds;
pub mod momentum;
pub mod servo;
pub mod target;

use aplomb_framework::control::Registry;
use aplomb_framework::input::shipped;
use include_dir::{Dir, include_dir};

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
    let all = FILES.iter().flat_map(|(folder, files)| {
        let named = move |(name, text)| (format!("{folder}/{name}.ron"), text);
        shipped(files).into_iter().map(named)
    });
    all.fold(registry, |r, (name, text)| r.with_file(name, text))
}

/// The folders of this crate that are shipped, by name.
static FILES: [(&str, Dir); 4] = [
    ("clips", include_dir!("$CARGO_MANIFEST_DIR/clips")),
    ("learned", include_dir!("$CARGO_MANIFEST_DIR/learned")),
    (
        "repertoires",
        include_dir!("$CARGO_MANIFEST_DIR/repertoires"),
    ),
    ("skills", include_dir!("$CARGO_MANIFEST_DIR/skills")),
];
