//! Meshes by themselves: what an OBJ file says, how its polygons are cut, and that whatever is wrong has its line.

use std::fmt::Write;
use std::time::{Duration, Instant};

use proptest::prelude::*;
use scenes::scene::{Mesh, MeshError, Normals, Scene, Triangle, Vector, triangles};

fn flat(text: &str) -> Vec<Triangle> {
    triangles(text, Normals::Flat).unwrap_or_else(|error| panic!("{text}{error}"))
}

/// The line and the problem.
fn refused(text: &str, normals: Normals) -> (usize, String) {
    match triangles(text, normals) {
        Err(MeshError::Line { line, problem }) => (line, problem),
        Err(error) => panic!("an error without a line: {error}"),
        Ok(_) => panic!("{text} is read"),
    }
}

/// One face through these places.
fn face(corners: &[Vector]) -> String {
    let mut text = String::new();
    for Vector { x, y, z } in corners {
        writeln!(text, "v {x} {y} {z}").unwrap();
    }
    text.push('f');
    (1..=corners.len()).for_each(|index| write!(text, " {index}").unwrap());
    text + "\n"
}

fn plane(corners: &[(f64, f64)]) -> Vec<Vector> {
    corners.iter().map(|&(x, y)| Vector::new(x, y, 0.0)).collect()
}

fn area(triangles: &[Triangle]) -> f64 {
    triangles.iter().map(|triangle| triangle.plane_normal().length() / 2.0).sum()
}

/// By the trapezoids under its edges, for a polygon with z = 0.
fn shoelace(corners: &[Vector]) -> f64 {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(a, b)| (a.x - b.x) * (a.y + b.y) / 2.0).sum()
}

/// The triangles fill the polygon, go round as it does, and have every corner.
fn fills(corners: &[Vector], area_wanted: f64) {
    let found = flat(&face(corners));
    assert_eq!(found.len(), corners.len() - 2, "{corners:?}");
    assert!((area(&found) - area_wanted).abs() < 1e-9 * area_wanted, "{} {area_wanted}", area(&found));
    let first = found[0].normals[0];
    assert!(found.iter().all(|triangle| (triangle.normals[0].dot(first) - 1.0).abs() < 1e-9));
    for corner in corners {
        assert!(found.iter().any(|triangle| triangle.corners.contains(corner)), "{corner:?}");
    }
}

#[test]
fn convex_polygons_are_fans_from_their_first_corner() {
    let hexagon = plane(&[(2.0, 0.0), (1.0, 2.0), (-1.0, 2.0), (-2.0, 0.0), (-1.0, -2.0), (1.0, -2.0)]);
    // Concave at the first corner, where its fan fills it as well.
    let arrow = plane(&[(0.0, 0.5), (-1.0, -1.0), (0.0, 2.0), (1.0, -1.0)]);
    // No plane goes through these four; the two triangles are those of every other program.
    let bent =
        [(0.0, 0.0, 0.0), (1.0, 0.0, 0.4), (1.0, 1.0, 0.0), (0.0, 1.0, 0.3)].map(|(x, y, z)| Vector::new(x, y, z));
    for corners in [&hexagon[..], &arrow, &bent] {
        let found: Vec<[Vector; 3]> = flat(&face(corners)).iter().map(|of| of.corners).collect();
        let fan: Vec<[Vector; 3]> =
            (2..corners.len()).map(|last| [corners[0], corners[last - 1], corners[last]]).collect();
        assert_eq!(found, fan);
    }
}

#[test]
fn polygons_that_turn_in_are_filled_and_not_left() {
    let l = [(1.0, -1.0), (1.0, -0.4), (-0.4, -0.4), (-0.4, 1.0), (-1.0, 1.0), (-1.0, -1.0)];
    let mut comb = vec![(0.0, 0.0), (20.0, 0.0)];
    (0..10).rev().for_each(|tooth| {
        let x = 2.0 * f64::from(tooth);
        comb.extend([(x + 2.0, 5.0), (x + 1.0, 1.0)]);
    });
    comb.push((0.0, 5.0));
    let square = |half: f64| [(-half, -half), (half, -half), (half, half), (-half, half)];
    // Out to a hole, round it the other way, and back along the same edge.
    let mut keyhole = square(2.0).to_vec();
    keyhole.push((-2.0, -2.0));
    keyhole.extend([(-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)]);
    let arrow = [(-1.0, -1.0), (0.0, 0.5), (1.0, -1.0), (0.0, 2.0)];
    for (corners, wanted) in [(&l[..], 2.0 * 0.6 + 1.4 * 0.6), (&comb, 60.0), (&keyhole, 12.0), (&arrow, 1.5)] {
        let corners = plane(corners);
        assert!((shoelace(&corners).abs() - wanted).abs() < 1e-9, "{}", shoelace(&corners));
        for start in 0..corners.len() {
            let mut turned = corners.clone();
            turned.rotate_left(start);
            // At the seam of the keyhole, where both ends of the list are one place, that place is counted once.
            if turned.first() == turned.last() {
                continue;
            }
            fills(&turned, wanted);
            turned.reverse();
            fills(&turned, wanted);
        }
    }
}

