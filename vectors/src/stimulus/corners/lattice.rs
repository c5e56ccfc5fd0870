//! Where the searches look, and how they come closer.

use std::ops::RangeInclusive;

/// The multiples of 2^k in `range`, with the least k that leaves at most `most` of them, and the two
/// ends; increasing. A range of at most `most` points is taken whole.
///
/// Multiples of a power of two, because a product of one has zeros at its low end: what a stage
/// drops is then likely to be a tie exactly, not only nearly.
#[derive(Debug, Clone)]
pub struct Lattice {
    /// The points, as bits of x.
    pub points: Vec<i64>,
    /// The distance between neighbouring points: 2^k.
    pub step: i64,
}

impl Lattice {
    pub fn new(range: &RangeInclusive<i64>, most: i64) -> Self {
        let (low, high) = (*range.start(), *range.end());
        let mut step = 1;
        while (high - low) / step >= most {
            step *= 2;
        }
        let mut points = vec![low];
        let mut next = (low / step + 1) * step;
        while next < high {
            points.push(next);
            next += step;
        }
        if high > low {
            points.push(high);
        }
        Self { points, step }
    }
}

/// The x of `range` that are a power of two away from 0 or from `greatest`.
///
/// A coefficient that itself ends in many zeros (B = 2(n − 1) of the tail is an integer) makes a tie
/// only of an x that ends in few, and a lattice has none of those.
pub fn powers_apart(range: &RangeInclusive<i64>, greatest: i64) -> impl Iterator<Item = i64> {
    (0..i64::BITS - 1)
        .map(|place| 1_i64 << place)
        .take_while(move |&power| power <= greatest)
        .flat_map(move |power| [power, greatest - power])
        .filter(|x| range.contains(x))
}

/// From `x`, in steps that halve from `step` to 1, to the x of `range` with the greatest score that
/// can be reached uphill. On a curve with one summit between two lattice points that is the summit.
pub fn climb<S: PartialOrd>(x: i64, step: i64, range: &RangeInclusive<i64>, score: impl Fn(i64) -> S) -> i64 {
    let mut best = (score(x), x);
    let mut step = step / 2;
    while step > 0 {
        for candidate in [best.1 - step, best.1 + step] {
            if range.contains(&candidate) {
                let reached = score(candidate);
                if reached > best.0 {
                    best = (reached, candidate);
                }
            }
        }
        step /= 2;
    }
    best.1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_small_range_is_taken_whole_and_a_large_one_thinned() {
        assert_eq!(Lattice::new(&(5..=9), 5).points, [5, 6, 7, 8, 9]);
        assert_eq!(Lattice::new(&(5..=5), 4).points, [5]);
        let thin = Lattice::new(&(5..=1000), 16);
        assert_eq!(thin.step, 64);
        assert_eq!(thin.points.first(), Some(&5));
        assert_eq!(thin.points.last(), Some(&1000));
        assert!(thin.points[1..thin.points.len() - 1].iter().all(|x| x % 64 == 0));
        assert_eq!(thin.points.len(), 17);
    }

    #[test]
    fn climbing_finds_the_summit() {
        for summit in [0, 1, 77, 333, 1000] {
            let found = climb(512, 1024, &(0..=1000), |x| -(x - summit).abs());
            assert_eq!(found, summit);
        }
    }
}
