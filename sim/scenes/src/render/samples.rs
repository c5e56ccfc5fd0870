//! What geometry and lights present, for every pixel: N·L and x in f64, before any hardware and any colour.

use rayon::prelude::*;

use super::angle::presented;
use super::bvh::Bvh;
use super::rays::ray;
use crate::scene::Scene;
use vectors::progress::Progress;

pub use super::angle::Presented as Sample;

/// A pixel that shows a surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SurfacePixel {
    /// Row times width plus column, from the upper left.
    pub pixel: u32,
    /// The place of its material in [`Scene::materials`].
    pub material: u16,
}

/// What a picture presents. Every surface pixel has one sample for each light.
#[derive(Debug, Clone, PartialEq)]
pub struct Samples {
    /// Pixels of a row.
    pub width: u32,
    /// The number of rows of the picture.
    pub height: u32,
    /// Lights of the scene, samples of a surface pixel.
    pub lights: usize,
    /// The pixels that show a surface, in the order of the picture.
    pub pixels: Vec<SurfacePixel>,
    /// The samples of the first of them, light by light, then those of the second, and so on.
    pub samples: Vec<Sample>,
}

impl Samples {
    /// Each sample with the material it belongs to, in the order of `samples`.
    pub fn with_material(&self) -> impl Iterator<Item = (u16, Sample)> {
        let materials = self.pixels.iter().flat_map(|pixel| std::iter::repeat_n(pixel.material, self.lights));
        materials.zip(self.samples.iter().copied())
    }

    /// The material of a sample.
    #[must_use]
    pub fn material_of(&self, sample: usize) -> u16 {
        self.pixels[sample / self.lights].material
    }

    /// The samples of every `step`-th column and row, as a picture of their own.
    #[must_use]
    pub fn every(&self, step: u32) -> Self {
        let (width, height) = (self.width.div_ceil(step), self.height.div_ceil(step));
        let mut thinned = Self { width, height, pixels: Vec::new(), samples: Vec::new(), ..*self };
        for (pixel, samples) in self.pixels.iter().zip(self.samples.chunks_exact(self.lights)) {
            let (row, column) = (pixel.pixel / self.width, pixel.pixel % self.width);
            if row % step == 0 && column % step == 0 {
                let place = row / step * width + column / step;
                thinned.pixels.push(SurfacePixel { pixel: place, ..*pixel });
                thinned.samples.extend_from_slice(samples);
            }
        }
        thinned
    }
}

/// What the picture presents; `progress` counts pixels. One ray for each pixel, through its middle.
#[must_use]
pub fn samples(scene: &Scene, progress: &dyn Progress) -> Samples {
    let bvh = Bvh::new(&scene.surfaces);
    let image = &scene.image;
    let row = |row: u32| {
        let mut found = (Vec::new(), Vec::new());
        for column in 0..image.width {
            let ray = ray(&scene.view, image, f64::from(column) + 0.5, f64::from(row) + 0.5);
            let Some((hit, material)) = bvh.first(&ray) else { continue };
            found.0.push(SurfacePixel { pixel: row * image.width + column, material });
            let place = ray.origin + ray.direction * hit.distance;
            let of = |light| presented(scene.angle, light, place, hit.normal, -ray.direction);
            found.1.extend(scene.lights.iter().map(of));
        }
        progress.advance(image.width.into());
        found
    };
    let rows: Vec<_> = (0..image.height).into_par_iter().map(row).collect();
    let mut samples = Samples {
        width: image.width,
        height: image.height,
        lights: scene.lights.len(),
        pixels: Vec::with_capacity(rows.iter().map(|row| row.0.len()).sum()),
        samples: Vec::with_capacity(rows.iter().map(|row| row.1.len()).sum()),
    };
    for (pixels, presented) in rows {
        samples.pixels.extend(pixels);
        samples.samples.extend(presented);
    }
    samples
}