#[test]
fn corners_on_an_edge_stay_corners() {
    let corners = [
        (-1.0, -1.0),
        (0.0, -1.0),
        (0.1, -1.0),
        (1.0, -1.0),
        (1.0, 0.3),
        (1.0, 0.7),
        (1.0, 1.0),
        (0.2, 1.0),
        (-0.3, 1.0),
        (-1.0, 1.0),
        (-1.0, 0.9),
        (-1.0, -0.9),
    ];
    // In a plane at an angle, where rounding moves them a little off their edges.
    let tilted: Vec<Vector> =
        corners.iter().map(|&(x, y)| Vector::new(x, 0.6 * y + 0.1 * x, 0.8 * y - 0.3 * x)).collect();
    for start in 0..corners.len() {
        let (mut flat, mut tilted) = (plane(&corners), tilted.clone());
        flat.rotate_left(start);
        tilted.rotate_left(start);
        fills(&flat, 4.0);
        let quad = [0, 3, 6, 9].map(|index| tilted[(index + corners.len() - start) % corners.len()]);
        fills(&tilted, area(&self::flat(&face(&quad))));
    }
}

#[test]
fn a_corner_that_repeats_the_one_before_it_is_none() {
    let quad = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 1 0\n";
    let wanted = flat(&format!("{quad}f 1 2 3 4\n"));
    for repeated in ["f 1 2 3 4 4", "f 1 1 1 2 2 3 4", "f 1 2 3 4 5 1", "f 1 2 3 4 5 4"] {
        assert_eq!(flat(&format!("{quad}{repeated}\n")), wanted, "{repeated}");
    }
    assert_eq!(flat(&format!("{quad}f 1 2 3 3\n")), flat(&format!("{quad}f 1 2 3\n")));
}

/// An outline that walks out and back along one line is as if it had not.
#[test]
fn a_spike_without_width_covers_nothing() {
    let spike = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (3.0, 3.0), (2.0, 2.0), (1.0, 0.5), (0.0, 2.0)];
    assert!((area(&flat(&face(&plane(&spike)))) - 2.5).abs() < 1e-12);
}

