//! Polygons into triangles.
//!
//! A polygon is seen along the normal of its mean plane (Newell's). Where the fan from its first corner fills it, the
//! fan is taken: convex polygons, and those that only turn in there. Every other one is cut by ear clipping. A corner
//! that lies on an edge stays a corner; one that repeats the corner before it does not.

use earcut::Earcut;

use super::vector::Vector;

/// The most corners of a polygon that a fan does not fill: finding edges that cross, and corners on sides, takes
/// their square at worst.
const MOST_CORNERS: usize = 4096;

/// What is left of rounding counts as no area: a height of less than a part in 10¹² of the longest side.
const LEAST_HEIGHT: f64 = 1e-12;

/// True where a triangle has a plane and a normal.
pub(crate) fn has_area(corners @ [a, b, c]: [Vector; 3]) -> bool {
    let longest = (b - a).length().max((c - b).length()).max((a - c).length());
    let area = plane_normal(corners).length();
    area > LEAST_HEIGHT * longest * longest && area > f64::MIN_POSITIVE
}

/// By the right-hand rule, with twice the area as its length.
pub(super) fn plane_normal([a, b, c]: [Vector; 3]) -> Vector {
    (b - a).cross(c - a)
}

/// The triangles of a polygon, as places in the list of its corners. A triangle without area shows nothing, and
/// exporters write some: it has none.
///
/// # Errors
/// Says why a polygon of more corners cannot be cut.
pub(super) fn triangles(corners: &[Vector]) -> Result<Vec<[usize; 3]>, String> {
    let places = distinct(corners);
    let at = |index: usize| corners.get(index).copied().unwrap_or_default();
    if let [a, b, c] = places[..] {
        return Ok(if has_area([a, b, c].map(at)) { vec![[a, b, c]] } else { Vec::new() });
    }
    if places.len() < 3 {
        return Ok(Vec::new());
    }
    let points: Vec<Vector> = places.iter().map(|&place| at(place)).collect();
    let triangles = match Flat::of(&points) {
        None => return Err(no_area()),
        Some(flat) if flat.is_filled_by_fan(&points) => flat.fan(),
        Some(flat) => flat.cut()?,
    };
    let named = |index: usize| places.get(index).copied().unwrap_or_default();
    Ok(triangles.into_iter().map(|triangle| triangle.map(named)).collect())
}

fn no_area() -> String {
    "this face has no area: its corners lie on one line, or its edges cross; \
     move a corner or leave the face out"
        .into()
}

/// The corners that do not repeat the one before them. The first stays.
fn distinct(corners: &[Vector]) -> Vec<usize> {
    let mut places: Vec<usize> = (0..corners.len()).collect();
    places.dedup_by_key(|place| corners.get(*place).map(|corner| corner.coordinates()));
    while places.len() > 1 && places.last().and_then(|&last| corners.get(last)) == corners.first() {
        places.pop();
    }
    places
}

type Point = [f64; 2];

/// Twice the area of a triangle, above 0 where it goes round to the left.
fn turn(a: Point, b: Point, c: Point) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// A polygon on its mean plane, going round to the left.
struct Flat {
    points: Vec<Point>,
    /// Twice the area of the polygon.
    area: f64,
    /// A turn below this is none.
    least: f64,
}

impl Flat {
    /// None where the polygon has no area. The greatest distance from the first corner says what rounding is.
    fn of(corners: &[Vector]) -> Option<Self> {
        let first = corners.first().copied().unwrap_or_default();
        let from_first: Vec<Vector> = corners.iter().map(|&corner| corner - first).collect();
        let pairs = from_first.iter().zip(from_first.iter().skip(1));
        let normal = pairs.fold(Vector::default(), |sum, (&one, &next)| sum + one.cross(next));
        let reach = from_first.iter().map(|corner| corner.length()).fold(0.0, f64::max);
        let least = LEAST_HEIGHT * reach * reach;
        let area = normal.length();
        if area.partial_cmp(&least) != Some(std::cmp::Ordering::Greater) {
            return None;
        }
        let normal = normal.unit()?;
        // Two directions in the plane, the first along the longest way from the first corner.
        let long = from_first.iter().copied().max_by(|a, b| a.length().total_cmp(&b.length()))?;
        let right = (long - normal * normal.dot(long)).unit()?;
        let up = normal.cross(right);
        let points = from_first.iter().map(|corner| [right.dot(*corner), up.dot(*corner)]).collect();
        Some(Self { points, area, least })
    }

    fn at(&self, index: usize) -> Point {
        self.points.get(index).copied().unwrap_or_default()
    }

    fn turn(&self, [a, b, c]: [usize; 3]) -> f64 {
        turn(self.at(a), self.at(b), self.at(c))
    }

    fn fan(&self) -> Vec<[usize; 3]> {
        (2..self.points.len()).map(|last| [0, last - 1, last]).collect()
    }

    /// True where the corners go round the first one to the left, by less than a full turn.
    fn is_filled_by_fan(&self, corners: &[Vector]) -> bool {
        let mut beyond_half = false;
        self.fan().into_iter().all(|triangle @ [_, _, last]| {
            let from_first = self.turn([0, 1, last]);
            beyond_half |= from_first < 0.0;
            let corners = triangle.map(|index| corners.get(index).copied().unwrap_or_default());
            self.turn(triangle) > 0.0 && has_area(corners) && !(beyond_half && from_first > 0.0)
        })
    }

