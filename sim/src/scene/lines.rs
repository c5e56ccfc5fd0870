//! The lines of a Wavefront OBJ file, looked at before the loader gets them.
//!
//! The loader says what is wrong and not where, and it takes NaN for a coordinate. Everything that it would
//! refuse, or that could not be rendered, is found here with its line; and the line of every triangle is kept, for
//! what shows only in the mesh.

use super::error::MeshError;

/// Coordinates and indices beyond these are mistakes: squares of lengths must stay far from the ends of f64.
pub(super) const GREATEST_COORDINATE: f64 = 1e9;

/// What the lines say about the mesh.
#[derive(Debug, Default)]
pub(super) struct Lines {
    /// The line of each triangle, in the order of the file; a face of k corners makes k − 2 triangles.
    pub triangles: Vec<usize>,
    counts: [usize; 3],
    /// Of positions, texture coordinates and normals: the greatest index used, and its line.
    greatest: [(usize, usize); 3],
    with_normals: Option<bool>,
}

/// What the parts of a corner are, in the order `v/vt/vn`.
const PARTS: [&str; 3] = ["v", "vt", "vn"];

impl Lines {
    /// Looks at every line.
    pub(super) fn of(text: &str) -> Result<Self, MeshError> {
        let mut lines = Self::default();
        for (index, text) in text.lines().enumerate() {
            let line = index + 1;
            lines.see(line, text).map_err(|problem| MeshError::Line { line, problem })?;
        }
        for ((part, count), (index, line)) in PARTS.iter().zip(lines.counts).zip(lines.greatest) {
            if index > count {
                let problem =
                    format!("{part} {index} of this face does not exist; there are {count}");
                return Err(MeshError::Line { line, problem });
            }
        }
        Ok(lines)
    }

    /// True where corners have normals of the file.
    pub(super) fn have_normals(&self) -> bool {
        self.with_normals == Some(true)
    }

    fn see(&mut self, line: usize, text: &str) -> Result<(), String> {
        let mut words = text.split_whitespace();
        match words.next() {
            Some("v") => {
                coordinates(words, "v x y z")?;
                self.counts[0] += 1;
            }
            Some("vt") => self.counts[1] += 1,
            Some("vn") => {
                if coordinates(words, "vn x y z")?.iter().all(|&number| number == 0.0) {
                    return Err("a normal of length 0 points nowhere; give it a direction".into());
                }
                self.counts[2] += 1;
            }
            Some("f") => self.face(line, &words.collect::<Vec<_>>())?,
            _ => {}
        }
        Ok(())
    }

    fn face(&mut self, line: usize, corners: &[&str]) -> Result<(), String> {
        if corners.len() < 3 {
            return Err(format!("a face has 3 corners or more, and this has {}", corners.len()));
        }
        for corner in corners {
            let parts: Vec<&str> = corner.split('/').collect();
            if parts.len() > 3 || parts[0].is_empty() {
                return Err(format!("{corner:?} is not a corner; write v, v/vt, v//vn or v/vt/vn"));
            }
            let with_normal = parts.get(2).is_some_and(|part| !part.is_empty());
            if *self.with_normals.get_or_insert(with_normal) != with_normal {
                let said = "some corners of the file have a normal and some have none; \
                            give one to all or to none";
                return Err(said.into());
            }
            for (kind, part) in parts.iter().enumerate().filter(|(_, part)| !part.is_empty()) {
                let index = self.index(kind, part)?;
                if index > self.greatest[kind].0 {
                    self.greatest[kind] = (index, line);
                }
            }
        }
        self.triangles.extend(std::iter::repeat_n(line, corners.len() - 2));
        Ok(())
    }

    /// From 1; a negative one counts back from the last.
    fn index(&self, kind: usize, text: &str) -> Result<usize, String> {
        let count = self.counts[kind];
        let wrong = || {
            let part = PARTS[kind];
            format!("{text:?} is not an index of a {part}; count from 1, or back from -1")
        };
        let index: i64 = text.parse().map_err(|_| wrong())?;
        let index = if index < 0 { count as i64 + 1 + index } else { index };
        usize::try_from(index).ok().filter(|&index| index > 0).ok_or_else(wrong)
    }
}

fn coordinates<'a>(
    mut words: impl Iterator<Item = &'a str>,
    form: &str,
) -> Result<[f64; 3], String> {
    let mut numbers = [0.0_f64; 3];
    for number in &mut numbers {
        let word = words.next().ok_or_else(|| format!("a number is missing; write {form}"))?;
        *number = word.parse().map_err(|_| format!("{word:?} is not a number; write {form}"))?;
        // NaN is in no range.
        if !(-GREATEST_COORDINATE..=GREATEST_COORDINATE).contains(number) {
            return Err(format!("{word} is not a coordinate; use numbers from -1e9 to 1e9"));
        }
    }
    Ok(numbers)
}