#[test]
fn polygons_that_are_none_are_refused_with_their_line() {
    let bow_tie = [(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)];
    let lopsided = [(0.0, 0.0), (3.0, 1.0), (3.0, 0.0), (0.0, 2.0), (-1.0, 1.0)];
    let pentagram = [0, 2, 4, 1, 3].map(|step| {
        let (sine, cosine) = (f64::from(step) * std::f64::consts::TAU / 5.0).sin_cos();
        (cosine, sine)
    });
    let line = [(0.0, 0.0), (1.0, 1.0), (2.0, 2.0), (3.0, 3.0)];
    let there_and_back = [(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (1.0, 0.0)];
    for (corners, said) in [
        (&bow_tie[..], "no area"),
        (&lopsided, "cross"),
        (&pentagram, "cross"),
        (&line, "no area"),
        (&there_and_back, "no area"),
    ] {
        let (line, problem) = refused(&format!("# a\n{}", face(&plane(corners))), Normals::Flat);
        assert_eq!(line, corners.len() + 2, "{problem}");
        assert!(problem.contains(said), "{problem}");
    }
}

/// Exporters write triangles whose corners lie on one line, or at one place: they show nothing.
#[test]
fn triangles_without_area_are_left_out() {
    let places = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\n";
    let whole = flat(&format!("{places}f 1 2 3\n"));
    let with_others = format!("{places}f 1 2 4\nf 1 2 3\nf 2 2 3\nf 1 1 1\n");
    let mesh = Mesh::read(&with_others, Normals::Flat).unwrap();
    assert_eq!((mesh.triangles, mesh.without_area, mesh.material_of.len()), (whole, 3, 1));
    let (line, problem) = refused(&format!("{places}f 1 2 4\n"), Normals::Smooth);
    assert!(line == 5 && problem.contains("no face of the file has an area"), "{line}: {problem}");
}

/// A star of many points around a middle.
fn star(count: u32, inner: f64) -> Vec<Vector> {
    let corner = |index: u32| {
        let (sine, cosine) = (f64::from(index) * std::f64::consts::TAU / f64::from(count)).sin_cos();
        let radius = if index.is_multiple_of(2) { 1.0 } else { inner };
        Vector::new(radius * cosine, radius * sine, 0.0)
    };
    (0..count).map(corner).collect()
}

#[test]
fn large_faces_take_no_square_of_time() {
    let start = Instant::now();
    let disc = star(100_000, 1.0);
    fills(&disc[..20_000], shoelace(&disc[..20_000]));
    assert_eq!(flat(&face(&disc)).len(), 99_998);
    let cut = star(4096, 0.1);
    assert_eq!(flat(&face(&cut)).len(), 4094);
    let (line, problem) = refused(&face(&star(4098, 0.9)), Normals::Flat);
    assert!(line == 4099 && problem.contains("at most 4096"), "{problem}");
    assert!(start.elapsed() < Duration::from_secs(20), "{:?}", start.elapsed());
}

/// Groups, objects and materials say nothing of normals.
#[test]
fn normals_do_not_end_at_groups() {
    let roof = "v 0 0 0\nv 1 0 0\nv 1 1 1\nv 0 1 1\nv 1 2 0\nv 0 2 0\n";
    let text = |between: &str| format!("{roof}f 1 2 3 4\n{between}\nf 4 3 5 6\n");
    let wanted = triangles(&text(""), Normals::Smooth).unwrap();
    assert_ne!(wanted[0].normals[0], wanted[0].normals[2]);
    for between in ["g right", "o right", "g", "usemtl tiles", "s off", "s 2", "o a\ng b\nusemtl"] {
        assert_eq!(triangles(&text(between), Normals::Smooth).unwrap(), wanted, "{between}");
    }
}

/// A file of several objects may give normals to some of them.
#[test]
fn faces_with_normals_stand_beside_faces_without() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 0\nvn 3 0 4\nf 1//-1 2/9/2 3//2\nf 1 3 2\n";
    let found = triangles(&text.replace("/9/", "//"), Normals::Smooth);
    // The mean of two planes back to back is none.
    assert!(found.is_err());
    let text = text.replace("/9/", "//").replace("f 1 3 2", "v 5 5 5\nv 6 5 5\nv 5 6 5\nf 4 6 5");
    let found = triangles(&text, Normals::Smooth).unwrap();
    let near = |one: Vector, other: Vector| (one - other).length() < 1e-12;
    assert!(found[0].normals.iter().all(|&normal| near(normal, Vector::new(0.6, 0.0, 0.8))));
    assert!(found[1].normals.iter().all(|&normal| near(normal, Vector::new(0.0, 0.0, -1.0))));
    // What no face uses is no mistake; what one uses is, in its own line, unless the scene wants flat normals.
    for wrong in ["vn 0 0 0", "vn nan 0 0", "vn inf 0 0", "vn 1 2", "vn one 2 3", "vn -1.#IND00 0 0", "vn"] {
        let text = format!("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\n{wrong}\nf 1//1 2//1 3//1\n");
        assert_eq!(triangles(&text, Normals::Smooth).unwrap().len(), 1);
        let used = text.replace("3//1", "3//2");
        let (line, problem) = refused(&used, Normals::Smooth);
        assert!(line == 5 && problem.contains("length 0"), "{problem}");
        assert_eq!(triangles(&used, Normals::Flat).unwrap().len(), 1);
    }
}

const MESH: &str = "# a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0 # b\nvt 0 0\nvn 0 0 1\ng a\n\
                    f 1//1 \\\n 2//1 3//1\nf 2 4 3\n";

