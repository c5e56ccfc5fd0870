//! What a scene asks of the pipeline: for each exponent the interval of x, over every real place of the picture.
//!
//! For spheres and planes the greatest and the least x are bounded by tiles: the whole picture is one, its bound by
//! interval arithmetic is loose, and the tile with the worst bound is cut in two until that bound is near an x that
//! is presented. Whatever hides a surface is not looked at, which only widens the interval. A mesh presents
//! everything from 0 to 1, and so do places where this finds no better bound.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use super::space::Rays;
use super::tile;
use crate::render::{meet, presented, ray};
use crate::scene::{Light, Scene, Shape, Surface};
use bounds::interval::Interval;

/// Bounds end this near to an x that is presented.
const NEAR: f64 = 1.0 / 16384.0;

/// The most tiles that are cut for one surface, light and end.
const MOST_TILES: usize = 1 << 15;

/// Pictures are computed in f64, whose rounding may move an x out of the bounds of the real ones: far less than this
/// unless a ball is seen from some 10⁵ of its radii, and what does leave is found where pixels are held against the
/// bounds ([`super::pixels_outside`]).
const MARGIN: f64 = 1e-9;

/// What is asked with one exponent.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Demand {
    /// The exponent that is asked with.
    pub exponent: f64,
    /// No place presents less. 0 also stands for what faces away, which is not asked for.
    pub least: f64,
    /// No place presents more.
    pub greatest: f64,
    /// True where the interval is that of a mesh, about which nothing is known.
    pub mesh: bool,
}

/// What the scene asks, by rising exponent; exponents of which no place is lit and seen are left out.
#[must_use]
pub fn demands(scene: &Scene) -> Vec<Demand> {
    scene.exponents().into_iter().filter_map(|exponent| demand(scene, exponent)).collect()
}

fn demand(scene: &Scene, exponent: f64) -> Option<Demand> {
    let of_it = |surface: &&Surface| scene.materials[usize::from(surface.material)].exponent == exponent;
    let surfaces: Vec<&Surface> = scene.surfaces.iter().filter(of_it).collect();
    if surfaces.iter().any(|surface| matches!(surface.shape, Shape::Triangle(_))) {
        return Some(Demand { exponent, least: 0.0, greatest: 1.0, mesh: true });
    }
    let mut found: Option<(f64, f64)> = None;
    for surface in surfaces {
        for light in &scene.lights {
            let of = Presenting { scene, shape: &surface.shape, light };
            let Some(greatest) = of.end(true) else { continue };
            let least = of.end(false).unwrap_or(0.0);
            let (low, high) = found.unwrap_or((least, greatest));
            found = Some((low.min(least), high.max(greatest)));
        }
    }
    let (least, greatest) = found?;
    let (least, greatest) = ((least - MARGIN).max(0.0), (greatest + MARGIN).min(1.0));
    Some(Demand { exponent, least, greatest, mesh: false })
}

/// One surface in one light.
struct Presenting<'a> {
    scene: &'a Scene,
    shape: &'a Shape,
    light: &'a Light,
}

/// A part of the picture, in pixels from its upper left corner, and what may lie in it.
struct Tile {
    columns: Interval,
    rows: Interval,
    /// No place of it is worth more: x, or −x where the least is looked for.
    worth: f64,
}

impl PartialEq for Tile {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}
impl Eq for Tile {}
impl PartialOrd for Tile {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Tile {
    fn cmp(&self, other: &Self) -> Ordering {
        self.worth.total_cmp(&other.worth)
    }
}

impl Presenting<'_> {
    /// A bound of the greatest x, or of the least; none where no place is lit and seen.
    fn end(&self, greatest: bool) -> Option<f64> {
        let sign = if greatest { 1.0 } else { -1.0 };
        let image = &self.scene.image;
        let side = |side: u32| Interval::new(0.0, f64::from(side));
        let mut open = BinaryHeap::new();
        let whole = self.tile(side(image.width), side(image.height), sign)?;
        open.push(whole);
        let mut best = f64::NEG_INFINITY;
        for _ in 0..MOST_TILES {
            let tile = open.peek()?;
            best = best.max(sign * self.middle(tile).unwrap_or(f64::NEG_INFINITY * sign));
            // x below 0 is not asked for: there is nothing beyond either end.
            let last = if greatest { 1.0 } else { 0.0 };
            if tile.worth <= best + NEAR || (tile.worth == last && best >= last - NEAR) {
                break;
            }
            let Tile { columns, rows, .. } = open.pop()?;
            for (columns, rows) in halves(columns, rows) {
                open.extend(self.tile(columns, rows, sign));
            }
        }
        open.peek().map(|tile| sign * tile.worth)
    }

