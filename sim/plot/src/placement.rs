//! Where the names of points go, so that none covers another, a point or a line, and none leaves the area.
//!
//! Each name tries places around its point, near ones first, and takes the one that costs least while the
//! others stay where they are; a few rounds of that settle. Names far off, or near other points as well, get a
//! line to their point.

/// A place in SVG units, y downwards.
pub(super) type Place = (f64, f64);

/// A rectangle, by its corners.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Frame {
    pub(super) low: Place,
    pub(super) high: Place,
}

impl Frame {
    pub(super) fn around((x, y): Place, half: Place) -> Self {
        Self { low: (x - half.0, y - half.1), high: (x + half.0, y + half.1) }
    }

    pub(super) fn overlap(&self, other: &Self) -> f64 {
        let side = |low: f64, high: f64| (high - low).max(0.0);
        side(self.low.0.max(other.low.0), self.high.0.min(other.high.0))
            * side(self.low.1.max(other.low.1), self.high.1.min(other.high.1))
    }

    fn has(&self, (x, y): Place) -> bool {
        (self.low.0..=self.high.0).contains(&x) && (self.low.1..=self.high.1).contains(&y)
    }

    fn within(&self, area: &Self) -> bool {
        area.has(self.low) && area.has(self.high)
    }

    fn centre(&self) -> Place {
        ((self.low.0 + self.high.0) / 2.0, (self.low.1 + self.high.1) / 2.0)
    }

    fn grown(&self, by: f64) -> Self {
        let (low, high) = (self.low, self.high);
        Self { low: (low.0 - by, low.1 - by), high: (high.0 + by, high.1 + by) }
    }

    /// From a place to the nearest of the frame.
    fn distance(&self, place: Place) -> f64 {
        distance(place, self.nearest(place))
    }

    /// Where a line from a place ends. The widths of words are upper bounds: a name above or below its point
    /// stands in the middle of its frame, and is narrower.
    pub(super) fn end(&self, place: Place) -> Place {
        let (x, y) = self.nearest(place);
        if x != place.0 {
            return (x, y);
        }
        let spare = 0.15 * (self.high.0 - self.low.0);
        (x.clamp(self.low.0 + spare, self.high.0 - spare), y)
    }

    /// The point of the frame that is nearest to a place.
    fn nearest(&self, (x, y): Place) -> Place {
        (x.clamp(self.low.0, self.high.0), y.clamp(self.low.1, self.high.1))
    }
}

/// A name that wants a place.
pub(super) struct Wanted {
    /// Its point.
    pub(super) at: Place,
    /// Its width and height.
    pub(super) size: Place,
}

/// Where a name goes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Placed {
    pub(super) frame: Frame,
    /// It is not plain whose name it is without a line to its point.
    pub(super) leader: bool,
}

/// Half the side of a point's frame, its rim included.
const POINT: f64 = 6.5;
/// How far from its point a name may begin.
const DISTANCES: [f64; 9] = [4.0, 8.0, 12.0, 18.0, 26.0, 36.0, 48.0, 62.0, 80.0];
/// Directions that are tried at each distance.
const DIRECTIONS: u32 = 24;
/// Beyond this a name needs a line to its point.
const NEAR: f64 = 13.0;
/// A name by its point without a line is nearer to it than to any other by this.
const NEARER: f64 = 6.0;
/// A shorter line to a point is hardly seen.
const SHORTEST: f64 = 17.0;
/// Between a name and a line that is not to be covered.
const CLEARANCE: f64 = 3.0;
/// Points that are nearer to each other than this are one to the eye.
pub(super) const ONE: f64 = 2.5;
const ROUNDS: usize = 5;
/// Orders that are tried.
const STARTS: usize = 8;

/// A frame for each name. `points` are all points, `lines` the corners of lines not to be covered.
pub(super) fn place(wanted: &[Wanted], points: &[Place], lines: &[Vec<Place>], area: &Frame) -> Vec<Placed> {
    let scenery = Scenery { points, dense: lines.iter().flat_map(|line| sampled(line)).collect() };
    // Who comes first has the best place, and the rest must do with that: others first may be better for all.
    let starts = (0..STARTS.min(wanted.len())).map(|start| start * wanted.len() / STARTS);
    let settled = starts.map(|first| scenery.settle(wanted, first, area));
    let frames = settled.min_by(|a, b| a.0.total_cmp(&b.0)).map_or_else(Vec::new, |best| best.1);
    let beside = |name: &Wanted| Frame::around(name.at, (name.size.0 / 2.0, name.size.1 / 2.0));
    let placed = |(frame, name): (&Option<Frame>, &Wanted)| {
        let frame = frame.unwrap_or_else(|| beside(name));
        Placed { frame, leader: scenery.needs_leader(&frame, name.at) }
    };
    frames.iter().zip(wanted).map(placed).collect()
}

