//! How much a scenario may hold.

/// The longest run, s.
pub const LONGEST_RUN: f64 = 3600.0;
/// s over which a push is spread unless it says otherwise.
pub const PUSH_DURATION: f64 = 0.1;
/// At most this many events: a person who drags makes some dozens a second.
pub const MOST_INPUTS: usize = 20_000;
/// At most this many props, joints, expectations or parameters.
pub const MOST_ENTRIES: usize = 1000;
/// At most this many characters.
pub const MOST_CHARACTERS: usize = 16;
