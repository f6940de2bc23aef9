//! A clip: a scenario whose first character is commanded to an anticipatory controller.
//!
//! scenario, repertoire → [`Clip`] → supervisors with other trajectories.

use std::collections::BTreeMap;
use std::sync::Arc;

use aplomb_controllers::kinds::cmrt::{Cmrt, CmrtController, CmrtSpec};
use aplomb_framework::character::Model;
use aplomb_framework::control::{Command, Contract, Controller, Registry, Spec, Supervisor};
use aplomb_framework::input::{Error, Result};
use aplomb_framework::run::Simulation;
use aplomb_framework::scenario::{Scenario, ScheduledInput};

use crate::exercise::skill::Skill;
use crate::search::tune::{line_of, text_of};

/// What is optimised: one motion of the controller that a scenario commands.
#[derive(Debug, Clone)]
pub struct Clip {
    /// The world, the real parameters, what is expected.
    pub scenario: Scenario,
    /// The controller in its place, and the first character.
    pub skill: Skill,
    /// s at which it is commanded.
    pub at: f64,
    /// Place of the motion that is optimised; the others keep the trajectories of their file.
    motion: usize,
    spec: CmrtSpec,
    /// As commanded, with its own trajectories.
    controller: CmrtController,
    /// The value of the motion's parameter, as commanded.
    value: f64,
}

impl Clip {
    /// The clip of a scenario with its parameters set, and which of its motions is optimised, the last
    /// if none is given.
    ///
    /// # Errors
    /// No such motion; no command, or one to a controller of another kind; an invalid repertoire or controller.
    pub fn new(scenario: Scenario, motion: Option<usize>, registry: &Registry) -> Result<Self> {
        let role = &scenario.characters[0];
        let model = Model::load(&role.character)?;
        let repertoire = role.repertoire(&model);
        let skills = Skill::all(repertoire, registry, &model)?;
        let (at, text) = commanded(&scenario)?;
        let command: Command = text.parse()?;
        let answers = |s: &&Skill| s.contract.answer(&command).is_some();
        let skill = skills.iter().find(answers).ok_or_else(|| {
            let known = skills.iter().map(Skill::name);
            Error::unknown("command", &command.name, known)
        })?;
        if skill.kind() != CmrtSpec::KIND {
            let (problem, accepted) = (skill.kind(), CmrtSpec::KIND);
            return Err(Error::invalid(skill.name(), "kind", problem, accepted));
        }
        let spec: CmrtSpec = skill.file.parameters()?;
        let controller = spec
            .clone()
            .controller(skill.contract.clone(), &model)?
            .commanded(&command)?;
        let motion = motion.unwrap_or(spec.motions.len().saturating_sub(1));
        let Some(optimised) = spec.motions.get(motion) else {
            let accepted = format!("0 to {}", spec.motions.len().saturating_sub(1));
            return Err(Error::invalid(skill.name(), "motion", motion, accepted));
        };
        let named = optimised.parameter.as_ref();
        let value = named.map_or(0.0, |n| skill.contract.parameter(Some(&command), n, 0.0));
        Ok(Self {
            skill: skill.clone(),
            scenario,
            at,
            motion,
            spec,
            controller,
            value,
        })
    }

    /// The first character.
    #[must_use]
    pub fn model(&self) -> &Arc<Model> {
        &self.skill.model
    }

    /// The controller's contract.
    #[must_use]
    pub fn contract(&self) -> &Contract {
        &self.skill.contract
    }

    /// The scenario's parameters as they are set.
    #[must_use]
    pub fn parameters(&self) -> BTreeMap<String, f64> {
        let all = self.scenario.parameters.iter();
        all.map(|(name, p)| (name.clone(), p.value)).collect()
    }

