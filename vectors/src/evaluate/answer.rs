//! A question and its answer.

use crate::Case;
use hw_model::datapath::front_end::Region;
use hw_model::datapath::{Datapath, Status};
use hw_model::highlight::{phong, phong_of_all};
use hw_model::quantise::real;

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

    /// Intensity less a [`reference`](Self::reference), in units of the output's last place.
    #[must_use]
    pub fn error_ulp(&self, datapath: &Datapath, reference: f64) -> f64 {
        (self.value(datapath) - reference) / datapath.formats().output.ulp()
    }
}

/// [`Answer::reference`] of many answers together, which takes a fifth of the time; NaN where there is none.
#[derive(Debug, Default)]
pub(super) struct References {
    exponents: Vec<f64>,
    xs: Vec<f64>,
    powers: Vec<f64>,
}

impl References {
    pub(super) fn of(&mut self, datapath: &Datapath, answers: &[Answer]) -> &[f64] {
        let Self { exponents, xs, powers } = self;
        exponents.clear();
        // Where there is no exponent, another one is as good: what comes of it is not looked at.
        exponents.extend(answers.iter().map(|answer| answer.question.exponent.unwrap_or(1.0)));
        xs.clear();
        xs.extend(answers.iter().map(|answer| answer.x(datapath).clamp(0.0, 1.0)));
        powers.resize(answers.len(), 0.0);
        phong_of_all(exponents, xs, powers);
        for (answer, power) in answers.iter().zip(&mut *powers) {
            if answer.question.exponent.is_none() {
                *power = f64::NAN;
            }
        }
        powers
    }
}
