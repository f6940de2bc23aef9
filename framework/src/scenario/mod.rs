//! The file of a scenario: characters, props, timed pushes and commands, expectations, parameters.
//!
//! RON → [`Scenario`] → run. Only the schema and its bounds; nothing here runs.

mod bounds;
mod expectation;
mod file;
mod limits;
mod number;
mod origin;
mod placing;
mod props;
mod scheduled;
mod values;

pub use expectation::{Expectation, Quantity};
pub use file::{Participant, Scenario, Start};
pub use limits::{LONGEST_RUN, MOST_CHARACTERS, MOST_ENTRIES, MOST_INPUTS, PUSH_DURATION};
pub use number::{Adjustable, Number};
pub use origin::Origin;
pub use props::{HingeEntry, PropEntry};
pub use scheduled::{Changeable, DragTarget, ScheduledInput};
