//! One instant: ground, props, characters, marks, tags, captions.

use aplomb_framework::character::{Kinematics, Outline};
use aplomb_framework::events::EventKind;
use aplomb_framework::run::Trajectory;
use svg::node::element::{Group, SVG};

use super::GRAVITY;
use super::body::{Looks, pose, shadow};
use super::camera::Camera;
use super::captions::{captions_in_line, event_colour, title_line};
use super::ground::{ground, measure};
use super::marks;
use super::style::{
    INK, controller_colours, line, polygon, px, rectangle, shortened, tag, text, text_width,
};

/// s that a push lasts.
pub(super) const PUSH_TIME: f64 = 0.1;
/// s for which its arrow stays, and s in which it fades, so that it is seen in an animation.
const STAYING: [f64; 2] = [0.35, 0.25];
/// s for which a caption stays in an animation, long enough to be read, and how many at a time.
const READING: f64 = 1.6;
const LINES: usize = 3;

/// Size of an animation's text, px.
fn font(size: [f64; 2]) -> f64 {
    (0.042 * size[1]).clamp(9.0, 24.0)
}

/// Height of the title of an animation's frame, px.
pub(super) fn head(size: [f64; 2]) -> f64 {
    1.9 * font(size)
}

/// Draws instants of one recording.
#[derive(Debug)]
pub(super) struct Scene<'a> {
    trajectory: &'a Trajectory,
    /// Per character, per controller.
    colours: Vec<Vec<&'static str>>,
    /// Per character.
    looks: Vec<Looks>,
}

impl<'a> Scene<'a> {
    pub(super) fn new(trajectory: &'a Trajectory) -> Self {
        let cast = trajectory.header.cast.iter();
        Self {
            trajectory,
            colours: cast.map(|c| controller_colours(&c.controllers)).collect(),
            looks: (0..)
                .zip(&trajectory.models)
                .map(|(i, m)| Looks::new(m, i))
                .collect(),
        }
    }

    /// A character's.
    pub(super) fn looks(&self, character: usize) -> Option<&Looks> {
        self.looks.get(character)
    }

    /// What a picture of [`Self::still`]s has once.
    pub(super) fn definitions(&self) -> Group {
        let all = self.looks.iter().map(Looks::definitions);
        all.fold(Group::new(), Group::add)
    }

    /// Name and colour of the controller that is active.
    pub(super) fn controller(
        &self,
        step: usize,
        character: usize,
    ) -> Option<(&'a str, &'static str)> {
        let active = self.trajectory.moment(step, character).active;
        let name = self.trajectory.header.cast[character]
            .controllers
            .get(active)?;
        Some((name, self.colours[character].get(active)?))
    }

    /// World and marks, with the pushes given as (event, opacity).
    pub(super) fn still(&self, step: usize, camera: &Camera, pushes: &[(usize, f64)]) -> Group {
        let t = self.trajectory;
        let poses: Vec<Kinematics> = t
            .models
            .iter()
            .enumerate()
            .map(|(who, model)| pose(model, t.moment(step, who).q))
            .collect();
        let mut group = Group::new().add(ground(camera));
        for (model, poses) in t.models.iter().zip(&poses) {
            group = group.add(shadow(model, poses, camera));
        }
        group = group.add(measure(camera));
        for who in 0..t.models.len() {
            group = group.add(marks::behind(&t.moment(step, who), camera));
        }
        group = group.add(self.props(step, camera));
        for (looks, poses) in self.looks.iter().zip(&poses).rev() {
            group = group.add(looks.draw(poses, camera));
        }
        for (who, model) in t.models.iter().enumerate() {
            let weight = model.total_mass() * GRAVITY;
            group = group.add(marks::before(&t.moment(step, who), weight, camera));
        }
        for (place, (event, opacity)) in pushes.iter().enumerate() {
            let event = &t.events[*event];
            let EventKind::Push { link, impulse } = &event.kind else {
                continue;
            };
            let link = t
                .models
                .get(event.character)
                .and_then(|m| m.link_index(link).ok());
            if let Some(link) = link {
                let at = poses[event.character].links[link].com;
                group = group.add(marks::push(at, *impulse, *opacity, place, camera));
            }
        }
        group
    }

