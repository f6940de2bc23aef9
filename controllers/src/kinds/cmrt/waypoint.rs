//! The poses that a motion goes through, and where between two of them it is.
//!
//! joint angles → [`Waypoint`] with pitch and height on a flat foot; time → [`Blend`].

use aplomb_framework::character::{Kinematics, Model, State, put_on_ground};
use aplomb_framework::input::{Error, Result};

/// A pose to go to.
#[derive(Debug, Clone)]
pub(super) struct Waypoint {
    pub(super) pose: Vec<f64>,
    /// Pitch of the root with a foot flat, rad.
    pub(super) pitch: f64,
    /// Height of the centre of mass, m.
    pub(super) height: f64,
    /// Place of a foot that is off the ground.
    pub(super) lifted: Option<usize>,
    /// Place of its motion, and when in it, in phases.
    pub(super) motion: usize,
    pub(super) from: f64,
    pub(super) to: f64,
    /// The same in s after the beginning, since the last [`Controller::enter`].
    pub(super) times: [f64; 2],
}

/// A place on the way from one pose to the next.
#[derive(Debug, Clone, Copy)]
pub(super) struct Blend {
    pub(super) from: usize,
    pub(super) to: usize,
    /// Part of the way, 0 to 1.
    pub(super) eased: f64,
    /// Its first and second derivative, 1/s and 1/s².
    pub(super) rate: f64,
    pub(super) acceleration: f64,
}

/// Place of the foot that is this link.
pub(super) fn foot_named(model: &Model, link: &str) -> Result<usize> {
    let link = model.link_index(link)?;
    let name = |l: usize| model.links[l].name.as_str();
    let feet = || model.feet.iter().map(|f| f.link);
    feet()
        .position(|f| f == link)
        .ok_or_else(|| Error::unknown("foot", name(link), feet().map(name)))
}

/// A pose on a flat foot: of the feet the one that is lowest.
pub(super) fn waypoint(model: &Model, pose: &[f64]) -> Waypoint {
    let mut state = State::standing(model);
    state.q[3..].copy_from_slice(pose);
    let mut kinematics = Kinematics::new(model);
    let mut best: Option<(f64, f64, f64)> = None;
    for foot in &model.feet {
        state.q[2] = 0.0;
        kinematics.update(model, &state);
        // Turned so that this foot's sole is level.
        state.q[2] = -kinematics.links[foot.link].angle;
        kinematics.update(model, &state);
        let sole = kinematics.point(foot.link, foot.toe)[1];
        if best.is_none_or(|(lowest, ..)| sole < lowest) {
            put_on_ground(model, &mut state, 0.0);
            kinematics.update(model, &state);
            best = Some((sole, state.q[2], kinematics.com[1]));
        }
    }
    let (_, pitch, height) = best.unwrap_or((0.0, 0.0, model.standing_com()[1]));
    Waypoint {
        pose: pose.to_vec(),
        pitch: aplomb_framework::character::wrapped(pitch),
        height,
        lifted: None,
        motion: 0,
        from: 0.0,
        to: 0.0,
        times: [0.0; 2],
    }
}

/// Where between two of the poses the reference is `elapsed` s after the beginning, by smoothstep.
pub(super) fn blend(waypoints: &[Waypoint], elapsed: f64) -> Blend {
    let later = waypoints.iter().skip(1);
    let to = later.take_while(|w| w.times[0] <= elapsed).count();
    let [begin, end] = waypoints[to].times;
    let span = (end - begin).max(1e-3);
    let u = if to == 0 {
        1.0
    } else {
        (elapsed - begin) / span
    };
    let moving = f64::from(u8::from(u < 1.0));
    let u = u.min(1.0);
    Blend {
        from: to.saturating_sub(1),
        to,
        eased: u * u * (3.0 - 2.0 * u),
        rate: moving * 6.0 * u * (1.0 - u) / span,
        acceleration: moving * (6.0 - 12.0 * u) / (span * span),
    }
}
