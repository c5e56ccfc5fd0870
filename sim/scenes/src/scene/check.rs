//! From a description to a scene: every value checked, and meshes loaded.

use std::collections::HashMap;
use std::io;

use hw_model::exponents::MAX_EXPONENT;
use hw_model::names;

use super::checked::{Light, Material, Origin, Scene, Shape, Surface, View};
use super::description::{self as said, Description, Geometry, Triple};
use super::error::{MeshError, SceneError};
use super::mesh::{Mesh, Triangle};
use super::obj::{GREATEST_COORDINATE, MOST_MATERIALS, MOST_TRIANGLES};
use super::vector::Vector;

/// Pixels of the longest side of a picture.
pub(crate) const GREATEST_SIDE: u32 = 16_384;
/// Pixels times lights of a picture: 64 million take some 4 GB.
pub(crate) const MOST_SAMPLES: u64 = 1 << 26;
/// The bits that a display code can have.
pub(crate) const DISPLAY_BITS: [u32; 3] = [8, 10, 12];
/// The most lights.
const MOST_LIGHTS: usize = 16;
/// The brightest light.
const BRIGHTEST: f64 = 100.0;

type Checked<T> = Result<T, SceneError>;

fn wrong<T>(path: impl Into<String>, problem: impl Into<String>) -> Checked<T> {
    Err(SceneError::Value { path: path.into(), problem: problem.into() })
}

pub(super) fn scene(description: &Description, read: &mut dyn FnMut(&str) -> io::Result<String>) -> Checked<Scene> {
    if let Err(error) = names::label(&description.name) {
        return wrong("name", error.to_string());
    }
    image(&description.image, description.lights.len())?;
    let view = view(&description.camera)?;
    let lights = lights(&description.lights)?;
    let materials = materials(&description.materials)?;
    let surfaces = surfaces(&description.geometry, &materials, read)?;
    outside(&view, description)?;
    Ok(Scene {
        name: description.name.clone(),
        image: description.image,
        angle: description.angle,
        view,
        background: colour("background", description.background, 1.0)?,
        ambient_light: colour("ambient_light", description.ambient_light, BRIGHTEST)?,
        lights,
        materials,
        surfaces,
    })
}

pub(super) fn image(image: &said::Image, lights: usize) -> Checked<()> {
    for (field, side) in [("width", image.width), ("height", image.height)] {
        if !(1..=GREATEST_SIDE).contains(&side) {
            let problem = format!("{side} pixels; use 1 to {GREATEST_SIDE}");
            return wrong(format!("image.{field}"), problem);
        }
    }
    let pixels = u64::from(image.width) * u64::from(image.height);
    if pixels * lights.max(1) as u64 > MOST_SAMPLES {
        let problem = format!("{pixels} pixels times {lights} lights; use at most {MOST_SAMPLES} together");
        return wrong("image", problem);
    }
    if !DISPLAY_BITS.contains(&image.display_bits) {
        let problem = format!("{} bits; use 8, 10 or 12", image.display_bits);
        return wrong("image.display_bits", problem);
    }
    Ok(())
}

fn view(camera: &said::Camera) -> Checked<View> {
    let position = place("camera.position", camera.position)?;
    let look_at = place("camera.look_at", camera.look_at)?;
    let Some(forward) = (look_at - position).unit() else {
        return wrong("camera.look_at", "the camera looks at its own place; choose another one");
    };
    let up = direction("camera.up", camera.up)?;
    let right = forward.cross(up);
    let Some(right) = right.unit().filter(|_| right.length() > 1e-6) else {
        return wrong("camera.up", "up is the direction of the view; choose one at an angle to it");
    };
    let degrees = camera.field_of_view_degrees;
    if !(0.01..=170.0).contains(&degrees) {
        let problem = format!("{degrees} degrees; use 0.01 to 170 (40 is usual)");
        return wrong("camera.field_of_view_degrees", problem);
    }
    let half_height = core_math::tan(degrees.to_radians() / 2.0);
    Ok(View { position, forward, right, up: right.cross(forward), half_height })
}

