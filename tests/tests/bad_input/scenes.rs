//! Scenes and meshes that are none, or cannot be rendered: the message names the way to the value, or the line of the
//! mesh, and what would be right.

use blysk_tests::bench;
use blysk_tests::cli::Bench;

const SCENE: &str = r#"{
  "name": "test",
  "image": {"width": 16, "height": 12},
  "camera": {"position": [0, 0, 5], "look_at": [0, 0, 0], "up": [0, 1, 0], "field_of_view_degrees": 40},
  "lights": [
    {"directional": {"towards": [1, 1, 1], "colour": [1, 1, 1]}},
    {"point": {"position": [3, 3, 3], "colour": [1, 1, 1]}}
  ],
  "materials": [
    {"name": "a", "exponent": 4, "diffuse": [0.5, 0.5, 0.5], "specular": [1, 1, 1]},
    {"name": "b", "exponent": 8, "diffuse": [0.5, 0.5, 0.5], "specular": [1, 1, 1]}
  ],
  "geometry": [
    {"sphere": {"centre": [0, 0, 0], "radius": 1, "material": "a"}},
    {"plane": {"point": [0, -1, 0], "normal": [0, 1, 0], "material": "b"}},
    {"mesh": {"file": "m.obj", "material": "b"}}
  ]
}
"#;

const MESH: &str = "# a comment\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\n";

fn edited(from: &str, to: &str) -> String {
    let edited = SCENE.replacen(from, to, 1);
    assert_ne!(edited, SCENE, "{from:?} is not in the scene");
    edited
}

fn refused(bench: &Bench, scene: &str, said: &[&str]) {
    bench.write("scene.json", scene);
    let said = [said, &["scene.json"]].concat();
    bench.refused("render scene.json --config small.json --out new/deep", &said);
    bench.refused("scene scene.json", &said);
}

fn with_mesh() -> Bench {
    let bench = bench!();
    bench.write("m.obj", MESH);
    bench.write("scene.json", SCENE);
    let _rendered = bench.good("render scene.json --config small.json");
    bench
}

#[test]
fn json_that_is_no_scene() {
    let bench = with_mesh();
    for (scene, said) in [
        ("", &["the file is empty"][..]),
        ("[]", &["line 1 column"]),
        (&SCENE[..200], &["EOF", "line 6"]),
        (&format!("{SCENE} x"), &["trailing", "line 19"]),
        (&edited("\"image\"", "\"imag\""), &["`imag`", "`image`", "line 3"]),
        (&edited("\"up\"", "\"upp\""), &["`camera.upp`", "`upp`", "`up`", "line 4"]),
        (&edited("\"radius\"", "\"size\""), &["`geometry[0].sphere.size`", "`radius`", "line 14"]),
        (&edited("\"sphere\"", "\"ball\""), &["`geometry[0]", "`ball`", "`sphere`"]),
        (&edited("\"directional\"", "\"sun\""), &["`lights[0]", "`sun`", "`directional`"]),
        (&edited("\"exponent\": 8, ", ""), &["`materials[1]`", "missing field `exponent`"]),
        (&edited("\"exponent\": 8", "\"exponent\": \"8\""), &["`materials[1].exponent`", "string"]),
        (&edited("\"exponent\": 8", "\"exponent\": NaN"), &["line 11 column"]),
        (&edited("\"exponent\": 8", "\"exponent\": 8,5"), &["line 11 column", "`8,5` a decimal comma? write 8.5"]),
        (&edited("[3, 3, 3]", "[3, 3]"), &["`lights[1].point.position", "array of length 3"]),
        (&edited("[3, 3, 3]", "[3, 3, 3, 3]"), &["`lights[1].point.position"]),
        (&edited("[3, 3, 3]", "[3, 3, null]"), &["`lights[1].point.position[2]`", "null"]),
        (&edited("\"width\": 16", "\"width\": -16"), &["`image.width`", "-16"]),
        (&edited("\"width\": 16", "\"width\": 1.5"), &["`image.width`", "1.5"]),
        (&edited("\"name\"", "\"angle\": \"cook\", \"name\""), &["`angle`", "`cook`", "`phong`", "`blinn`"]),
        (&edited("\"name\"", "\"name\": \"x\", \"name\""), &["duplicate field `name`"]),
    ] {
        refused(&bench, scene, said);
    }
    bench.write("scene.json", [0xff, 0xfe]);
    bench.refused("scene scene.json", &["cannot read the scene scene.json", "UTF-8"]);
    bench.refused("scene none.json", &["cannot read the scene none.json", "No such file"]);
    bench.refused("scene .", &["cannot read the scene .", "directory"]);
    bench.refused("scene", &["<FILE>"]);
    bench.refused("render --config small.json", &["<SCENE>"]);
    bench.refused("render scene.json", &["--preset", "--config"]);
}

