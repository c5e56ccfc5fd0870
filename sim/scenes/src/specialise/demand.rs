//! What a scene asks of the pipeline: for each exponent the interval of x, over every real place of the picture.
//!
//! The greatest and the least x are bounded by parts: the whole picture, or the whole mesh, is one, its bound by
//! interval arithmetic is loose, and the part with the worst bound is cut in two until that bound is near an x that
//! is presented ([`super::search`]). Parts of spheres and planes are tiles of the picture, parts of meshes are boxes of
//! a tree and pieces of triangles ([`super::patch`]). Whatever hides a surface is not looked at, which only widens the
//! interval.

use rayon::prelude::*;

use super::patch::Patches;
use super::search::{Places, end};
use super::space::Rays;
use super::tile;
use crate::render::{meet, presented, ray};
use crate::scene::{Light, Scene, Shape, Surface};
use bounds::interval::Interval;

/// Pictures are computed in f64, whose rounding may move an x out of the bounds of the real ones: far less than this
/// unless a ball is seen from some 10⁵ of its radii, or a triangle nearly edge on. What does leave is found where
/// pixels are held against the bounds ([`super::pixels_outside`]).
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
}

/// What the scene asks, by rising exponent; exponents of which no place is lit and seen are left out.
#[must_use]
pub fn demands(scene: &Scene) -> Vec<Demand> {
    scene.exponents().into_par_iter().filter_map(|exponent| demand(scene, exponent)).collect()
}

fn demand(scene: &Scene, exponent: f64) -> Option<Demand> {
    let of_it = |surface: &&Surface| scene.materials[usize::from(surface.material)].exponent == exponent;
    let (triangles, others): (Vec<&Surface>, Vec<&Surface>) =
        scene.surfaces.iter().filter(of_it).partition(|surface| matches!(surface.shape, Shape::Triangle(_)));
    let patches = Patches::new(scene, triangles.into_iter().copied());
    let mut ends = Vec::new();
    for light in &scene.lights {
        ends.extend(both_ends(&patches.lit_by(light)));
        ends.extend(others.iter().filter_map(|surface| both_ends(&Presenting { scene, shape: &surface.shape, light })));
    }
    let (least, greatest) = ends.into_iter().reduce(|one, other| (one.0.min(other.0), one.1.max(other.1)))?;
    let (least, greatest) = ((least - MARGIN).max(0.0), (greatest + MARGIN).min(1.0));
    Some(Demand { exponent, least, greatest })
}

/// Bounds of the least and the greatest x; none where no place is lit and seen.
fn both_ends(places: &impl Places) -> Option<(f64, f64)> {
    let greatest = end(places, true)?;
    Some((end(places, false).unwrap_or(0.0), greatest))
}

/// One surface in one light.
struct Presenting<'a> {
    scene: &'a Scene,
    shape: &'a Shape,
    light: &'a Light,
}

/// A tile of the picture, in pixels from its upper left corner.
struct Tile {
    columns: Interval,
    rows: Interval,
}

