//! Colours that go from dark to light with a number, after the map "plasma".

const GRADES: [&str; 12] = [
    "#0d0887", "#340598", "#5602a3", "#7403a7", "#900ea4", "#a92395", "#bf3983", "#d24f72",
    "#e26561", "#ee7d50", "#f79740", "#fcb231",
];

/// The colour of member `i` of `count`.
pub(super) fn grade(i: usize, count: usize) -> &'static str {
    let part = i as f64 / count.saturating_sub(1).max(1) as f64;
    let place = (part * (GRADES.len() - 1) as f64).round() as usize;
    GRADES[place.min(GRADES.len() - 1)]
}
