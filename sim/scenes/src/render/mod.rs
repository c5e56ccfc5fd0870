//! Pictures of a scene, every highlight of which is the pipeline's.
//!
//! ```text
//! Scene ─► rays, hits (bvh) ─► Samples: N·L and x of every surface pixel and light
//!                                 │  (geometry alone: no hardware, no colours)
//!                                 ▼
//!               Requests: x in the pipeline's bits, by exponent ─► Block ─► intensities
//!                                 │                                          │
//!        reference x^n ───────────┴──────────── shading ─────────────────────┘
//!                                                  ▼
//!                         display codes ─► PNG, differences, figures
//! ```
//!
//! | file | holds |
//! |---|---|
//! | `rays.rs` | the ray of a pixel |
//! | `surfaces.rs`, `bvh.rs` | where a ray meets a surface first |
//! | `angle.rs` | from light, normal and viewer to N·L and x |
//! | `samples.rs` | the same for a whole picture: what geometry and lights present |
//! | `requests.rs` | x in the pipeline's bits, by exponent, and which of them need the pipeline |
//! | `highlight.rs` | the pipeline's answers, and x^n |
//! | `colour.rs`, `shading.rs` | linear light, and display codes |
//! | `figures.rs`, `frame_clock.rs` | differences, regions, cycles; the clock of a pipeline |
//! | `png.rs`, `heat.rs`, `methods.rs`, `compare.rs`, `panels.rs`, `sheet.rs` | the pictures |
//!
//! Everything is computed in f64 with correctly rounded functions and in an order of its own, so that neither machine
//! nor number of threads changes a byte.

mod angle;
mod bvh;
mod colour;
mod compare;
mod figures;
mod frame_clock;
mod heat;
mod highlight;
mod methods;
mod panels;
mod png;
mod rays;
mod requests;
mod samples;
mod shading;
mod sheet;
mod surfaces;

pub use angle::{Presented, presented};
pub(crate) use bvh::Below;
pub use bvh::Bvh;
pub use colour::Codes;
pub use compare::{Compared, compare, side_by_side};
pub use figures::{Cycles, Difference, MaterialFigures, by_material, difference};
pub use frame_clock::FrameClock;
pub use heat::heat_map;
pub use highlight::{Answers, Zone, reference};
pub use methods::methods;
pub use png::{PngError, encode};
pub use rays::{Ray, ray};
pub use requests::{Group, MissingExponent, RowFor, ScenePipeline, Which, bits};
pub use samples::{Sample, Samples, SurfacePixel, samples};
pub use shading::{Picture, shade, smooth};
pub use sheet::SheetError;
pub use surfaces::{Hit, meet};
