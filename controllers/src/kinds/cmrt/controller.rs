//! Anticipatory balance: momentum control whose reference centre of mass is drawn forth and back in
//! time for a task that is known to come (2017 paper, sections 3 and 4).
//!
//! poses, phases, gains, trajectories → [`CmrtController`]; sensors → reference pose and centre of
//! mass → momentum control → torques. The reference is the middle of the base of support plus the
//! displacements of all motions under way, so that overlapping ones superpose.
//!
//! Succeeds when its motions are over and its post-condition holds. Fails as its contract says: when
//! what it met is not what it expected, the others take over.

#[cfg(test)]
mod tests;

use std::sync::Arc;

use aplomb_framework::character::Model;
use aplomb_framework::control::{Command, Contract, Controller, ControllerFile, Progress, Spec};
use aplomb_framework::input::{Error, Result, Source, check};
use aplomb_framework::sensing::Sensors;
use serde::{Deserialize, Serialize};

use crate::kinds::balance::BalanceSpec;
use crate::kinds::cmrt::motion::{Motion, Timeline};
use crate::kinds::cmrt::spline::Spline;
use crate::kinds::cmrt::trajectory;
use crate::kinds::cmrt::trajectory::Cmrt;
use crate::kinds::cmrt::waypoint::{Waypoint, blend, foot_named, waypoint};
use crate::momentum::{GLIDE, Gains, Swing, Upright, glided};
use crate::target::{NamedAngles, overlay};

/// At most this many motions in a row.
pub(super) const MOST_MOTIONS: usize = 16;

/// Balance for a task, whose gains serve every clip and character.
const BALANCE: &str = include_str!("../../../skills/balance_task.ron");

/// Parameters of [`CmrtController`] in a file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CmrtSpec {
    /// Gains and the pose that is begun with; those of the shipped `balance_task` if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub balance: Option<BalanceSpec>,
    /// Angles to begin with where they are not those of the balance's pose, rad.
    #[serde(default, skip_serializing_if = "NamedAngles::is_empty")]
    pub begin: NamedAngles,
    /// The motions, in the order of their beginnings.
    pub motions: Vec<Motion>,
}

/// The controller.
#[derive(Debug, Clone)]
pub struct CmrtController {
    contract: Contract,
    upright: Upright,
    gains: Gains,
    com_ahead: f64,
    motions: Vec<Motion>,
    /// The first is where the motion begins; in the order of time.
    waypoints: Vec<Waypoint>,
    /// Of the motions, since the last [`Controller::enter`].
    timelines: Vec<Timeline>,
    splines: Vec<Option<Spline>>,
    command: Option<Command>,
    began: f64,
    /// s after the beginning.
    elapsed: f64,
    /// The middle of the base of support with the balance's offset, followed, world x, m.
    middle: f64,
}

impl Spec for CmrtSpec {
    const KIND: &'static str = "cmrt";

    fn build(self, contract: Contract, model: &Arc<Model>) -> Result<Box<dyn Controller>> {
        Ok(Box::new(self.controller(contract, model)?))
    }
}