    /// A frame of an animation: with title, time, tags, captions, and pushes that fade.
    pub(super) fn moving(&self, step: usize, camera: &Camera) -> Group {
        let time = step as f64 * self.trajectory.header.dt;
        let mut pushes = Vec::new();
        let mut lines = Vec::new();
        for (i, event) in self.trajectory.events.iter().enumerate() {
            let age = time - event.time;
            if age < 0.0 {
                continue;
            }
            if matches!(event.kind, EventKind::Push { .. }) {
                let opacity = 1.0 - ((age - STAYING[0]) / STAYING[1]).max(0.0);
                pushes.extend((opacity > 0.0).then_some((i, opacity)));
            }
            if age <= READING {
                let label = event.kind.label();
                let line = label.map(|l| (l, event_colour(&event.kind)));
                // Both hands may take the same.
                lines.extend(line.filter(|l| !lines.contains(l)));
            }
        }
        let lines = &lines[lines.len().saturating_sub(LINES)..];
        let view = [camera.width, camera.height];
        let size = font(view);
        let (left, below) = (0.8 * size, head(view));
        let clock = format!("{time:.2} s");
        let beside = 1.1 * text_width(&clock, 1.1 * size) + 2.0 * size;
        // Names with their dots.
        let all = 0..self.trajectory.models.len();
        let names = all.filter_map(|who| self.controller(step, who));
        let tag = names.map(|(name, _)| text_width(name, size) + 2.8 * size);
        let tag = tag.fold(0.0, f64::max);
        Group::new()
            .add(self.definitions())
            .add(self.still(step, camera, &pushes))
            .add(title_line(
                self.trajectory,
                [left, 1.35 * size],
                0.85 * size,
                camera.width - 2.0 * left,
            ))
            .add(
                text([left, below + size], 1.1 * size, INK, "start", &clock)
                    .set("font-weight", "bold"),
            )
            .add(captions_in_line(
                lines,
                [beside, below + size],
                0.95 * size,
                camera.width - beside - tag,
            ))
            .add(self.tags(
                step,
                [camera.width - 0.6 * size, below - 0.2 * size],
                size,
                camera.width - beside,
            ))
    }

    /// The characters' controllers, one below the other, at most so wide in px.
    pub(super) fn tags(&self, step: usize, at: [f64; 2], size: f64, width: f64) -> Group {
        let mut group = Group::new();
        let mut top = at[1];
        for who in 0..self.trajectory.models.len() {
            let Some((name, colour)) = self.controller(step, who) else {
                continue;
            };
            let name = shortened(name, size, width - size);
            let (label, wide) = tag(at[0], top, size, colour, &name);
            group = group.add(label);
            if self.trajectory.models.len() > 1 {
                // Whose tag it is: a dot in its clothes' colour.
                let dot = rectangle(
                    [at[0] - wide - 0.9 * size, top + 0.45 * size],
                    [0.6 * size; 2],
                    &self.looks[who].sign(),
                );
                group = group.add(
                    dot.set("rx", px(0.3 * size))
                        .set("stroke", INK)
                        .set("stroke-width", 0.6),
                );
            }
            top += 1.75 * size;
        }
        group
    }

    fn props(&self, step: usize, camera: &Camera) -> Group {
        let mut group = Group::new();
        for (i, prop) in self.trajectory.header.props.iter().enumerate() {
            let [x, y, angle] = self.trajectory.prop(step, i).map(f64::from);
            if ![x, y, angle].iter().all(|v| v.is_finite()) {
                continue;
            }
            let (sin, cos) = angle.sin_cos();
            let world =
                |p: [f64; 2]| camera.at([x + cos * p[0] - sin * p[1], y + sin * p[0] + cos * p[1]]);
            let (fill, edge) = if prop.mass > 0.0 {
                ("#d9c8a9", "#5d4a27")
            } else {
                ("#c3cad1", "#4a545e")
            };
            let Outline { corners, radius } = prop.shape.outline();
            let corners: Vec<[f64; 2]> = corners.into_iter().map(world).collect();
            let wide = 2.0 * radius * camera.scale;
            group = if let [a, mut b] = corners[..] {
                b[0] += 0.01;
                group
                    .add(line(a, b, edge, wide).set("stroke-linecap", "round"))
                    .add(line(a, b, fill, (wide - 2.0).max(0.5)).set("stroke-linecap", "round"))
            } else if radius > 0.0 {
                let round = |colour: &str, width: f64| {
                    let shape = polygon(&corners, colour).set("stroke", colour);
                    shape
                        .set("stroke-width", width)
                        .set("stroke-linejoin", "round")
                };
                let inner = round(fill, (wide - 2.0).max(0.5));
                group.add(round(edge, wide)).add(inner)
            } else {
                let shape = polygon(&corners, fill).set("stroke", edge);
                group.add(shape.set("stroke-width", 1))
            };
        }
        group
    }
}

/// Cuts a picture off at its edges, at a place in a larger one.
pub(super) fn window(at: [f64; 2], size: [f64; 2], content: Group) -> SVG {
    SVG::new()
        .set("x", px(at[0]))
        .set("y", px(at[1]))
        .set("width", px(size[0]))
        .set("height", px(size[1]))
        .set("overflow", "hidden")
        .add(content)
}