/// What does not move.
struct Scenery<'a> {
    points: &'a [Place],
    /// Places along the lines.
    dense: Vec<Place>,
}

impl Scenery<'_> {
    /// Frames that none would leave by itself, and what they cost; the name at `first` chooses first.
    fn settle(&self, wanted: &[Wanted], first: usize, area: &Frame) -> (f64, Vec<Option<Frame>>) {
        let mut frames: Vec<Option<Frame>> = vec![None; wanted.len()];
        for _ in 0..ROUNDS {
            for index in (first..wanted.len()).chain(0..first) {
                let name = &wanted[index];
                let others = all_but(index, wanted, &frames);
                let cost = |frame: &Frame| self.cost(frame, name.at) + among(frame, name.at, &others);
                frames[index] = candidates(name)
                    .filter(|frame| frame.within(area))
                    .map(|frame| (cost(&frame), frame))
                    .min_by(|a, b| a.0.total_cmp(&b.0))
                    .map(|(_, frame)| frame);
            }
        }
        let costs = frames.iter().enumerate().map(|(index, frame)| {
            let (at, others) = (wanted[index].at, all_but(index, wanted, &frames));
            frame.map_or(0.0, |frame| self.cost(&frame, at) + among(&frame, at, &others))
        });
        (costs.sum(), frames)
    }

    fn needs_leader(&self, frame: &Frame, at: Place) -> bool {
        let own = frame.distance(at);
        let another = |point: Place| distance(point, at) > ONE;
        own > NEAR || self.points.iter().any(|&p| another(p) && frame.distance(p) < own + NEARER)
    }

    /// Of a frame for the name of the point `at`, whatever the other names do.
    fn cost(&self, frame: &Frame, at: Place) -> f64 {
        let own = frame.distance(at);
        // Where there is a choice, level with its point.
        let mut cost = own + 0.15 * (frame.centre().1 - at.1).abs();
        let leader = self.needs_leader(frame, at).then(|| sampled(&[at, frame.end(at)]));
        if leader.is_some() {
            cost += if own < SHORTEST { 40.0 } else { 8.0 };
        }
        for &point in self.points {
            let obstacle = Frame::around(point, (POINT, POINT));
            cost += 20.0 * frame.overlap(&obstacle);
            let apart = distance(point, at);
            if apart > ONE {
                // No line to a point can keep clear of one that lies over it.
                let weight = if apart < 2.0 * POINT { 2.0 } else { 12.0 };
                cost += weight * count(leader.iter().flatten(), &obstacle);
            }
        }
        cost + 60.0 * count(&self.dense, &frame.grown(CLEARANCE))
    }
}

/// The frames of the others, each with its point.
fn all_but(index: usize, wanted: &[Wanted], frames: &[Option<Frame>]) -> Vec<(Frame, Place)> {
    let placed = frames.iter().zip(wanted).enumerate().filter(|(other, _)| *other != index);
    placed.filter_map(|(_, (frame, name))| Some(((*frame)?, name.at))).collect()
}

/// What a frame costs beside other names, each with its point.
fn among(frame: &Frame, at: Place, others: &[(Frame, Place)]) -> f64 {
    let end = frame.end(at);
    let leader = sampled(&[at, end]);
    let mut cost = 0.0;
    for &(other, point) in others {
        cost += 40.0 * frame.overlap(&other);
        // Lines to points may not run through names, nor through each other.
        let their_end = other.end(point);
        cost += 60.0 * count(&leader, &other.grown(CLEARANCE));
        cost += 60.0 * count(&sampled(&[point, their_end]), &frame.grown(CLEARANCE));
        if cross((at, end), (point, their_end)) {
            cost += 80.0;
        }
    }
    cost
}

fn count<'a>(places: impl IntoIterator<Item = &'a Place>, frame: &Frame) -> f64 {
    places.into_iter().filter(|&&place| frame.has(place)).count() as f64
}

