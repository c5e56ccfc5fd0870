//! Scenes and rendering by themselves: geometry against arithmetic done here, and the highlights of a picture against
//! the data path, one sample at a time.

use std::path::{Path, PathBuf};

use hw_model::datapath::Signals;
use hw_model::datapath::front_end::Region;
use hw_model::design::Design;
use hw_model::highlight::phong;
use hw_model::presets;
use proptest::prelude::*;
use scenes::render::{
    Bvh, Codes, Presented, Ray, Samples, ScenePipeline, SurfacePixel, Which, Zone, difference, meet, presented,
    reference, samples, shade,
};
use scenes::scene::{Angle, Knot, Light, Normals, Origin, Scene, Shape, Surface, Triangle, Vector, schema, triangles};
use vectors::progress::Progress;

struct Silent;
impl Progress for Silent {
    fn advance(&self, _samples: u64) {}
}

fn documents() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs")
}

const SCENES: [&str; 5] = ["one_material", "many_materials", "close_up", "low_exponents", "torus_knot"];

/// One of `docs/scenes`, in a small picture of the same shape.
fn scene(name: &str) -> Scene {
    let directory = documents().join("scenes");
    let text = std::fs::read_to_string(directory.join(format!("{name}.json"))).unwrap();
    let read = |file: &str| std::fs::read_to_string(directory.join(file));
    let mut scene = Scene::from_json(&text, &mut { read }).unwrap();
    assert_eq!(scene.name, name);
    let (width, height) = (scene.image.width / 4, scene.image.height / 4);
    scene.resize(width, height).unwrap();
    scene
}

fn design(preset: &str) -> Design {
    Design::new(presets::find(preset).unwrap().config().unwrap()).unwrap()
}

fn unit() -> impl Strategy<Value = Vector> {
    let part = -1.0..1.0_f64;
    (part.clone(), part.clone(), part).prop_filter_map("too short", |(x, y, z)| {
        let vector = Vector::new(x, y, z);
        vector.unit().filter(|_| vector.length() > 0.01)
    })
}

fn place(reach: f64) -> impl Strategy<Value = Vector> {
    let part = -reach..reach;
    (part.clone(), part.clone(), part).prop_map(|(x, y, z)| Vector::new(x, y, z))
}

fn sun(towards: Vector) -> Light {
    Light { origin: Origin::Direction(towards), colour: Vector::new(1.0, 1.0, 1.0) }
}

fn at_origin(angle: Angle, towards: Vector, normal: Vector, viewer: Vector) -> Presented {
    presented(angle, &sun(towards), Vector::default(), normal, viewer)
}

