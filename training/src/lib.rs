//! Optimisation of Aplomb's controllers over many perturbed rollouts.
//!
//! - [`cma_es`]: bounded minimisation by CMA-ES, parallel and deterministic
//! - [`dimension`]: what is optimised, mapped to the unit cube
//! - [`falling`]: how well a falling controller protects
//! - [`standing`]: how well a standing controller takes pushes at its limit
//! - [`tune`]: controller file → optimised controller file

pub mod cma_es;
pub mod dimension;
pub mod falling;
pub mod rising;
pub mod standing;
pub mod starts;
pub mod stepping;
pub mod tune;
pub mod worlds;
