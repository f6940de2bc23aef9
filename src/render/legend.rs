//! Marks whose shapes differ as well as their colours, and the list that names them.

use svg::node::element::{Circle, Group, Path};

use super::chart::Style;
use super::style::{INK, px, rectangle, text};

/// From one line of a legend to the next, px.
const LINE: f64 = 15.0;

/// The shape of a mark.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Mark {
    Circle,
    Diamond,
    Square,
    Cross,
}

impl Mark {
    /// About `radius` px around a point, edged in white.
    pub(super) fn draw(self, at: [f64; 2], radius: f64, colour: &str) -> Group {
        let [x, y] = at.map(px);
        let edged = Group::new()
            .set("fill", colour)
            .set("stroke", "#ffffff")
            .set("stroke-width", px(0.3 * radius));
        match self {
            Self::Circle => edged.add(Circle::new().set("cx", x).set("cy", y).set("r", px(radius))),
            Self::Diamond => {
                let r = px(1.3 * radius);
                edged.add(
                    Path::new().set("d", format!("M{x} {y}m0 -{r}l{r} {r}l-{r} {r}l-{r} -{r}z")),
                )
            }
            Self::Square => {
                let r = 0.9 * radius;
                edged.add(rectangle([x - r, y - r], [2.0 * r, 2.0 * r], colour))
            }
            Self::Cross => {
                let r = px(0.8 * radius);
                let d = px(1.6 * radius);
                let path = format!("M{x} {y}m-{r} -{r}l{d} {d}m0 -{d}l-{d} {d}");
                let stroke = |colour: &str, width: f64| {
                    Path::new()
                        .set("d", path.as_str())
                        .set("fill", "none")
                        .set("stroke", colour)
                        .set("stroke-width", px(width))
                };
                Group::new()
                    .add(stroke("#ffffff", 1.1 * radius))
                    .add(stroke(colour, 0.55 * radius))
            }
        }
    }
}

/// Adds points of a picture joined by a line, with a mark at each.
pub(super) fn marked_line(
    group: Group,
    places: &[[f64; 2]],
    style: Style,
    mark: Mark,
    radius: f64,
    colour: &str,
) -> Group {
    let line = group.add(style.polyline(places));
    let marks = places.iter().map(|at| mark.draw(*at, radius, colour));
    marks.fold(line, Group::add)
}

/// Samples with their names, one below the other.
#[derive(Debug)]
pub(super) struct Legend {
    at: [f64; 2],
    group: Group,
}

impl Legend {
    /// The first sample's middle is this far down; samples begin this far right, px.
    pub(super) fn new(at: [f64; 2]) -> Self {
        Self {
            at,
            group: Group::new(),
        }
    }

    /// Adds what `draw` draws from a point on, over 22 px to the right. Further lines of the name
    /// stand below the first.
    pub(super) fn entry(mut self, name: &str, draw: impl FnOnce([f64; 2]) -> Group) -> Self {
        let mut group = self.group.add(draw(self.at));
        for line in name.lines() {
            let at = [self.at[0] + 30.0, self.at[1] + 3.8];
            group = group.add(text(at, 10.5, INK, "start", line));
            self.at[1] += LINE;
        }
        self.at[1] += 6.0;
        self.group = group;
        self
    }

    /// As [`Self::entry`], for a mark.
    pub(super) fn mark(self, name: &str, mark: Mark, radius: f64, colour: &str) -> Self {
        self.entry(name, |[x, y]| mark.draw([x + 11.0, y], radius, colour))
    }

    /// As [`Self::entry`], for a line.
    pub(super) fn line(self, name: &str, style: Style) -> Self {
        self.entry(name, |at| Group::new().add(style.sample(at, 22.0)))
    }

    /// As [`Self::entry`], for a line with a mark on it.
    pub(super) fn marked(
        self,
        name: &str,
        style: Style,
        mark: Mark,
        radius: f64,
        colour: &str,
    ) -> Self {
        self.entry(name, |[x, y]| {
            let sample = Group::new().add(style.sample([x, y], 22.0));
            sample.add(mark.draw([x + 11.0, y], radius, colour))
        })
    }

    /// The whole list.
    pub(super) fn finish(self) -> Group {
        self.group
    }
}
