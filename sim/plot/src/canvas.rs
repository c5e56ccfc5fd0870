//! Lines, boxes and words as SVG: the only file that knows the crate that writes it.

use svg::Document;
use svg::node::element::{Description, Group, Polygon, Polyline, Rectangle, Text, Title};

/// The bundled font first, as in the plots.
const FONT: &str = "'DejaVu Sans', Verdana, sans-serif";
/// Free space around a picture.
pub const MARGIN: f64 = 12.0;

/// A place, in SVG units, y downwards.
pub type Point = (f64, f64);

/// Which part of a text stands at its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    /// The place is where the text begins.
    Start,
    /// The place is in the middle of the text.
    Middle,
    /// The place is where the text ends.
    End,
}

/// Colours, chosen from those of Okabe and Ito and their tints, which people with any common colour
/// vision deficiency can tell apart. Nothing is said by colour alone.
pub mod colour {
    /// For letters and outlines.
    pub const INK: &str = "#1a1a1a";
    /// Words that stand back.
    pub(crate) const QUIET: &str = "#555555";
    /// Grid lines, and wires that carry nothing.
    pub const FAINT: &str = "#c4c4c4";
    /// For the background.
    pub const PAPER: &str = "#ffffff";
    /// For what belongs to the polynomial.
    pub const BLUE: &str = "#d6e9f5";
    /// For what belongs to the divider.
    pub const ORANGE: &str = "#fbe6c5";
    /// For the ROM.
    pub const GREEN: &str = "#d3efe6";
    /// What belongs to both parts.
    pub const GREY: &str = "#ececec";
    /// Cycles to look at.
    pub const SHADE: &str = "#fdf3d8";
    /// For registers.
    pub const REGISTER: &str = "#0072b2";
}

/// A picture under way.
pub struct Canvas {
    group: Group,
    /// What stands around the group under way.
    outer: Vec<Group>,
}

impl Default for Canvas {
    fn default() -> Self {
        Self::new()
    }
}

impl Canvas {
    /// An empty picture.
    #[must_use]
    pub fn new() -> Self {
        Self { group: Group::new().set("font-family", FONT), outer: Vec::new() }
    }

    /// Begins a part of the picture that stands for these registers, named with spaces between: its element has them as
    /// `data-register`, for pages in which a click asks about it. [`Canvas::close`] ends it.
    pub fn open(&mut self, registers: &str) {
        let part = Group::new();
        let part = if registers.is_empty() { part } else { part.set("data-register", registers) };
        self.outer.push(std::mem::replace(&mut self.group, part));
    }

    /// Ends the part that was begun last.
    pub fn close(&mut self) {
        if let Some(outer) = self.outer.pop() {
            let part = std::mem::replace(&mut self.group, outer);
            self.add(part);
        }
    }

    /// A filled box with an outline.
    pub fn rectangle(&mut self, (x, y): Point, (width, height): Point, fill: &str) {
        let shape = Self::area((x, y), (width, height), fill).set("stroke", colour::INK).set("stroke-width", 1);
        self.add(shape);
    }

    /// A filled box without an outline.
    pub fn block(&mut self, place: Point, size: Point, fill: &str) {
        self.add(Self::area(place, size, fill));
    }

    fn area((x, y): Point, (width, height): Point, fill: &str) -> Rectangle {
        Rectangle::new().set("x", x).set("y", y).set("width", width).set("height", height).set("fill", fill)
    }

    /// A filled shape with an outline.
    pub fn polygon(&mut self, points: &[Point], fill: &str) {
        let shape = Polygon::new()
            .set("points", listed(points))
            .set("fill", fill)
            .set("stroke", colour::INK)
            .set("stroke-width", 1);
        self.add(shape);
    }

    /// A line through these places.
    pub fn line(&mut self, points: &[Point], stroke: &str, width: f64) {
        self.add(Self::stroke(points, stroke, width));
    }

    /// A broken line through these places.
    pub fn dashes(&mut self, points: &[Point], stroke: &str) {
        self.add(Self::stroke(points, stroke, 1.0).set("stroke-dasharray", "3 3"));
    }

    fn stroke(points: &[Point], stroke: &str, width: f64) -> Polyline {
        Polyline::new()
            .set("points", listed(points))
            .set("fill", "none")
            .set("stroke", stroke)
            .set("stroke-width", width)
    }

    /// A wire with an arrow head at its end.
    pub fn arrow(&mut self, points: &[Point]) {
        const LENGTH: f64 = 8.0;
        const HALF: f64 = 3.5;
        let [.., (from_x, from_y), (x, y)] = *points else { return };
        self.line(points, colour::INK, 1.2);
        let along = (x - from_x, y - from_y);
        let length = along.0.hypot(along.1).max(1.0);
        let (dx, dy) = (along.0 / length, along.1 / length);
        let (back_x, back_y) = (x - LENGTH * dx, y - LENGTH * dy);
        let head = [(x, y), (back_x - HALF * dy, back_y + HALF * dx), (back_x + HALF * dy, back_y - HALF * dx)];
        self.polygon(&head, colour::INK);
    }

    /// A word, its baseline at this height.
    pub fn text(&mut self, (x, y): Point, words: &str, anchor: Anchor, size: f64) {
        self.words((x, y), words, anchor, size, colour::INK);
    }

    /// A word that stands back.
    pub fn quiet(&mut self, (x, y): Point, words: &str, anchor: Anchor, size: f64) {
        self.words((x, y), words, anchor, size, colour::QUIET);
    }

    fn words(&mut self, (x, y): Point, words: &str, anchor: Anchor, size: f64, fill: &str) {
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let text = Text::new(words)
            .set("x", x)
            .set("y", y)
            .set("font-size", size)
            .set("text-anchor", anchor)
            .set("fill", fill);
        self.add(text);
    }

    fn add(&mut self, node: impl Into<Box<dyn svg::Node>>) {
        svg::Node::append(&mut self.group, node);
    }

    /// The picture as text: on white, with a margin; title and description for those who listen.
    #[must_use]
    pub fn finish(self, (width, height): Point, title: &str, description: &str) -> String {
        let (wide, high) = (width + 2.0 * MARGIN, height + 2.0 * MARGIN);
        let document = Document::new()
            .set("viewBox", format!("0 0 {wide} {high}"))
            .set("width", wide)
            .set("height", high)
            .set("role", "img")
            .add(Title::new(title))
            .add(Description::new().add(svg::node::Text::new(description)))
            .add(Self::area((0.0, 0.0), (wide, high), colour::PAPER))
            .add(self.group.set("transform", format!("translate({MARGIN} {MARGIN})")));
        format!("{document}\n")
    }
}

/// The corners of a wire on its way up that hops over another at this place.
#[must_use]
pub fn hop((x, y): Point) -> Vec<Point> {
    const RADIUS: f64 = 6.0;
    const CORNERS: u32 = 8;
    let corner = |index| {
        let angle = std::f64::consts::PI * f64::from(index) / f64::from(CORNERS);
        (x + RADIUS * angle.sin(), y + RADIUS * angle.cos())
    };
    (0..=CORNERS).map(corner).collect()
}

fn listed(points: &[Point]) -> String {
    let points: Vec<String> = points.iter().map(|(x, y)| format!("{x:.1},{y:.1}")).collect();
    points.join(" ")
}
