//! Where the names of points go, so that none covers another, a point or a line, and none leaves the area.
//!
//! Each name tries places around its point, near ones first, and takes the one that costs least while the
//! others stay where they are; a few rounds of that settle. Names far off get a line to their point.

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

    fn overlap(&self, other: &Self) -> f64 {
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

    /// The point of the frame that is nearest to a place.
    pub(super) fn nearest(&self, (x, y): Place) -> Place {
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

/// Half the side of a point's frame.
const POINT: f64 = 5.0;
/// How far from its point a name may begin.
const DISTANCES: [f64; 9] = [5.0, 8.0, 12.0, 18.0, 26.0, 36.0, 48.0, 62.0, 80.0];
/// Directions that are tried at each distance.
const DIRECTIONS: u32 = 24;
/// Beyond this a name needs a line to its point.
pub(super) const NEAR: f64 = 9.0;
const ROUNDS: usize = 6;

/// A frame for each name. `points` are all points, `lines` the corners of lines not to be covered.
pub(super) fn place(
    wanted: &[Wanted],
    points: &[Place],
    lines: &[Vec<Place>],
    area: &Frame,
) -> Vec<Frame> {
    let obstacles: Vec<Frame> =
        points.iter().map(|&point| Frame::around(point, (POINT, POINT))).collect();
    let dense: Vec<Place> = lines.iter().flat_map(|line| sampled(line)).collect();
    let mut frames: Vec<Option<Frame>> = vec![None; wanted.len()];
    for _ in 0..ROUNDS {
        for (index, name) in wanted.iter().enumerate() {
            let others: Vec<(Frame, Place)> = frames
                .iter()
                .enumerate()
                .filter(|(other, _)| *other != index)
                .filter_map(|(other, frame)| Some(((*frame)?, wanted[other].at)))
                .collect();
            let cost = |frame: &Frame| {
                let leader = sampled(&[name.at, frame.nearest(name.at)]);
                // Where there is a choice, level with its point.
                let mut cost = distance(name.at, frame.nearest(name.at))
                    + 0.15 * (frame.centre().1 - name.at.1).abs();
                for (other, at) in &others {
                    cost += 40.0 * frame.overlap(other);
                    // Lines to points may not run through names.
                    cost += 60.0 * leader.iter().filter(|&&place| other.has(place)).count() as f64;
                    let theirs = sampled(&[*at, other.nearest(*at)]);
                    cost += 60.0 * theirs.iter().filter(|&&place| frame.has(place)).count() as f64;
                }
                for obstacle in &obstacles {
                    cost += 20.0 * frame.overlap(obstacle);
                    let through = leader.iter().skip(3).filter(|&&place| obstacle.has(place));
                    if obstacle.centre() != name.at {
                        cost += 12.0 * through.count() as f64;
                    }
                }
                cost + 60.0 * dense.iter().filter(|&&place| frame.has(place)).count() as f64
            };
            let tried = candidates(name).filter(|frame| frame.within(area));
            frames[index] = tried
                .map(|frame| (cost(&frame), frame))
                .min_by(|a, b| a.0.total_cmp(&b.0))
                .map(|(_, frame)| frame);
        }
    }
    let beside = |name: &Wanted| Frame::around(name.at, (name.size.0 / 2.0, name.size.1 / 2.0));
    frames.iter().zip(wanted).map(|(frame, name)| frame.unwrap_or_else(|| beside(name))).collect()
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

fn distance(a: Place, b: Place) -> f64 {
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
        let points: Vec<Place> = (0..16)
            .map(|i| (150.0 + 12.0 * f64::from(i % 4), 100.0 + 14.0 * f64::from(i / 4)))
            .collect();
        let wanted: Vec<Wanted> =
            points.iter().map(|&at| Wanted { at, size: (55.0, 12.0) }).collect();
        let frames = place(&wanted, &points, &[vec![(0.0, 150.0), (500.0, 150.0)]], &area);
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
        let level = (frames[0].centre().1 - 100.0).abs() < 4.0;
        assert!(frames[0].low.0 > 100.0 && level, "{frames:?}");
        // At the right border it moves to the left.
        let wanted = [Wanted { at: (495.0, 100.0), size: (50.0, 12.0) }];
        let frames = place(&wanted, &[(495.0, 100.0)], &[], &area);
        assert!(frames[0].within(&area), "{frames:?}");
    }
}
