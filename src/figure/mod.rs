//! What a character looks like: outlines of its body, clothes and face about its physical shapes.
//!
//! character model → [`FigurePart`]s, from back to front, each in the frame of its link. Pure
//! geometry: whoever draws them puts every link where it is and chooses the colours.
//!
//! Links are known by their names, as those of the shipped characters; a link with another name is
//! drawn as its physical outline. Drawing a layer's edges first and then its fills and lines leaves
//! no seam at a joint.

mod anatomy;
mod arms;
mod beast;
mod curve;
mod head;
mod legs;
mod order;
mod person;
mod plain;
mod trunk;

use aplomb_framework::character::{Model, Point};
use serde::Serialize;

use curve::outside;

/// What a part is covered with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
#[allow(missing_docs, reason = "the names say it")]
pub enum Tone {
    Skin,
    /// Eyes, too.
    Hair,
    Shirt,
    Trousers,
    Shoe,
    Fur,
    Mane,
    Belt,
}

/// A piece of a drawn character that moves with one link.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FigurePart {
    /// Its place in the model's links.
    pub link: usize,
    /// What it is covered with.
    pub tone: Tone,
    /// Whether it is on the side away from the viewer.
    pub far: bool,
    /// Parts of one layer follow each other and have one edge around them all.
    pub layer: usize,
    /// A closed polygon in the link's frame, counter-clockwise, m; the first corner is not repeated.
    pub outline: Vec<Point>,
    /// Lines that are drawn on it, in the link's frame, m: its own edge away from the joints, and
    /// details such as a sole.
    pub lines: Vec<Vec<Point>>,
}

/// A part of some link, before its place in the order is known.
#[derive(Debug, Clone, PartialEq)]
struct Patch {
    tone: Tone,
    /// Whether it lies over the near leg, as a belt does.
    over: bool,
    outline: Vec<Point>,
    lines: Vec<Vec<Point>>,
}

impl Patch {
    /// Without lines.
    fn plain(tone: Tone, outline: Vec<Point>) -> Self {
        Self {
            tone,
            over: false,
            outline,
            lines: Vec::new(),
        }
    }

    /// With a line all around.
    fn edged(tone: Tone, outline: Vec<Point>) -> Self {
        Self::seamed(tone, outline, &[])
    }

    /// With a line around, but for what lies inside the discs, each (middle, radius in m).
    fn seamed(tone: Tone, outline: Vec<Point>, discs: &[(Point, f64)]) -> Self {
        Self {
            lines: outside(&outline, discs),
            ..Self::plain(tone, outline)
        }
    }

    /// Over the near leg.
    fn over(self) -> Self {
        Self { over: true, ..self }
    }

    /// With one more line on it.
    fn with(mut self, line: impl Into<Vec<Point>>) -> Self {
        self.lines.push(line.into());
        self
    }
}

/// The parts of a character from back to front; every link has one at least.
///
/// ```
/// # use aplomb::framework::character::Model;
/// let model = Model::load("humanoid")?;
/// let parts = aplomb::figure::figure(&model);
/// assert!(parts[0].far); // the far arm is behind all others
/// # Ok::<(), aplomb::framework::Error>(())
/// ```
#[must_use]
pub fn figure(model: &Model) -> Vec<FigurePart> {
    let mut parts = Vec::new();
    for (layer, order::Layer { far, links, arms }) in order::layers(model).into_iter().enumerate() {
        let part = |(link, piece): (usize, Patch)| FigurePart {
            link,
            tone: piece.tone,
            far,
            layer,
            outline: piece.outline,
            lines: piece.lines,
        };
        let all = |links: Vec<usize>| {
            let each = links.into_iter();
            each.flat_map(|link| pieces(model, link).into_iter().map(move |p| (link, p)))
        };
        let (over, under): (Vec<_>, Vec<_>) = all(links).partition(|(_, piece)| piece.over);
        parts.extend(under.into_iter().chain(over).chain(all(arms)).map(part));
    }
    parts
}

/// A link's pieces: those of the body that it is known to belong to, else its physical outline.
fn pieces(model: &Model, link: usize) -> Vec<Patch> {
    let mut pieces = if beast::is(model) {
        beast::pieces(model, link)
    } else {
        person::pieces(model, link)
    };
    if pieces.is_empty() {
        pieces.push(plain::physical(model, link));
    }
    let bridges = plain::bridges(model, link, &pieces);
    [bridges, pieces].concat()
}

#[cfg(test)]
mod tests;