    fn tile(&self, columns: Interval, rows: Interval, sign: f64) -> Option<Tile> {
        let rays = Rays::new(&self.scene.view, &self.scene.image, columns, rows);
        let x = tile::presented(&rays, self.shape, self.scene.angle, self.light)?;
        let worth = if sign > 0.0 { x.high() } else { -x.low() };
        Some(Tile { columns, rows, worth })
    }

    /// x in the middle of a tile, where it shows the surface and the light.
    fn middle(&self, tile: &Tile) -> Option<f64> {
        let Scene { view, image, angle, .. } = self.scene;
        let ray = ray(view, image, tile.columns.middle(), tile.rows.middle());
        let hit = meet(&ray, self.shape, f64::INFINITY)?;
        let place = ray.origin + ray.direction * hit.distance;
        let found = presented(*angle, self.light, place, hit.normal, -ray.direction);
        (!found.faces_away()).then_some(found.x)
    }
}

/// Cut across the longer side.
fn halves(columns: Interval, rows: Interval) -> [(Interval, Interval); 2] {
    let cut = |side: Interval| {
        let middle = side.middle();
        [Interval::new(side.low(), middle), Interval::new(middle, side.high())]
    };
    if columns.high() - columns.low() >= rows.high() - rows.low() {
        cut(columns).map(|columns| (columns, rows))
    } else {
        cut(rows).map(|rows| (columns, rows))
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn scene(rest: &str) -> Scene {
        let text = format!(
            r#"{{"name": "s", "image": {{"width": 40, "height": 30}},
            "lights": [{{"directional": {{"towards": [1, 2, 2], "colour": [1, 1, 1]}}}},
                       {{"point": {{"position": [2, 3, 4], "colour": [1, 1, 1]}}}}],
            "materials": [{{"name": "a", "exponent": 5, "diffuse": [0, 0, 0], "specular": [1, 1, 1]}},
                          {{"name": "b", "exponent": 9, "diffuse": [0, 0, 0], "specular": [1, 1, 1]}}],
            {rest}}}"#
        );
        Scene::from_json(&text, &mut |_| Ok(String::new())).unwrap()
    }

    fn holds(scene: &Scene, demands: &[Demand], column: f64, row: f64) {
        let ray = ray(&scene.view, &scene.image, column, row);
        for surface in &scene.surfaces {
            let Some(hit) = meet(&ray, &surface.shape, f64::INFINITY) else { continue };
            let place = ray.origin + ray.direction * hit.distance;
            let exponent = scene.materials[usize::from(surface.material)].exponent;
            for light in &scene.lights {
                let found = presented(scene.angle, light, place, hit.normal, -ray.direction);
                if found.faces_away() {
                    continue;
                }
                let demand = demands.iter().find(|demand| demand.exponent == exponent).unwrap();
                let inside = demand.least <= found.x && found.x.min(1.0) <= demand.greatest;
                assert!(inside, "{demand:?} {found:?} at {column}, {row}");
            }
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(40))]

        #[test]
        fn no_place_leaves_its_interval(
            (x, y, z) in (-6.0..6.0, 0.2..6.0, 3.0..9.0),
            field in 0.5..60.0,
            phong in any::<bool>(),
            places in prop::collection::vec((0.0..40.0, 0.0..30.0), 400)
        ) {
            let angle = if phong { "phong" } else { "blinn" };
            let scene = scene(&format!(
                r#""angle": "{angle}", "camera": {{"position": [{x}, {y}, {z}], "look_at": [0, 0, 0],
                "field_of_view_degrees": {field}}}, "geometry": [
                {{"sphere": {{"centre": [0, 0, 0], "radius": 1.3, "material": "a"}}}},
                {{"plane": {{"point": [0, -1, 0], "normal": [0, 1, 0.1], "material": "b"}}}}]"#
            ));
            let demands = demands(&scene);
            for (column, row) in places {
                holds(&scene, &demands, column, row);
            }
        }
    }

    #[test]
    fn the_close_up_is_bounded_tightly() {
        let text = include_str!("../../../../docs/scenes/close_up.json");
        let scene = Scene::from_json(text, &mut |_| Ok(String::new())).unwrap();
        let [demand] = demands(&scene)[..] else { panic!("one exponent") };
        // What docs/SCENES.md says of its corners: at most 6.92 degrees.
        assert!(demand.least > 6.93_f64.to_radians().cos(), "{demand:?}");
        assert!(demand.least > (0.5_f64).powf(1.0 / 64.0) && demand.greatest == 1.0);
    }
}