impl CmrtSpec {
    /// The controller, for who wants to give it other trajectories.
    ///
    /// # Errors
    /// As [`Spec::build`].
    pub fn controller(self, contract: Contract, model: &Arc<Model>) -> Result<CmrtController> {
        let count = self.motions.len();
        check::count("motions", count, 1..=MOST_MOTIONS, "motions")?;
        let balance = match self.balance {
            Some(balance) => balance,
            None => shipped_balance()?,
        };
        let upright = balance.upright(model).map_err(|e| e.inside("balance"))?;
        let mut begin = upright.reference.pose.clone();
        overlay(model, &self.begin, &mut begin).map_err(|e| e.inside("begin"))?;
        let mut waypoints = vec![waypoint(model, &begin)];
        let mut before = 0.0;
        for (i, motion) in self.motions.iter().enumerate() {
            let of = |e: Error| e.inside(("motions", i));
            motion.validate().map_err(of)?;
            check::within("start", motion.start, before..=3600.0).map_err(of)?;
            before = motion.start;
            let known = contract.check_parameter("timed_by", motion.timed_by.as_ref());
            known.map_err(of)?;
            let known = contract.check_parameter("parameter", motion.parameter.as_ref());
            known.map_err(of)?;
            for (k, key) in motion.keys.iter().enumerate() {
                let of = |e: Error| of(e.inside(("keys", k)));
                let mut pose = waypoints[waypoints.len() - 1].pose.clone();
                let posed = overlay(model, &key.pose, &mut pose);
                posed.map_err(|e| of(e.inside("pose")))?;
                let lifted = key.lifted.as_deref().map(|l| foot_named(model, l));
                let lifted = lifted.transpose().map_err(|e| of(e.inside("lifted")))?;
                waypoints.push(Waypoint {
                    lifted,
                    motion: i,
                    from: key.from,
                    to: key.to,
                    ..waypoint(model, &pose)
                });
            }
        }
        let mut controller = CmrtController {
            gains: balance.gains,
            com_ahead: balance.com_ahead,
            timelines: Vec::with_capacity(self.motions.len()),
            splines: Vec::with_capacity(self.motions.len()),
            motions: self.motions,
            waypoints,
            command: None,
            began: 0.0,
            elapsed: 0.0,
            middle: 0.0,
            upright,
            contract,
        };
        controller.plan();
        Ok(controller)
    }
}

fn shipped_balance() -> Result<BalanceSpec> {
    let source = Source::new("built-in skills/balance_task.ron", BALANCE);
    ControllerFile::parse(source)?.parameters()
}

impl CmrtController {
    /// s from the beginning of the first motion to the end of the last, as last commanded.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.timelines
            .iter()
            .map(|t| t.time(3.0))
            .fold(0.0, f64::max)
    }

    /// When the phases of a motion are, as last commanded.
    #[must_use]
    pub fn timeline(&self, motion: usize) -> Option<&Timeline> {
        self.timelines.get(motion)
    }

    /// The same controller with another trajectory, or none, for one motion whatever its parameter.
    #[must_use]
    pub fn with_cmrt(mut self, motion: usize, cmrt: Option<Cmrt>) -> Self {
        if let Some(motion) = self.motions.get_mut(motion) {
            motion.cmrts = cmrt.into_iter().collect();
        }
        self.plan();
        self
    }

    /// The reference pose `elapsed` s after the beginning, rad, one a joint.
    pub fn pose_at(&self, elapsed: f64, pose: &mut [f64]) {
        let way = blend(&self.waypoints, elapsed);
        let ends = self.waypoints[way.from]
            .pose
            .iter()
            .zip(&self.waypoints[way.to].pose);
        for (angle, (a, b)) in pose.iter_mut().zip(ends) {
            *angle = a + way.eased * (b - a);
        }
    }

    /// The same controller as it answers to a command.
    ///
    /// # Errors
    /// What [`Controller::obey`] refuses.
    pub fn commanded(mut self, command: &Command) -> Result<Self> {
        self.obey(command)?;
        self.plan();
        Ok(self)
    }

    /// Fixes times and curves by the last command. Allocates nothing after the first time.
    fn plan(&mut self) {
        self.timelines.clear();
        self.splines.clear();
        let command = self.command.as_ref();
        for motion in &self.motions {
            let value = |name: &Option<String>, otherwise: f64| {
                let parameter = |n: &String| self.contract.parameter(command, n, otherwise);
                name.as_ref().map_or(otherwise, parameter)
            };
            let task = value(&motion.timed_by, motion.task);
            self.timelines.push(motion.timeline(task));
            let cmrt = trajectory::interpolated(&motion.cmrts, value(&motion.parameter, 0.0));
            self.splines.push(cmrt.as_ref().map(Spline::new));
        }
        let mut before = 0.0;
        for waypoint in self.waypoints.iter_mut().skip(1) {
            let timeline = &self.timelines[waypoint.motion];
            let begin = timeline.time(waypoint.from).max(before);
            before = timeline.time(waypoint.to).max(begin + 1e-3);
            waypoint.times = [begin, before];
        }
    }

    /// Moves the reference to the time since the beginning.
    fn steer(&mut self, now: &Sensors) {
        let passed = self.upright.passed(now);
        self.elapsed = now.time - self.began;
        let t = self.elapsed;
        if let Some(centre) = now.support_centre() {
            let step = GLIDE * passed;
            self.middle = glided(self.middle, centre + self.com_ahead, step);
        }
        let way = blend(&self.waypoints, t);
        let (from, to) = (&self.waypoints[way.from], &self.waypoints[way.to]);
        let reference = &mut self.upright.reference;
        for (j, (a, b)) in from.pose.iter().zip(&to.pose).enumerate() {
            reference.pose[j] = a + way.eased * (b - a);
            reference.rates[j] = way.rate * (b - a);
            reference.accelerations[j] = way.acceleration * (b - a);
        }
        reference.pitch = from.pitch + way.eased * (to.pitch - from.pitch);
        let rise = to.height - from.height;
        let (height, climb) = (from.height + way.eased * rise, way.rate * rise);
        let (mut displacement, mut velocity) = (0.0, 0.0);
        for (timeline, spline) in self.timelines.iter().zip(&self.splines) {
            if let Some(spline) = spline {
                let (d, v) = spline.at(timeline.since(t));
                displacement += d;
                velocity += v;
            }
        }
        reference.com = [self.middle + displacement, now.ground + height];
        reference.com_velocity = [velocity, climb];
        let foot = to.lifted.or(from.lifted.filter(|_| way.eased < 1.0));
        reference.swing = foot.map(|foot| free(foot, now));
        let weights = self.timelines.iter().map(|line| line.task_weight(t));
        let doing = self.motions.iter().zip(weights).find(|(_, w)| *w > 0.0);
        self.upright.set_gains(match doing {
            Some((motion, weight)) => motion.schedule.scaled(&self.gains, weight),
            None => self.gains.clone(),
        });
    }
}

