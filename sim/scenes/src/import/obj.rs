//! A Wavefront OBJ file with its libraries of materials.

use std::collections::BTreeMap;
use std::io;

use crate::scene::{Angle, Mesh, Normals, Statements, name_behind};

use super::error::ImportError;
use super::framing;
use super::material::{Draft, without_rows};
use super::mtl::{self, Written};
use super::wish::{Imported, Wish};

/// What faces before the first `usemtl` are made of.
const NAMELESS: &str = "nameless";

/// A library of materials that the user names beside the model.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Library {
    /// Its path, for messages.
    pub name: String,
    /// Its text.
    pub text: String,
}

/// A scene of the model in the text of an OBJ file. `libraries` count before those that the file names (`mtllib`),
/// which `read` gives by the name they have there.
///
/// # Errors
/// Where the mesh cannot be used, or a line of a library cannot be read. A library that is not there is a remark.
pub fn obj(
    wish: &Wish,
    text: &str,
    libraries: &[Library],
    read: &mut dyn FnMut(&str) -> io::Result<String>,
) -> Result<Imported, ImportError> {
    let mesh = Mesh::read(text, Normals::Smooth)?;
    let mut remarks = Vec::new();
    if mesh.without_area > 0 {
        remarks.push(format!("left out: {} faces without area", mesh.without_area));
    }
    let mut known: BTreeMap<String, Written> = BTreeMap::new();
    let mut take = |name: &str, text: &str| -> Result<(), ImportError> {
        let found = mtl::read(text);
        let found = found.map_err(|(line, problem)| ImportError::Library { library: name.into(), line, problem })?;
        for (material, written) in found {
            known.entry(material).or_insert(written);
        }
        Ok(())
    };
    for Library { name, text } in libraries {
        take(name, text)?;
    }
    let named = Named::of(text, read);
    for (line, name) in &named.libraries {
        match read(name) {
            Ok(text) => take(name, &text)?,
            Err(error) => remarks.push(format!("line {line}: the library {name:?} cannot be read: {error}")),
        }
    }
    let mut used = mesh.materials.clone();
    if mesh.material_of.iter().any(Option::is_none) {
        let free = |name: &String| !mesh.materials.contains(name);
        let mut names = std::iter::once(NAMELESS.to_owned()).chain((2..).map(|count| format!("{NAMELESS}{count}")));
        used.insert(0, names.find(free).unwrap_or_default());
        remarks.push(format!("faces without a `usemtl` are of the material {:?}", used.first().map_or("", |n| n)));
    }
    let unknown = |name: &String| Draft::unknown(name, named.materials.get(name).copied());
    let draft = |name: &String| known.get(name).map_or_else(|| unknown(name), |written| written.draft(name));
    let (materials, treated): (Vec<_>, Vec<_>) = used.iter().map(|name| draft(name).finish()).unzip();
    remarks.extend(without_rows(&materials));
    let corners = mesh.triangles.iter().flat_map(|triangle| triangle.corners);
    let said = format!("Imported from {}, with camera and light that were chosen", wish.mesh);
    let description = framing::scene(wish, said, corners, materials, Normals::Smooth, Angle::Phong)?;
    Ok(Imported { description, treated, remarks, mesh: None })
}

/// What a model names, and the line that names it first, counted from 1.
#[derive(Default)]
struct Named {
    /// The libraries behind `mtllib`, in the order of the file, each once.
    libraries: Vec<(usize, String)>,
    /// The materials behind `usemtl`.
    materials: BTreeMap<String, usize>,
}

impl Named {
    /// The name of a library may have spaces in it, and a line may have several names: it is one name where there is
    /// such a file.
    fn of(text: &str, read: &mut dyn FnMut(&str) -> io::Result<String>) -> Self {
        let mut named = Self::default();
        for (line, statement) in Statements::of(text) {
            let whole = name_behind(&statement);
            match statement.split_whitespace().next() {
                Some("mtllib") => {
                    let several = whole.split_whitespace().count() > 1 && read(whole).is_err();
                    let names = if several { whole.split_whitespace().collect() } else { vec![whole] };
                    names.into_iter().for_each(|name| named.library(line, name));
                }
                Some("usemtl") => drop(named.materials.entry(whole.to_owned()).or_insert(line)),
                _ => {}
            }
        }
        named
    }

    fn library(&mut self, line: usize, name: &str) {
        if !name.is_empty() && !self.libraries.iter().any(|(_, known)| known == name) {
            self.libraries.push((line, name.to_owned()));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::import::UpAxis;

    const MODEL: &str = "mtllib two words.mtl\nmtllib a.mtl b.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n\
                         f 1 2 3\nusemtl steel\nf 1 2 4\nusemtl lost\nf 2 3 4\n";

    fn wish() -> Wish {
        Wish { name: "model".into(), mesh: "model.obj".into(), size: (64, 48), up: UpAxis::Y }
    }

    fn library(name: &str) -> io::Result<String> {
        match name {
            "two words.mtl" => Ok("newmtl unused\nNs 3\n".into()),
            "a.mtl" => Ok("newmtl steel\nNs 96.5\nKs 1 1 1\n".into()),
            _ => Err(io::ErrorKind::NotFound.into()),
        }
    }

    #[test]
    fn faces_get_the_materials_of_the_libraries() {
        let made = obj(&wish(), MODEL, &[], &mut |name| library(name)).unwrap();
        let materials: Vec<(&str, f64)> =
            made.description.materials.iter().map(|material| (material.name.as_str(), material.exponent)).collect();
        assert_eq!(materials, [("nameless", 1.0), ("steel", 96.5), ("lost", 1.0)]);
        assert_eq!(made.remarks.len(), 3, "{:?}", made.remarks);
        assert!(made.remarks[0].starts_with("line 2: the library \"b.mtl\""), "{:?}", made.remarks);
        assert!(made.remarks[2].starts_with("1 of 3 exponents is"), "{:?}", made.remarks);
        assert!(
            made.treated[2].remarks[0].contains("no library tells of this material (line 10)"),
            "{:?}",
            made.treated
        );
    }

    #[test]
    fn a_library_of_the_user_counts_before_the_models() {
        let own = Library { name: "mine.mtl".into(), text: "newmtl steel\nNs 7\nKs 1 1 1\n".into() };
        let made = obj(&wish(), MODEL, &[own], &mut |name| library(name)).unwrap();
        assert_eq!(made.description.materials[1].exponent, 7.0);
    }

    #[test]
    fn a_wrong_library_is_named_with_its_line() {
        let wrong = Library { name: "mine.mtl".into(), text: "newmtl steel\nNs x\n".into() };
        let error = obj(&wish(), MODEL, &[wrong], &mut |name| library(name)).unwrap_err();
        assert!(error.to_string().starts_with("mine.mtl:2: "), "{error}");
    }
}