fn lights(lights: &[said::Light]) -> Checked<Vec<Light>> {
    if !(1..=MOST_LIGHTS).contains(&lights.len()) {
        return wrong("lights", format!("{} lights; use 1 to {MOST_LIGHTS}", lights.len()));
    }
    let light = |(index, light): (usize, &said::Light)| {
        let (path, origin, colour_said) = match light {
            said::Light::Directional(light) => {
                let path = format!("lights[{index}].directional");
                let towards = direction(&format!("{path}.towards"), light.towards)?;
                (path, Origin::Direction(towards), light.colour)
            }
            said::Light::Point(light) => {
                let path = format!("lights[{index}].point");
                let position = place(&format!("{path}.position"), light.position)?;
                (path, Origin::Place(position), light.colour)
            }
        };
        let colour = colour(&format!("{path}.colour"), colour_said, BRIGHTEST)?;
        Ok(Light { origin, colour })
    };
    lights.iter().enumerate().map(light).collect()
}

fn materials(materials: &[said::Material]) -> Checked<Vec<Material>> {
    if !(1..=MOST_MATERIALS).contains(&materials.len()) {
        let problem = format!("{} materials; use 1 to {MOST_MATERIALS}", materials.len());
        return wrong("materials", problem);
    }
    let mut names = HashMap::new();
    let material = |(index, material): (usize, &said::Material)| {
        let path = format!("materials[{index}]");
        let said::Material { name, exponent, ambient, diffuse, specular } = material;
        if name.is_empty() {
            return wrong(format!("{path}.name"), "is empty; geometry needs a name to call it by");
        }
        if let Some(first) = names.insert(name.clone(), index) {
            let problem = format!("{name:?} is the name of materials[{first}] too; choose another");
            return wrong(format!("{path}.name"), problem);
        }
        if !(1.0..=MAX_EXPONENT).contains(exponent) {
            let problem = format!("{exponent} is out of range; exponents are numbers from 1 to 1e15");
            return wrong(format!("{path}.exponent"), problem);
        }
        let part = |field: &str, of: &Triple| colour(&format!("{path}.{field}"), *of, 1.0);
        Ok(Material {
            name: name.clone(),
            exponent: *exponent,
            ambient: part("ambient", ambient)?,
            diffuse: part("diffuse", diffuse)?,
            specular: part("specular", specular)?,
        })
    };
    materials.iter().enumerate().map(material).collect()
}

fn surfaces(
    geometry: &[Geometry],
    materials: &[Material],
    read: &mut dyn FnMut(&str) -> io::Result<String>,
) -> Checked<Vec<Surface>> {
    if geometry.is_empty() {
        return wrong("geometry", "there is nothing to see; give at least one sphere, plane or mesh");
    }
    let mut surfaces = Vec::new();
    for (index, geometry) in geometry.iter().enumerate() {
        let path = format!("geometry[{index}]");
        match geometry {
            Geometry::Sphere(sphere) => {
                let path = format!("{path}.sphere");
                let material = material_of(&format!("{path}.material"), &sphere.material, materials)?;
                let shape = Shape::Sphere {
                    centre: place(&format!("{path}.centre"), sphere.centre)?,
                    radius: size(&format!("{path}.radius"), sphere.radius)?,
                };
                surfaces.push(Surface { shape, material });
            }
            Geometry::Plane(plane) => {
                let path = format!("{path}.plane");
                let material = material_of(&format!("{path}.material"), &plane.material, materials)?;
                let shape = Shape::Plane {
                    point: place(&format!("{path}.point"), plane.point)?,
                    normal: direction(&format!("{path}.normal"), plane.normal)?,
                };
                surfaces.push(Surface { shape, material });
            }
            Geometry::Mesh(file) => {
                let path = format!("{path}.mesh");
                surfaces.extend(mesh_surfaces(&path, file, materials, read)?);
                if surfaces.len() > MOST_TRIANGLES {
                    let problem = format!("there are more than {MOST_TRIANGLES} triangles; use a coarser mesh");
                    return wrong(format!("{path}.file"), problem);
                }
            }
        }
    }
    Ok(surfaces)
}