/// A foot that carries nothing and goes where its joints' targets take it.
fn free(foot: usize, now: &Sensors) -> Swing {
    Swing {
        foot,
        position: now.com,
        velocity: [0.0; 2],
        angle: 0.0,
        stiffness: 0.0,
        weight: 0.0,
    }
}

impl Controller for CmrtController {
    fn contract(&self) -> &Contract {
        &self.contract
    }

    fn enter(&mut self, now: &Sensors) {
        self.plan();
        self.upright.enter(now);
        (self.began, self.elapsed, self.middle) = (now.time, 0.0, now.com[0]);
    }

    fn act(&mut self, now: &Sensors, torques: &mut [f64]) {
        self.steer(now);
        self.upright.act(now, torques);
    }

    fn clone_box(&self) -> Box<dyn Controller> {
        Box::new(self.clone())
    }

    fn progress(&self, now: &Sensors, elapsed: f64, kept: Option<f64>) -> Progress {
        // Success before the motions are over would cut them short, and what is not as expected is
        // none.
        let over = elapsed >= self.length() && self.contract.expected.holds(now);
        let kept = kept.filter(|_| over);
        self.contract.progress(now, elapsed, kept)
    }

    fn obey(&mut self, command: &Command) -> Result<bool> {
        let answers = self.contract.answers(command)?;
        if answers {
            self.command = Some(command.clone());
        }
        Ok(answers)
    }

    fn grips(&self) -> bool {
        let mut all = self.motions.iter().zip(&self.timelines);
        all.any(|(motion, line)| {
            let within =
                |[from, to]: [f64; 2]| (line.time(from)..line.time(to)).contains(&self.elapsed);
            motion.grips.is_some_and(within)
        })
    }

    fn reference_com(&self) -> Option<f64> {
        Some(self.upright.reference.com[0])
    }
}
