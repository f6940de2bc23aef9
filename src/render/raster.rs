//! From SVG to pixels, with a font of our own.

use std::sync::{Arc, LazyLock};

use anyhow::{Context, Result, bail};
use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::fontdb::{Database, Source};
use resvg::usvg::{Options, Tree};

/// Most pixels of a picture.
const MOST_PIXELS: f64 = 2e8;
/// The embedded font is a light one: it is drawn with an edge of its colour.
const SHEET: &str =
    "text { stroke-width: 0.028em } text[font-weight=\"bold\"] { stroke-width: 0.065em }";

static FONTS: LazyLock<Arc<Database>> = LazyLock::new(|| {
    let mut fonts = Database::new();
    for font in [
        epaint_default_fonts::UBUNTU_LIGHT,
        epaint_default_fonts::HACK_REGULAR,
    ] {
        fonts.load_font_source(Source::Binary(Arc::new(font)));
    }
    let family = fonts
        .faces()
        .next()
        .and_then(|f| f.families.first())
        .map(|f| f.0.clone());
    if let Some(family) = family {
        fonts.set_sans_serif_family(family.clone());
        fonts.set_serif_family(family);
    }
    Arc::new(fonts)
});

fn parse(svg: &str) -> Result<Tree> {
    let options = Options {
        fontdb: Arc::clone(&FONTS),
        style_sheet: Some(SHEET.to_owned()),
        ..Options::default()
    };
    Tree::from_str(svg, &options).context("this is no SVG that can be drawn")
}

/// Draws with `scale` px per SVG unit.
pub(super) fn pixels(svg: &str, scale: f64) -> Result<Pixmap> {
    let tree = parse(svg)?;
    let side = |length: f32| (f64::from(length) * scale).round().max(1.0);
    let (width, height) = (side(tree.size().width()), side(tree.size().height()));
    if !(scale.is_finite() && scale > 0.0 && width * height <= MOST_PIXELS) {
        bail!(
            "a picture of {width} × {height} px is too large; accepted: up to {MOST_PIXELS:.0} px"
        );
    }
    let mut pixmap = Pixmap::new(width as u32, height as u32)
        .with_context(|| format!("a picture of {width} × {height} px is too large"))?;
    let scale = scale as f32;
    resvg::render(
        &tree,
        Transform::from_scale(scale, scale),
        &mut pixmap.as_mut(),
    );
    Ok(pixmap)
}

/// Rasterises an SVG to a PNG file's bytes, with `scale` px per SVG unit. Text is set in an
/// embedded font: the picture is the same on every machine.
///
/// # Errors
/// Text that is no SVG, or a picture of more than 200 million pixels.
pub fn png(svg: &str, scale: f64) -> Result<Vec<u8>> {
    pixels(svg, scale)?
        .encode_png()
        .context("the picture could not be encoded")
}