impl Places for Presenting<'_> {
    type Part = Tile;

    fn whole(&self) -> Option<Tile> {
        let side = |side: u32| Interval::new(0.0, f64::from(side));
        let image = &self.scene.image;
        Some(Tile { columns: side(image.width), rows: side(image.height) })
    }

    fn bound(&self, tile: &Tile) -> Option<Interval> {
        let rays = Rays::new(&self.scene.view, &self.scene.image, tile.columns, tile.rows);
        tile::presented(&rays, self.shape, self.scene.angle, self.light)
    }

    /// x in the middle of a tile.
    fn sample(&self, tile: &Tile) -> Option<f64> {
        let Scene { view, image, angle, .. } = self.scene;
        let ray = ray(view, image, tile.columns.middle(), tile.rows.middle());
        let hit = meet(&ray, self.shape, f64::INFINITY)?;
        let place = ray.origin + ray.direction * hit.distance;
        let found = presented(*angle, self.light, place, hit.normal, -ray.direction);
        (!found.faces_away()).then_some(found.x)
    }

    fn cut(&self, tile: &Tile) -> Option<Vec<Tile>> {
        Some(halves(tile.columns, tile.rows).map(|(columns, rows)| Tile { columns, rows }).into())
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
        scene_with(rest, "")
    }

    fn scene_with(rest: &str, mesh: &str) -> Scene {
        let text = format!(
            r#"{{"name": "s", "image": {{"width": 40, "height": 30}},
            "lights": [{{"directional": {{"towards": [1, 2, 2], "colour": [1, 1, 1]}}}},
                       {{"point": {{"position": [2, 3, 4], "colour": [1, 1, 1]}}}}],
            "materials": [{{"name": "a", "exponent": 5, "diffuse": [0, 0, 0], "specular": [1, 1, 1]}},
                          {{"name": "b", "exponent": 9, "diffuse": [0, 0, 0], "specular": [1, 1, 1]}}],
            {rest}}}"#
        );
        Scene::from_json(&text, &mut |_| Ok(mesh.to_owned())).unwrap()
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

    /// Triangles between places, with normals of any direction at their corners: some of them beyond the plane.
    fn mesh(places: &[[f64; 3]], normals: &[[f64; 3]]) -> String {
        use std::fmt::Write;
        let mut text = String::new();
        for ([x, y, z], [a, b, c]) in places.iter().zip(normals) {
            writeln!(text, "v {x} {y} {z}\nvn {a} {b} {c}").unwrap();
        }
        for first in (1..places.len() - 1).step_by(3) {
            let [a, b, c] = [0, 1, 2].map(|step| first + step);
            writeln!(text, "f {a}//{a} {b}//{b} {c}//{c}").unwrap();
        }
        text
    }

    fn triples(count: usize, reach: f64) -> impl Strategy<Value = Vec<[f64; 3]>> {
        prop::collection::vec([-reach..reach, -reach..reach, -reach..reach], count)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]

        #[test]
        fn no_place_of_a_mesh_leaves_its_interval(
            (x, y, z) in (-4.0..4.0, 0.2..4.0, 1.0..5.0),
            field in 2.0..90.0,
            (phong, smooth, like_a_ball) in (any::<bool>(), any::<bool>(), any::<bool>()),
            corners in triples(30, 1.5),
            free in triples(30, 1.0),
            places in prop::collection::vec((0.0..40.0, 0.0..30.0), 400)
        ) {
            let angle = if phong { "phong" } else { "blinn" };
            let normals = if smooth { "smooth" } else { "flat" };
            let text = mesh(&corners, if like_a_ball { &corners } else { &free });
            let scene = scene_with(&format!(
                r#""angle": "{angle}", "camera": {{"position": [{x}, {y}, {z}], "look_at": [0, 0, 0],
                "field_of_view_degrees": {field}}}, "geometry": [
                {{"mesh": {{"file": "m.obj", "material": "a", "normals": "{normals}"}}}}]"#
            ), &text);
            let demands = demands(&scene);
            for (column, row) in places {
                holds(&scene, &demands, column, row);
            }
        }
    }

    /// A mesh of a ball is bounded nearly as the ball is.
    #[test]
    fn a_close_up_of_a_mesh_is_bounded_as_a_ball_is() {
        use std::fmt::Write;
        let side = 25;
        let mut text = String::new();
        for (row, column) in (0..side).flat_map(|row| (0..side).map(move |column| (row, column))) {
            let of = |step: i32| (f64::from(step) / f64::from(side - 1) - 0.5) * 0.4;
            let normal = crate::scene::Vector::new(of(column), of(row), 1.0).unit().unwrap();
            let [place, normal] = [normal * 20.0, normal].map(crate::scene::Vector::coordinates);
            writeln!(text, "v {} {} {}", place[0], place[1], place[2]).unwrap();
            writeln!(text, "vn {} {} {}", normal[0], normal[1], normal[2]).unwrap();
        }
        for (row, column) in (1..side).flat_map(|row| (1..side).map(move |column| (row, column))) {
            let [a, b, c, d] = [(row - 1, column - 1), (row - 1, column), (row, column), (row, column - 1)]
                .map(|(row, column)| row * side + column + 1);
            writeln!(text, "f {a}//{a} {b}//{b} {c}//{c} {d}//{d}").unwrap();
        }
        let ball = r#"{"sphere": {"centre": [0, 0, 0], "radius": 20, "material": "a"}}"#;
        let of = |geometry: &str| {
            let rest = format!(
                r#""camera": {{"position": [0, 0, 600], "look_at": [0, 0, 0], "field_of_view_degrees": 0.18}},
                "geometry": [{geometry}]"#
            );
            let mut scene = scene_with(&rest, &text);
            scene.lights.truncate(1);
            scene.lights[0].origin = crate::scene::Origin::Direction(crate::scene::Vector::new(0.0, 0.0, 1.0));
            let [demand] = demands(&scene)[..] else { panic!("one exponent") };
            demand
        };
        let (of_ball, of_mesh) = (of(ball), of(r#"{"mesh": {"file": "m.obj", "material": "a"}}"#));
        assert!(of_ball.least > 0.98 && (of_ball.least - of_mesh.least).abs() < 3e-4, "{of_ball:?} {of_mesh:?}");
        assert!(of_mesh.greatest > 0.9999, "{of_mesh:?}");
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
