//! From highlights to a picture in display codes.

use rayon::prelude::*;

use super::colour::Codes;
use super::samples::Samples;
use crate::scene::{Scene, Vector};

/// A picture in display codes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Picture {
    /// Pixels of a row.
    pub width: u32,
    /// The number of rows.
    pub height: u32,
    /// Bits of a code.
    pub bits: u32,
    /// Red, green and blue of each pixel, row by row from the upper left.
    pub codes: Vec<[u16; 3]>,
}

/// The picture with these highlights, one for each sample:
///
/// light of a pixel = ambient · ambient light + Σ light · (diffuse · N·L + specular · highlight), where N·L > 0
#[must_use]
pub fn shade(scene: &Scene, samples: &Samples, codes: &Codes, highlights: &[f64]) -> Picture {
    let coded = |light: Vector| light.coordinates().map(|part| codes.of(part));
    let shaded = |(index, pixel): (usize, &super::samples::SurfacePixel)| {
        let material = &scene.materials[usize::from(pixel.material)];
        let mut light = times(material.ambient, scene.ambient_light);
        let first = index * samples.lights;
        for (place, source) in (first..).zip(&scene.lights) {
            let lit = samples.samples[place].lit;
            if lit > 0.0 {
                let back = material.diffuse * lit + material.specular * highlights[place];
                light = light + times(source.colour, back);
            }
        }
        coded(light)
    };
    let colours: Vec<[u16; 3]> = samples.pixels.par_iter().enumerate().map(shaded).collect();
    let count = samples.width as usize * samples.height as usize;
    let mut picture = vec![coded(scene.background); count];
    for (pixel, colour) in samples.pixels.iter().zip(colours) {
        picture[pixel.pixel as usize] = colour;
    }
    let (width, height) = (samples.width, samples.height);
    Picture { width, height, bits: codes.bits(), codes: picture }
}

fn times(one: Vector, other: Vector) -> Vector {
    Vector::new(one.x * other.x, one.y * other.y, one.z * other.z)
}