    /// s of the motion that is optimised.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.spec.motions[self.motion].length
    }

    /// The time at a phase of the motion, 0 to 3, s after the command.
    fn time(&self, phase: f64) -> f64 {
        let line = self.controller.timeline(self.motion);
        line.map_or(0.0, |line| line.time(phase))
    }

    /// When the motion begins and ends, s.
    #[must_use]
    pub fn window(&self) -> [f64; 2] {
        [0.0, 3.0].map(|phase| self.at + self.time(phase))
    }

    /// When its task begins, s.
    #[must_use]
    pub fn task(&self) -> f64 {
        self.at + self.time(1.0)
    }

    /// Whether another motion goes on after it.
    #[must_use]
    pub fn goes_on(&self) -> bool {
        self.at + self.controller.length() > self.window()[1] + 1e-9
    }

    /// s of preparation, task and decay of the motion that is optimised, as commanded.
    #[must_use]
    pub fn phases(&self) -> [f64; 3] {
        let [t0, t1, t2, t3] = [0.0, 1.0, 2.0, 3.0].map(|phase| self.time(phase));
        [t1 - t0, t2 - t1, t3 - t2]
    }

    /// The controller as commanded, with its own trajectories.
    #[must_use]
    pub fn controller(&self) -> &CmrtController {
        &self.controller
    }

    /// The trajectory that its file has for this command, if any.
    #[must_use]
    pub fn shipped(&self) -> Option<Cmrt> {
        aplomb_controllers::kinds::cmrt::interpolated(
            &self.spec.motions[self.motion].cmrts,
            self.value,
        )
    }

    /// Values of the motion's parameter for which its file has trajectories, in ascending order.
    #[must_use]
    pub fn learned_values(&self) -> Vec<f64> {
        let family = &self.spec.motions[self.motion].cmrts;
        family.iter().map(|cmrt| cmrt.value).collect()
    }

    /// The repertoire with the motion along another trajectory; with none, no motion has one.
    ///
    /// # Errors
    /// What makes a repertoire invalid.
    pub fn supervisor(&self, cmrt: Option<Cmrt>) -> Result<Supervisor> {
        let own = self.controller.clone();
        let controller = match cmrt {
            Some(cmrt) => own.with_cmrt(self.motion, Some(cmrt)),
            None => (0..self.spec.motions.len()).fold(own, |c, i| c.with_cmrt(i, None)),
        };
        self.skill.supervisor.with_replaced(controller.clone_box())
    }

    /// The scenario's run with the controller's first motion along a trajectory, or none, at its
    /// beginning.
    ///
    /// # Errors
    /// What makes a scenario or repertoire invalid.
    pub fn simulation(&self, cmrt: Option<Cmrt>) -> Result<Simulation> {
        let cast = vec![(Arc::clone(self.model()), self.supervisor(cmrt)?)];
        Simulation::with_cast(&self.scenario, cast)
    }

    /// The controller's file with one more trajectory, in the place of one for the same value.
    #[must_use]
    pub fn text(&self, cmrt: &Cmrt, comment: &str) -> String {
        text_of(&self.skill.file.contract, None, &self.with(cmrt), comment)
    }

    /// The same in one line.
    #[must_use]
    pub fn line(&self, cmrt: &Cmrt) -> String {
        line_of(&self.skill.file.contract, None, &self.with(cmrt))
    }

    fn with(&self, cmrt: &Cmrt) -> CmrtSpec {
        let mut spec = self.spec.clone();
        let family = &mut spec.motions[self.motion].cmrts;
        let value = self.value;
        family.retain(|c| c.value != value && c.times.len() == cmrt.times.len());
        let place = family.partition_point(|c| c.value < value);
        family.insert(
            place,
            Cmrt {
                value,
                ..cmrt.clone()
            },
        );
        spec
    }
}

/// The first command to the first character, and when, s.
fn commanded(scenario: &Scenario) -> Result<(f64, String)> {
    for event in &scenario.events {
        if let ScheduledInput::Command {
            at,
            text,
            character: 0,
        } = event
        {
            return Ok((scenario.number(at)?, scenario.filled(text)?));
        }
    }
    let accepted = "a command to the first character, which starts the clip";
    Err(Error::invalid(&scenario.name, "events", "none", accepted))
}
