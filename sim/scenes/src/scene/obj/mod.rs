//! Wavefront OBJ: the few statements that say where a mesh is.
//!
//! | statement | is |
//! |---|---|
//! | `v x y z` | a position; a weight or a colour after it is not used |
//! | `vn x y z` | a normal, which counts where a face names it |
//! | `vt` | counted, never read: texture coordinates are not used |
//! | `f` (and `fo`, its old name) | a face: corners `v`, `v/vt`, `v//vn` or `v/vt/vn`, counted from 1 or back from -1 |
//! | `surf`, the old patches and `call` | refused: leaving them out would leave a hole |
//! | `usemtl name` | the material of the faces after it, by the name it has in a library; without a name, none |
//! | anything else | passed over: names, groups, lines, points, curves |
//!
//! The reader is our own: docs/DEPENDENCIES.md says what the loaders that there are would do.

mod statements;

use std::collections::HashMap;

use super::error::MeshError;
use super::vector::Vector;
pub(crate) use statements::Statements;

/// Coordinates beyond these are mistakes: squares of lengths must stay far from the ends of f64.
pub(crate) const GREATEST_COORDINATE: f64 = 1e9;
/// The most triangles of a scene: they take half a gigabyte.
pub(crate) const MOST_TRIANGLES: usize = 4_000_000;
/// The most materials of a file, and of a scene; an index of 16 bits, with room.
pub(super) const MOST_MATERIALS: usize = 4096;
/// The most positions, and the most normals.
pub(crate) const MOST_VECTORS: usize = 1 << 24;

/// A corner of a face: places in the lists of an [`Obj`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct Corner {
    /// Its place in [`Obj::positions`].
    pub position: usize,
    /// Its normal's place in [`Obj::normals`], where the file gives one.
    normal: Option<usize>,
}

impl Corner {
    /// True where the file gives its normal.
    pub(super) fn has_normal(self) -> bool {
        self.normal.is_some()
    }
}

/// A face as the file lists it, before it is cut into triangles.
#[derive(Debug, Clone, Copy)]
pub(super) struct Face<'a> {
    /// Its line, counted from 1.
    pub line: usize,
    /// The corners, 3 or more.
    pub corners: &'a [Corner],
    /// The place of its material in [`Obj::materials`]; none before the first `usemtl`.
    pub material: Option<u16>,
}

/// A `vn`: exporters write normals that are none and use them nowhere.
#[derive(Debug, Clone, Copy)]
pub(super) struct Normal {
    /// Of length 1; none where the line has no direction.
    pub unit: Option<Vector>,
    /// Its line, counted from 1.
    pub line: usize,
}

/// What an OBJ file says. Every index is one of its list.
#[derive(Debug, Default)]
pub(super) struct Obj {
    /// The positions, one for each `v`.
    pub positions: Vec<Vector>,
    /// The normals, one for each `vn`.
    normals: Vec<Normal>,
    texture_coordinates: usize,
    corners: Vec<Corner>,
    /// The line of each face, its first corner and its material.
    faces: Vec<(usize, usize, Option<u16>)>,
    /// The names that `usemtl` says, in the order of the file, each once.
    pub materials: Vec<String>,
    /// The place of a name there.
    material_places: HashMap<String, u16>,
    material: Option<u16>,
    triangles: usize,
    /// Of positions, texture coordinates and normals: the greatest index used, and its line. A face may stand before
    /// what it names.
    greatest: [(usize, usize); 3],
}

/// What the parts of a corner are, in the order `v/vt/vn`.
const PARTS: [&str; 3] = ["v", "vt", "vn"];

