//! Where the camera looks at each step, and how far it sees: the character and the props that matter.
//!
//! recording → what must be in view at each step → a smooth way of the camera, one scale.
//!
//! A prop matters if it comes near the followed character, or moves not far from it. It is seen as a
//! whole all the time, unless it goes far: then the camera looks in its direction.

use aplomb_framework::run::Trajectory;

use super::body::pose;
use super::camera::Camera;
use super::drawable;

/// s over which the camera's way is smoothed, twice.
const SMOOTHING: f64 = 0.6;
/// Characters that never part further, m, are followed together.
const TOGETHER: f64 = 4.0;
/// Props that never leave it, m about the followed character, are seen as a whole; and how far the
/// camera looks towards others.
const REACH: [f64; 2] = [4.2, 2.4];
/// A prop that comes so near matters, m.
const NEAR: f64 = 0.4;
/// A prop that moves so far, m, matters if it comes within reach.
const MOVES: f64 = 0.1;
/// Room about the middles of links, and above them, m.
const PAD: [f64; 2] = [0.28, 0.25];
/// Most samples of a recording.
const SAMPLES: usize = 500;

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
        Ok(Framing::of(trajectory, character).camera(step, size, super::scene::head(size)))
    }
}

/// What must be in view at one step, m: from, to, and up to which height.
#[derive(Debug, Clone, Copy)]
struct Extent {
    from: f64,
    to: f64,
    top: f64,
}

impl Extent {
    const NOTHING: Self = Self {
        from: f64::INFINITY,
        to: f64::NEG_INFINITY,
        top: 0.0,
    };

    fn add(&mut self, x: f64, y: f64, around: [f64; 2]) {
        if x.is_finite() && y.is_finite() {
            self.from = self.from.min(x - around[0]);
            self.to = self.to.max(x + around[0]);
            self.top = self.top.max(y + around[1]);
        }
    }

    fn middle(&self) -> f64 {
        0.5 * (self.from + self.to)
    }
}

/// The camera's way through a recording.
#[derive(Debug)]
pub(super) struct Framing {
    /// Steps from one sample to the next.
    every: usize,
    /// The camera's x at each sample, m.
    way: Vec<f64>,
    /// How far it sees to either side, m.
    pub(super) half: f64,
    /// And above the ground.
    pub(super) top: f64,
}

impl Framing {
    pub(super) fn of(trajectory: &Trajectory, character: usize) -> Self {
        let every = (trajectory.len() / SAMPLES).max(1);
        let steps: Vec<usize> = (0..trajectory.len()).step_by(every).collect();
        let mut extents = bodies(trajectory, character, &steps);
        let followed: Vec<f64> = extents.iter().map(Extent::middle).collect();
        for prop in 0..trajectory.header.props.len() {
            if matters(trajectory, prop, &steps, &extents) {
                see(trajectory, prop, &steps, &followed, &mut extents);
            }
        }
        let mut last = extents
            .iter()
            .map(Extent::middle)
            .find(|x| x.is_finite())
            .unwrap_or(0.0);
        let mut way = Vec::with_capacity(extents.len());
        for extent in &extents {
            let middle = extent.middle();
            last = if middle.is_finite() { middle } else { last };
            way.push(last);
        }
        let reach = 0.5 * SMOOTHING / (trajectory.header.dt * every as f64);
        let reach = reach.min(1e6) as usize;
        let way = smoothed(&smoothed(&way, reach), reach);
        let (mut half, mut top) = (0.0_f64, 0.0_f64);
        for (extent, x) in extents.iter().zip(&way) {
            if extent.middle().is_finite() {
                half = half.max(extent.to - x).max(x - extent.from);
                top = top.max(extent.top);
            }
        }
        Self {
            every,
            way,
            half: half.clamp(1.0, 3.5),
            top: top.clamp(2.0, 4.0),
        }
    }

    /// The camera's x at a step, m: straight from sample to sample.
    fn at(&self, step: usize) -> f64 {
        let last = self.way.len().saturating_sub(1);
        let [a, b] = [0, 1].map(|k| (step / self.every + k).min(last));
        let [from, to] = [a, b].map(|i| self.way.get(i).copied().unwrap_or(0.0));
        let part = (step % self.every) as f64 / self.every as f64;
        from + part * (to - from)
    }

    /// A picture of a size in px that shows all of it, below so many px at its top.
    pub(super) fn camera(&self, step: usize, size: [f64; 2], head: f64) -> Camera {
        let ground = (0.1 * size[1]).clamp(20.0, 60.0);
        let high = size[1] - ground - head;
        let scale = (size[0] / (2.0 * self.half)).min(high / self.top);
        Camera {
            x: self.at(step),
            scale: scale.max(1.0),
            width: size[0],
            height: size[1],
            ground,
        }
    }
}

/// The followed character and those that stay near it.
fn bodies(trajectory: &Trajectory, character: usize, steps: &[usize]) -> Vec<Extent> {
    let x = |step: usize, who: usize| f64::from(trajectory.moment(step, who).com[0]);
    let together = |who: usize| {
        let mut all = steps.iter();
        who == character || all.all(|s| (x(*s, who) - x(*s, character)).abs() <= TOGETHER)
    };
    let mut extents = vec![Extent::NOTHING; steps.len()];
    for (who, model) in trajectory.models.iter().enumerate() {
        if !together(who) {
            continue;
        }
        for (extent, &step) in extents.iter_mut().zip(steps) {
            for link in &pose(model, trajectory.moment(step, who).q).links {
                extent.add(link.com[0], link.com[1], PAD);
            }
        }
    }
    extents
}

