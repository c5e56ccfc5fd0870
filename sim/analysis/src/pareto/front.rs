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
    let dominated = |point: &[f64; AXES]| points.iter().any(|other| dominates(other, point));
    let front: Vec<usize> = (0..points.len()).filter(|&place| !dominated(&points[place])).collect();
    points
        .iter()
        .map(|point| {
            let above = front.iter().copied().filter(|&place| dominates(&points[place], point));
            above.min_by(|&a, &b| last(&points[a]).total_cmp(&last(&points[b])))
        })
        .collect()
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
