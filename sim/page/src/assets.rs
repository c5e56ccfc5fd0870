//! Style sheet and scripts: files of `assets/`, compiled in. Pages have them inside; a server can serve them.

/// The style of every page: light and dark, from 390 pixels of width up.
pub const STYLE: &str = include_str!("../assets/style.css");
/// Tables that can be sorted and searched.
pub const TABLES: &str = include_str!("../assets/tables.js");
/// Plots that tell the value of a point, drawn by uPlot.
pub const PLOTS: &str = include_str!("../assets/plots.js");
/// Diagrams whose parts show the row of the register they stand for.
pub const DIAGRAMS: &str = include_str!("../assets/diagrams.js");
/// The plotting library uPlot 1.6.32, by Leon Sorokin, MIT (`assets/uplot/LICENSE`).
pub const UPLOT: &str = include_str!("../assets/uplot/uPlot.iife.min.js");
/// The style of uPlot.
pub const UPLOT_STYLE: &str = include_str!("../assets/uplot/uPlot.min.css");
/// The licence of uPlot, which every page with it has inside.
pub const UPLOT_LICENSE: &str = include_str!("../assets/uplot/LICENSE");
