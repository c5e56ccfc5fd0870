//! What is asked, and what is answered.

mod alter;
mod archive;
mod clock;
mod curve;
mod hardware;
mod highlight;

pub(crate) use alter::{AlterAsk, Altered};
pub(crate) use archive::archive;
pub(crate) use clock::{ClockAsk, Clocked, OpenAsk, Opened};
pub(crate) use curve::{Curve, CurveAsk};
pub(crate) use hardware::{Beginning, Hardware, HardwareAsk};
pub(crate) use highlight::{Highlight, HighlightAsk};
