//! A camera that the model fills the picture of, and a light over its shoulder.

use crate::scene::{
    Angle, Camera, Description, Directional, Geometry, Image, LightDescription as Light,
    MaterialDescription as Material, MeshFile, Normals, Transfer, Vector,
};

use super::error::ImportError;
use super::wish::Wish;

/// The angle from the lower to the upper edge of the picture: that of a portrait lens.
const FIELD_OF_VIEW_DEGREES: f64 = 30.0;
/// How much of the picture's half the model may fill.
const FILLED: f64 = 0.92;
/// From the middle of the model to the camera: from the right, from above, from the front.
const TOWARDS_CAMERA: [f64; 3] = [0.55, 0.4, 1.0];
/// From the model to the light, in the picture: from the left, from above, from the camera's side.
const TOWARDS_LIGHT: [f64; 3] = [-0.5, 0.7, 0.8];

/// A scene of one mesh with these materials, seen from where it fills the picture.
///
/// For a corner at p from the middle, with f the direction of the view and D the camera's distance, the corner is in
/// the picture where |p·up| ≤ h·(D + p·f) and |p·right| ≤ w·(D + p·f), h and w being the tangents of half the angles of
/// view. So D is the greatest of |p·up|/h − p·f and |p·right|/w − p·f.
///
/// # Errors
/// Where all corners are in one place.
pub(super) fn scene(
    wish: &Wish,
    description: String,
    corners: impl Iterator<Item = Vector> + Clone,
    materials: Vec<Material>,
    normals: Normals,
    angle: Angle,
) -> Result<Description, ImportError> {
    let middle = middle(corners.clone());
    let up = wish.up.turn([0.0, 1.0, 0.0]);
    let towards = wish.up.turn(TOWARDS_CAMERA).unit().unwrap_or(up);
    let forward = -towards;
    let right = forward.cross(up).unit().unwrap_or(up);
    let above = right.cross(forward);
    let half_height = core_math::tan(FIELD_OF_VIEW_DEGREES.to_radians() / 2.0) * FILLED;
    let half_width = half_height * f64::from(wish.size.0) / f64::from(wish.size.1);
    let distance = corners
        .map(|corner| corner - middle)
        .map(|p| (p.dot(above).abs() / half_height).max(p.dot(right).abs() / half_width) - p.dot(forward))
        .fold(0.0, f64::max);
    if distance <= 0.0 {
        return Err(ImportError::NoSize);
    }
    let [x, y, z] = TOWARDS_LIGHT;
    let light = right * x + above * y + towards * z;
    let default = materials.first().map(|material| material.name.clone()).unwrap_or_default();
    Ok(Description {
        schema: None,
        name: wish.name.clone(),
        description,
        image: Image { width: wish.size.0, height: wish.size.1, display_bits: 8, transfer: Transfer::Srgb },
        angle,
        camera: Camera {
            position: rounded(middle + towards * distance, distance),
            look_at: rounded(middle, distance),
            up: up.coordinates(),
            field_of_view_degrees: FIELD_OF_VIEW_DEGREES,
        },
        background: [0.03, 0.035, 0.05],
        ambient_light: [0.2, 0.2, 0.2],
        lights: vec![Light::Directional(Directional { towards: rounded(light, 1.0), colour: [0.9, 0.9, 0.9] })],
        materials,
        geometry: vec![Geometry::Mesh(MeshFile {
            file: wish.mesh.clone(),
            material: default,
            usemtl: true,
            position: [0.0; 3],
            scale: 1.0,
            normals,
        })],
    })
}

/// The middle of the box that the corners are in.
fn middle(corners: impl Iterator<Item = Vector>) -> Vector {
    let (mut least, mut greatest) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for corner in corners {
        let corner = corner.coordinates();
        for axis in 0..3 {
            least[axis] = least[axis].min(corner[axis]);
            greatest[axis] = greatest[axis].max(corner[axis]);
        }
    }
    (Vector::from(least) + Vector::from(greatest)) * 0.5
}

/// To a ten-thousandth of a size, in decimals, for people who edit the scene.
fn rounded(place: Vector, size: f64) -> [f64; 3] {
    let decimals = (4.0 - core_math::log10(size).floor()).clamp(0.0, 17.0) as usize;
    // Adding 0 takes the sign from what was rounded to -0.
    place.coordinates().map(|coordinate| format!("{coordinate:.decimals$}").parse().unwrap_or(coordinate) + 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::import::UpAxis;

    fn wish(size: (u32, u32), up: UpAxis) -> Wish {
        Wish { name: "model".into(), mesh: "model.obj".into(), size, up }
    }

    fn grey() -> Vec<Material> {
        let colour = [0.5; 3];
        vec![Material { name: "grey".into(), exponent: 8.0, ambient: colour, diffuse: colour, specular: colour }]
    }

    /// Every corner is inside, and the outermost nearly at an edge.
    #[test]
    fn the_model_fills_the_picture() {
        for (size, up) in [((640, 360), UpAxis::Y), ((300, 900), UpAxis::Z)] {
            for scale in [1e-6, 1.0, 250.0, 1e7] {
                let corners: Vec<Vector> = (0..8)
                    .map(|i| Vector::new(f64::from(i & 1), f64::from(i >> 1 & 1) * 2.0, f64::from(i >> 2)) * scale)
                    .collect();
                let made = scene(
                    &wish(size, up),
                    String::new(),
                    corners.iter().copied(),
                    grey(),
                    Normals::Smooth,
                    Angle::Phong,
                );
                let camera = made.unwrap().camera;
                let position = Vector::from(camera.position);
                let forward = (Vector::from(camera.look_at) - position).unit().unwrap();
                let right = forward.cross(Vector::from(camera.up)).unit().unwrap();
                let above = right.cross(forward);
                let half = core_math::tan(camera.field_of_view_degrees.to_radians() / 2.0);
                let aspect = f64::from(size.0) / f64::from(size.1);
                let mut outermost: f64 = 0.0;
                for corner in &corners {
                    let seen = *corner - position;
                    let depth = seen.dot(forward);
                    assert!(depth > 0.0);
                    let y = seen.dot(above) / depth / half;
                    let x = seen.dot(right) / depth / half / aspect;
                    outermost = outermost.max(x.abs()).max(y.abs());
                }
                assert!((0.9..0.94).contains(&outermost), "{outermost} {size:?} {scale}");
            }
        }
    }

    #[test]
    fn a_model_of_one_place_is_refused() {
        let corners = std::iter::repeat_n(Vector::new(1.0, 2.0, 3.0), 3);
        let made = scene(&wish((4, 4), UpAxis::Y), String::new(), corners, grey(), Normals::Flat, Angle::Phong);
        assert!(matches!(made, Err(ImportError::NoSize)));
    }
}
