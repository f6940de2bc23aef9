//! Colours, fonts and the small SVG elements that all drawings share.

use svg::Document;
use svg::node::element::{Group, Line, Polygon, Rectangle, Text};

/// Browsers take the first family they have; our rasteriser takes its embedded `sans-serif`.
const FONTS: &str = "'Helvetica Neue', Helvetica, Arial, 'Liberation Sans', sans-serif";

pub(super) const INK: &str = "#1f2933";
pub(super) const FAINT_INK: &str = "#66727f";
pub(super) const GRID: &str = "#e4e8ec";
pub(super) const FRAME: &str = "#c9d0d7";
pub(super) const GROUND: &str = "#eceff2";
pub(super) const SHADOW: &str = "#b9c2cc";
pub(super) const PUSH: &str = "#c8102e";
pub(super) const FORCE: &str = "#00845c";
pub(super) const SUPPORT: &str = "#e69f00";
pub(super) const COM: &str = "#0b4f8a";
pub(super) const CAPTURE: &str = "#b5478f";

/// Two dozen colours, the second dozen for large pools only. The hues of the first remain apart for
/// the common kinds of colour blindness (after Okabe and Ito, and Tol's "muted"); each of the second
/// is as far as can be from all before it, as seen with and without colour blindness.
const CONTROLLERS: [[&str; 12]; 2] = [
    [
        "#0072b2", "#d55e00", "#117733", "#aa4499", "#e69f00", "#332288", "#44aa99", "#882255",
        "#56b4e9", "#999933", "#cc6677", "#5f6b76",
    ],
    [
        "#003300", "#6622cc", "#bbbbbb", "#554400", "#77cc77", "#550044", "#7788bb", "#cc2255",
        "#554488", "#443333", "#0000aa", "#0044aa",
    ],
];

/// A coordinate for SVG: two decimals, finite, and near enough for every renderer.
pub(super) fn px(x: f64) -> f64 {
    if x.is_nan() {
        return 0.0;
    }
    let x = (x.clamp(-1e5, 1e5) * 100.0).round() / 100.0;
    if x == 0.0 { 0.0 } else { x }
}

/// One colour a controller of a pool. A name prefers the same colour in every pool, and gets
/// another only where an earlier name of the pool has it already.
pub(super) fn controller_colours(pool: &[String]) -> Vec<&'static str> {
    let mut taken: Vec<&str> = Vec::new();
    let mut colours = Vec::with_capacity(pool.len());
    for name in pool {
        if taken.len() == CONTROLLERS.as_flattened().len() {
            taken.clear();
        }
        // FNV-1a: the same on every machine and in every version.
        let hash = name.bytes().fold(0x811c_9dc5_u32, |h, b| {
            (h ^ u32::from(b)).wrapping_mul(0x0100_0193)
        });
        let preferred = |dozen: &'static [&'static str; 12]| {
            let first = hash as usize % dozen.len();
            dozen.iter().cycle().skip(first).take(dozen.len())
        };
        let mut free = CONTROLLERS.iter().flat_map(preferred);
        let colour = free.find(|c| !taken.contains(c)).unwrap_or(&INK);
        taken.push(colour);
        colours.push(*colour);
    }
    colours
}

/// Black or white, whichever is more readable on the colour.
pub(super) fn readable_on(colour: &str) -> &'static str {
    let channel = |at: usize| {
        let byte = colour
            .get(at..at + 2)
            .and_then(|t| u8::from_str_radix(t, 16).ok());
        let c = f64::from(byte.unwrap_or(0)) / 255.0;
        if c <= 0.04045 {
            c / 12.92
        } else {
            ((c + 0.055) / 1.055).powf(2.4)
        }
    };
    let luminance = 0.2126 * channel(1) + 0.7152 * channel(3) + 0.0722 * channel(5);
    if luminance > 0.30 { INK } else { "#ffffff" }
}

