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
    let (width, height) = (samples.width, samples.height);
    let lights = lights(scene, samples, highlights);
    Picture {
        width,
        height,
        bits: codes.bits(),
        codes: lights.into_par_iter().map(|light| coded(codes, light)).collect(),
    }
}

/// The picture for looking at, from samples of `side` times as many columns and rows: each pixel is the mean of the
/// light of `side` times `side` samples, each as bright as the display can show.
#[must_use]
pub fn smooth(scene: &Scene, samples: &Samples, codes: &Codes, highlights: &[f64], side: u32) -> Picture {
    let (width, height) = (samples.width / side, samples.height / side);
    let lights = lights(scene, samples, highlights);
    let white = Vector::new(1.0, 1.0, 1.0);
    let pixel = |index: u32| {
        let (row, column) = (index / width * side, index % width * side);
        let rows = (row..row + side).map(|row| (row * samples.width + column) as usize);
        let of_row = |start: usize| lights.iter().skip(start).take(side as usize);
        let sum = rows.flat_map(of_row).fold(Vector::default(), |sum, light| sum + light.least(white));
        coded(codes, sum * (1.0 / f64::from(side * side)))
    };
    Picture { width, height, bits: codes.bits(), codes: (0..width * height).into_par_iter().map(pixel).collect() }
}

fn coded(codes: &Codes, light: Vector) -> [u16; 3] {
    light.coordinates().map(|part| codes.of(part))
}

/// Linear light of every pixel, row by row.
fn lights(scene: &Scene, samples: &Samples, highlights: &[f64]) -> Vec<Vector> {
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
        light
    };
    let colours: Vec<Vector> = samples.pixels.par_iter().enumerate().map(shaded).collect();
    let count = samples.width as usize * samples.height as usize;
    let mut picture = vec![scene.background; count];
    for (pixel, colour) in samples.pixels.iter().zip(colours) {
        picture[pixel.pixel as usize] = colour;
    }
    picture
}

fn times(one: Vector, other: Vector) -> Vector {
    Vector::new(one.x * other.x, one.y * other.y, one.z * other.z)
}
