//! The triangles of a document as the text of an OBJ file.

use std::fmt::Write;

use crate::import::error::ImportError;
use crate::scene::{MOST_TRIANGLES, MOST_VECTORS, Vector, has_area};
use vectors::text_file::MESH;

/// An OBJ file under way.
pub(super) struct ObjText {
    text: String,
    positions: usize,
    triangles: usize,
    without_area: usize,
    material: String,
    others: usize,
}

/// Corners of one primitive, in the scene's coordinates.
pub(super) struct Corners {
    pub(super) positions: Vec<Vector>,
    /// As many as positions, or none.
    pub(super) normals: Vec<Option<Vector>>,
}

impl ObjText {
    pub(super) fn new(name: &str) -> Self {
        let text = format!("# {name}: made by blysk scene import\n");
        Self { text, positions: 0, triangles: 0, without_area: 0, material: String::new(), others: 0 }
    }

    /// A primitive of lines or points, which is not taken.
    pub(super) fn pass_over(&mut self) {
        self.others += 1;
    }

    /// Adds the triangles of one primitive.
    pub(super) fn add(
        &mut self,
        material: &str,
        corners: &Corners,
        triangles: impl Iterator<Item = [usize; 3]>,
    ) -> Result<(), ImportError> {
        // Writing to a string cannot fail.
        if material != self.material {
            let _ = writeln!(self.text, "usemtl {material}");
            material.clone_into(&mut self.material);
        }
        let base = self.positions + 1;
        if corners.positions.len() > MOST_VECTORS.saturating_sub(self.positions) {
            let problem = format!("there are more than {MOST_VECTORS} positions; use a coarser mesh");
            return Err(ImportError::Gltf(problem));
        }
        for place in &corners.positions {
            let [x, y, z] = place.coordinates();
            let _ = writeln!(self.text, "v {x} {y} {z}");
        }
        // One for each position, so that a corner has one number.
        for index in 0..corners.positions.len() {
            let [x, y, z] = corners.normals.get(index).copied().flatten().unwrap_or_default().coordinates();
            let _ = writeln!(self.text, "vn {x} {y} {z}");
        }
        self.positions += corners.positions.len();
        for triangle in triangles {
            let mut places = [Vector::default(); 3];
            for (place, &index) in places.iter_mut().zip(&triangle) {
                let there = corners.positions.get(index).copied();
                *place = there.ok_or_else(|| ImportError::Gltf(format!("index {index} is that of no position")))?;
            }
            if !has_area(places) {
                self.without_area += 1;
                continue;
            }
            self.triangles += 1;
            if self.triangles > MOST_TRIANGLES {
                let problem = format!("there are more than {MOST_TRIANGLES} triangles; use a coarser mesh");
                return Err(ImportError::Gltf(problem));
            }
            let with_normals = triangle.iter().all(|&index| matches!(corners.normals.get(index), Some(Some(_))));
            let _ = self.text.write_str("f");
            for index in triangle.map(|index| index + base) {
                let _ =
                    if with_normals { write!(self.text, " {index}//{index}") } else { write!(self.text, " {index}") };
            }
            let _ = self.text.write_str("\n");
        }
        if self.text.len() as u64 > MESH.most_bytes {
            let problem = "the triangles are too many for an OBJ file that can be read; use a coarser mesh".into();
            return Err(ImportError::Gltf(problem));
        }
        Ok(())
    }

    /// What was left out.
    pub(super) fn remarks(&self) -> Vec<String> {
        let counts = [
            (self.without_area, "triangles without area"),
            (self.others, "primitives of lines, points or strips of them"),
        ];
        let there = counts.into_iter().filter(|&(count, _)| count > 0);
        there.map(|(count, what)| format!("left out: {count} {what}")).collect()
    }

    pub(super) fn finish(self) -> String {
        self.text
    }
}
