//! Aplomb: composable controllers for physically simulated characters.

pub mod render;
