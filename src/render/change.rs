//! How much the picture changes from step to step.
//!
//! recording → what a viewer sees of each step → how far it has changed up to any step, and how far
//! two steps differ.

use aplomb_framework::run::Trajectory;

use super::body::pose;

/// Between samples of the motion, s; longer in long recordings.
const SAMPLING: f64 = 0.005;
/// Fewest and most samples, as far as there are steps.
const SAMPLES: [usize; 2] = [200, 20_000];
/// Change of the picture that is counted when nothing moves, m/s.
const REST: f64 = 0.004;
/// Faster changes count as this fast, m/s.
const FASTEST: f64 = 2.5;
/// How much of a change of place counts, as the camera goes along.
const TRAVEL: f64 = 0.25;
/// A look is read from the head's turn: a face counts as if it were so far from the neck, m.
const FACE: f64 = 0.5;
/// How much a prop's way counts beside a link's.
const PROPS: f64 = 0.2;

/// How far the picture has changed up to each sample, m.
#[derive(Debug)]
pub(super) struct Change {
    pub(super) stride: usize,
    sums: Vec<f64>,
}

impl Change {
    pub(super) fn new(trajectory: &Trajectory) -> Self {
        let dt = trajectory.header.dt;
        let stride = ((SAMPLING / dt).round().max(1.0) as usize).max(trajectory.len() / SAMPLES[1]);
        let stride = stride.min((trajectory.len() / SAMPLES[0]).max(1));
        let span = stride as f64 * dt;
        let mut sums = vec![0.0];
        let mut sum = 0.0;
        let mut last: Option<Vec<[f64; 2]>> = None;
        for step in (0..trajectory.len()).step_by(stride) {
            let now = seen(trajectory, step);
            if let Some(last) = last.replace(now.clone()) {
                let squares = now
                    .iter()
                    .zip(&last)
                    .map(|(a, b)| (a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2));
                let speed = (squares.sum::<f64>() / now.len().max(1) as f64).sqrt() / span;
                let speed = if speed.is_finite() {
                    speed.min(FASTEST)
                } else {
                    0.0
                };
                sum += (speed + REST) * span;
                sums.push(sum);
            }
        }
        Self { stride, sums }
    }

    /// The whole change, m.
    pub(super) fn total(&self) -> f64 {
        self.sums.last().copied().unwrap_or(0.0)
    }

    /// The change up to a step, m.
    pub(super) fn at(&self, step: usize) -> f64 {
        self.sums[(step / self.stride).min(self.sums.len() - 1)]
    }

    /// The step by which the picture has changed so far.
    pub(super) fn step(&self, change: f64) -> usize {
        self.sums.partition_point(|s| *s < change) * self.stride
    }
}

/// What a viewer sees of a step: the links, the faces and the props, by a camera that goes along
/// with most of the motion.
fn seen(trajectory: &Trajectory, step: usize) -> Vec<[f64; 2]> {
    let mut points = Vec::new();
    for (who, model) in trajectory.models.iter().enumerate() {
        let poses = pose(model, trajectory.moment(step, who).q);
        let along = (1.0 - TRAVEL) * poses.com[0];
        points.extend(poses.links.iter().map(|l| [l.com[0] - along, l.com[1]]));
        let head = model.links[model.head].com;
        for face in [[FACE, 0.0], [0.0, FACE]] {
            let face = poses.point(model.head, [head[0] + face[0], head[1] + face[1]]);
            points.push([face[0] - along, face[1]]);
        }
    }
    for prop in 0..trajectory.header.props.len() {
        let [x, y, _] = trajectory.prop(step, prop).map(f64::from);
        points.push([PROPS * x, PROPS * y]);
    }
    points
}

/// The furthest that anything in the picture moves from one step to another, m.
pub(super) fn difference(trajectory: &Trajectory, steps: [usize; 2]) -> f64 {
    let [a, b] = steps.map(|step| seen(trajectory, step));
    let apart = a
        .iter()
        .zip(&b)
        .map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1]));
    apart.filter(|d| d.is_finite()).fold(0.0, f64::max)
}
