//! The same data path with a part exchanged: hardware that was built wrongly, for the search for vectors that tell it
//! from the right hardware.
//!
//! The ROM and the formats stay: they say which hardware it was meant to be. Its registers may now
//! be given values that do not fit; a caller that goes rank by rank trims them with
//! [`QFormat::from_word`](crate::format::QFormat::from_word).

use super::front_end::FrontEnd;
use super::parts::Datapath;
use super::stage::{MultiplyAdd, Stages};
use super::tail::Divider;

impl Datapath {
    /// With another front end.
    #[must_use]
    pub fn with_front_end(self, front_end: FrontEnd) -> Self {
        Self { front_end, ..self }
    }

    /// With another line in the place of stage `index` (0 is the first), where there is one.
    #[must_use]
    pub fn with_stage(self, index: usize, line: MultiplyAdd) -> Self {
        let lines = self.stages.lines().iter().enumerate();
        let stages = lines.map(|(place, &own)| if place == index { line } else { own });
        Self { stages: Stages::new(stages), ..self }
    }

    /// With another divider; only for a data path that has one. The number of ranks follows it.
    #[must_use]
    pub fn with_divider(self, divider: Divider) -> Self {
        Self { divider: self.divider.map(|_| divider), ..self }
    }

    /// Computed in the wide lane, whatever the lines need: values that do not fit their registers have
    /// room there until they are trimmed.
    #[must_use]
    pub fn in_wide_lane(self) -> Self {
        Self { narrow: false, ..self }
    }
}
