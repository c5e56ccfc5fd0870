//! Points that have a name written beside them.

/// The form of a point. The forms differ, so that kinds can be told apart without colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shape {
    /// A disc around the point.
    Circle,
    /// A square on its side.
    Square,
    /// A square on its corner.
    Diamond,
    /// A triangle on its side.
    Triangle,
}

/// A point with a name. Its colour is its kind's.
#[derive(Debug, Clone, PartialEq)]
pub struct Spot {
    /// Its place, in the units of the axes.
    pub at: (f64, f64),
    /// The place of its kind in [`Chart::kinds`](crate::Chart::kinds).
    pub kind: usize,
    /// Filled, or an outline.
    pub filled: bool,
    /// True where it has a black outline.
    pub marked: bool,
    /// What is written beside it; nothing for an empty text.
    pub label: String,
    /// What a reader is told who points at it, where the picture can: its full name and its values.
    pub told: String,
}

/// A kind of points, for the legend.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Kind {
    /// The name in the legend.
    pub name: String,
    /// The form of its points.
    pub shape: Shape,
    /// Which of the colours of series they have.
    pub colour: usize,
}