#[test]
fn what_is_wrong_has_its_line() {
    let _read = flat(MESH);
    for (from, to, line, said) in [
        ("v 1 0 0", "v 1,5 0 0", 3, "\"1,5\" is not a number: it has a decimal comma; write 1.5"),
        ("v 1 0 0", "v 1, 0, 0", 3, "\"1,\" is not a number"),
        ("v 1 0 0", "v 1d0 0 0", 3, "\"1d0\" is not a number"),
        ("v 1 0 0", "v 1 0", 3, "a number is missing"),
        ("v 1 0 0", "v 1 0 #0", 3, "a number is missing"),
        ("v 1 0 0", "v -1.#IND 0 0", 3, "a number is missing"),
        ("v 1 0 0", "v", 3, "a number is missing"),
        ("v 1 0 0", "v nan 0 0", 3, "nan is not a coordinate"),
        ("v 1 0 0", "v 1 0 -inf", 3, "-inf is not a coordinate"),
        ("v 1 0 0", "v 1 0 1e10", 3, "1e10 is not a coordinate"),
        ("v 1 0 0", "v 1 0 0 1 2", 3, "there are 5 numbers"),
        ("v 1 0 0", "v 1 0 0 1 2 3 4 5", 3, "there are 8 numbers"),
        ("v 1 0 0", "v 1 0 0 red", 3, "\"red\" is not a number"),
        ("v 1 0 0", "1 0 0", 3, "begins with \"1\" and no statement"),
        ("v 1 0 0", "V 1 0 0", 3, "`V` is no statement; write v"),
        ("g a", "surf 0 1 0 1 1 2", 8, "free-form"),
        ("g a", "call other.obj", 8, "`call` is not followed"),
        ("f 2 4 3", "f 2 4", 11, "3 corners or more, and this has 2"),
        ("f 2 4 3", "f", 11, "this has 0"),
        ("f 2 4 3", "f 2 4 3//1", 11, "some corners of this face"),
        ("f 2 4 3", "f 2 4 5", 11, "v 5 of this face does not exist; there are 4"),
        ("f 2 4 3", "f 2 4 3/2", 11, "vt 2 of this face does not exist; there are 1"),
        ("f 2 4 3", "f 2//2 4//2 3//2", 11, "vn 2 of this face does not exist; there are 1"),
        ("f 2 4 3", "f 2 4 0", 11, "\"0\" is not an index of a v"),
        ("f 2 4 3", "f 2 4 -5", 11, "\"-5\" is not an index of a v"),
        ("f 2 4 3", "f 2 4 1.0", 11, "\"1.0\" is not an index of a v"),
        ("f 2 4 3", "f 2 4 99999999999999999999", 11, "is not an index of a v"),
        ("f 2 4 3", "f 2 4 -9223372036854775808", 11, "is not an index of a v"),
        ("f 2 4 3", "f 2 4 9223372036854775807", 11, "v 9223372036854775807 of this face does not exist"),
        ("f 2 4 3", "f 2 4 3/1/1/1", 11, "v, v/vt, v//vn or v/vt/vn"),
        ("f 2 4 3", "f 2 4 /1", 11, "\"/1\" is not a corner"),
        ("f 2 4 3", "f 2 4 /", 11, "\"/\" is not a corner"),
        ("f 2 4 3", "f 2 4 3/a", 11, "\"a\" is not an index of a vt"),
        ("f 1//1 \\\n 2//1 3//1", "f 1//1 \\\n 2//1 3//9", 9, "vn 9"),
        ("f 1//1 \\\n 2//1 3//1", "f 1//1\n 2//1 3//1", 9, "this has 1"),
    ] {
        let text = MESH.replace(from, to);
        assert_ne!(text, MESH, "{from:?}");
        let found = refused(&text, Normals::Smooth);
        assert!(found.0 == line && found.1.contains(said), "{to:?}: {found:?}");
        let ends = refused(&text.replace('\n', "\r\n"), Normals::Smooth);
        assert_eq!(ends, found, "{to:?}");
    }
    for (text, line) in [("", 1), ("\n\n", 2), ("# a\nv 0 0 0\n", 2), ("solid a\nfacet normal 0 0 1", 2)] {
        let (found, problem) = refused(text, Normals::Flat);
        assert!(found == line && problem.contains("no face"), "{found} {problem}");
    }
}

const SCENE: &str = r#"{
  "name": "probe",
  "image": {"width": 96, "height": 72},
  "camera": {"position": [0, 0, 6], "look_at": [0, 0, 0], "field_of_view_degrees": 40},
  "lights": [{"directional": {"towards": [0.3, 0.4, 0.9], "colour": [1, 1, 1]}}],
  "materials": [{"name": "m", "exponent": 8, "diffuse": [0.2, 0.2, 0.2], "specular": [1, 1, 1]}],
  "geometry": [{"mesh": {"file": "m.obj", "material": "m"}}]
}
"#;

