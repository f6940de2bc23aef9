//! One instant: ground, props, characters, marks, tags.

use aplomb_framework::character::{Kinematics, Outline};
use aplomb_framework::events::EventKind;
use aplomb_framework::run::Trajectory;
use svg::node::element::{Group, SVG};

use super::GRAVITY;
use super::body::{SKINS, draw, pose};
use super::camera::Camera;
use super::marks;
use super::style::{
    FAINT_INK, GROUND, INK, controller_colours, line, polygon, px, rectangle, shortened, tag, text,
};

/// s that a push lasts.
pub(super) const PUSH_TIME: f64 = 0.1;
/// s in which its arrow fades afterwards, so that it is seen in an animation.
const FADING: f64 = 0.25;

/// Draws instants of one recording.
#[derive(Debug)]
pub(super) struct Scene<'a> {
    trajectory: &'a Trajectory,
    /// Per character, per controller.
    colours: Vec<Vec<&'static str>>,
}

impl<'a> Scene<'a> {
    pub(super) fn new(trajectory: &'a Trajectory) -> Self {
        let cast = trajectory.header.cast.iter();
        Self {
            trajectory,
            colours: cast.map(|c| controller_colours(&c.controllers)).collect(),
        }
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
        for who in 0..t.models.len() {
            group = group.add(marks::behind(&t.moment(step, who), camera));
        }
        group = group.add(self.props(step, camera));
        for (who, model) in t.models.iter().enumerate().rev() {
            group = group.add(draw(model, &poses[who], camera, &SKINS[who % SKINS.len()]));
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

    /// A frame of an animation: with time, tags, and pushes that fade.
    pub(super) fn moving(&self, step: usize, camera: &Camera) -> Group {
        let time = step as f64 * self.trajectory.header.dt;
        let pushes = self
            .trajectory
            .events
            .iter()
            .enumerate()
            .filter_map(|(i, event)| {
                let age = time - event.time;
                let shown = matches!(event.kind, EventKind::Push { .. }) && age >= 0.0;
                let opacity = 1.0 - ((age - PUSH_TIME) / FADING).max(0.0);
                (shown && opacity > 0.0).then_some((i, opacity))
            });
        let pushes: Vec<_> = pushes.collect();
        let size = (0.045 * camera.height).clamp(9.0, 22.0);
        Group::new()
            .add(self.still(step, camera, &pushes))
            .add(
                text(
                    [0.8 * size, 1.6 * size],
                    1.1 * size,
                    INK,
                    "start",
                    &format!("{time:.2} s"),
                )
                .set("font-weight", "bold"),
            )
            .add(self.tags(
                step,
                [camera.width - 0.6 * size, 0.55 * size],
                size,
                0.6 * camera.width,
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
                // Whose tag it is: a dot in the body's colour.
                let dot = rectangle(
                    [at[0] - wide - 0.9 * size, top + 0.45 * size],
                    [0.6 * size; 2],
                    SKINS[who % SKINS.len()].near,
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

/// Ground with a tick every 0.25 m and its x in m at whole metres.
fn ground(camera: &Camera) -> Group {
    let level = camera.at([0.0, 0.0])[1];
    let size = camera.mark_size();
    let mut group = Group::new().add(rectangle(
        [0.0, level],
        [camera.width, camera.height - level],
        GROUND,
    ));
    let [left, right] = camera.span();
    let every = if camera.scale > 40.0 { 0.25 } else { 1.0 };
    if (right - left) / every < 400.0 && left.abs() < 1e9 {
        for k in (left / every).ceil() as i64..=(right / every).floor() as i64 {
            let metres = k as f64 * every;
            let x = camera.at([metres, 0.0])[0];
            let whole = (metres - metres.round()).abs() < 1e-9;
            let long = if whole { 8.0 } else { 4.0 } * size;
            group = group.add(line(
                [x, level],
                [x, level + long],
                if whole { INK } else { "#9aa5b0" },
                0.9,
            ));
            let label = format!("{metres:.0} m").replace('-', "−");
            let font = (9.0 * size).max(8.5);
            let room = super::style::text_width(&label, font) / 2.0 + 1.0;
            if whole && (room..=camera.width - room).contains(&x) {
                group = group.add(text(
                    [x, level + 8.0 * size + 0.9 * font],
                    font,
                    FAINT_INK,
                    "middle",
                    &label,
                ));
            }
        }
    }
    group.add(line([0.0, level], [camera.width, level], INK, 1.2))
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
