//! A scene as its file says it: JSON, every field named, nothing checked but its form.
//!
//! `docs/scene.schema.json` is made from these types, and the texts here are its descriptions.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Three coordinates, in the scene's own unit of length.
pub(super) type Triple = [f64; 3];

/// A picture to be rendered: what is seen, by which light, and in how many display codes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "Blysk scene")]
pub struct Description {
    /// Where the schema is, for editors; not read.
    #[serde(default, rename = "$schema", skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// Letters, digits, - and _.
    pub name: String,
    /// One sentence for people.
    #[serde(default)]
    pub description: String,
    /// The picture's size and display codes.
    pub image: Image,
    /// Which angle the highlight falls off with.
    #[serde(default)]
    pub angle: Angle,
    /// Where the picture is seen from.
    pub camera: Camera,
    /// Linear colour, 0 to 1, of pixels that show nothing.
    #[serde(default)]
    pub background: Triple,
    /// Linear colour, 0 and up, of the light that comes from everywhere; it makes no highlight.
    #[serde(default)]
    pub ambient_light: Triple,
    /// At least one, at most 16.
    pub lights: Vec<Light>,
    /// At least one, each with a name of its own.
    pub materials: Vec<Material>,
    /// At least one.
    pub geometry: Vec<Geometry>,
}

/// The picture's size and display codes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Image {
    /// Pixels, 1 to 16384.
    #[schemars(range(min = 1, max = 16384))]
    pub width: u32,
    /// Pixels, 1 to 16384.
    #[schemars(range(min = 1, max = 16384))]
    pub height: u32,
    /// Bits of a display code: 8, 10 or 12.
    #[serde(default = "eight")]
    #[schemars(extend("enum" = [8, 10, 12]))]
    pub display_bits: u32,
    /// From linear light to display codes.
    #[serde(default)]
    pub transfer: Transfer,
}

const fn eight() -> u32 {
    8
}

/// From linear light to display codes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Transfer {
    /// The curve of sRGB (IEC 61966-2-1).
    #[default]
    Srgb,
    /// Codes proportional to light.
    Linear,
}

impl Transfer {
    /// The name in a scene.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Srgb => "srgb",
            Self::Linear => "linear",
        }
    }
}

/// Which angle the highlight falls off with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Angle {
    /// Between the mirrored light and the viewer: x = R·V.
    #[default]
    Phong,
    /// Between the normal and the direction halfway from light to viewer: x = N·H.
    Blinn,
}

impl Angle {
    /// The name in a scene.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Phong => "phong",
            Self::Blinn => "blinn",
        }
    }
}

/// Where the picture is seen from.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Camera {
    /// Where the camera is.
    pub position: Triple,
    /// The place in the middle of the picture.
    pub look_at: Triple,
    /// Which way is up; need not be at a right angle to the view.
    #[serde(default = "second_axis")]
    pub up: Triple,
    /// The angle from the lower to the upper edge of the picture, 0.01 to 170 degrees.
    #[schemars(range(min = 0.01, max = 170))]
    pub field_of_view_degrees: f64,
}

const fn second_axis() -> Triple {
    [0.0, 1.0, 0.0]
}

/// A light. None casts a shadow: what counts is the normal alone.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Light {
    /// From one direction, as from the sun.
    Directional(Directional),
    /// From a place, the same strength at every distance.
    Point(Point),
}

/// A light from one direction.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Directional {
    /// The direction towards the light; its length does not matter.
    pub towards: Triple,
    /// Linear colour, 0 to 100.
    pub colour: Triple,
}

/// A light at a place.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Point {
    /// Where the light is.
    pub position: Triple,
    /// Linear colour, 0 to 100.
    pub colour: Triple,
}

/// What a surface makes of light: ambient, diffuse and specular parts, each a linear colour of 0 to 1.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// What geometry calls it.
    pub name: String,
    /// n of the highlight x^n, 1 and up; the ROM must have a word for it.
    #[schemars(range(min = 1))]
    pub exponent: f64,
    /// Times the ambient light.
    #[serde(default)]
    pub ambient: Triple,
    /// Times the light and the cosine of its angle to the normal.
    pub diffuse: Triple,
    /// Times the light and the highlight.
    pub specular: Triple,
}

/// Something to be seen.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Geometry {
    /// A ball, seen from outside.
    Sphere(Sphere),
    /// A plane without end, seen from both sides.
    Plane(Plane),
    /// Triangles of a Wavefront OBJ file, seen from both sides.
    Mesh(MeshFile),
}

/// A ball.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Sphere {
    /// Its middle.
    pub centre: Triple,
    /// Above 0.
    pub radius: f64,
    /// The name of a material.
    pub material: String,
}

/// A plane.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plane {
    /// A place on it.
    pub point: Triple,
    /// At a right angle to it; its length does not matter.
    pub normal: Triple,
    /// The name of a material.
    pub material: String,
}

/// Triangles of a file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MeshFile {
    /// A Wavefront OBJ file; a relative path starts at the scene's directory. Libraries of materials are not read.
    pub file: String,
    /// The name of a material: of all faces, or with `usemtl` of those that stand before the first such line.
    pub material: String,
    /// Whether the faces after a line `usemtl NAME` of the file have the scene's material of that name.
    #[serde(default, skip_serializing_if = "is_false")]
    pub usemtl: bool,
    /// Where the file's origin is put.
    #[serde(default)]
    pub position: Triple,
    /// Every coordinate of the file times this, above 0.
    #[serde(default = "unchanged")]
    pub scale: f64,
    /// Where normals come from.
    #[serde(default)]
    pub normals: Normals,
}

const fn is_false(flag: &bool) -> bool {
    !*flag
}

const fn unchanged() -> f64 {
    1.0
}

/// Where the normals of a mesh come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Normals {
    /// Those of the file; where it has none, the mean of the triangles around a corner, weighed by their angles
    /// there. Between the corners they are interpolated.
    #[default]
    Smooth,
    /// Those of the flat triangles.
    Flat,
}