/// A line of text; `anchor` is `start`, `middle` or `end`.
///
/// Its stroke has no width in a browser; the rasteriser widens it, as its font is a light one.
pub(super) fn text(at: [f64; 2], size: f64, colour: &str, anchor: &str, content: &str) -> Text {
    let content: String = content.chars().filter(|c| !c.is_control()).collect();
    Text::new(content)
        .set("x", px(at[0]))
        .set("y", px(at[1]))
        .set("font-size", px(size))
        .set("fill", colour)
        .set("stroke", colour)
        .set("stroke-width", 0)
        .set("text-anchor", anchor)
}

/// About how wide a line of text is, px.
pub(super) fn text_width(content: &str, size: f64) -> f64 {
    let em = |c: char| match c {
        'i' | 'j' | 'l' | 't' | 'f' | 'r' | ' ' | '.' | ',' | ':' | '\'' | '|' | '(' | ')' => 0.32,
        'm' | 'w' | 'M' | 'W' => 0.86,
        c if c.is_uppercase() => 0.68,
        _ => 0.53,
    };
    content.chars().map(em).sum::<f64>() * size
}

/// Text shortened to a width in px.
pub(super) fn shortened(content: &str, size: f64, width: f64) -> String {
    if text_width(content, size) <= width {
        return content.to_owned();
    }
    let mut short: String = content.to_owned();
    while !short.is_empty() && text_width(&short, size) + size > width {
        short.pop();
    }
    format!("{}…", short.trim_end())
}

/// A controller's name in its colour. Returns the tag and its width in px.
pub(super) fn tag(right: f64, top: f64, size: f64, colour: &str, name: &str) -> (Group, f64) {
    let width = text_width(name, size) + size;
    let group = Group::new()
        .add(rectangle([right - width, top], [width, 1.5 * size], colour).set("rx", px(0.3 * size)))
        .add(
            text(
                [right - width / 2.0, top + 1.08 * size],
                size,
                readable_on(colour),
                "middle",
                name,
            )
            .set("font-weight", "bold"),
        );
    (group, width)
}

/// A filled rectangle.
pub(super) fn rectangle(at: [f64; 2], size: [f64; 2], fill: &str) -> Rectangle {
    Rectangle::new()
        .set("x", px(at[0]))
        .set("y", px(at[1]))
        .set("width", px(size[0].max(0.0)))
        .set("height", px(size[1].max(0.0)))
        .set("fill", fill)
}

/// A straight line.
pub(super) fn line(from: [f64; 2], to: [f64; 2], colour: &str, width: f64) -> Line {
    Line::new()
        .set("x1", px(from[0]))
        .set("y1", px(from[1]))
        .set("x2", px(to[0]))
        .set("y2", px(to[1]))
        .set("stroke", colour)
        .set("stroke-width", px(width))
}

/// The corners of a polygon or polyline.
pub(super) fn points(points: &[[f64; 2]]) -> String {
    let each = points.iter().map(|p| format!("{},{}", px(p[0]), px(p[1])));
    each.collect::<Vec<_>>().join(" ")
}

/// A filled polygon.
pub(super) fn polygon(corners: &[[f64; 2]], fill: &str) -> Polygon {
    Polygon::new()
        .set("points", points(corners))
        .set("fill", fill)
}

/// An arrow; its head is as long as it may be on a short shaft. Edged in white, to stand out
/// against bodies.
pub(super) fn arrow(from: [f64; 2], to: [f64; 2], colour: &str, width: f64) -> Group {
    let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
    let length = dx.hypot(dy);
    if !length.is_finite() || length < 1.0 {
        return Group::new();
    }
    let (ux, uy) = (dx / length, dy / length);
    let head = (4.2 * width).min(0.7 * length);
    let (half, thin) = (0.42 * head, width / 2.0);
    let at = |along: f64, across: f64| {
        [
            from[0] + along * ux - across * uy,
            from[1] + along * uy + across * ux,
        ]
    };
    let neck = length - head;
    let corners = [
        at(0.0, thin),
        at(neck, thin),
        at(neck, half),
        at(length, 0.0),
        at(neck, -half),
        at(neck, -thin),
        at(0.0, -thin),
    ];
    Group::new().add(
        polygon(&corners, colour)
            .set("stroke", "#ffffff")
            .set("stroke-width", 1)
            .set("paint-order", "stroke")
            .set("stroke-linejoin", "round"),
    )
}