#[test]
fn a_decimal_comma_in_a_scene_is_named() {
    for (from, to, said) in [
        ("\"exponent\": 8", "\"exponent\": 8,5", "line 6 column"),
        ("_degrees\": 40", "_degrees\": 40,25", "line 4 column"),
    ] {
        let text = SCENE.replacen(from, to, 1);
        let error = Scene::from_json(&text, &mut |_| Ok(MESH.to_owned())).unwrap_err().to_string();
        let (_, number) = to.split_once(": ").unwrap();
        let right = format!("`{number}` a decimal comma? write {}", number.replace(',', "."));
        assert!(error.contains(said) && error.contains(&right), "{error}");
    }
}

/// Read, or refused with a line that the file has.
fn read_or_refused(text: &str) -> Result<(), TestCaseError> {
    for normals in [Normals::Flat, Normals::Smooth] {
        match triangles(text, normals) {
            Ok(found) => prop_assert!(!found.is_empty()),
            Err(MeshError::Line { line, .. }) => {
                prop_assert!((1..=text.lines().count().max(1)).contains(&line), "{}", line);
            }
            Err(error) => prop_assert!(false, "{}", error),
        }
    }
    Ok(())
}

proptest! {
    #[test]
    fn any_text_is_read_or_refused(text in "[vnf0-9 ./#\\\\\r\n-]{0,120}") {
        read_or_refused(&text)?;
    }

    #[test]
    fn altered_meshes_are_read_or_refused(
        edits in prop::collection::vec((0_usize..200, any::<u8>(), 0..4), 1..6),
    ) {
        let mut bytes = MESH.as_bytes().to_vec();
        for (place, byte, how) in edits {
            let place = place % bytes.len();
            match how {
                0 => bytes[place] = byte,
                1 => bytes.insert(place, byte),
                2 => drop(bytes.remove(place)),
                _ => bytes.insert(place, b"0123456789 -/.\\#\nvf"[usize::from(byte) % 19]),
            }
        }
        read_or_refused(&String::from_utf8_lossy(&bytes))?;
    }

    #[test]
    fn altered_scenes_are_read_or_refused(
        edits in prop::collection::vec((0_usize..1000, any::<char>(), 0..4), 1..6),
    ) {
        let mut text: Vec<char> = SCENE.chars().collect();
        for (place, other, how) in edits {
            let place = place % text.len();
            match how {
                0 => text[place] = other,
                1 => text.insert(place, other),
                2 => drop(text.remove(place)),
                _ => text.insert(place, ['0', '5', ',', '-', '"', '{', '}', '['][other as usize % 8]),
            }
        }
        let read = |_: &str| Ok(MESH.to_owned());
        let text: String = text.into_iter().collect();
        if let Err(error) = Scene::from_json(&text, &mut { read }) {
            let said = error.to_string();
            prop_assert!(said.contains("line ") || said.starts_with("at `"), "{}", said);
        }
    }

    /// Places on a small grid: edges cross, touch and overlap, corners repeat. Whatever is cut is cut rightly.
    #[test]
    fn polygons_on_a_grid_are_filled_or_refused(
        corners in prop::collection::vec((0..5_i32, 0..5_i32), 3..12),
    ) {
        let corners: Vec<(f64, f64)> =
            corners.into_iter().map(|(x, y)| (f64::from(x), f64::from(y))).collect();
        let corners = plane(&corners);
        let text = face(&corners);
        if let Ok(found) = triangles(&text, Normals::Flat) {
            prop_assert!((area(&found) - shoelace(&corners).abs()).abs() < 1e-9);
            let sign = found[0].normals[0].z;
            prop_assert!(found.iter().all(|triangle| triangle.normals[0].z == sign));
        }
        read_or_refused(&text)?;
    }

    /// Any radii around a middle make a simple polygon.
    #[test]
    fn stars_are_filled(
        radii in prop::collection::vec(0.05..1.0_f64, 4..40),
        (start, tilt) in (0_usize..40, -0.9..0.9_f64),
    ) {
        let count = radii.len();
        let mut corners: Vec<Vector> = (0..count).map(|index| {
            let (sine, cosine) = (index as f64 * std::f64::consts::TAU / count as f64).sin_cos();
            Vector::new(radii[index] * cosine, radii[index] * sine, 0.0)
        }).collect();
        corners.rotate_left(start % count);
        let wanted = shoelace(&corners);
        fills(&corners, wanted);
        let lean = (1.0 + tilt * tilt).sqrt();
        let tilted: Vec<Vector> =
            corners.iter().map(|of| Vector::new(of.x, of.y, tilt * of.x)).collect();
        fills(&tilted, wanted * lean);
    }
}
