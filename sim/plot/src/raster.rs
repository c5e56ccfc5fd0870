//! From SVG to PNG and pixels: with `texts.rs` the only file that knows the renderer.

use std::sync::{Arc, LazyLock};

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{self, Options, Tree, fontdb};

use super::chart::Chart;
use super::error::PlotError;

/// The one font there is: a picture must not depend on what the machine has installed.
static FONT: &[u8] = include_bytes!("../assets/DejaVuSans.ttf");
const FONT_NAME: &str = "DejaVu Sans";

/// The longest side of a PNG, in pixels.
const LONGEST_SIDE: f32 = 16_384.0;

/// Loading the font costs more than drawing a chart, so it is done once.
static FONTS: LazyLock<Arc<fontdb::Database>> = LazyLock::new(|| {
    let mut fonts = fontdb::Database::new();
    fonts.load_font_data(FONT.to_vec());
    fonts.set_sans_serif_family(FONT_NAME);
    Arc::new(fonts)
});

/// Pixels of a chart's PNG for each unit of its SVG.
const CHART_SCALE: f32 = 2.0;

impl Chart {
    /// The chart as SVG text, and as PNG with twice as many pixels as it has units.
    ///
    /// # Errors
    /// As [`to_svg`](Self::to_svg) and [`svg_to_png`].
    pub fn to_svg_and_png(&self) -> Result<(String, Vec<u8>), PlotError> {
        let svg = self.to_svg()?;
        let png = svg_to_png(&svg, CHART_SCALE)?;
        Ok((svg, png))
    }
}

/// Draws an SVG as PNG with `scale` pixels to the SVG unit; 2 suits a screen, 4 suits print.
///
/// # Errors
/// When the text is not an SVG, or the picture would have no pixels or more than 16 384 a side.
pub fn svg_to_png(svg: &str, scale: f32) -> Result<Vec<u8>, PlotError> {
    let pixels = drawn(svg, scale)?;
    pixels.encode_png().map_err(|error| PlotError::Png(error.to_string()))
}

/// Draws an SVG with an opaque ground at one pixel to the unit: width, height, and red, green and blue of every pixel.
///
/// # Errors
/// As [`svg_to_png`].
pub fn svg_to_pixels(svg: &str) -> Result<(u32, u32, Vec<[u8; 3]>), PlotError> {
    let pixels = drawn(svg, 1.0)?;
    let colours = pixels.pixels().iter().map(|pixel| [pixel.red(), pixel.green(), pixel.blue()]);
    Ok((pixels.width(), pixels.height(), colours.collect()))
}

fn drawn(svg: &str, scale: f32) -> Result<Pixmap, PlotError> {
    let tree = parse(svg)?;
    let (width, height) = (tree.size().width() * scale, tree.size().height() * scale);
    let refused = PlotError::Size { width, height, scale };
    // The comparisons are false for a scale that is not a number.
    let sensible = |side: f32| side > 0.0 && side <= LONGEST_SIDE;
    if !(scale > 0.0 && sensible(width) && sensible(height)) {
        return Err(refused);
    }
    let mut pixels = Pixmap::new(width.ceil() as u32, height.ceil() as u32).ok_or(refused)?;
    let transform = Transform::from_scale(scale, scale);
    resvg::render(&tree, transform, &mut pixels.as_mut());
    Ok(pixels)
}

/// Reads an SVG with the bundled font and no other.
pub(super) fn parse(svg: &str) -> Result<Tree, PlotError> {
    let options = Options { fontdb: Arc::clone(&FONTS), font_family: FONT_NAME.to_owned(), ..Options::default() };
    Tree::from_str(svg, &options).map_err(|error: usvg::Error| PlotError::Svg(error.to_string()))
}
