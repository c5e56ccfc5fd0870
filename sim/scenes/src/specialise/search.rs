//! The greatest and the least x of many places, by bounds: the part of them with the worst bound is cut until that
//! bound is near an x that is presented.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use bounds::interval::Interval;

/// Bounds end this near to an x that is presented.
const NEAR: f64 = 1.0 / 16384.0;

/// The most parts that are cut for one end.
const MOST_PARTS: usize = 1 << 15;

/// Places of the picture, and what they present.
pub(super) trait Places {
    /// Some of the places.
    type Part;
    /// All of the places; none where there are none.
    fn whole(&self) -> Option<Self::Part>;
    /// An interval that holds x of every place of a part; none where no place is lit and seen.
    fn bound(&self, part: &Self::Part) -> Option<Interval>;
    /// x of one place of the part, in f64; none where that place is not lit or not seen.
    fn sample(&self, part: &Self::Part) -> Option<f64>;
    /// Parts that have all places of this one; none where it cannot be cut.
    fn cut(&self, part: &Self::Part) -> Option<Vec<Self::Part>>;
    /// How often a part was cut. Of parts with the same bound the one that was cut most is cut next.
    fn depth(&self, _part: &Self::Part) -> u32 {
        0
    }
}

/// A part, and what it may be worth.
struct Open<P> {
    part: P,
    depth: u32,
    /// No place of it is worth more: x, or −x where the least is looked for.
    worth: f64,
}

impl<P> PartialEq for Open<P> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}
impl<P> Eq for Open<P> {}
impl<P> PartialOrd for Open<P> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl<P> Ord for Open<P> {
    fn cmp(&self, other: &Self) -> Ordering {
        self.worth.total_cmp(&other.worth).then(self.depth.cmp(&other.depth))
    }
}

/// A bound of the greatest x, or of the least; none where no place is lit and seen.
pub(super) fn end<P: Places>(places: &P, greatest: bool) -> Option<f64> {
    let sign = if greatest { 1.0 } else { -1.0 };
    let opened = |part: P::Part| {
        let x = places.bound(&part)?;
        let worth = if greatest { x.high() } else { -x.low() };
        Some(Open { depth: places.depth(&part), part, worth })
    };
    let mut open = BinaryHeap::new();
    open.push(opened(places.whole()?)?);
    let mut best = f64::NEG_INFINITY;
    for _ in 0..MOST_PARTS {
        let Open { part, worth, .. } = open.peek()?;
        best = best.max(places.sample(part).map_or(f64::NEG_INFINITY, |x| sign * x));
        // x below 0 is not asked for: there is nothing beyond either end.
        let last = if greatest { 1.0 } else { 0.0 };
        if *worth <= best + NEAR || (*worth == last && best >= last - NEAR) {
            break;
        }
        let Some(parts) = places.cut(part) else { break };
        open.pop();
        open.extend(parts.into_iter().filter_map(&opened));
    }
    open.peek().map(|open| sign * open.worth)
}
