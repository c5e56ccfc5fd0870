//! What the highlight pipeline computes, bit for bit: cos(γ)^n by a cubic whose coefficients sit in a ROM indexed by n.
//!
//! ```
//! use hw_model::design::Design;
//!
//! let design = Design::preset("paper")?;
//! assert_eq!(design.highlight(64.0, 0.99)?, 0.5257568359375); // 0.99^64 = 0.5256
//! assert_eq!(design.intensity_bits(63, 8_304_722)?, 17_228); // the same at the ports
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A [`Config`](config::Config) says what is to be built, a [`Design`](design::Design) is everything that follows from
//! it, and its [`Datapath`](datapath::Datapath) gives every register of every rank.
//!
//! | to know | see |
//! |---|---|
//! | what can be configured, and what comes with the project | [`config`], [`presets`] |
//! | which polynomial stands for x^n, and how far it errs | [`fit`], [`highlight`] |
//! | why a register has its width | [`budget`], [`format`](mod@format) |
//! | what a rank of registers takes in from the one before | [`datapath`], [`rom`], [`rounding`] |
//! | how a real number becomes bits | [`quantise`] |
//!
//! Pure: no files, no clock, no randomness, no threads, no command line. Floating point appears only
//! where real numbers are the subject: [`highlight`], [`fit`], [`quantise`], [`budget`], and the real
//! rows and the front door of a [`design`]; the data path ([`datapath`]) has none.
#![cfg_attr(not(test), deny(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::unreachable))]

pub mod budget;
pub mod clock;
pub mod config;
pub mod datapath;
pub mod design;
pub mod domain;
pub mod exponents;
pub mod fit;
pub mod format;
pub mod handshake;
pub mod highlight;
pub mod names;
pub mod pipelining;
pub mod presets;
pub mod quantise;
pub mod registers;
pub mod rom;
pub mod rounding;
pub mod rtl;
pub mod stated;
pub mod steps;
pub mod widths;