/// A complete SVG file on white.
pub(super) fn document(size: [f64; 2], content: Group) -> String {
    let (width, height) = (px(size[0].ceil()), px(size[1].ceil()));
    let document = Document::new()
        .set("width", width)
        .set("height", height)
        .set("viewBox", (0.0, 0.0, width, height))
        .set("font-family", FONTS)
        .add(rectangle([0.0, 0.0], [width, height], "#ffffff"))
        .add(content);
    format!("{document}\n")
}

/// Steps of 1, 2 or 5 times a power of ten, at most about `most` over the range.
pub(super) fn nice_step(range: f64, most: f64) -> f64 {
    if !(range.is_finite() && range > 0.0) {
        return 1.0;
    }
    let rough = range / most.max(1.0);
    let power = 10_f64.powf(rough.log10().floor());
    let times = [1.0, 2.0, 5.0, 10.0];
    power
        * times
            .into_iter()
            .find(|t| t * power >= rough * 0.999)
            .unwrap_or(10.0)
}

/// A tick's number with as many decimals as its step has.
pub(super) fn tick_label(value: f64, step: f64) -> String {
    let decimals = (-step.log10().floor()).clamp(0.0, 6.0) as usize;
    let text = format!("{value:.decimals$}");
    let zero = text
        .trim_start_matches('-')
        .chars()
        .all(|c| c == '0' || c == '.');
    if zero {
        text.trim_start_matches('-').to_owned()
    } else {
        text.replace('-', "−")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pool(names: &[&str]) -> Vec<String> {
        names.iter().map(|n| (*n).to_owned()).collect()
    }

    #[test]
    fn controllers_of_a_pool_differ_and_keep_their_colours_in_other_pools() {
        let names = pool(&[
            "balance", "step", "fall", "rest", "roll", "rise", "sit", "catch",
        ]);
        let colours = controller_colours(&names);
        let mut distinct = colours.clone();
        distinct.sort_unstable();
        distinct.dedup();
        assert_eq!(distinct.len(), names.len());
        for (name, colour) in names.iter().zip(&colours).take(1) {
            assert_eq!(controller_colours(&pool(&[name]))[0], *colour);
        }
    }

    #[test]
    fn two_dozen_controllers_have_as_many_colours() {
        let many: Vec<String> = (0..60).map(|i| format!("controller {i}")).collect();
        let colours = controller_colours(&many);
        assert_eq!(colours.len(), 60);
        let mut distinct = colours[..24].to_vec();
        distinct.sort_unstable();
        distinct.dedup();
        assert_eq!(distinct.len(), 24);
        let (first, all) = (&colours[..12], controller_colours(&many[..12]));
        assert_eq!(first, all, "those added later take nobody's colour");
    }

    #[test]
    fn coordinates_are_finite_and_short() {
        assert_eq!(px(f64::NAN), 0.0);
        assert_eq!(px(f64::INFINITY), 1e5);
        assert_eq!(px(-0.001).to_string(), "0");
        assert_eq!(px(1.0 / 3.0).to_string(), "0.33");
    }

    #[test]
    fn ticks_are_round_numbers() {
        assert_eq!(nice_step(10.0, 10.0), 1.0);
        assert_eq!(nice_step(1.3, 6.0), 0.5);
        assert_eq!(nice_step(f64::NAN, 6.0), 1.0);
        assert_eq!(tick_label(-0.5, 0.5), "−0.5");
        assert_eq!(tick_label(-1e-17, 0.5), "0.0");
        assert_eq!(tick_label(20.0, 10.0), "20");
    }
}
