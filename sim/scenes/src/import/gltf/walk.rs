//! The nodes of a document's scene, each in its place, and the triangles of their meshes.

use gltf::mesh::Mode;
use gltf::{Node, Primitive, Semantic};

use crate::import::error::ImportError;
use crate::scene::{GREATEST_COORDINATE, Vector};

use super::accessor::{indices, triples};
use super::material::Names;
use super::obj_text::{Corners, ObjText};

/// Four columns, as glTF has them.
type Matrix = [[f64; 4]; 4];

/// Adds every triangle of the default scene, or of the first where none is the default.
pub(super) fn scene<'a>(
    document: &'a gltf::Document,
    buffers: &[Vec<u8>],
    names: &mut Names<'a>,
    text: &mut ObjText,
) -> Result<(), ImportError> {
    let Some(scene) = document.default_scene().or_else(|| document.scenes().next()) else {
        return Err(ImportError::Gltf("the document has no scene; export one".into()));
    };
    // A node has one parent, so that each is met once; a circle would be walked without end.
    let mut met = vec![false; document.nodes().count()];
    let mut open: Vec<(Node, Matrix)> = scene.nodes().map(|node| (node, IDENTITY)).collect();
    open.reverse();
    while let Some((node, above)) = open.pop() {
        if met.get(node.index()).copied().unwrap_or(true) {
            let problem = format!("node {} stands in two places, or below itself", node.index());
            return Err(ImportError::Gltf(problem));
        }
        if let Some(met) = met.get_mut(node.index()) {
            *met = true;
        }
        let matrix = product(&above, &node.transform().matrix().map(|column| column.map(f64::from)));
        for primitive in node.mesh().iter().flat_map(gltf::Mesh::primitives) {
            self::primitive(&primitive, &matrix, buffers, names, text)?;
        }
        let children = open.len();
        open.extend(node.children().map(|child| (child, matrix)));
        open.get_mut(children..).unwrap_or_default().reverse();
    }
    Ok(())
}

const IDENTITY: Matrix = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];

fn product(left: &Matrix, right: &Matrix) -> Matrix {
    right.map(|column| std::array::from_fn(|row| (0..4).map(|k| left[k][row] * column[k]).sum()))
}

fn primitive<'a>(
    primitive: &Primitive<'a>,
    matrix: &Matrix,
    buffers: &[Vec<u8>],
    names: &mut Names<'a>,
    text: &mut ObjText,
) -> Result<(), ImportError> {
    let mode = primitive.mode();
    if !matches!(mode, Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan) {
        text.pass_over();
        return Ok(());
    }
    let Some(places) = primitive.get(&Semantic::Positions) else {
        return Err(ImportError::Gltf("a primitive has no positions".into()));
    };
    let turn = turn_of_normals(matrix);
    let places = triples(&places, buffers)?;
    let normals = primitive.get(&Semantic::Normals).map(|normals| triples(&normals, buffers)).transpose()?;
    let corners = Corners {
        positions: places.iter().map(|&place| moved(matrix, place)).collect(),
        normals: normals.unwrap_or_default().into_iter().map(|normal| turned(&turn, normal)).collect(),
    };
    let far = |place: &Vector| {
        place.coordinates().iter().any(|part| !(-GREATEST_COORDINATE..=GREATEST_COORDINATE).contains(part))
    };
    if corners.positions.iter().any(far) {
        return Err(ImportError::Gltf("a position is out of range; use numbers from -1e9 to 1e9".into()));
    }
    let order = match primitive.indices() {
        Some(accessor) => indices(&accessor, buffers)?,
        None => (0..places.len()).collect(),
    };
    text.add(names.of_material(primitive.material()), &corners, triangles(mode, &order).into_iter())
}

/// The corners of each triangle, all in the same sense.
fn triangles(mode: Mode, order: &[usize]) -> Vec<[usize; 3]> {
    match mode {
        Mode::TriangleStrip => {
            let triangle = |index: usize| match order.get(index..index + 3) {
                Some(&[a, b, c]) if index.is_multiple_of(2) => Some([a, b, c]),
                Some(&[a, b, c]) => Some([b, a, c]),
                _ => None,
            };
            (0..order.len()).map_while(triangle).collect()
        }
        Mode::TriangleFan => match order.split_first() {
            Some((&first, rest)) => {
                rest.windows(2).filter_map(|pair| Some([first, *pair.first()?, *pair.last()?])).collect()
            }
            None => Vec::new(),
        },
        _ => order.as_chunks::<3>().0.to_vec(),
    }
}

fn moved(matrix: &Matrix, [x, y, z]: [f64; 3]) -> Vector {
    let part = |row: usize| matrix[0][row] * x + matrix[1][row] * y + matrix[2][row] * z + matrix[3][row];
    Vector::new(part(0), part(1), part(2))
}

/// The cofactors of the upper left of a matrix: what normals are turned by, up to a length that does not matter. The
/// sign of the determinant takes back what a mirror turns round.
fn turn_of_normals(matrix: &Matrix) -> [Vector; 3] {
    let column = |index: usize| Vector::new(matrix[index][0], matrix[index][1], matrix[index][2]);
    let (a, b, c) = (column(0), column(1), column(2));
    let sign = if a.dot(b.cross(c)) < 0.0 { -1.0 } else { 1.0 };
    [b.cross(c) * sign, c.cross(a) * sign, a.cross(b) * sign]
}

fn turned(turn: &[Vector; 3], [x, y, z]: [f64; 3]) -> Option<Vector> {
    (turn[0] * x + turn[1] * y + turn[2] * z).unit()
}
