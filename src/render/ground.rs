//! The ground, with its measure.

use svg::node::element::Group;

use super::camera::Camera;
use super::style::{FAINT_INK, GROUND, INK, line, rectangle, text, text_width};

/// The ground itself, behind the characters.
pub(super) fn ground(camera: &Camera) -> Group {
    let level = camera.at([0.0, 0.0])[1];
    let size = [camera.width, camera.height - level];
    Group::new().add(rectangle([0.0, level], size, GROUND))
}

/// Its surface, with a tick every 0.25 m and its x in m at whole metres.
pub(super) fn measure(camera: &Camera) -> Group {
    let level = camera.at([0.0, 0.0])[1];
    let size = camera.mark_size();
    let mut group = Group::new();
    let [left, right] = camera.span();
    let every = if camera.scale > 40.0 { 0.25 } else { 1.0 };
    if (right - left) / every < 400.0 && left.abs() < 1e9 {
        for k in (left / every).ceil() as i64..=(right / every).floor() as i64 {
            let metres = k as f64 * every;
            let x = camera.at([metres, 0.0])[0];
            let whole = (metres - metres.round()).abs() < 1e-9;
            let long = if whole { 8.0 } else { 4.0 } * size;
            let colour = if whole { INK } else { "#9aa5b0" };
            group = group.add(line([x, level], [x, level + long], colour, 0.9));
            let label = format!("{metres:.0} m").replace('-', "−");
            let font = (9.0 * size).max(8.5);
            let room = text_width(&label, font) / 2.0 + 1.0;
            if whole && (room..=camera.width - room).contains(&x) {
                let at = [x, level + 8.0 * size + 0.9 * font];
                group = group.add(text(at, font, FAINT_INK, "middle", &label));
            }
        }
    }
    group.add(line([0.0, level], [camera.width, level], INK, 1.2))
}