fn mesh_surfaces(
    path: &str,
    file: &said::MeshFile,
    materials: &[Material],
    read: &mut dyn FnMut(&str) -> io::Result<String>,
) -> Checked<Vec<Surface>> {
    let material = material_of(&format!("{path}.material"), &file.material, materials)?;
    let position = place(&format!("{path}.position"), file.position)?;
    let scale = size(&format!("{path}.scale"), file.scale)?;
    let refused = |source| SceneError::Mesh { path: format!("{path}.file"), file: file.file.clone(), source };
    let text = read(&file.file).map_err(|error| refused(MeshError::Read(error.into())))?;
    let mesh = Mesh::read(&text, file.normals).map_err(refused)?;
    // By its place in the file's own list, the material of the scene.
    let mut own = Vec::new();
    if file.usemtl {
        for name in &mesh.materials {
            own.push(material_of(&format!("{path}.usemtl"), name, materials)?);
        }
    }
    let surface = |(mut triangle, place): (Triangle, Option<u16>)| {
        triangle.corners = triangle.corners.map(|corner| corner * scale + position);
        let material = place.and_then(|place| own.get(usize::from(place)).copied()).unwrap_or(material);
        Surface { shape: Shape::Triangle(triangle), material }
    };
    Ok(mesh.triangles.into_iter().zip(mesh.material_of).map(surface).collect())
}

fn material_of(path: &str, name: &str, materials: &[Material]) -> Checked<u16> {
    match materials.iter().position(|material| material.name == name) {
        Some(index) => Ok(index as u16),
        None => {
            let names: Vec<String> = materials.iter().map(|m| format!("{:?}", m.name)).collect();
            let problem = format!("there is no material {name:?}; there is {}", names.join(", "));
            wrong(path, problem)
        }
    }
}

/// A sphere has no inside that could be seen.
fn outside(view: &View, description: &Description) -> Checked<()> {
    let spheres = description.geometry.iter().enumerate().filter_map(|(index, geometry)| {
        let Geometry::Sphere(sphere) = geometry else { return None };
        Some((index, Vector::from(sphere.centre), sphere.radius))
    });
    for (index, centre, radius) in spheres {
        if (view.position - centre).length() <= radius {
            let problem = format!("the camera is inside the sphere geometry[{index}]; move it out");
            return wrong("camera.position", problem);
        }
    }
    Ok(())
}

fn place(path: &str, triple: Triple) -> Checked<Vector> {
    if triple.iter().any(|coordinate| coordinate.abs() > GREATEST_COORDINATE) {
        return wrong(path, "a coordinate is out of range; use numbers from -1e9 to 1e9");
    }
    Ok(triple.into())
}

fn direction(path: &str, triple: Triple) -> Checked<Vector> {
    match place(path, triple)?.unit() {
        Some(unit) => Ok(unit),
        None => wrong(path, "a direction of length 0 points nowhere; use for example [0, 1, 0]"),
    }
}

fn size(path: &str, size: f64) -> Checked<f64> {
    if (1.0 / GREATEST_COORDINATE..=GREATEST_COORDINATE).contains(&size) {
        return Ok(size);
    }
    wrong(path, format!("{size} is out of range; use a number above 0, from 1e-9 to 1e9"))
}

fn colour(path: &str, triple: Triple, greatest: f64) -> Checked<Vector> {
    for part in triple {
        if !(0.0..=greatest).contains(&part) {
            let problem = format!("{part} is no part of a colour here; use 0 to {greatest}");
            return wrong(path, problem);
        }
    }
    Ok(triple.into())
}
