//! What the highlight pipeline computes, bit for bit.
//!
//! Pure: no files, no clock, no randomness, no threads, no command line. Floating point appears only
//! where real numbers are the subject: [`highlight`], [`fit`], [`quantise`], [`budget`], and the real
//! rows of a [`design`]; the data path ([`datapath`]) has none.

pub mod budget;
pub mod config;
pub mod datapath;
pub mod design;
pub mod domain;
pub mod exponents;
pub mod fit;
pub mod format;
pub mod highlight;
pub mod names;
pub mod presets;
pub mod quantise;
pub mod rom;
pub mod rounding;
pub mod rtl;
pub mod stated;
pub mod steps;
