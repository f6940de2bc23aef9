//! Where a character begins: posed, and put on the ground.
//!
//! [`Model`], [`Start`] → [`State`].

use crate::error::Result;
use crate::kinematics::Kinematics;
use crate::model::{Model, Shape};
use crate::scenario::Start;
use crate::state::State;

/// The state in which a character of a scenario begins: its lowest point `lift` above the ground.
///
/// # Errors
/// An unknown joint.
pub fn start_state(model: &Model, start: &Start) -> Result<State> {
    let mut state = State::standing(model);
    for (joint, angle) in &start.angles {
        state.q[3 + model.joint_index(joint)?] = *angle;
    }
    state.q[0] = start.x;
    state.q[2] = start.pitch;
    put_on_ground(model, &mut state, start.lift);
    Ok(state)
}

/// Moves the root up or down until the character's lowest point is `lift` m above y = 0.
pub fn put_on_ground(model: &Model, state: &mut State, lift: f64) {
    let mut kinematics = Kinematics::new(model);
    kinematics.update(model, state);
    let mut lowest = f64::INFINITY;
    for (i, link) in model.links.iter().enumerate() {
        match link.shape {
            Shape::Capsule { radius, from, to } => {
                for end in [from, to] {
                    lowest = lowest.min(kinematics.point(i, end)[1] - radius);
                }
            }
            Shape::Box { half, centre } => {
                for corner in [[-1.0, -1.0], [-1.0, 1.0], [1.0, -1.0], [1.0, 1.0]] {
                    let p = [
                        centre[0] + corner[0] * half[0],
                        centre[1] + corner[1] * half[1],
                    ];
                    lowest = lowest.min(kinematics.point(i, p)[1]);
                }
            }
        }
    }
    state.q[1] += lift - lowest;
}
