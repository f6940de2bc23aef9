//! Where a character begins: posed, and put on the ground.
//!
//! [`Model`], [`Start`] → [`State`].

use crate::character::{Model, State, put_on_ground};
use crate::input::{Error, FieldPath, Result};
use crate::scenario::Start;

/// The state in which a character of a scenario begins: its lowest point `lift` above the ground.
///
/// # Errors
/// An unknown joint, by the way from the start.
pub fn start_state(model: &Model, start: &Start) -> Result<State> {
    let mut state = State::standing(model);
    for (joint, angle) in &start.angles {
        let of = |e: Error| e.inside(FieldPath::name(joint)).inside("angles");
        state.q[3 + model.joint_index(joint).map_err(of)?] = *angle;
    }
    state.q[0] = start.x;
    state.q[2] = start.pitch;
    put_on_ground(model, &mut state, start.lift);
    Ok(state)
}