/// The ends of each lie on both sides of the other.
fn cross(one: (Place, Place), other: (Place, Place)) -> bool {
    let side = |(a, b): (Place, Place), p: Place| (b.0 - a.0) * (p.1 - a.1) - (b.1 - a.1) * (p.0 - a.0);
    side(one, other.0) * side(one, other.1) < 0.0 && side(other, one.0) * side(other, one.1) < 0.0
}

fn candidates(name: &Wanted) -> impl Iterator<Item = Frame> + '_ {
    let half = (name.size.0 / 2.0, name.size.1 / 2.0);
    DISTANCES.into_iter().flat_map(move |distance| {
        (0..DIRECTIONS).map(move |step| {
            // To the right first.
            let angle = f64::from(step) / f64::from(DIRECTIONS) * std::f64::consts::TAU;
            let (cos, sin) = (angle.cos(), angle.sin());
            let reach = POINT + distance;
            let stretch = |part: f64| part.clamp(-0.4, 0.4) / 0.4;
            let x = name.at.0 + cos * reach + stretch(cos) * half.0;
            let y = name.at.1 - sin * reach - stretch(sin) * half.1;
            Frame::around((x, y), half)
        })
    })
}

pub(super) fn distance(a: Place, b: Place) -> f64 {
    (a.0 - b.0).hypot(a.1 - b.1)
}

/// Places along a line, a few units apart.
fn sampled(line: &[Place]) -> Vec<Place> {
    let mut places = Vec::new();
    for ends in line.windows(2) {
        let (from, to) = (ends[0], ends[1]);
        let steps = (distance(from, to) / 3.0).ceil().max(1.0) as u32;
        places.extend((0..=steps).map(|step| {
            let part = f64::from(step) / f64::from(steps);
            (from.0 + part * (to.0 - from.0), from.1 + part * (to.1 - from.1))
        }));
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_a_crowd_do_not_meet() {
        let area = Frame { low: (0.0, 0.0), high: (500.0, 300.0) };
        let points: Vec<Place> =
            (0..16).map(|i| (150.0 + 12.0 * f64::from(i % 4), 100.0 + 14.0 * f64::from(i / 4))).collect();
        let wanted: Vec<Wanted> = points.iter().map(|&at| Wanted { at, size: (55.0, 12.0) }).collect();
        let frames = place(&wanted, &points, &[vec![(0.0, 150.0), (500.0, 150.0)]], &area);
        let frames: Vec<Frame> = frames.iter().map(|placed| placed.frame).collect();
        for (index, frame) in frames.iter().enumerate() {
            assert!(frame.within(&area), "{frame:?}");
            for other in &frames[..index] {
                assert!(frame.overlap(other) == 0.0, "{frame:?} {other:?}");
            }
        }
    }

    #[test]
    fn a_name_by_itself_stands_at_its_right() {
        let area = Frame { low: (0.0, 0.0), high: (500.0, 300.0) };
        let wanted = [Wanted { at: (100.0, 100.0), size: (50.0, 12.0) }];
        let frames = place(&wanted, &[(100.0, 100.0)], &[], &area);
        let level = (frames[0].frame.centre().1 - 100.0).abs() < 4.0;
        assert!(frames[0].frame.low.0 > 100.0 && level, "{frames:?}");
        // At the right border it moves to the left.
        let wanted = [Wanted { at: (495.0, 100.0), size: (50.0, 12.0) }];
        let frames = place(&wanted, &[(495.0, 100.0)], &[], &area);
        assert!(frames[0].frame.within(&area), "{frames:?}");
    }

    #[test]
    fn a_name_that_could_be_another_points_has_a_line_to_its_own() {
        let area = Frame { low: (0.0, 0.0), high: (500.0, 300.0) };
        let named = |points: &[Place]| {
            let wanted: Vec<Wanted> = points.iter().map(|&at| Wanted { at, size: (50.0, 12.0) }).collect();
            place(&wanted, points, &[], &area)
        };
        assert!(named(&[(100.0, 100.0), (300.0, 100.0)]).iter().all(|placed| !placed.leader));
        let column: Vec<Place> = (0..6).map(|i| (100.0, 100.0 + 3.0 * f64::from(i))).collect();
        for (placed, at) in named(&column).iter().zip(&column) {
            let own = placed.frame.distance(*at);
            let nearer = column.iter().any(|p| p != at && placed.frame.distance(*p) < own);
            assert!(placed.leader || !nearer, "{placed:?}");
        }
    }
}