impl Obj {
    /// Reads the text of a file.
    pub(super) fn read(text: &str) -> Result<Self, MeshError> {
        let mut obj = Self::default();
        for (line, statement) in Statements::of(text) {
            obj.see(line, &statement).map_err(|problem| MeshError::Line { line, problem })?;
        }
        for ((part, count), (index, line)) in PARTS.iter().zip(obj.counts()).zip(obj.greatest) {
            if index > count {
                let problem = format!("{part} {index} of this face does not exist; there are {count}");
                return Err(MeshError::Line { line, problem });
            }
        }
        if obj.faces.is_empty() {
            let line = text.lines().count().max(1);
            let problem = "the file ends and has no face; give at least one line `f a b c`".into();
            return Err(MeshError::Line { line, problem });
        }
        Ok(obj)
    }

    /// The faces, in the order of the file.
    pub(super) fn faces(&self) -> impl Iterator<Item = Face<'_>> {
        let ends = self.faces.iter().skip(1).map(|face| face.1).chain([self.corners.len()]);
        self.faces.iter().zip(ends).map(|(&(line, first, material), end)| {
            let corners = self.corners.get(first..end).unwrap_or_default();
            Face { line, corners, material }
        })
    }

    /// Where a corner is.
    pub(super) fn position(&self, corner: Corner) -> Vector {
        self.positions.get(corner.position).copied().unwrap_or_default()
    }

    /// The normal that the file gives a corner.
    pub(super) fn normal(&self, corner: Corner) -> Option<Normal> {
        self.normals.get(corner.normal?).copied()
    }

    /// How many triangles the faces make, but for corners that repeat.
    pub(super) fn triangle_count(&self) -> usize {
        self.triangles
    }

    fn counts(&self) -> [usize; 3] {
        [self.positions.len(), self.texture_coordinates, self.normals.len()]
    }

    fn see(&mut self, line: usize, statement: &str) -> Result<(), String> {
        let mut words = statement.split_whitespace();
        let Some(keyword) = words.next() else { return Ok(()) };
        match keyword {
            "v" => {
                room(self.positions.len(), "v")?;
                self.positions.push(position(words)?);
            }
            "vt" => self.texture_coordinates += 1,
            "vn" => {
                room(self.normals.len(), "vn")?;
                self.normals.push(Normal { unit: direction(words), line });
            }
            "f" | "fo" => self.face(line, words)?,
            "usemtl" => self.material = self.place_of_material(name_behind(statement))?,
            "surf" | "bsp" | "bzp" | "cdc" | "cdp" => {
                let said = format!("free-form surfaces (`{keyword}`) are not read; export polygons");
                return Err(said);
            }
            "call" => return Err("`call` is not followed; put the lines of that file here".into()),
            "V" | "VT" | "VN" | "F" => {
                return Err(format!("`{keyword}` is no statement; write {}", keyword.to_lowercase()));
            }
            number if number.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c)) => {
                return Err(format!(
                    "the line begins with {number:?} and no statement; write v, vn or f in front of it, or end \
                     the line before it with \\"
                ));
            }
            _ => {}
        }
        Ok(())
    }

    /// The place of a material's name in the list, where it is put if it is new. Without a name there is no material.
    fn place_of_material(&mut self, name: &str) -> Result<Option<u16>, String> {
        if name.is_empty() {
            return Ok(None);
        }
        if let Some(&place) = self.material_places.get(name) {
            return Ok(Some(place));
        }
        let place = self.materials.len();
        if place >= MOST_MATERIALS {
            return Err(format!("there are more than {MOST_MATERIALS} names of materials; merge some"));
        }
        self.materials.push(name.to_owned());
        self.material_places.insert(name.to_owned(), place as u16);
        Ok(Some(place as u16))
    }

    fn face<'a>(&mut self, line: usize, words: impl Iterator<Item = &'a str>) -> Result<(), String> {
        let first = self.corners.len();
        for word in words {
            let corner = self.corner(line, word)?;
            self.corners.push(corner);
        }
        let corners = self.corners.get(first..).unwrap_or_default();
        let count = corners.len();
        if count < 3 {
            return Err(format!("a face has 3 corners or more, and this has {count}"));
        }
        let with_normals = corners.iter().filter(|corner| corner.has_normal()).count();
        if with_normals != 0 && with_normals != count {
            let said = "some corners of this face have a normal and some have none; \
                        give one to all or to none";
            return Err(said.into());
        }
        self.triangles += count - 2;
        if self.triangles > MOST_TRIANGLES {
            return Err(format!("there are more than {MOST_TRIANGLES} triangles; use a coarser mesh"));
        }
        self.faces.push((line, first, self.material));
        Ok(())
    }

    fn corner(&mut self, line: usize, word: &str) -> Result<Corner, String> {
        let mut indices = [None; 3];
        let mut parts = word.split('/');
        for (kind, index) in indices.iter_mut().enumerate() {
            *index = match parts.next() {
                None | Some("") => None,
                Some(part) => Some(self.index(kind, line, part)?),
            };
        }
        match (indices, parts.next()) {
            ([Some(position), _, normal], None) => Ok(Corner { position, normal }),
            _ => Err(format!("{word:?} is not a corner; write v, v/vt, v//vn or v/vt/vn")),
        }
    }

    /// The place in its list, from 0. In the file it counts from 1, or back from the last that was read.
    fn index(&mut self, kind: usize, line: usize, text: &str) -> Result<usize, String> {
        let count = self.counts().get(kind).copied().unwrap_or_default();
        let part = PARTS.get(kind).copied().unwrap_or_default();
        let wrong = || format!("{text:?} is not an index of a {part}; count from 1, or back from -1");
        let index: i64 = text.parse().map_err(|_| wrong())?;
        let index = if index < 0 { count as i64 + 1 + index } else { index };
        let index = usize::try_from(index).ok().filter(|&index| index > 0).ok_or_else(wrong)?;
        if let Some(greatest) = self.greatest.get_mut(kind).filter(|greatest| index > greatest.0) {
            *greatest = (index, line);
        }
        Ok(index - 1)
    }
}