/// A prop's middle, or none where it is no number, and its reach to either side and up, m.
fn place(trajectory: &Trajectory, prop: usize, step: usize) -> (Option<[f64; 2]>, [f64; 2]) {
    let [x, y, angle] = trajectory.prop(step, prop).map(f64::from);
    let shape = &trajectory.header.props[prop].shape;
    let [wide, high] = shape.reach();
    let (sin, cos) = (angle.sin().abs(), angle.cos().abs());
    let reach = [wide * cos + high * sin, wide * sin + high * cos];
    let known = [x, y, angle].iter().all(|v| v.is_finite());
    (known.then_some([x, y]), reach)
}

fn matters(trajectory: &Trajectory, prop: usize, steps: &[usize], bodies: &[Extent]) -> bool {
    let loose = trajectory.header.props[prop].mass > 0.0;
    let mut nearest = f64::INFINITY;
    let mut ends = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
    for (body, &step) in bodies.iter().zip(steps) {
        let (Some(at), reach) = place(trajectory, prop, step) else {
            continue;
        };
        // The body's extent has some room about it.
        let gap = (at[0] - body.middle()).abs() - reach[0] - 0.5 * (body.to - body.from);
        if gap.is_finite() {
            nearest = nearest.min(gap);
        }
        for k in [0, 1] {
            ends[0][k] = ends[0][k].min(at[k]);
            ends[1][k] = ends[1][k].max(at[k]);
        }
    }
    let moved = (0..2).any(|k| ends[1][k] - ends[0][k] > MOVES);
    loose && (nearest < NEAR || (moved && nearest < REACH[0]))
}

/// Adds a prop to what must be in view: as much of it as is within reach.
fn see(
    trajectory: &Trajectory,
    prop: usize,
    steps: &[usize],
    followed: &[f64],
    extents: &mut [Extent],
) {
    let stays = steps.iter().zip(followed).all(|(step, middle)| {
        let (at, [wide, _]) = place(trajectory, prop, *step);
        at.is_none_or(|[x, _]| (x - middle).abs() + wide < REACH[0])
    });
    let reach = REACH[usize::from(!stays)];
    for ((extent, &step), &middle) in extents.iter_mut().zip(steps).zip(followed) {
        let (Some([x, y]), [wide, high]) = place(trajectory, prop, step) else {
            continue;
        };
        if !middle.is_finite() {
            continue;
        }
        let within = |x: f64| x.clamp(middle - reach, middle + reach);
        let (from, to) = (within(x - wide - 0.1), within(x + wide + 0.1));
        let seen = to > from;
        let top = if seen { y.min(3.0) + high } else { 0.0 };
        extent.add(0.5 * (from + to), top, [0.5 * (to - from), 0.1]);
    }
}

/// Each number's mean with its neighbours, so many to either side.
fn smoothed(numbers: &[f64], reach: usize) -> Vec<f64> {
    let mut sums = vec![0.0];
    for x in numbers {
        sums.push(sums[sums.len() - 1] + x);
    }
    let len = numbers.len();
    let mean = |i: usize| {
        let reach = reach.min(i).min(len - 1 - i);
        let (from, to) = (i - reach, i + reach + 1);
        (sums[to] - sums[from]) / (to - from) as f64
    };
    (0..len).map(mean).collect()
}

#[cfg(test)]
mod tests {
    use aplomb_framework::world::Prop;

    use super::*;
    use crate::render::tests::staged;

    /// Where a box's edges are in a picture 600 px wide, at each step that is asked for, px.
    fn seen(at: impl Fn(usize) -> f64, steps: [usize; 2]) -> [[f64; 2]; 2] {
        let shape = "Box(half: (0.2, 0.2), centre: (0, 0))";
        let prop: Prop = ron::from_str(&format!(
            "(name: \"box\", shape: {shape}, mass: 30, position: (0, 0), angle: 0, velocity: (0, 0),
              friction: 0.5, restitution: 0, grip: 0)"
        ))
        .unwrap();
        let t = staged(1000, vec![prop], |step, row| {
            row.extend([at(step) as f32, 0.2, 0.0]);
        });
        let framing = Framing::of(&t, 0);
        steps.map(|step| {
            let camera = framing.camera(step, [600.0, 300.0], 0.0);
            [-0.2, 0.2].map(|x| camera.at([at(step) + x, 0.0])[0])
        })
    }

    fn whole([left, right]: [f64; 2]) -> bool {
        (0.0..=600.0).contains(&left) && (0.0..=600.0).contains(&right)
    }

    #[test]
    fn a_box_that_is_moved_is_in_view_all_the_time() {
        let pulled = seen(|step| 2.2 - 3e-4 * step as f64, [0, 999]);
        assert!(pulled.into_iter().all(whole), "{pulled:?}");
        let far = seen(|_| 8.0, [0, 999]);
        assert!(!far.into_iter().any(whole), "{far:?}");
    }

    #[test]
    fn a_ball_that_comes_from_afar_is_seen_before_it_arrives() {
        let [early, late] = seen(|step| 7.0 - 6.6e-3 * step as f64, [0, 800]);
        assert!(!whole(early), "{early:?}");
        assert!(whole(late), "{late:?}");
    }

    #[test]
    fn the_camera_moves_smoothly() {
        let smooth = smoothed(&[0.0, 0.0, 0.0, 1.0, 1.0, 1.0], 1);
        let jumps = smooth.windows(2).map(|w| w[1] - w[0]);
        assert!(jumps.clone().all(|j| (0.0..0.4).contains(&j)), "{smooth:?}");
    }
}
