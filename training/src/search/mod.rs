//! Searches: CMA-ES over the numbers of a controller file, resumable.
//!
//! controller file ↔ point of the unit cube ([`tune`], [`dimension`]) → [`cma_es`] → scores, kept by
//! the [`journal`] → better controller file ([`improve`](mod@improve)).

pub mod cma_es;
pub mod dimension;
pub(crate) mod growing;
pub mod improve;
pub mod journal;
pub mod tune;