    /// Cuts the polygon into triangles by ear clipping.
    fn cut(&self) -> Result<Vec<[usize; 3]>, String> {
        let count = self.points.len();
        if count > MOST_CORNERS {
            return Err(format!(
                "this face has {count} corners and turns in; cut it into faces of at most {MOST_CORNERS}"
            ));
        }
        if let Some([a, b]) = self.crossing() {
            let (a, b) = (a + 1, b + 1);
            return Err(format!(
                "edges of this face cross: those that begin at its corners {a} and {b}; \
                 put the corners in order, or cut the face in two"
            ));
        }
        let bends = self.bends();
        let points = bends.iter().map(|&index| self.at(index));
        let mut found: Vec<usize> = Vec::new();
        Earcut::new().earcut(points, &[], &mut found);
        let mut triangles = Vec::with_capacity(count);
        for three in found.as_chunks::<3>().0 {
            let mut triangle = three.map(|index| bends.get(index).copied().unwrap_or_default());
            // In the order of the polygon they go round as it does.
            triangle.sort_unstable();
            if self.turn(triangle).abs() > self.least {
                triangles.push(triangle);
            }
        }
        if triangles.len() + 2 < count {
            triangles = self.split_at_corners(triangles);
        }
        let filled: f64 = triangles.iter().map(|&triangle| self.turn(triangle)).sum();
        let all_left = triangles.iter().all(|&triangle| self.turn(triangle) > 0.0);
        if all_left && (filled - self.area).abs() <= 1e-9 * self.area {
            return Ok(triangles);
        }
        let said = "this face cannot be cut into triangles: its edges touch or overlap; cut it in two";
        Err(said.into())
    }

    /// The corners at which the polygon bends; the others lie on a line between two of these.
    fn bends(&self) -> Vec<usize> {
        let count = self.points.len();
        let mut bends: Vec<usize> = Vec::with_capacity(count);
        for index in 0..count {
            let before = bends.last().copied().unwrap_or(count - 1);
            if self.turn([before, index, (index + 1) % count]).abs() > self.least {
                bends.push(index);
            }
        }
        bends
    }

    /// A corner that lies on a side of a triangle cuts it there, so that no corner stands beside a longer side.
    fn split_at_corners(&self, mut open: Vec<[usize; 3]>) -> Vec<[usize; 3]> {
        let mut done = Vec::with_capacity(self.points.len());
        open.reverse();
        while let Some(triangle @ [a, b, c]) = open.pop() {
            let sides = [[a, b, c], [b, c, a], [c, a, b]];
            let cut = sides.into_iter().find_map(|side| Some((side, self.on_side(side)?)));
            match cut {
                // A polygon has two triangles less than corners: more of them are none that are looked for.
                Some(([from, to, opposite], corner)) if done.len() < self.points.len() => {
                    open.push([corner, to, opposite]);
                    open.push([from, corner, opposite]);
                }
                _ => done.push(triangle),
            }
        }
        done
    }

    /// A corner between the ends of the first side of a triangle.
    fn on_side(&self, [from, to, _]: [usize; 3]) -> Option<usize> {
        let (start, end) = (self.at(from), self.at(to));
        let along = [end[0] - start[0], end[1] - start[1]];
        let whole = along[0] * along[0] + along[1] * along[1];
        self.points.iter().position(|point| {
            let part = along[0] * (point[0] - start[0]) + along[1] * (point[1] - start[1]);
            (1e-9..=1.0 - 1e-9).contains(&(part / whole)) && turn(start, end, *point).abs() <= self.least
        })
    }

    /// Two edges that cross, by their first corners. Edges may touch: an outline that walks to a hole and back does.
    fn crossing(&self) -> Option<[usize; 2]> {
        let count = self.points.len();
        let ends = |index: usize| [self.at(index), self.at((index + 1) % count)];
        let span = |index: usize, axis: usize| {
            let [one, other] = ends(index).map(|point| point[axis]);
            (one.min(other), one.max(other))
        };
        let mut order: Vec<usize> = (0..count).collect();
        order.sort_by(|&a, &b| span(a, 0).0.total_cmp(&span(b, 0).0));
        for (place, &one) in order.iter().enumerate() {
            let (end, (low, high)) = (span(one, 0).1, span(one, 1));
            let later = order.iter().skip(place + 1).take_while(|&&other| span(other, 0).0 <= end);
            for &other in later {
                let (other_low, other_high) = span(other, 1);
                if other_low <= high && low <= other_high && self.cross(ends(one), ends(other)) {
                    return Some([one.min(other), one.max(other)]);
                }
            }
        }
        None
    }

    fn cross(&self, [a, b]: [Point; 2], [c, d]: [Point; 2]) -> bool {
        let sides =
            |one: f64, other: f64| one.abs() > self.least && other.abs() > self.least && (one > 0.0) != (other > 0.0);
        sides(turn(a, b, c), turn(a, b, d)) && sides(turn(c, d, a), turn(c, d, b))
    }
}