proptest! {
    #[test]
    fn a_mirrored_light_keeps_its_angle(n in unit(), l in unit(), v in unit()) {
        let one = at_origin(Angle::Phong, l, n, v);
        let other = at_origin(Angle::Phong, v, n, l);
        prop_assert!((one.x - other.x).abs() < 1e-14, "light and viewer may change places");
        prop_assert!((one.x - (2.0 * n.dot(l) * n.dot(v) - l.dot(v))).abs() < 1e-14);
        prop_assert!(one.x.abs() <= 1.0 + 1e-14);
        prop_assert_eq!(one.lit, n.dot(l));
        // Seen along the mirrored light the highlight is brightest; turning the normal round changes nothing.
        let mirrored = (n * (2.0 * n.dot(l)) - l).unit().unwrap();
        prop_assert!((at_origin(Angle::Phong, l, n, mirrored).x - 1.0).abs() < 1e-14);
        prop_assert_eq!(at_origin(Angle::Phong, l, -n, v).x, one.x);
    }

    #[test]
    fn halfway_is_between(n in unit(), l in unit(), v in unit()) {
        prop_assume!((l + v).length() > 1e-3);
        let one = at_origin(Angle::Blinn, l, n, v);
        prop_assert!((one.x - at_origin(Angle::Blinn, v, n, l).x).abs() < 1e-14);
        let wanted = (n.dot(l) + n.dot(v)) / (2.0 + 2.0 * l.dot(v)).sqrt();
        prop_assert!((one.x - wanted).abs() < 1e-9, "{} {wanted}", one.x);
        prop_assert!((at_origin(Angle::Blinn, l, n, l).x - n.dot(l)).abs() < 1e-14);
        prop_assert_eq!(at_origin(Angle::Blinn, l, n, -l).x, 0.0);
    }

    #[test]
    fn a_light_far_away_is_one_from_a_direction(n in unit(), l in unit(), v in unit(), p in place(1.0)) {
        let far = Light { origin: Origin::Place(l * 1e8), colour: Vector::default() };
        for angle in [Angle::Phong, Angle::Blinn] {
            prop_assume!((l + v).length() > 0.1);
            let (one, other) = (presented(angle, &far, p, n, v), at_origin(angle, l, n, v));
            prop_assert!((one.x - other.x).abs() < 1e-6 && (one.lit - other.lit).abs() < 1e-6);
        }
    }

    /// By walking along the ray in small steps until the distance from the centre falls below the radius.
    #[test]
    fn a_ball_is_met_where_walking_meets_it(o in place(6.0), d in unit(), c in place(3.0), r in 0.05..2.0_f64) {
        prop_assume!((o - c).length() > r * 1.001);
        let ray = Ray { origin: o, direction: d };
        let outside = |t: f64| (o + d * t - c).length() - r;
        const STEPS: u32 = 6000;
        let at = |step: u32| 20.0 * f64::from(step) / f64::from(STEPS);
        let walked = (1..=STEPS).find(|&step| outside(at(step)) < 0.0).map(|step| {
            let (mut low, mut high) = (at(step - 1), at(step));
            for _ in 0..60 {
                let middle = (low + high) / 2.0;
                if outside(middle) < 0.0 { high = middle } else { low = middle }
            }
            high
        });
        let met = meet(&ray, &Shape::Sphere { centre: c, radius: r }, f64::INFINITY);
        match (walked, met) {
            (Some(walked), Some(hit)) => {
                prop_assert!((walked - hit.distance).abs() < 1e-6, "{walked} {}", hit.distance);
                let outwards = (o + d * hit.distance - c).unit().unwrap();
                prop_assert!((hit.normal - outwards).length() < 1e-6);
                prop_assert!(hit.normal.dot(d) < 1e-6);
            }
            (Some(_), None) => prop_assert!(false, "walked into a ball that was not met"),
            // Steps may pass over a ball that the ray only grazes.
            (None, Some(hit)) => prop_assert!(hit.normal.dot(d).abs() < 0.2, "{hit:?}"),
            (None, None) => {}
        }
        prop_assert_eq!(meet(&ray, &Shape::Sphere { centre: c, radius: r }, 0.0), None);
    }

    #[test]
    fn a_triangle_is_met_where_its_plane_is_and_inside_its_edges(
        o in place(4.0), a in place(2.0), b in place(2.0), c in place(2.0), u in 0.0..1.0_f64, w in 0.0..1.0_f64
    ) {
        let normal = (b - a).cross(c - a);
        prop_assume!(normal.length() > 1e-2);
        let (u, w) = if u + w > 1.0 { (1.0 - u, 1.0 - w) } else { (u, w) };
        let target = a + (b - a) * u + (c - a) * w;
        let Some(direction) = (target - o).unit() else { return Ok(()) };
        prop_assume!(normal.unit().unwrap().dot(direction).abs() > 1e-3);
        prop_assume!(u > 1e-6 && w > 1e-6 && u + w < 1.0 - 1e-6);
        let flat = Triangle { corners: [a, b, c], normals: [normal.unit().unwrap(); 3] };
        let ray = Ray { origin: o, direction };
        let hit = meet(&ray, &Shape::Triangle(flat), f64::INFINITY);
        let hit = hit.expect("the ray aims at its inside");
        prop_assert!((hit.distance - (target - o).length()).abs() < 1e-6);
        prop_assert!(hit.normal.dot(direction) < 0.0, "the side that is seen");
        let beyond = a + (b - a) * (1.1 + u) + (c - a) * w;
        if let Some(direction) = (beyond - o).unit() {
            let ray = Ray { origin: o, direction };
            prop_assert_eq!(meet(&ray, &Shape::Triangle(flat), f64::INFINITY), None);
        }
    }

    #[test]
    fn the_tree_finds_what_asking_every_surface_finds(
        corners in prop::collection::vec((place(3.0), place(0.7), place(0.7)), 0..60),
        balls in prop::collection::vec((place(3.0), 0.05..0.6_f64), 0..12),
        rays in prop::collection::vec((place(5.0), unit()), 24)
    ) {
        let mut surfaces = Vec::new();
        for (a, b, c) in corners {
            let plane = b.cross(c);
            let Some(normal) = plane.unit().filter(|_| plane.length() > 1e-6) else { continue };
            let triangle = Triangle { corners: [a, a + b, a + c], normals: [normal; 3] };
            let material = surfaces.len() as u16;
            surfaces.push(Surface { shape: Shape::Triangle(triangle), material });
        }
        for (centre, radius) in balls {
            let material = surfaces.len() as u16;
            surfaces.push(Surface { shape: Shape::Sphere { centre, radius }, material });
        }
        let plane = Shape::Plane { point: Vector::new(0.0, -2.0, 0.0), normal: Vector::new(0.0, 1.0, 0.0) };
        surfaces.push(Surface { shape: plane, material: surfaces.len() as u16 });
        let bvh = Bvh::new(&surfaces);
        for (origin, direction) in rays {
            // Along an axis too, where the reciprocal of the direction is infinite.
            for direction in [direction, Vector::new(0.0, 0.0, -1.0)] {
                let ray = Ray { origin, direction };
                let all = surfaces.iter().filter_map(|surface| {
                    meet(&ray, &surface.shape, f64::INFINITY).map(|hit| (hit, surface.material))
                });
                let nearest = all.min_by(|one, other| one.0.distance.total_cmp(&other.0.distance));
                prop_assert_eq!(bvh.first(&ray), nearest);
            }
        }
    }

    /// Whatever is presented, each answer is that of the data path for the same x on its own.
    #[test]
    fn every_highlight_is_the_data_paths(
        presented in prop::collection::vec((-0.2..1.0_f64, -0.3..1.000_000_1_f64, 0_u16..13), 1..300)
    ) {
        let scene = scene("many_materials");
        let pixels = |(pixel, &(_, _, material)): (usize, &(f64, f64, u16))| {
            SurfacePixel { pixel: pixel as u32, material }
        };
        let samples = Samples {
            width: presented.len() as u32,
            height: 1,
            lights: 1,
            pixels: presented.iter().enumerate().map(pixels).collect(),
            samples: presented.iter().map(|&(lit, x, _)| Presented { lit, x }).collect(),
        };
        for preset in ["paper", "compact"] {
            let design = DESIGNS.with(|designs| designs[usize::from(preset == "compact")].clone());
            one_by_one(&scene, &design, &samples);
        }
    }
}

