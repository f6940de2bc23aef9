//! What can be seen of a picture, for tests.
//!
//! SVG → its labels and outlines with their colours, in px → what is missing of what must be seen,
//! which labels overlap or leave the picture.

use std::sync::{Arc, LazyLock};

use resvg::usvg::fontdb::{Database, Source};
use resvg::usvg::{Group, Node, Options, Paint, Rect, Tree};

/// px by which the boxes of two labels may overlap, or a label may leave the picture.
const SLACK: f32 = 0.5;

static FONTS: LazyLock<Arc<Database>> = LazyLock::new(|| {
    let mut fonts = Database::new();
    let font = epaint_default_fonts::UBUNTU_LIGHT;
    let ids = fonts.load_font_source(Source::Binary(Arc::new(font)));
    let family = fonts.face(ids[0]).unwrap().families[0].0.clone();
    fonts.set_sans_serif_family(family.clone());
    fonts.set_serif_family(family);
    Arc::new(fonts)
});

/// A line of text and the box around its ink.
#[derive(Debug)]
pub(crate) struct SeenLabel {
    pub(crate) text: String,
    pub(crate) ink: Rect,
}

/// A filled or drawn line or area.
#[derive(Debug)]
pub(crate) struct SeenOutline {
    fill: Option<String>,
    stroke: Option<String>,
    pub(crate) points: usize,
    pub(crate) extent: Rect,
}

impl SeenOutline {
    fn has(&self, colour: &str) -> bool {
        [&self.fill, &self.stroke]
            .iter()
            .any(|c| c.as_deref() == Some(colour))
    }
}

/// A picture's contents, from back to front.
#[derive(Debug)]
pub(crate) struct Seen {
    size: [f32; 2],
    pub(crate) labels: Vec<SeenLabel>,
    pub(crate) outlines: Vec<SeenOutline>,
}

impl Seen {
    pub(crate) fn of(svg: &str) -> Self {
        let options = Options {
            fontdb: Arc::clone(&FONTS),
            ..Options::default()
        };
        let tree = Tree::from_str(svg, &options).unwrap();
        let mut seen = Self {
            size: [tree.size().width(), tree.size().height()],
            labels: Vec::new(),
            outlines: Vec::new(),
        };
        seen.add(tree.root());
        seen
    }

    fn add(&mut self, group: &Group) {
        for node in group.children() {
            match node {
                Node::Group(inner) => self.add(inner),
                Node::Path(path) => {
                    let colour = |paint: &Paint| match paint {
                        Paint::Color(c) => format!("#{:02x}{:02x}{:02x}", c.red, c.green, c.blue),
                        _ => "a pattern".to_owned(),
                    };
                    self.outlines.push(SeenOutline {
                        fill: path.fill().map(|f| colour(f.paint())),
                        stroke: path.stroke().map(|s| colour(s.paint())),
                        points: path.data().points().len(),
                        extent: path.abs_bounding_box(),
                    });
                }
                Node::Text(text) => self.labels.push(SeenLabel {
                    text: text.chunks().iter().map(|c| c.text().trim()).collect(),
                    ink: text.flattened().abs_bounding_box(),
                }),
                Node::Image(_) => {}
            }
        }
    }

    /// The outlines that are filled or drawn in a colour.
    pub(crate) fn coloured(&self, colour: &str) -> Vec<&SeenOutline> {
        self.outlines.iter().filter(|o| o.has(colour)).collect()
    }

    /// Labels that overlap or leave the picture.
    pub(crate) fn crowded(&self) -> Vec<String> {
        let mut complaints = Vec::new();
        for (i, label) in self.labels.iter().enumerate() {
            let (text, ink) = (&label.text, label.ink);
            let low = ink.left().min(ink.top()) < -SLACK;
            if low || ink.right() > self.size[0] + SLACK || ink.bottom() > self.size[1] + SLACK {
                complaints.push(format!("'{text}' leaves the picture: {ink:?}"));
            }
            for other in &self.labels[..i] {
                let across = ink.right().min(other.ink.right()) - ink.left().max(other.ink.left());
                let down = ink.bottom().min(other.ink.bottom()) - ink.top().max(other.ink.top());
                if across.min(down) > SLACK {
                    complaints.push(format!("'{text}' lies over '{}'", other.text));
                }
            }
        }
        complaints
    }
}

/// Something that must be seen.
#[derive(Debug, Clone)]
pub(crate) enum Sight<'a> {
    /// So many labels with this text in them, at least.
    Text(&'a str, usize),
    /// So many outlines of a colour, exactly.
    Shapes(&'a str, usize),
    /// A line or area of a colour: of so many points at least, so many px wide at least.
    Curve(&'a str, usize, f32),
}

impl Sight<'_> {
    /// What a picture lacks of it.
    fn missing(&self, seen: &Seen) -> Option<String> {
        match *self {
            Self::Text(text, least) => {
                let found = seen.labels.iter().filter(|l| l.text.contains(text));
                let found = found.count();
                (found < least).then(|| format!("'{text}' stands there {found} times, not {least}"))
            }
            Self::Shapes(colour, wanted) => {
                let found = seen.coloured(colour).len();
                (found != wanted).then(|| format!("{found} shapes are {colour}, not {wanted}"))
            }
            Self::Curve(colour, points, width) => {
                let curves = seen.coloured(colour);
                let wide = |o: &&&SeenOutline| o.points >= points && o.extent.width() >= width;
                let found = curves.iter().any(|o| wide(&o));
                (!found).then(|| format!("no {colour} curve of {points} points over {width} px"))
            }
        }
    }

    /// The picture without it.
    fn taken_out_of(&self, svg: &str) -> String {
        match self {
            Self::Text(text, _) => {
                let text = text.replace('&', "&amp;").replace('<', "&lt;");
                svg.replace(&text.replace('>', "&gt;"), "")
            }
            Self::Shapes(colour, _) | Self::Curve(colour, ..) => svg.replace(colour, "none"),
        }
    }
}

/// What is missing in a picture.
fn missing(svg: &str, sights: &[Sight<'_>]) -> Vec<String> {
    let seen = Seen::of(svg);
    sights.iter().filter_map(|s| s.missing(&seen)).collect()
}

/// The same page with nothing on it.
pub(crate) fn blank(svg: &str) -> String {
    let end = svg.find('>').unwrap() + 1;
    format!("{}</svg>", &svg[..end])
}

/// Asserts that a picture has all of the sights and that its numbers are numbers; that a blank page
/// would have none of them, and that it would be noticed if any of them were taken out.
#[track_caller]
pub(crate) fn assert_seen(svg: &str, sights: &[Sight<'_>]) -> Seen {
    let found = missing(svg, sights);
    assert!(found.is_empty(), "{}", found.join("\n"));
    assert!(!svg.contains("NaN") && !svg.contains("inf"), "not finite");
    assert_eq!(missing(&blank(svg), sights).len(), sights.len());
    for sight in sights {
        let without = sight.taken_out_of(svg);
        let noticed = missing(&without, std::slice::from_ref(sight));
        assert_eq!(noticed.len(), 1, "{sight:?} taken out is not noticed");
    }
    Seen::of(svg)
}
