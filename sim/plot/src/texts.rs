//! Where the words of a picture stand, for whoever asks whether it can be read.

use resvg::usvg::{Group, Node, Rect};

use super::error::PlotError;
use super::raster::parse;

/// A text of a picture, and the box that its letters take, in SVG units from the upper left corner.
#[derive(Debug, Clone, PartialEq)]
pub struct Text {
    /// What is written.
    pub words: String,
    /// The box's left side.
    pub left: f32,
    /// The box's upper side.
    pub top: f32,
    /// The box's right side.
    pub right: f32,
    /// The box's lower side.
    pub bottom: f32,
}

impl Text {
    fn new(words: String, place: Rect) -> Self {
        let (left, top, right, bottom) = (place.left(), place.top(), place.right(), place.bottom());
        Self { words, left, top, right, bottom }
    }
}

/// Every text of an SVG in the order in which they are drawn, and the width and height of the picture.
///
/// # Errors
/// When it is no SVG.
pub fn texts(svg: &str) -> Result<(Vec<Text>, (f32, f32)), PlotError> {
    let tree = parse(svg)?;
    let mut found = Vec::new();
    add(tree.root(), &mut found);
    Ok((found, (tree.size().width(), tree.size().height())))
}

fn add(group: &Group, found: &mut Vec<Text>) {
    for node in group.children() {
        match node {
            Node::Group(group) => add(group, found),
            Node::Text(text) => {
                let words = text.chunks().iter().map(|chunk| chunk.text()).collect();
                found.push(Text::new(words, text.abs_bounding_box()));
            }
            _ => {}
        }
    }
}
