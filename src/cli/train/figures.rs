//! The figures of `train cmrt` and `train basis`: SVG files in a folder, named after the clip.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use aplomb::controllers::kinds::cmrt::Cmrt;
use aplomb::framework::input::write_atomically;
use aplomb::framework::run::Trajectory;
use aplomb::framework::scenario::Scenario;
use aplomb::render::anticipation::{Drawing, LearnedTrajectory, Rollout, basis, learned};
use aplomb::render::{FilmOptions, filmstrip};
use aplomb::training::anticipation::basis::Basis;
use aplomb::training::anticipation::clip::Clip;
use aplomb::training::anticipation::objective::Judged;
use aplomb::training::anticipation::search::FoundTrajectory;

use crate::cli::output::{check_writable, message};
use crate::cli::scene;

/// Frames of either film strip, so that they are compared with each other.
const FRAMES: usize = 12;

/// A folder for figures, checked before the search.
pub(super) struct Figures {
    folder: PathBuf,
    /// What the files' names begin with.
    stem: String,
}

impl Figures {
    /// # Errors
    /// A folder that cannot be written into.
    pub(super) fn new(folder: &Path, scenario: &Scenario) -> Result<Self> {
        let last = scenario.name.rsplit(['/', '\\']).next();
        let figures = Self {
            folder: folder.to_owned(),
            stem: last.unwrap_or_default().to_owned(),
        };
        check_writable(&figures.path("figure"))?;
        Ok(figures)
    }

    /// The same for a clip, which will be recorded.
    ///
    /// # Errors
    /// Also a run that is too long for a recording.
    pub(super) fn of_clip(folder: &Path, clip: &Clip) -> Result<Self> {
        scene::record(&mut clip.simulation(None)?, &clip.scenario).context("--figures")?;
        Self::new(folder, &clip.scenario)
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.join(format!("{}.{name}.svg", self.stem))
    }

    fn write(&self, drawings: &[Drawing]) -> Result<()> {
        for Drawing { name, svg } in drawings {
            write_atomically(&self.path(name), svg.as_bytes())?;
        }
        let folder = self.folder.display();
        message(format_args!(
            "{} figures drawn into {folder}",
            drawings.len()
        ));
        Ok(())
    }

    /// Draws what was found for a clip beside the clip without it.
    pub(super) fn found(
        &self,
        clip: &Clip,
        found: &FoundTrajectory,
        flat: &Judged,
        optimised: &Judged,
    ) -> Result<()> {
        let without = recorded(clip, None, "without anticipation")?;
        let with = recorded(clip, Some(&found.cmrt), "with anticipation")?;
        let rollout = |recording, objective, judged: &Judged| Rollout {
            recording,
            objective,
            cop_norm: judged.cop_norm,
        };
        let [preparation, task, decay] = clip.phases();
        let mut drawings = learned(&LearnedTrajectory {
            controller: &clip.contract().name,
            begin: clip.window()[0],
            phases: [preparation, preparation + task, preparation + task + decay],
            cmrt: &found.cmrt,
            course: &found.course,
            without: rollout(&without, found.flat, flat),
            with: rollout(&with, found.objective, optimised),
        })?;
        let options = FilmOptions {
            frames: Some(FRAMES),
            ..FilmOptions::default()
        };
        for (name, recording) in [("without", &without), ("with", &with)] {
            let svg = filmstrip(recording, &options)?;
            drawings.push(Drawing { name, svg });
        }
        self.write(&drawings)
    }

    /// Draws a basis and the family that it is of.
    pub(super) fn basis(&self, of: &Basis) -> Result<()> {
        self.write(&basis(of)?)
    }
}

/// The clip's run along a trajectory, or none.
fn recorded(clip: &Clip, cmrt: Option<&Cmrt>, how: &str) -> Result<Trajectory> {
    let mut simulation = clip.simulation(cmrt.cloned())?;
    let scenario = Scenario {
        name: format!("{}, {how}", clip.scenario.name),
        ..clip.scenario.clone()
    };
    scene::record(&mut simulation, &scenario)?;
    simulation.run(scenario.duration);
    simulation.into_recording().context("nothing was recorded")
}