thread_local! {
    static DESIGNS: [Design; 2] = [design("paper"), design("compact")];
}

fn one_by_one(scene: &Scene, design: &Design, samples: &Samples) {
    let pipeline = ScenePipeline::new(design, scene).unwrap();
    let every = pipeline.answers(samples, Which::Every);
    let needed = pipeline.answers(samples, Which::Needed);
    assert_eq!(every.intensities, needed.intensities);
    assert_eq!(every.parts, needed.parts);
    assert_eq!(every.requests, samples.samples.len() as u64);
    let mut asked = 0;
    for (index, (material, sample)) in samples.with_material().enumerate() {
        let exponent = scene.materials[usize::from(material)].exponent;
        let address = design.rom().address_of(exponent);
        let x = pipeline.bits(sample.x);
        let Signals { intensity, region, .. } = design.datapath().evaluate(address, x);
        let part = needed.parts[index];
        if !(sample.lit > 0.0 && sample.x > 0.0) {
            assert_eq!((part, needed.intensities[index]), (Zone::FacesAway, 0));
            continue;
        }
        asked += u64::from(region != Region::Zero);
        assert_eq!(needed.intensities[index], intensity, "n = {exponent}, x = {x}");
        let row = &design.rows()[address as usize];
        let wanted = match region {
            Region::Zero => Zone::Zero,
            _ if x >= row.first_of_epicentre(design.config()) => Zone::Epicentre,
            _ => Zone::Tail,
        };
        assert_eq!(part, wanted, "n = {exponent}, x = {x}");
    }
    assert_eq!(needed.requests, asked);
}

