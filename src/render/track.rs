//! How a picture follows its characters, and how much room they take.
//!
//! recording → where the camera looks at each step, how far it sees.

use aplomb_framework::run::Trajectory;

use super::body::pose;
use super::camera::Camera;
use super::drawable;

/// s over which the camera's way is smoothed.
const SMOOTHING: f64 = 0.5;
/// Characters that never part further, m, are followed together.
const TOGETHER: f64 = 4.0;

impl Camera {
    /// A picture of the given size in px that has room for the character at every step, placed
    /// where it looks at the given step.
    ///
    /// # Errors
    /// An empty trajectory or an unknown character.
    pub fn following(
        trajectory: &Trajectory,
        character: usize,
        step: usize,
        size: [f64; 2],
    ) -> anyhow::Result<Self> {
        drawable(trajectory, character)?;
        let track = Track::new(trajectory, character);
        let every = (trajectory.len() / 500).max(1);
        let steps: Vec<usize> = (0..trajectory.len()).step_by(every).collect();
        let room = Room::of(trajectory, character, &track, &steps);
        Ok(room.camera(track.at(step), size))
    }
}

/// The camera's x at every step, m.
#[derive(Debug)]
pub(super) struct Track(Vec<f64>);

impl Track {
    /// Follows a character's centre of mass smoothly; together with the others' if they stay near.
    pub(super) fn new(trajectory: &Trajectory, character: usize) -> Self {
        let x = |step: usize, who: usize| f64::from(trajectory.moment(step, who).com[0]);
        let all = 0..trajectory.models.len();
        let together = (0..trajectory.len()).step_by(20).all(|step| {
            let apart = |who| (x(step, who) - x(step, character)).abs() <= TOGETHER;
            all.clone().all(apart)
        });
        let raw = |step: usize| {
            if together {
                all.clone().map(|who| x(step, who)).sum::<f64>() / all.len() as f64
            } else {
                x(step, character)
            }
        };
        let mut last = (0..trajectory.len())
            .map(raw)
            .find(|x| x.is_finite())
            .unwrap_or(0.0);
        let mut sums = vec![0.0];
        let mut sum = 0.0;
        for step in 0..trajectory.len() {
            let now = raw(step);
            if now.is_finite() {
                last = now;
            }
            sum += last;
            sums.push(sum);
        }
        let len = trajectory.len();
        let reach = (0.5 * SMOOTHING / trajectory.header.dt).min(1e6) as usize;
        let smooth = |i: usize| {
            let reach = reach.min(i).min(len - 1 - i);
            let (from, to) = (i - reach, i + reach + 1);
            (sums[to] - sums[from]) / (to - from) as f64
        };
        Self((0..len).map(smooth).collect())
    }

    /// m
    pub(super) fn at(&self, step: usize) -> f64 {
        self.0.get(step).or(self.0.last()).copied().unwrap_or(0.0)
    }
}

/// The room that characters take about the camera's track, m.
#[derive(Debug, Clone, Copy)]
pub(super) struct Room {
    /// To either side.
    pub(super) half: f64,
    /// Above the ground.
    pub(super) top: f64,
}

impl Room {
    /// At the given steps: the followed character and those within a few metres.
    pub(super) fn of(
        trajectory: &Trajectory,
        character: usize,
        track: &Track,
        steps: &[usize],
    ) -> Self {
        let (mut half, mut top) = (0.0_f64, 0.0_f64);
        for (who, model) in trajectory.models.iter().enumerate() {
            for &step in steps {
                let moment = trajectory.moment(step, who);
                if who != character && (f64::from(moment.com[0]) - track.at(step)).abs() > TOGETHER
                {
                    continue;
                }
                for link in &pose(model, moment.q).links {
                    half = half.max((link.com[0] - track.at(step)).abs());
                    top = top.max(link.com[1]);
                }
            }
        }
        Self {
            half: (half + 0.28).clamp(1.0, 3.5),
            top: (top + 0.25).clamp(2.0, 4.0),
        }
    }

    /// A picture of a size in px that shows all of it.
    pub(super) fn camera(&self, x: f64, size: [f64; 2]) -> Camera {
        let ground = (0.1 * size[1]).clamp(20.0, 60.0);
        let scale = (size[0] / (2.0 * self.half)).min((size[1] - ground) / self.top);
        Camera {
            x,
            scale: scale.max(1.0),
            width: size[0],
            height: size[1],
            ground,
        }
    }
}