/// What stands behind the keyword of a statement: names may have spaces in them.
pub(crate) fn name_behind(statement: &str) -> &str {
    let statement = statement.trim();
    statement.split_once(char::is_whitespace).map_or("", |(_, name)| name.trim())
}

fn room(count: usize, keyword: &str) -> Result<(), String> {
    if count < MOST_VECTORS {
        return Ok(());
    }
    Err(format!("there are more than {MOST_VECTORS} lines `{keyword}`; use a coarser mesh"))
}

/// x, y and z; a weight, a colour or both may follow, and must be numbers.
fn position<'a>(words: impl Iterator<Item = &'a str>) -> Result<Vector, String> {
    const FORM: &str = "write v x y z";
    let mut numbers = [0.0_f64; 3];
    let mut count = 0_usize;
    for word in words {
        let number: f64 = word.parse().map_err(|_| match as_decimal_comma(word) {
            Some(right) => {
                format!("{word:?} is not a number: it has a decimal comma; write {right}")
            }
            None => format!("{word:?} is not a number; {FORM}"),
        })?;
        if let Some(place) = numbers.get_mut(count) {
            // NaN is in no range.
            if !(-GREATEST_COORDINATE..=GREATEST_COORDINATE).contains(&number) {
                return Err(format!("{word} is not a coordinate; use numbers from -1e9 to 1e9"));
            }
            *place = number;
        }
        count += 1;
    }
    match count {
        0..3 => Err(format!("a number is missing; {FORM}")),
        3 | 4 | 6 | 7 => Ok(numbers.into()),
        _ => Err(format!("there are {count} numbers; {FORM}, and a weight or a colour after it or nothing")),
    }
}

/// `1.5` of `1,5`; none where it is something else.
fn as_decimal_comma(word: &str) -> Option<String> {
    let right = word.replacen(',', ".", 1);
    (right != word && right.parse::<f64>().is_ok()).then_some(right)
}

/// None where the words are no direction: only a face that uses the normal makes this a mistake.
fn direction<'a>(mut words: impl Iterator<Item = &'a str>) -> Option<Vector> {
    let mut next = || words.next()?.parse::<f64>().ok();
    Vector::new(next()?, next()?, next()?).unit()
}