/// The requests that a scene makes are its samples, in the pipeline's bits, each once.
#[test]
fn requests_are_the_samples_by_exponent() {
    let scene = scene("many_materials");
    let design = design("paper");
    let pipeline = ScenePipeline::new(&design, &scene).unwrap();
    let samples = samples(&scene, &Silent);
    let groups = pipeline.requests(&samples, 0..samples.samples.len(), Which::Every);
    let mut seen = vec![false; samples.samples.len()];
    for group in &groups {
        assert_eq!(design.rom().exponents().as_slice()[group.address as usize], group.exponent);
        for (&sample, &x) in group.samples.iter().zip(&group.xs) {
            let index = sample as usize;
            assert!(!std::mem::replace(&mut seen[index], true), "sample {index} is asked twice");
            let material = &scene.materials[usize::from(samples.material_of(index))];
            assert_eq!(material.exponent, group.exponent);
            let real = samples.samples[index].x.clamp(0.0, 2.0);
            assert!((x as f64 * design.config().input.ulp() - real).abs() <= 2_f64.powi(-24));
        }
    }
    assert!(seen.iter().all(|&seen| seen));
    let exponents: Vec<f64> = groups.iter().map(|group| group.exponent).collect();
    assert_eq!(exponents, scene.exponents());
}

/// Every preset that has the exponents: leaving samples out changes no bit, and the picture errs by what the method
/// does.
#[test]
fn every_preset_renders_every_scene() {
    for preset in presets::ALL {
        let design = design(preset.name);
        for name in SCENES {
            let scene = scene(name);
            let samples = samples(&scene, &Silent);
            one_by_one(&scene, &design, &samples);
            let pipeline = ScenePipeline::new(&design, &scene).unwrap();
            let answers = pipeline.answers(&samples, Which::Needed);
            let codes = Codes::new(&scene.image);
            let ideal = shade(&scene, &samples, &codes, &reference(&scene, &samples));
            let shown = shade(&scene, &samples, &codes, &pipeline.highlights(&answers));
            let difference = difference(&shown, &ideal);
            let noise = difference.psnr.unwrap_or(f64::INFINITY);
            assert!(noise > 25.0, "{name} by {}: {difference:?}", preset.name);
        }
    }
}

#[test]
fn the_reference_is_x_to_the_n() {
    let scene = scene("low_exponents");
    let samples = samples(&scene, &Silent);
    let ideal = reference(&scene, &samples);
    let mut bright = 0;
    for ((material, sample), &value) in samples.with_material().zip(&ideal) {
        let exponent = scene.materials[usize::from(material)].exponent;
        let faces = sample.lit > 0.0 && sample.x > 0.0;
        let wanted = if faces { phong(exponent, sample.x.min(1.0)) } else { 0.0 };
        assert_eq!(value, wanted);
        bright += u32::from(value > 0.99);
    }
    assert!(bright > 0 && samples.samples.len() > 1000);
}

