//! The non-dominated set of points whose every coordinate is better when it is less.

/// True when `a` is nowhere worse than `b` and somewhere better. Points that are equal do not dominate
/// one another, and a coordinate that is not a number is neither better nor worse.
#[must_use]
pub(crate) fn dominates<const AXES: usize>(a: &[f64; AXES], b: &[f64; AXES]) -> bool {
    a.iter().zip(b).all(|(a, b)| a <= b) && a.iter().zip(b).any(|(a, b)| a < b)
}

/// For each point nothing, if no other dominates it, else the place of one that does.
///
/// The one that is named is itself on the front: of those that dominate, the one whose last coordinate
/// is least, the first of them where there are several. (There always is one: domination is transitive
/// and never goes round, so that climbing from dominator to dominator ends.)
#[must_use]
pub(crate) fn dominators<const AXES: usize>(points: &[[f64; AXES]]) -> Vec<Option<usize>> {
    named(points.len(), |a, b| dominates(&points[a], &points[b]), |place| last(&points[place]))
}

/// The same for points of a time, which is known within a spread, and an error. One dominates another where it is
/// quicker beyond the spread of both and its error no greater, or where the spreads overlap and its error is less.
///
/// An overlap is not transitive. So the one that is named is on the front where one of those is above, and otherwise
/// the one with the least error. (There is no way round: along it errors fall, and where they are equal spreads move
/// apart.)
#[must_use]
pub(crate) fn dominators_in_time(points: &[Timed]) -> Vec<Option<usize>> {
    named(points.len(), |a, b| points[a].dominates(&points[b]), |place| points[place].error)
}

/// A time with its spread, and an error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Timed {
    /// The quartiles of the time.
    pub quartiles: [f64; 2],
    pub error: f64,
}

impl Timed {
    fn dominates(&self, other: &Self) -> bool {
        if overlap(self.quartiles, other.quartiles) {
            return self.error < other.error;
        }
        self.quartiles[1] < other.quartiles[0] && self.error <= other.error
    }
}

/// Whether two times are the same as far as their quartiles tell.
#[must_use]
pub(crate) fn overlap(one: [f64; 2], other: [f64; 2]) -> bool {
    one[0] <= other[1] && other[0] <= one[1]
}

/// For each place one that dominates it, of those on the front if there is one; the one whose `key` is least.
fn named(count: usize, dominates: impl Fn(usize, usize) -> bool, key: impl Fn(usize) -> f64) -> Vec<Option<usize>> {
    let all = || 0..count;
    let front: Vec<bool> = all().map(|place| !all().any(|other| dominates(other, place))).collect();
    let one = |place: usize| {
        let above = all().filter(|&other| dominates(other, place));
        above.min_by(|&a, &b| front[b].cmp(&front[a]).then_with(|| key(a).total_cmp(&key(b))))
    };
    all().map(one).collect()
}

fn last<const AXES: usize>(point: &[f64; AXES]) -> f64 {
    point.last().copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_front_that_is_known() {
        let points = [[1.0, 9.0], [3.0, 3.0], [3.0, 4.0], [9.0, 1.0], [9.0, 9.0], [3.0, 3.0]];
        // Equal points stay; (3, 4) is beaten by (3, 3), (9, 9) most clearly by (9, 1).
        assert_eq!(dominators(&points), [None, None, Some(1), None, Some(3), None]);
        assert_eq!(dominators::<2>(&[]), []);
        assert_eq!(dominators(&[[1.0]]), [None]);
    }

    #[test]
    fn what_is_no_number_stays_by_itself() {
        assert_eq!(dominators(&[[f64::NAN, 1.0], [0.0, 0.0], [1.0, 1.0]]), [None, None, Some(1)]);
    }

    #[test]
    fn times_within_the_spread_are_told_apart_by_the_error() {
        let timed = |low, high, error| Timed { quartiles: [low, high], error };
        let points = [
            timed(0.2199, 0.2200, 88e-6),
            timed(0.2200, 0.2201, 1e-6),
            timed(0.1, 0.2, 1e-3),
            timed(0.3, 0.4, 1e-6),
            timed(0.35, 0.5, 1e-6),
        ];
        // The first is no quicker than the second, and less exact; the fourth is slower, and ties with the fifth.
        assert_eq!(dominators_in_time(&points), [Some(1), None, None, Some(1), Some(1)]);
        // Overlaps of a chain: the second of three is above the third, the first above the second alone.
        let chain = [timed(1.0, 2.0, 1.0), timed(1.5, 3.0, 2.0), timed(2.5, 4.0, 3.0)];
        assert_eq!(dominators_in_time(&chain), [None, Some(0), Some(0)]);
        let chain = [timed(2.5, 4.0, 1.0), timed(1.5, 3.0, 2.0), timed(1.0, 2.0, 3.0)];
        assert_eq!(dominators_in_time(&chain), [None, Some(0), Some(1)]);
    }

    fn points() -> impl Strategy<Value = Vec<[f64; 3]>> {
        // Few values, so that ties are common.
        prop::collection::vec(prop::array::uniform3((0_u8..5).prop_map(f64::from)), 0..24)
    }

    proptest! {
        #[test]
        fn whoever_is_named_dominates_and_is_not_dominated(points in points()) {
            let found = dominators(&points);
            for (place, dominator) in found.iter().enumerate() {
                match dominator {
                    Some(by) => {
                        prop_assert!(dominates(&points[*by], &points[place]));
                        prop_assert_eq!(found[*by], None);
                    }
                    None => prop_assert!(!points.iter().any(|p| dominates(p, &points[place]))),
                }
            }
            // The front is never empty.
            prop_assert!(points.is_empty() || found.contains(&None));
        }

        #[test]
        fn the_order_does_not_matter(points in points()) {
            let turned: Vec<_> = points.iter().rev().copied().collect();
            let on = |points: &[[f64; 3]]| -> Vec<bool> {
                dominators(points).iter().map(Option::is_none).collect()
            };
            let mut back = on(&turned);
            back.reverse();
            prop_assert_eq!(on(&points), back);
        }
    }
}
