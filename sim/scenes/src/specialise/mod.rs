//! Hardware for one scene: what the scene can ask, and a configuration that answers that and leaves out the rest.
//!
//! | file | holds |
//! |---|---|
//! | `demand.rs`, `search.rs`, `tile.rs`, `patch.rs`, `space.rs` | for each exponent the interval of x that the picture presents, proved |
//! | `derive.rs` | the configuration that keeps what these need, its points where they were |
//! | `serve.rs` | the fewest rows that serve exponents which are near each other |
//! | `codes.rs` | the same with fewer output bits, where display codes may differ |
//! | `compare.rs` | every (n, x) through both |
//! | `certificate.rs` | what was found, sealed |
//! | `check.rs` | the same found again, and held against what the user asks about |
//! | `figures.rs` | what was left out, and why |

mod certificate;
mod check;
mod codes;
mod compare;
mod demand;
mod derive;
mod figures;
mod patch;
mod refused;
mod search;
mod serve;
mod space;
mod tile;

pub use certificate::{Certificate, Display, Part, Proved, Served};
pub use check::{Asked, Held, check, inputs};
pub use codes::{ReduceError, pixels_outside, reduce};
pub use compare::{certify, points};
pub use demand::{Demand, demands};
pub use derive::{AskedRow, SpecialiseError, derive, is_guarded, rows, served_rows, serving};
pub use figures::{LeftOut, left_out};
pub use refused::Refused;
pub use serve::{serve, with_words};
