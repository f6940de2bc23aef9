//! Anticipation learned for a task: centre-of-mass reference trajectories by CMA-ES over a clip
//! (2017 paper, sections 4 and 5).
//!
//! clip ([`clip`]: scenario and controller) → candidates ([`encoding`]: the unit cube, or a [`basis`]) →
//! rollout and [`objective`] → [`search`] → trajectory in the controller's file.

pub mod basis;
pub mod clip;
pub mod encoding;
mod knots;
pub mod objective;
pub mod search;
