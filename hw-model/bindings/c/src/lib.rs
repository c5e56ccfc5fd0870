//! The golden model as a C library: `include/blysk.h` is made of this crate by cbindgen.
//!
//! Nothing is computed here. Each function checks what it is given, calls the crate `model`, and says with a code how
//! it went; `error.rs` keeps the sentence to a code, thread by thread.
//!
//! # Where `unsafe` stands
//!
//! `pointers.rs` has every `unsafe` block, and says why each is right. The other modules that export functions need
//! the permission for `#[unsafe(no_mangle)]` alone: names that C can link are promised to be the only ones.
//! No panic crosses the boundary: every function that could have one goes through `error::guard`.
#![cfg_attr(not(test), deny(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::unreachable))]

// In the order in which the header has them.
mod abi;

mod status;

#[allow(unsafe_code)]
mod error;

mod formats;

#[allow(unsafe_code)]
mod models;

#[allow(unsafe_code)]
mod registers;

#[allow(unsafe_code)]
mod pipelines;

#[allow(unsafe_code)]
mod scoreboards;

#[allow(unsafe_code)]
#[allow(clippy::too_many_arguments, reason = "SystemVerilog hands over ports one by one")]
mod dpi;

mod names;
#[allow(unsafe_code)]
mod pointers;

pub use abi::ABI_VERSION;
pub use error::Code;
pub use formats::{Format, Interface};
pub use registers::Register;
pub use status::{STATUS_ABOVE_ONE, STATUS_CLAMPED, STATUS_FACING_AWAY, STATUS_NO_WORD, STATUS_OUT_OF_DOMAIN};