/// By the samples, and by the angles themselves: a ray at most θ off the axis passes within 600 · tan θ of it wherever
/// it meets the ball of radius 20, so the normal there leaves the axis by at most arcsin(600 · tan θ / 20), and the
/// mirrored light the viewer by twice that and θ.
#[test]
fn the_close_up_never_leaves_the_epicentre() {
    let scene = scene("close_up");
    let design = design("paper");
    let samples = samples(&scene, &Silent);
    let count = scene.image.width * scene.image.height;
    assert_eq!(samples.pixels.len(), count as usize, "it fills the picture");
    let pipeline = ScenePipeline::new(&design, &scene).unwrap();
    let answers = pipeline.answers(&samples, Which::Every);
    assert!(answers.parts.iter().all(|&part| part == Zone::Epicentre));
    let [material] = scene.materials.as_slice() else { panic!("one material") };
    let epicentre = 0.5_f64.powf(1.0 / material.exponent);
    let aspect = f64::from(scene.image.width) / f64::from(scene.image.height);
    let half_diagonal = (scene.view.half_height * aspect.hypot(1.0)).atan();
    let Shape::Sphere { radius, .. } = scene.surfaces[0].shape else { panic!("a ball") };
    let beside = scene.view.position.length() * half_diagonal.tan();
    let bend = (beside / radius).asin();
    let least = (2.0 * bend + half_diagonal).cos();
    assert!(least > epicentre, "{least} {epicentre}");
    assert!(samples.samples.iter().all(|sample| sample.x >= least));
    let darkest = samples.samples.iter().fold(1.0_f64, |least, sample| least.min(sample.x));
    assert!(phong(material.exponent, darkest) < 0.75, "a highlight that falls off is seen");
}

#[test]
fn the_schema_and_the_mesh_are_those_of_the_code() {
    let kept = std::fs::read_to_string(documents().join("scene.schema.json")).unwrap();
    assert!(kept == schema(), "docs/scene.schema.json is stale: make pictures");
    let mesh = std::fs::read_to_string(documents().join("scenes/torus_knot.obj")).unwrap();
    let knot = Knot::new(2, 3, 288, 24, 0.22).unwrap();
    let origin = mesh.lines().next().unwrap().strip_prefix("# ").unwrap();
    assert!(mesh == knot.to_obj(origin), "docs/scenes/torus_knot.obj is stale: make pictures");
    assert!(knot.triangle_count() >= 10_000);
    assert_eq!(triangles(&mesh, Normals::Smooth).unwrap().len() as u64, knot.triangle_count());
}

/// A closed mesh: the sum of its directed areas is nothing, its volume is that of the tube, and the means of the
/// triangles point where the flat ones do.
#[test]
fn the_knot_is_closed_and_its_normals_point_outwards() {
    let knot = Knot::new(2, 3, 192, 16, 0.2).unwrap();
    let mesh = triangles(&knot.to_obj("a test"), Normals::Smooth).unwrap();
    let (mut area, mut volume) = (Vector::default(), 0.0);
    for triangle in &mesh {
        let [a, b, c] = triangle.corners;
        area = area + triangle.plane_normal();
        volume += a.dot(b.cross(c)) / 6.0;
        let plane = triangle.plane_normal().unit().unwrap();
        for normal in triangle.normals {
            assert!((normal.length() - 1.0).abs() < 1e-12);
            assert!(normal.dot(plane) > 0.8, "{triangle:?}");
        }
    }
    assert!(area.length() < 1e-9, "{area:?}");
    // π·r² times the length of the line, about 15.9 for this knot.
    assert!((1.5..2.5).contains(&volume), "{volume}");
}

/// However a cube's faces are cut into triangles, its corners point along the diagonals.
#[test]
fn normals_do_not_depend_on_how_polygons_are_cut() {
    let corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n";
    let faces = ["4 3 2 1", "5 6 7 8", "1 2 6 5", "2 3 7 6", "3 4 8 7", "4 1 5 8"];
    let turned = |face: &str, turns: usize| {
        let mut corners: Vec<&str> = face.split(' ').collect();
        corners.rotate_left(turns);
        format!("f {}\n", corners.join(" "))
    };
    for turns in 0..64 {
        let faces = faces.iter().enumerate().map(|(index, face)| turned(face, turns >> index & 1));
        let text = format!("{corners}{}", faces.collect::<String>());
        for triangle in triangles(&text, Normals::Smooth).unwrap() {
            for (corner, normal) in triangle.corners.into_iter().zip(triangle.normals) {
                let diagonal = (corner - Vector::new(0.5, 0.5, 0.5)).unit().unwrap();
                assert!((normal - diagonal).length() < 1e-12, "{normal:?} at {corner:?}");
            }
        }
        let flat = triangles(&text, Normals::Flat).unwrap();
        assert!(flat.iter().all(|t| t.normals[0].coordinates().iter().any(|c| c.abs() == 1.0)));
    }
}
