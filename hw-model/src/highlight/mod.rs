//! Real functions of the exponent n and x = cos γ: the reference, the oracle that checks it, and the
//! approximations.
//!
//! x and s = 1 − x carry the same information, and every function that is used close to the
//! highlight takes s: for n = 10⁹ the whole epicentre is 7·10⁻¹⁰ wide, and 1 − s would keep six digits.

pub mod cubic;
pub mod exact;
pub mod phong;
pub mod powers;
pub mod rational;
pub mod schlick;
pub mod segment;

pub use cubic::{Centred, Cubic, Power};
pub use exact::{ExactError, ExactPower};
pub use phong::{phong, phong_at_s};
pub use powers::phong_of_all;
pub use rational::Rational;
pub use schlick::{schlick, schlick_at_s};
pub use segment::Segment;