#[test]
fn values_that_cannot_be_used() {
    let bench = with_mesh();
    for (from, to, said) in [
        ("\"test\"", "\"../up\"", &["`name`", "letters"][..]),
        ("\"width\": 16", "\"width\": 0", &["`image.width`", "0 pixels", "1 to 16384"]),
        ("\"height\": 12", "\"height\": 16385", &["`image.height`", "16385", "1 to 16384"]),
        ("\"width\": 16, \"height\": 12", "\"width\": 16384, \"height\": 16384", &["`image`", "at most 67108864"]),
        ("\"height\": 12", "\"height\": 12, \"display_bits\": 9", &["`image.display_bits`", "8, 10 or 12"]),
        ("\"look_at\": [0, 0, 0]", "\"look_at\": [0, 0, 5]", &["`camera.look_at`", "its own place"]),
        ("\"up\": [0, 1, 0]", "\"up\": [0, 0, 2]", &["`camera.up`", "direction of the view"]),
        ("\"up\": [0, 1, 0]", "\"up\": [0, 0, 0]", &["`camera.up`", "length 0"]),
        ("degrees\": 40", "degrees\": 0", &["`camera.field_of_view_degrees`", "0.01 to 170"]),
        ("degrees\": 40", "degrees\": 180", &["`camera.field_of_view_degrees`", "0.01 to 170"]),
        ("degrees\": 40", "degrees\": -40", &["`camera.field_of_view_degrees`", "0.01 to 170"]),
        ("\"position\": [0, 0, 5]", "\"position\": [0, 0, 0.5]", &["`camera.position`", "inside", "geometry[0]"]),
        ("\"position\": [0, 0, 5]", "\"position\": [0, 0, 1e10]", &["`camera.position`", "1e9"]),
        ("\"towards\": [1, 1, 1]", "\"towards\": [0, 0, 0]", &["`lights[0].directional.towards`", "length 0"]),
        ("\"colour\": [1, 1, 1]}}\n", "\"colour\": [1, -1, 1]}}\n", &["`lights[1].point.colour`", "-1", "0 to 100"]),
        ("\"specular\": [1, 1, 1]", "\"specular\": [1, 1.5, 1]", &["`materials[0].specular`", "1.5", "0 to 1"]),
        ("\"exponent\": 8", "\"exponent\": 0.5", &["`materials[1].exponent`", "0.5", "1 to 1e15"]),
        ("\"exponent\": 8", "\"exponent\": 1e16", &["`materials[1].exponent`", "1 to 1e15"]),
        ("\"name\": \"b\"", "\"name\": \"a\"", &["`materials[1].name`", "\"a\"", "materials[0]"]),
        ("\"name\": \"b\"", "\"name\": \"\"", &["`materials[1].name`", "empty"]),
        ("\"material\": \"a\"", "\"material\": \"c\"", &["`geometry[0].sphere.material`", "\"c\"", "\"a\", \"b\""]),
        ("\"radius\": 1", "\"radius\": 0", &["`geometry[0].sphere.radius`", "above 0"]),
        ("\"radius\": 1", "\"radius\": -1", &["`geometry[0].sphere.radius`", "above 0"]),
        ("\"normal\": [0, 1, 0]", "\"normal\": [0, 0, 0]", &["`geometry[1].plane.normal`", "length 0"]),
        ("\"m.obj\", ", "\"m.obj\", \"scale\": 0, ", &["`geometry[2].mesh.scale`", "above 0"]),
        ("\"m.obj\"", "\"none.obj\"", &["`geometry[2].mesh.file`", "none.obj", "No such file", "directory"]),
        ("\"m.obj\"", "\"\"", &["`geometry[2].mesh.file`", "cannot be read"]),
    ] {
        refused(&bench, &edited(from, to), said);
    }
    let (before, _) = SCENE.split_once("\"geometry\"").unwrap();
    refused(&bench, &format!("{before}\"geometry\": []}}"), &["`geometry`", "nothing to see"]);
    let (start, rest) = SCENE.split_once("\"lights\": [").unwrap();
    let (_, rest) = rest.split_once("\n  ],").unwrap();
    refused(&bench, &format!("{start}\"lights\": [],{rest}"), &["`lights`", "0 lights", "1 to 16"]);
}

#[test]
fn exponents_the_rom_does_not_have() {
    let bench = with_mesh();
    for exponent in ["9", "2.5"] {
        bench.write("scene.json", edited("\"exponent\": 8", &format!("\"exponent\": {exponent}")));
        bench.refused(
            "render scene.json --config small.json --out new/deep",
            &["scene.json", "`materials[1].exponent`", &format!("n = {exponent}"), "1..=8"],
        );
        let _listed = bench.good("scene scene.json");
    }
}

