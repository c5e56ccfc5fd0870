//! Stiff and extreme cases, each with what it costs.
//!
//! | part             | asks                                                               | configuration |
//! |------------------|--------------------------------------------------------------------|---------------|
//! | [`coefficients`] | how many digits a way of computing coefficients in f64 loses        | none          |
//! | [`conditioning`] | how ill-conditioned the two forms are, and the widths that costs    | none          |
//! | [`edges`]        | what the pipeline answers at the edges of x, n, formats and ROM     | one           |
//! | [`seams`]        | where the output falls as x rises, and how far it jumps             | one           |
//! | [`mod@reference`] | how far x^n in f64 is from x^n                                      | none          |
//!
//! "Stiff" means large n: the slope at x = 1 is n, power-form coefficients grow as n², and p → 0.

mod cases;
pub mod coefficients;
pub mod conditioning;
pub mod edges;
mod expressions;
pub mod reference;
pub mod seams;
mod wide;
mod words;
