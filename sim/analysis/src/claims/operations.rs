//! How many operations a cubic takes: the expression is evaluated with a number that counts.

use std::cell::Cell;
use std::ops::{Add, Mul};

use super::claim::{Claim, Evidence, Judgement, command};

/// Multiplications and additions done so far.
#[derive(Debug, Default)]
struct Tally {
    multiplications: Cell<u32>,
    additions: Cell<u32>,
}

fn count_one(of: &Cell<u32>) {
    of.set(of.get() + 1);
}

/// A number that adds to the tally what is done with it.
#[derive(Clone, Copy)]
struct Counted<'a>(&'a Tally);

impl Mul for Counted<'_> {
    type Output = Self;
    fn mul(self, _: Self) -> Self {
        count_one(&self.0.multiplications);
        self
    }
}

impl Add for Counted<'_> {
    type Output = Self;
    fn add(self, _: Self) -> Self {
        count_one(&self.0.additions);
        self
    }
}

/// a·x³ + b·x² + c·x term by term, each power from the one before.
fn written_out<T: Copy + Add<Output = T> + Mul<Output = T>>([a, b, c]: [T; 3], x: T) -> T {
    let square = x * x;
    let cube = square * x;
    a * cube + b * square + c * x
}

/// The same by Horner's rule.
fn horner<T: Copy + Add<Output = T> + Mul<Output = T>>([a, b, c]: [T; 3], x: T) -> T {
    ((a * x + b) * x + c) * x
}

/// Multiplications and additions of an expression.
fn count<F>(expression: F) -> [u32; 2]
where
    F: for<'a> Fn([Counted<'a>; 3], Counted<'a>) -> Counted<'a>,
{
    let tally = Tally::default();
    let number = Counted(&tally);
    expression([number; 3], number);
    [tally.multiplications.get(), tally.additions.get()]
}

pub(super) fn claims() -> [Claim; 1] {
    let (printed, nested) = (count(|k, x| written_out(k, x)), count(|k, x| horner(k, x)));
    let evidence = |what: &str, value: u32, limit: Option<u32>| Evidence {
        what: what.to_owned(),
        n: None,
        value: value.into(),
        limit: limit.map(Into::into),
        unit: "",
    };
    let verdict = if printed == [5, 2] { Judgement::Holds } else { Judgement::Fails };
    [Claim {
        id: "operations",
        claim: "For each n three coefficients are enough, and hardware needs 5 multiplications and 2 additions",
        source: "the paragraph after the 15th formula",
        computed: format!(
            "written out {} multiplications and {} additions; by Horner's rule {} and {}",
            printed[0], printed[1], nested[0], nested[1]
        ),
        holds_for: "every n".to_owned(),
        fails_from: None,
        verdict,
        command: command("operations"),
        evidence: vec![
            evidence("multiplications, written out", printed[0], Some(5)),
            evidence("additions, written out", printed[1], Some(2)),
            evidence("multiplications, Horner's rule", nested[0], None),
            evidence("additions, Horner's rule", nested[1], None),
        ],
    }]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_expressions_are_the_cubic() {
        for x in [-2.0, 0.0, 0.5, 1.0, 3.0] {
            let expected = 4.0 * f64::powi(x, 3) - 3.0 * x * x + 2.0 * x;
            assert_eq!((written_out([4.0, -3.0, 2.0], x), horner([4.0, -3.0, 2.0], x)), (expected, expected));
        }
    }

    #[test]
    fn what_is_done_is_counted() {
        assert_eq!(count(|[a, b, _], x| a * x + b), [1, 1]);
        assert_eq!((count(|k, x| written_out(k, x)), count(|k, x| horner(k, x))), ([5, 2], [3, 2]));
    }
}
