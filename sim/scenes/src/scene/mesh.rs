//! Triangles of a Wavefront OBJ file, with a normal at every corner.

use super::description::Normals;
use super::error::MeshError;
use super::obj::{Corner, Obj};
use super::polygon::{self, plane_normal};
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

/// The triangles of a file, and the materials that it says they have.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    /// The triangles, in the order of the faces.
    pub triangles: Vec<Triangle>,
    /// For each triangle the place of its material in [`Mesh::materials`]; none for faces before the first `usemtl`.
    pub material_of: Vec<Option<u16>>,
    /// The names that `usemtl` says, in the order of the file, each once.
    pub materials: Vec<String>,
    /// Faces of three corners or fewer that have no area, and so no triangle.
    pub without_area: usize,
}

/// A triangle of a face.
struct Piece {
    /// The line of the face.
    line: usize,
    material: Option<u16>,
    corners: [Corner; 3],
}

/// The triangles of a mesh, before they have normals.
struct Pieces<'a> {
    obj: &'a Obj,
    list: Vec<Piece>,
    without_area: usize,
}

/// The triangles in the text of a Wavefront OBJ file.
///
/// # Errors
/// When a line cannot be read, a number is not finite, a face of four corners or more has no area or is no polygon, a
/// normal no direction, or there is no face with an area at all; with the line.
pub fn triangles(text: &str, normals: Normals) -> Result<Vec<Triangle>, MeshError> {
    Mesh::read(text, normals).map(|mesh| mesh.triangles)
}

impl Mesh {
    /// The triangles in the text of a Wavefront OBJ file, with the names of their materials.
    ///
    /// # Errors
    /// Those of [`triangles`].
    pub fn read(text: &str, normals: Normals) -> Result<Self, MeshError> {
        let obj = Obj::read(text)?;
        let pieces = Pieces::of(&obj)?;
        let triangles = match normals {
            Normals::Flat => pieces.flat(),
            Normals::Smooth => pieces.smooth()?,
        };
        let material_of = pieces.list.iter().map(|piece| piece.material).collect();
        let without_area = pieces.without_area;
        Ok(Self { triangles, material_of, materials: obj.materials, without_area })
    }
}

impl<'a> Pieces<'a> {
    fn of(obj: &'a Obj) -> Result<Self, MeshError> {
        let mut list = Vec::with_capacity(obj.triangle_count());
        let mut places = Vec::new();
        let (mut without_area, mut last) = (0, 0);
        for face in obj.faces() {
            let line = face.line;
            places.clear();
            places.extend(face.corners.iter().map(|corner| obj.position(*corner)));
            let triangles = polygon::triangles(&places).map_err(|problem| MeshError::Line { line, problem })?;
            without_area += usize::from(triangles.is_empty());
            last = line;
            let corner = |index: usize| face.corners.get(index).copied().unwrap_or_default();
            let material = face.material;
            list.extend(triangles.into_iter().map(|of| Piece { line, material, corners: of.map(corner) }));
        }
        if list.is_empty() {
            let problem = "no face of the file has an area; move the corners of one apart".into();
            return Err(MeshError::Line { line: last, problem });
        }
        Ok(Self { obj, list, without_area })
    }

    fn places(&self, piece: &Piece) -> [Vector; 3] {
        piece.corners.map(|corner| self.obj.position(corner))
    }

    fn flat(&self) -> Vec<Triangle> {
        let triangle = |piece| {
            let corners = self.places(piece);
            let normal = plane_normal(corners).unit().unwrap_or_default();
            Triangle { corners, normals: [normal; 3] }
        };
        self.list.iter().map(triangle).collect()
    }

    fn smooth(&self) -> Result<Vec<Triangle>, MeshError> {
        let all_given = self.list.iter().flat_map(|piece| piece.corners).all(Corner::has_normal);
        let means = if all_given { Vec::new() } else { self.means() };
        let mut triangles = Vec::with_capacity(self.list.len());
        for piece in &self.list {
            let mut normals = [Vector::default(); 3];
            for (normal, corner) in normals.iter_mut().zip(piece.corners) {
                *normal = match self.obj.normal(corner) {
                    Some(given) => given.unit.ok_or_else(|| no_direction(given.line))?,
                    None => {
                        let mean = means.get(corner.position).and_then(|mean| mean.unit());
                        mean.ok_or_else(|| planes_cancel(piece.line))?
                    }
                };
            }
            triangles.push(Triangle { corners: self.places(piece), normals });
        }
        Ok(triangles)
    }

    /// At every position the mean of the planes around it, weighed by their angles there, so that cutting a polygon
    /// into other triangles changes nothing.
    fn means(&self) -> Vec<Vector> {
        let mut sums = vec![Vector::default(); self.obj.positions.len()];
        for piece in &self.list {
            let places = self.places(piece);
            let Some(plane) = plane_normal(places).unit() else { continue };
            for corner in 0..3 {
                let [here, next, last] = [0, 1, 2].map(|step| places[(corner + step) % 3]);
                let (Some(one), Some(other)) = ((next - here).unit(), (last - here).unit()) else {
                    continue;
                };
                let angle = core_math::acos(one.dot(other).clamp(-1.0, 1.0));
                if let Some(sum) = sums.get_mut(piece.corners[corner].position) {
                    *sum = *sum + plane * angle;
                }
            }
        }
        // A sum that is only what rounding left of planes that cancel is none.
        sums.iter().map(|&sum| if sum.length() < 1e-9 { Vector::default() } else { sum }).collect()
    }
}

fn no_direction(line: usize) -> MeshError {
    let problem = "a normal of length 0, or of what is no number, points nowhere; write vn x y z, or say \
                   \"normals\": \"flat\" in the scene";
    MeshError::Line { line, problem: problem.into() }
}

fn planes_cancel(line: usize) -> MeshError {
    let problem = "the normal at a corner of this face has length 0: the triangles around it cancel; give \
                   normals (vn), or say \"normals\": \"flat\"";
    MeshError::Line { line, problem: problem.into() }
}
