//! From which integer exponent on a claim fails.

use rayon::prelude::*;

use super::claim::ClaimsError;

/// The greatest exponent that is looked at. What depends on h = 1/n has come to its limit there, to nine
/// digits.
pub const GREATEST: u64 = 1_000_000_000;

/// Every exponent up to this one is computed, beside those that the bisection asks for.
pub const EXAMINED: u64 = 1024;

/// Where a claim that holds at first fails from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Boundary {
    /// It holds for every n.
    Always,
    /// It fails for every n.
    Never,
    /// It holds up to this n, and fails from the next one on.
    HoldsTo(u64),
}

impl Boundary {
    const fn holds(self, n: u64) -> bool {
        match self {
            Self::Always => true,
            Self::Never => false,
            Self::HoldsTo(last) => n <= last,
        }
    }
}

/// Bisects over 1..=[`GREATEST`], and holds the answer against every exponent of [`examined`].
pub(super) fn boundary(claim: &'static str, holds: impl Fn(u64) -> bool + Sync) -> Result<Boundary, ClaimsError> {
    let found = match (holds(1), holds(GREATEST)) {
        (true, true) => Boundary::Always,
        (false, _) => Boundary::Never,
        (true, false) => Boundary::HoldsTo(bisect(&holds)),
    };
    match examined().into_par_iter().find_first(|&n| holds(n) != found.holds(n)) {
        Some(n) => Err(ClaimsError::NotMonotone { claim, n, expected: found.holds(n) }),
        None => Ok(found),
    }
}

/// Every integer up to [`EXAMINED`], powers of two above, and [`GREATEST`].
pub(super) fn examined() -> Vec<u64> {
    let powers = (0..u64::BITS).map(|bits| 1 << bits).filter(|n| (EXAMINED + 1..GREATEST).contains(n));
    (1..=EXAMINED).chain(powers).chain([GREATEST]).collect()
}

/// The last n for which a claim holds that holds at 1 and fails at [`GREATEST`].
fn bisect(holds: impl Fn(u64) -> bool) -> u64 {
    let (mut last, mut first) = (1, GREATEST);
    while first - last > 1 {
        let middle = last + (first - last) / 2;
        if holds(middle) {
            last = middle;
        } else {
            first = middle;
        }
    }
    last
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn what_never_changes_is_seen_as_that() {
        assert_eq!(boundary("always", |_| true), Ok(Boundary::Always));
        assert_eq!(boundary("never", |_| false), Ok(Boundary::Never));
    }

    #[test]
    fn a_claim_that_comes_back_is_refused() {
        let hole = boundary("hole", |n| n != 700);
        assert_eq!(hole, Err(ClaimsError::NotMonotone { claim: "hole", n: 700, expected: true }));
        assert!(hole.unwrap_err().to_string().contains("it holds at n = 700"));
        assert!(boundary("late", |n| n < 10 || n == 1 << 20).is_err());
    }

    proptest! {
        #[test]
        fn the_last_is_found(last in 1..GREATEST) {
            prop_assert_eq!(boundary("some", |n| n <= last), Ok(Boundary::HoldsTo(last)));
        }
    }
}
