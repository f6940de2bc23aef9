//! The key of a film strip: what its marks mean, as far as they are in it.

use aplomb_framework::events::EventKind;
use aplomb_framework::run::{Moment, Trajectory};
use svg::node::element::Group;

use super::GRAVITY;
use super::choose::Shot;
use super::marks::{WEIGHT_ARROW, com_sign, cop_sign, shows_force, support_sign};
use super::scene::Scene;
use super::style::{FORCE, INK, PUSH, arrow, line, px, text, text_width};

/// From one line to the next, px.
const LINE: f64 = 20.0;
/// Entries end here, px.
const RIGHT: f64 = 1050.0;

/// Signs with their names, set in lines.
#[derive(Debug)]
struct Entries {
    group: Group,
    at: [f64; 2],
}

impl Entries {
    fn add(mut self, sign: Group, width: f64, label: &str) -> Self {
        let wide = width + 6.0 + text_width(label, 10.5);
        if self.at[0] > 0.0 && self.at[0] + wide > RIGHT {
            self.at = [0.0, self.at[1] + LINE];
        }
        let [x, y] = self.at;
        let sign = sign.set("transform", format!("translate({} {})", px(x), px(y)));
        let label_at = [x + width + 6.0, y + 3.6];
        self.at[0] = x + wide + 20.0;
        self.group = self
            .group
            .add(sign)
            .add(text(label_at, 10.5, INK, "start", label));
        self
    }
}

fn limb(colour: &str) -> Group {
    Group::new()
        .add(line([0.0, 0.0], [9.0, 0.0], INK, 9.5).set("stroke-linecap", "round"))
        .add(line([0.0, 0.0], [9.0, 0.0], colour, 7.5).set("stroke-linecap", "round"))
}

/// The key and its height in px; `scale` is that of the frames, in px per m.
pub(super) fn key(
    scene: &Scene<'_>,
    trajectory: &Trajectory,
    shots: &[Shot],
    character: usize,
    scale: f64,
) -> (Group, f64) {
    let weight = trajectory.models[character].total_mass() * GRAVITY;
    let all = 0..trajectory.models.len();
    let moments: Vec<Moment<'_>> = shots
        .iter()
        .flat_map(|shot| all.clone().map(|who| trajectory.moment(shot.step, who)))
        .collect();
    let seen = |of: &dyn Fn(&Moment<'_>) -> bool| moments.iter().any(of);
    let mut entries = Entries {
        group: Group::new(),
        at: [0.0; 2],
    };
    if let Some([near, far]) = scene.looks(character).and_then(|looks| looks.sides()) {
        entries = entries
            .add(limb(&near), 14.0, "right limbs")
            .add(limb(&far), 14.0, "left limbs");
    }
    if seen(&|m| m.com.iter().all(|x| x.is_finite())) {
        entries = entries.add(com_sign([3.0, 0.0], 4.5), 8.0, "centre of mass");
    }
    if seen(&|m| m.cop.is_some_and(f32::is_finite)) {
        entries = entries.add(cop_sign([3.0, -4.0], 5.0), 7.0, "centre of pressure");
    }
    if seen(&|m| m.support.is_some_and(|s| s.iter().all(|x| x.is_finite()))) {
        let sign = support_sign([0.0, -2.0], [22.0, -2.0], 5.0);
        entries = entries.add(sign, 22.0, "base of support");
    }
    if seen(&|m| shows_force(m, weight, scale)) {
        let length = (WEIGHT_ARROW * scale).clamp(10.0, 60.0);
        let label = format!("ground reaction force (this long: {weight:.0} N, body weight)");
        let sign = arrow([0.0, 0.0], [length, 0.0], FORCE, 2.6);
        entries = entries.add(sign, length, &label);
    }
    let push = |event: &usize| matches!(trajectory.events[*event].kind, EventKind::Push { .. });
    if shots.iter().any(|shot| shot.events.iter().any(push)) {
        entries = entries.add(arrow([0.0, 0.0], [22.0, 0.0], PUSH, 3.4), 22.0, "push");
    }
    let high = entries.at[1] + 26.0;
    (entries.group, high)
}
