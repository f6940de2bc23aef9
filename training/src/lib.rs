//! Optimisation of Aplomb's controllers over many perturbed rollouts.
//!
//! Controllers of a repertoire, in random worlds:
//!
//! - [`skill`]: a controller with the repertoire around it
//! - [`worlds`]: friction, strength and mass that the controllers do not know
//! - [`starts`]: heaps and falls from which the repertoire hands over to a controller
//! - [`pushes`]: pushes of a character that stands
//! - [`rising`]: how well a controller brings a character that is down to its goal
//! - [`stepping`]: how well a step takes pushes
//! - [`falling`]: how well a falling controller protects
//! - [`impact`]: how hard head and trunk are hit
//! - [`exercise`]: which of the three a controller is measured by, and its score
//! - [`improve`](mod@improve): skill → better controller file
//! - [`journal`]: what a search has found out so far, on disk
//!
//! Controllers alone:
//!
//! - [`standing`]: how well a standing controller takes pushes at its limit
//!
//! Learned pre-conditions:
//!
//! - [`rollouts`]: what a controller can really do, as a dataset
//! - [`learning`]: samples of successes and failures → support vector machine, nearest neighbour
//! - [`report`]: how often a learned pre-condition is right, beside its rivals
//!
//! All of them:
//!
//! - [`tune`]: controller file ↔ point of the unit cube
//! - [`dimension`]: what is optimised, mapped to the unit cube
//! - [`cma_es`]: bounded minimisation by CMA-ES, parallel and deterministic

pub mod anticipation;
pub mod cma_es;
pub mod dimension;
pub mod exercise;
pub mod falling;
mod growing;
pub mod impact;
pub mod improve;
pub mod journal;
pub mod learning;
pub mod pushes;
pub mod report;
pub mod rising;
pub mod rollouts;
pub mod skill;
pub mod standing;
pub mod starts;
pub mod stepping;
pub mod tune;
pub mod worlds;
