//! A claim that compares a number, which depends on the exponent, with a limit.

use rayon::prelude::*;

use super::boundary::{Boundary, GREATEST, boundary, examined};
use super::claim::{Claim, ClaimsError, Evidence, Judgement, command};

/// On which side of the limit a claim wants the number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Sense {
    /// At most the limit.
    AtMost,
    /// At least the limit.
    AtLeast,
}

/// A claim that compares a number with a limit, for every exponent.
pub(super) struct Comparison<'a> {
    pub(super) id: &'static str,
    pub(super) claim: &'static str,
    pub(super) source: &'static str,
    /// What the number is.
    pub(super) what: &'static str,
    /// The unit of the number: `%` or `times`.
    pub(super) unit: &'static str,
    /// The limit that the paper states, in `unit`.
    pub(super) limit: f64,
    pub(super) sense: Sense,
    /// The number for an exponent, in `unit`; infinite where it divides by an error of zero.
    pub(super) value: &'a (dyn Fn(f64) -> Result<f64, ClaimsError> + Sync),
}

impl Comparison<'_> {
    pub(super) fn holds(&self, value: f64) -> bool {
        match self.sense {
            Sense::AtMost => value <= self.limit,
            Sense::AtLeast => value >= self.limit,
        }
    }

    /// The nearer of two to failing, or further beyond.
    fn is_worse(&self, value: f64, than: f64) -> bool {
        match self.sense {
            Sense::AtMost => value > than,
            Sense::AtLeast => value < than,
        }
    }

    fn at(&self, n: u64) -> Result<f64, ClaimsError> {
        // At most 10^9, an f64 of its own.
        (self.value)(n as f64)
    }

    fn evidence(&self, n: u64) -> Result<Evidence, ClaimsError> {
        Ok(Evidence {
            what: self.what.to_owned(),
            n: Some(n as f64),
            value: self.at(n)?,
            limit: Some(self.limit),
            unit: self.unit,
        })
    }

    /// The worst of the examined exponents, the first of them where several are.
    fn worst(&self) -> Result<u64, ClaimsError> {
        let values: Vec<(u64, f64)> =
            examined().into_par_iter().map(|n| Ok((n, self.at(n)?))).collect::<Result<_, ClaimsError>>()?;
        let worst = values.into_iter().reduce(|worst, next| if self.is_worse(next.1, worst.1) { next } else { worst });
        Ok(worst.map_or(1, |(n, _)| n))
    }

    /// Where it holds, and the numbers around.
    pub(super) fn judged(&self) -> Result<Claim, ClaimsError> {
        // Fails at the first exponent that a method refuses: all that are looked at are within its range.
        let found = boundary(self.id, |n| self.at(n).is_ok_and(|value| self.holds(value)))?;
        let (verdict, exponents) = match found {
            Boundary::Always => (Judgement::Holds, vec![self.worst()?]),
            Boundary::Never => (Judgement::Fails, vec![1, GREATEST]),
            Boundary::HoldsTo(last) => (Judgement::HoldsTo(last), vec![last, last + 1, GREATEST]),
        };
        let evidence = exponents.into_iter().map(|n| self.evidence(n)).collect::<Result<Vec<_>, _>>()?;
        let fails_from = match found {
            Boundary::HoldsTo(last) => Some(last + 1),
            Boundary::Always | Boundary::Never => None,
        };
        Ok(Claim {
            id: self.id,
            claim: self.claim,
            source: self.source,
            computed: computed(found, &evidence),
            holds_for: match found {
                Boundary::Always => "every n".to_owned(),
                Boundary::Never => "no n".to_owned(),
                Boundary::HoldsTo(last) => format!("n <= {last}"),
            },
            fails_from,
            verdict,
            command: command(self.id),
            evidence,
        })
    }
}

fn computed(found: Boundary, evidence: &[Evidence]) -> String {
    let numbers: Vec<String> = evidence.iter().map(figure).collect();
    match found {
        Boundary::Always => format!("at its worst {}", numbers.join(", ")),
        Boundary::Never | Boundary::HoldsTo(_) => numbers.join(", "),
    }
}

/// A number in words.
fn figure(evidence: &Evidence) -> String {
    let n = evidence.n.map_or_else(String::new, |n| {
        // The greatest stands for the limit.
        if n == GREATEST as f64 { " at n = 10^9".to_owned() } else { format!(" at n = {n}") }
    });
    match evidence.unit {
        "%" => format!("{:.5} %{n}", evidence.value),
        unit => format!("{:.4} {unit}{n}", evidence.value),
    }
}