#[test]
fn meshes_that_are_none() {
    let bench = with_mesh();
    bench.write("scene.json", SCENE);
    for (mesh, said) in [
        ("", &["m.obj", "no face"][..]),
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\n", &["m.obj:", "no face"]),
        (&MESH.replace("v 1 0 0", "v NaN 0 0"), &["m.obj:3:", "NaN", "-1e9 to 1e9"]),
        (&MESH.replace("v 1 0 0", "v inf 0 0"), &["m.obj:3:", "inf"]),
        (&MESH.replace("v 1 0 0", "v 1e300 0 0"), &["m.obj:3:", "1e300"]),
        (&MESH.replace("v 1 0 0", "v one 0 0"), &["m.obj:3:", "\"one\"", "v x y z"]),
        (&MESH.replace("v 1 0 0", "v 1 0"), &["m.obj:3:", "missing", "v x y z"]),
        (&MESH.replace("v 1 0 0", "v 0 0 0").replace("f 2 4 3", "f 2 2 3"), &["m.obj:7:", "no face", "area"]),
        (&MESH.replace("f 2 4 3", "f 2 5 3"), &["m.obj:7:", "v 5", "there are 4"]),
        (&MESH.replace("f 2 4 3", "f 2 0 3"), &["m.obj:7:", "\"0\"", "count from 1"]),
        (&MESH.replace("f 2 4 3", "f 2 -5 3"), &["m.obj:7:", "\"-5\""]),
        (&MESH.replace("f 2 4 3", "f 2 4"), &["m.obj:7:", "3 corners"]),
        (&MESH.replace("f 2 4 3", "f 2 four 3"), &["m.obj:7:", "\"four\""]),
        (&MESH.replace("f 2 4 3", "f 2 4/1/1/1 3"), &["m.obj:7:", "v/vt/vn"]),
        (&MESH.replace("f 2 4 3", "f 2//1 4//1 3//1"), &["m.obj:7:", "vn 1", "there are 0"]),
        (&MESH.replace("f 2 4 3", "vn 0 0 1\nf 2//1 4 3//1"), &["m.obj:8:", "some corners"]),
        (&MESH.replace("f 2 4 3", "f 2/1 4/1 3/1"), &["m.obj:7:", "vt 1", "there are 0"]),
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 0\nf 1//1 2//1 3//1\n", &["m.obj:4:", "length 0"]),
        (
            // Two triangles back to back: their normals cancel.
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 3 2\n",
            &["m.obj:4:", "cancel", "flat"],
        ),
    ] {
        bench.write("m.obj", mesh);
        let said = [said, &["scene.json", "`geometry[2].mesh.file`"]].concat();
        bench.refused("render scene.json --config small.json --out new/deep", &said);
    }
    for (bytes, said) in [
        (&b"v\xff"[..], &["m.obj:1:", "no face"][..]),
        (b"v 0 0 0\nv \xb5 0 0\n", &["m.obj:2:", "\"?\"", "not a number"]),
        (b"v 0 0 0\nv 1 \0 0\n", &["m.obj:2:", "byte of 0"]),
        (b"v\0 \x000\0\n\0", &["m.obj cannot be read", "UTF-16LE", "UTF-8"]),
        (b"", &["m.obj cannot be read", "empty", "`f a b c`"]),
    ] {
        bench.write("m.obj", bytes);
        bench.refused("scene scene.json", said);
    }
    let flat = edited("\"m.obj\", ", "\"m.obj\", \"normals\": \"flat\", ");
    bench.write("flat.json", flat);
    bench.write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 3 2\n");
    let _flat = bench.good("render flat.json --config small.json");
}

#[test]
fn options_of_render_and_mesh() {
    let bench = with_mesh();
    for (options, said) in [
        ("--size 0x4", &["--size 0x4", "image.width"][..]),
        ("--size 16385x4", &["16384"]),
        ("--size 640", &["\"640\"", "1920x1080"]),
        ("--size 6x-4", &["1920x1080"]),
        ("--clock-mhz 0", &["\"0\"", "MHz"]),
        ("--clock-mhz NaN", &["\"NaN\"", "MHz"]),
        ("--format xml", &["xml", "table, csv, json"]),
    ] {
        bench.refused(&format!("render scene.json --config small.json --out new {options}"), said);
    }
    for (options, said) in [
        ("--around 0", &["--around 0", "1 to 16"][..]),
        ("--around 2 --through 4", &["common divisor", "2 and 3"]),
        ("--along 2", &["--along 2", "3 to 100000"]),
        ("--sides 2", &["--sides 2", "3 to 10000"]),
        ("--along 100000 --sides 10000", &["triangles", "4000000"]),
        ("--tube NaN", &["--tube NaN", "0.01 to 0.5"]),
        ("--tube 0.6", &["--tube 0.6", "0.01 to 0.5"]),
    ] {
        bench.refused(&format!("mesh --out new/m.obj {options}"), said);
    }
}

/// A file in the way of a picture: nothing of the set is written, and the files that were there stay.
#[test]
fn places_that_cannot_be_written() {
    let bench = with_mesh();
    bench.write("file", "keep me");
    let render = "render scene.json --config small.json";
    for place in ["file", "file/dir"] {
        bench.refused(&format!("{render} --out {place}"), &[place, "a file is in the way"]);
    }
    bench.refused("mesh --out file/m.obj", &["file", "a file is in the way"]);
    std::fs::create_dir_all(bench.path("taken/methods.png")).unwrap();
    bench.refused(&format!("{render} --out taken"), &["methods.png", "not a regular file"]);
    assert_eq!(bench.text("file"), "keep me");
}
