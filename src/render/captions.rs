//! What was done in a run, in words: for titles, and beside frames.
//!
//! recording → its title; events → captions.

use aplomb_framework::events::{Event, EventKind};
use aplomb_framework::run::Trajectory;
use svg::node::element::Group;

use super::style::{FAINT_INK, FORCE, INK, PUSH, shortened, text, text_width};

/// What is done to the characters is named in a title up to this many times.
const MOST: usize = 4;

/// The colour in which an event is told.
pub(super) fn event_colour(kind: &EventKind) -> &'static str {
    match kind {
        EventKind::Push { .. }
        | EventKind::Fell
        | EventKind::Slipped { .. }
        | EventKind::Broke { .. } => PUSH,
        EventKind::Stood | EventKind::Grasped { .. } => FORCE,
        _ => INK,
    }
}

/// A number with as many decimals as it needs, three at most.
fn short(x: f64) -> String {
    let text = format!("{x:.3}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    text.replace('-', "−")
}

/// An impulse: forward or backward by its sign, else both components.
fn impulse([x, y]: [f64; 2]) -> String {
    if y == 0.0 {
        format!("{} N·s", short(x))
    } else {
        format!("({}, {}) N·s", short(x), short(y))
    }
}

/// What a push or an accepted command is called in a title.
fn done(trajectory: &Trajectory, event: &Event) -> Option<String> {
    let what = match &event.kind {
        EventKind::Push { link, impulse: by } if by.iter().all(|x| x.is_finite()) => {
            let model = trajectory.models.get(event.character)?;
            let trunk = model.links[model.trunk].name == *link;
            let of = if trunk {
                String::new()
            } else {
                format!(" of {link}")
            };
            format!("push{of} {}", impulse(*by))
        }
        EventKind::Command {
            text,
            accepted: true,
        } => format!("“{text}”"),
        _ => return None,
    };
    let whose = match event.character {
        0 => String::new(),
        other => format!(" ({other})"),
    };
    let within = event.time <= trajectory.duration() + trajectory.header.dt;
    within.then(|| format!("{what}{whose} at {} s", short(event.time)))
}

/// What the recording is of: the scenario, and what is done in it.
pub(super) fn title(trajectory: &Trajectory) -> String {
    let done: Vec<String> = trajectory
        .events
        .iter()
        .filter_map(|e| done(trajectory, e))
        .collect();
    let mut parts = vec![trajectory.header.scenario.clone()];
    parts.extend(done.iter().take(MOST).cloned());
    if done.len() > MOST {
        parts.push("…".to_owned());
    }
    parts.join(", ")
}

/// The title in a line, with duration and seed behind it where there is room.
pub(super) fn title_line(trajectory: &Trajectory, at: [f64; 2], size: f64, width: f64) -> Group {
    let about = format!(
        "{:.2} s, seed {}",
        trajectory.duration(),
        trajectory.header.seed
    );
    let small = 0.8 * size;
    let beside = text_width(&about, small) + 1.2 * size;
    let title = shortened(&title(trajectory), size, (width - beside) / 1.08);
    let after = at[0] + 1.08 * text_width(&title, size) + 0.8 * size;
    Group::new()
        .add(text(at, size, INK, "start", &title).set("font-weight", "bold"))
        .add(text([after, at[1]], small, FAINT_INK, "start", &about))
}

/// Captions one below the other, each (text, colour).
pub(super) fn captions(lines: &[(String, &str)], at: [f64; 2], size: f64, width: f64) -> Group {
    let mut group = Group::new();
    for (i, (caption, colour)) in lines.iter().enumerate() {
        let place = [at[0], at[1] + 1.25 * size * i as f64];
        let caption = shortened(caption, size, width);
        group = group.add(text(place, size, colour, "start", &caption).set("font-weight", "bold"));
    }
    group
}

/// Captions one behind the other, as far as there is room; the last ones first.
pub(super) fn captions_in_line(
    lines: &[(String, &str)],
    at: [f64; 2],
    size: f64,
    width: f64,
) -> Group {
    let wide = |text: &str| 1.08 * text_width(text, size) + 1.2 * size;
    let mut room = width;
    let fitting = lines.iter().rev().take_while(|(caption, _)| {
        room -= wide(caption);
        room >= 0.0
    });
    let first = lines.len() - fitting.count();
    let mut x = at[0];
    let mut group = Group::new();
    for (caption, colour) in &lines[first..] {
        let label = text([x, at[1]], size, colour, "start", caption);
        group = group.add(label.set("font-weight", "bold"));
        x += wide(caption);
    }
    group
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::tests::recording;

    #[test]
    fn a_title_names_what_is_done() {
        let t = recording(1000, |_, _| {});
        assert_eq!(title(&t), "a & b <c>, push −60 N·s at 0.5 s");
    }

    #[test]
    fn a_line_keeps_the_last_captions_that_fit() {
        let lines = ["first", "second", "third"].map(|l| (l.to_owned(), INK));
        let shown = |width| captions_in_line(&lines, [0.0; 2], 10.0, width).to_string();
        assert!(shown(1000.0).contains("first"));
        let few = shown(100.0);
        assert!(few.contains("third") && !few.contains("first"), "{few}");
        assert!(!shown(5.0).contains("third"));
    }

    #[test]
    fn numbers_are_short() {
        assert_eq!(short(1.0), "1");
        assert_eq!(short(-12.25), "−12.25");
        assert_eq!(short(100.0), "100");
        assert_eq!(impulse([0.0, -3.5]), "(0, −3.5) N·s");
    }
}
