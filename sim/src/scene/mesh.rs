//! Triangles of a Wavefront OBJ file, with a normal at every corner.

use tobj::LoadOptions;

use super::description::Normals;
use super::error::MeshError;
use super::lines::Lines;
use super::vector::Vector;

/// A triangle: where it is, and the normals between which those of its inside are interpolated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Triangle {
    /// Corners, in the scene's coordinates.
    pub corners: [Vector; 3],
    /// Normals at the corners, of length 1. All three are equal where the mesh is flat.
    pub normals: [Vector; 3],
}

impl Triangle {
    /// The normal of its plane, by the right-hand rule, with twice the area as its length.
    #[must_use]
    pub fn plane_normal(&self) -> Vector {
        plane_normal(self.corners)
    }
}

fn plane_normal([a, b, c]: [Vector; 3]) -> Vector {
    (b - a).cross(c - a)
}

/// The corners and normals of a mesh, before they become triangles: indices into both lists.
struct Faces {
    positions: Vec<Vector>,
    corners: Vec<[usize; 3]>,
    /// With the file's own normals.
    normals: Option<(Vec<Vector>, Vec<[usize; 3]>)>,
}

/// The triangles in the text of a Wavefront OBJ file; polygons become fans of triangles.
///
/// # Errors
/// When a line cannot be read, a number is not finite, a triangle has no area, a normal no direction, or there is
/// no triangle at all; with the line.
pub fn triangles(text: &str, normals: Normals) -> Result<Vec<Triangle>, MeshError> {
    let lines = Lines::of(text)?;
    if lines.triangles.is_empty() {
        return Err(MeshError::at(None, "has no face; give at least one line `f a b c`"));
    }
    let options = LoadOptions {
        triangulate: true,
        ignore_points: true,
        ignore_lines: true,
        ..LoadOptions::default()
    };
    // Materials come from the scene: whatever library the file names is not read.
    let skip = |_: &std::path::Path| Err(tobj::LoadError::GenericFailure);
    let (models, _) = tobj::load_obj_buf(&mut text.as_bytes(), &options, skip)
        .map_err(|error| MeshError::at(None, error.to_string()))?;
    let mut found = Vec::with_capacity(lines.triangles.len());
    for model in &models {
        let faces = Faces::of(&model.mesh, lines.have_normals());
        let first = found.len();
        let line = |index: usize| lines.triangles.get(first + index).copied();
        faces.refuse_degenerate(line)?;
        match normals {
            Normals::Flat => found.extend(faces.flat()),
            Normals::Smooth => found.extend(faces.smooth(line)?),
        }
    }
    if found.len() != lines.triangles.len() {
        return Err(MeshError::at(None, "has faces that are no polygons; write them as triangles"));
    }
    Ok(found)
}

fn threes<T: Copy, U>(list: &[T], of: impl Fn([T; 3]) -> U) -> Vec<U> {
    list.as_chunks::<3>().0.iter().map(|&three| of(three)).collect()
}

impl Faces {
    fn of(mesh: &tobj::Mesh, with_normals: bool) -> Self {
        let indices = |list: &[u32]| threes(list, |three| three.map(|index| index as usize));
        let normals = with_normals
            .then(|| (threes(&mesh.normals, Vector::from), indices(&mesh.normal_indices)));
        Self {
            positions: threes(&mesh.positions, Vector::from),
            corners: indices(&mesh.indices),
            normals,
        }
    }

    fn places(&self, corners: [usize; 3]) -> [Vector; 3] {
        corners.map(|index| self.positions[index])
    }

    /// A triangle without area has no plane and no normal. What is left of rounding counts as none: a height of less
    /// than a part in 10¹² of the longest side.
    fn refuse_degenerate(&self, line: impl Fn(usize) -> Option<usize>) -> Result<(), MeshError> {
        const LEAST: f64 = 1e-12;
        for (index, &corners) in self.corners.iter().enumerate() {
            let places @ [a, b, c] = self.places(corners);
            let longest = (b - a).length().max((c - b).length()).max((a - c).length());
            let area = plane_normal(places).length();
            if !(area > LEAST * longest * longest && area > f64::MIN_POSITIVE) {
                let problem = "a triangle of this face has no area: its corners lie on one line; \
                               move a corner or leave the face out";
                return Err(MeshError::at(line(index), problem));
            }
        }
        Ok(())
    }

    fn flat(&self) -> impl Iterator<Item = Triangle> {
        self.corners.iter().map(|&corners| {
            let corners = self.places(corners);
            let normal = plane_normal(corners).unit().unwrap_or_default();
            Triangle { corners, normals: [normal; 3] }
        })
    }

    fn smooth(&self, line: impl Fn(usize) -> Option<usize>) -> Result<Vec<Triangle>, MeshError> {
        let means;
        let (normals, indices) = match &self.normals {
            Some((normals, indices)) => (normals, indices),
            None => {
                means = self.means();
                (&means, &self.corners)
            }
        };
        let units: Vec<Option<Vector>> = normals.iter().map(|normal| normal.unit()).collect();
        let mut triangles = Vec::with_capacity(self.corners.len());
        for (face, (&corners, of)) in self.corners.iter().zip(indices).enumerate() {
            let [Some(a), Some(b), Some(c)] = of.map(|index| units.get(index).copied().flatten())
            else {
                let problem = "the normal at a corner of this face has length 0: the triangles around it \
                               cancel; give normals (vn), or say \"normals\": \"flat\"";
                return Err(MeshError::at(line(face), problem));
            };
            triangles.push(Triangle { corners: self.places(corners), normals: [a, b, c] });
        }
        Ok(triangles)
    }

    /// At every position the mean of the planes around it, weighed by their angles there, so that cutting a polygon
    /// into other triangles changes nothing.
    fn means(&self) -> Vec<Vector> {
        let mut sums = vec![Vector::default(); self.positions.len()];
        for &corners in &self.corners {
            let places = self.places(corners);
            let Some(plane) = plane_normal(places).unit() else { continue };
            for corner in 0..3 {
                let [here, next, last] = [0, 1, 2].map(|step| places[(corner + step) % 3]);
                if let (Some(one), Some(other)) = ((next - here).unit(), (last - here).unit()) {
                    let angle = core_math::acos(one.dot(other).clamp(-1.0, 1.0));
                    sums[corners[corner]] = sums[corners[corner]] + plane * angle;
                }
            }
        }
        // A sum that is only what rounding left of planes that cancel is none.
        sums.iter().map(|&sum| if sum.length() < 1e-9 { Vector::default() } else { sum }).collect()
    }
}
