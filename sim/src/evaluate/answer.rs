//! A question and its answer.

use hw_model::datapath::front_end::Region;
use hw_model::datapath::{Datapath, Status};
use hw_model::highlight::phong;
use hw_model::quantise::real;
use vectors::Case;

/// What is asked: the case of `vectors`, so that n and x mean the same everywhere.
pub type Question = Case;

/// What the golden model answers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Answer {
    /// The question that this answers: an address and an x.
    pub question: Question,
    /// The intensity, bits in the output format.
    pub intensity: i64,
    /// The status flags of the result.
    pub status: Status,
    /// The part of the pipeline that answered.
    pub region: Region,
}

impl Answer {
    /// Asks the data path, rank by rank.
    #[must_use]
    pub fn of(datapath: &Datapath, question: Question) -> Self {
        let held = datapath.evaluate(question.address, question.x);
        let (intensity, status) = (held.intensity, held.status);
        Self { question, intensity, status, region: held.region }
    }

    /// x as the hardware sees it: the value of its bits.
    #[must_use]
    pub fn x(&self, datapath: &Datapath) -> f64 {
        real(self.question.x, datapath.formats().input)
    }

    /// The intensity as a real number.
    #[must_use]
    pub fn value(&self, datapath: &Datapath) -> f64 {
        real(self.intensity, datapath.formats().output)
    }

    /// x^n at [`x`](Self::x) clamped to [0, 1], correctly rounded; none where no exponent belongs to the address.
    #[must_use]
    pub fn reference(&self, datapath: &Datapath) -> Option<f64> {
        Some(phong(self.question.exponent?, self.x(datapath).clamp(0.0, 1.0)))
    }

    /// Intensity less reference, in units of the output's last place.
    #[must_use]
    pub fn error_ulp(&self, datapath: &Datapath) -> Option<f64> {
        Some(self.error_ulp_from(datapath, self.reference(datapath)?))
    }

    /// The same from a [`reference`](Self::reference) that is at hand: a power is what an answer costs most.
    #[must_use]
    pub fn error_ulp_from(&self, datapath: &Datapath, reference: f64) -> f64 {
        (self.value(datapath) - reference) / datapath.formats().output.ulp()
    }
}
