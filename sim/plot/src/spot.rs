//! Points that have a name written beside them.

/// The form of a point. The forms differ, so that kinds can be told apart without colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shape {
    /// A disc.
    Circle,
    /// A square on its side.
    Square,
    /// A square on its corner.
    Diamond,
    /// A triangle on its side.
    Triangle,
}

/// A point with a name. Its colour is that of the kind it belongs to.
#[derive(Debug, Clone, PartialEq)]
pub struct Spot {
    /// Its coordinates.
    pub at: (f64, f64),
    /// The place of its kind in [`Chart::kinds`](crate::Chart::kinds).
    pub kind: usize,
    /// Filled, or an outline.
    pub filled: bool,
    /// Outlined in black.
    pub marked: bool,
    /// What is written beside it; nothing for an empty text.
    pub label: String,
}

/// A kind of points, for the legend.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Kind {
    /// Its name.
    pub name: String,
    /// The form of its points.
    pub shape: Shape,
    /// Which of the colours of series they have.
    pub colour: usize,
}
