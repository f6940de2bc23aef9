//! `aplomb train`: searches and training, one file each.

mod basis;
mod cmrt;
mod figures;
mod preconditions;
mod skill;

use std::io::Write;

use anyhow::Result;
use aplomb::framework::character::Model;
use aplomb::training::exercise::skill::Skill;
use clap::Subcommand;

use super::Ending;
use super::scene::CastArgs;

/// Optimise controllers
#[derive(Debug, Subcommand)]
pub(super) enum TrainCommand {
    Basis(Box<basis::BasisArgs>),
    Cmrt(Box<cmrt::CmrtArgs>),
    Preconditions(Box<preconditions::PreconditionsArgs>),
    #[command(alias = "poses")]
    Skill(skill::SkillArgs),
}

impl TrainCommand {
    pub(super) fn run(self, out: &mut dyn Write) -> Result<Ending> {
        match self {
            Self::Basis(args) => args.run(out),
            Self::Cmrt(args) => args.run(out),
            Self::Preconditions(args) => args.run(out),
            Self::Skill(args) => args.run(out),
        }
    }
}

/// The controllers of the repertoire that was asked for.
pub(super) fn skills(cast: &CastArgs) -> Result<Vec<Skill>> {
    let registry = aplomb::controllers::registry();
    let scenario = cast.apply(None, 1.0, &registry)?;
    let role = &scenario.characters[0];
    let model = Model::load(&role.character)?;
    let repertoire = role.repertoire(&model);
    Ok(Skill::all(repertoire, &registry, &model)?)
}
