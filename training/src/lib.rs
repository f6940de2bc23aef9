//! Learning for Aplomb: better numbers for controllers, pre-conditions, and anticipation, all from
//! many perturbed rollouts.
//!
//! # Folders
//!
//! Each depends only on those above it in this list.
//!
//! | folder | data in → data out |
//! |---|---|
//! | [`situations`] | distribution, random stream → where a rollout begins |
//! | [`exercise`] | skill → rollouts → score |
//! | [`search`] | controller file → CMA-ES → better controller file |
//! | [`preconditions`] | rollouts → dataset → support vector machine → boundary file, report |
//! | [`anticipation`] | clip → CMA-ES or basis → reference trajectories of the centre of mass |

#![cfg_attr(
    test,
    allow(
        clippy::disallowed_methods,
        reason = "tests compare with the standard library's functions"
    )
)]

pub mod anticipation;
pub mod exercise;
pub mod preconditions;
pub mod search;
pub mod situations;
