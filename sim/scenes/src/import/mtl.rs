//! Wavefront MTL: the few statements of a library of materials that a scene has a place for.
//!
//! | statement | is |
//! |---|---|
//! | `newmtl name` | begins a material |
//! | `Ns n` | the exponent of its highlight |
//! | `Ka`, `Kd`, `Ks` with `r g b`, or one number for a grey | its ambient, diffuse and specular colour, as linear light |
//! | `illum 0`, `illum 1` | models without a highlight |
//! | `map_…`, `bump`, `disp`, `decal`, `refl` | textures: named in a remark, not read |
//! | anything else | passed over: transparency, indices of refraction, filters, extensions |

use std::collections::BTreeMap;

use crate::scene::{Statements, name_behind};

use super::material::Draft;

/// What stands in a library of one material.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Written {
    exponent: Option<f64>,
    ambient: Option<[f64; 3]>,
    diffuse: Option<[f64; 3]>,
    specular: Option<[f64; 3]>,
    illumination: Option<i64>,
    textures: Vec<String>,
}

/// The materials in the text of a library, by name. A material that is written twice is the later one.
///
/// # Errors
/// The line, counted from 1, and what is wrong with it.
pub(super) fn read(text: &str) -> Result<BTreeMap<String, Written>, (usize, String)> {
    let mut materials = BTreeMap::new();
    let mut name: Option<String> = None;
    for (line, statement) in Statements::of(text) {
        let mut words = statement.split_whitespace();
        let Some(keyword) = words.next() else { continue };
        let wrong = |problem: String| (line, problem);
        if keyword == "newmtl" {
            let new = name_behind(&statement);
            if new.is_empty() {
                return Err(wrong("a material has no name; write newmtl name".into()));
            }
            materials.insert(new.to_owned(), Written::default());
            name = Some(new.to_owned());
        } else if let Some(written) = name.as_ref().and_then(|name| materials.get_mut(name)) {
            written.see(keyword, &statement, words).map_err(wrong)?;
        } else if matches!(keyword, "Ns" | "Ka" | "Kd" | "Ks") {
            return Err(wrong(format!("`{keyword}` stands before any material; write newmtl name first")));
        }
    }
    Ok(materials)
}

impl Written {
    fn see<'a>(&mut self, keyword: &str, statement: &str, words: impl Iterator<Item = &'a str>) -> Result<(), String> {
        match keyword {
            "Ns" => {
                let [exponent] = numbers(keyword, "n", words)?.try_into().map_err(|_| form(keyword, "n"))?;
                if exponent < 0.0 {
                    return Err(format!("an exponent of {exponent} is none; write a number from 0 up"));
                }
                self.exponent = Some(exponent);
            }
            "Ka" => self.ambient = colour(keyword, words)?,
            "Kd" => self.diffuse = colour(keyword, words)?,
            "Ks" => self.specular = colour(keyword, words)?,
            "illum" => {
                let model = name_behind(statement);
                let model = model.parse().map_err(|_| format!("{model:?} is no model; write illum 2"))?;
                self.illumination = Some(model);
            }
            "bump" | "disp" | "decal" | "refl" => self.textures.push(keyword.to_owned()),
            other if other.starts_with("map_") || other.starts_with("norm") => self.textures.push(other.to_owned()),
            _ => {}
        }
        Ok(())
    }

    /// The material on its way into a scene. What a library leaves out is black, as most readers take it, but for the
    /// diffuse colour, which is grey.
    pub(super) fn draft(&self, name: &str) -> Draft {
        let said = self.exponent.map_or_else(|| "no Ns".to_owned(), |exponent| format!("Ns {exponent}"));
        let mut draft = Draft {
            name: name.to_owned(),
            said,
            exponent: self.exponent,
            ambient: self.ambient.unwrap_or_default(),
            diffuse: self.diffuse.unwrap_or([0.6; 3]),
            specular: self.specular.unwrap_or_default(),
            remarks: Vec::new(),
        };
        if let Some(model @ (0 | 1)) = self.illumination {
            draft.drop_highlight(&format!("illum {model} is a model without a highlight"));
        }
        if !self.textures.is_empty() {
            draft.remarks.push(format!("textures are not read: {}", self.textures.join(", ")));
        }
        draft
    }
}

/// Nothing for what is written as a spectrum or in XYZ: it would have to be converted.
fn colour<'a>(keyword: &str, words: impl Iterator<Item = &'a str>) -> Result<Option<[f64; 3]>, String> {
    let mut words = words.peekable();
    if let Some(&way @ ("spectral" | "xyz")) = words.peek() {
        return Err(format!("a colour by `{way}` is not read; write {keyword} r g b"));
    }
    match numbers(keyword, "r g b", words)?[..] {
        [grey] => Ok(Some([grey; 3])),
        [r, g, b] => Ok(Some([r, g, b])),
        _ => Err(form(keyword, "r g b")),
    }
}

fn numbers<'a>(keyword: &str, what: &str, words: impl Iterator<Item = &'a str>) -> Result<Vec<f64>, String> {
    let number = |word: &str| match word.parse::<f64>() {
        Ok(number) if number.is_finite() => Ok(number),
        _ => Err(format!("{word:?} is not a number; write {keyword} {what}")),
    };
    words.map(number).collect()
}

fn form(keyword: &str, what: &str) -> String {
    format!("the numbers of `{keyword}` are not as many as it has; write {keyword} {what}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_exporters_write_is_read() {
        let text = "# Blender MTL File\r\nnewmtl Dull steel\r\nNs 96.078431 # exponent\r\nKa 1 1 1\r\nKd 0.64\r\n\
                    Ks 0.5 0.25 0.125\r\nNi 1.45\r\nd 1\r\nillum 2\r\nmap_Kd -s 1 1 1 wood.png\r\n\
                    newmtl flat\nNs 10\nKs 1 1 1\nillum 1\n";
        let read = read(text).unwrap();
        let names: Vec<&String> = read.keys().collect();
        assert_eq!(names, ["Dull steel", "flat"]);
        let steel = read["Dull steel"].draft("Dull steel");
        assert_eq!(steel.exponent, Some(96.078431));
        assert_eq!((steel.diffuse, steel.specular), ([0.64; 3], [0.5, 0.25, 0.125]));
        assert_eq!(steel.remarks, ["textures are not read: map_Kd"]);
        assert_eq!(read["flat"].draft("flat").specular, [0.0; 3]);
    }

    #[test]
    fn a_wrong_line_is_named() {
        for (text, line, says) in [
            ("Ns 3\n", 1, "before any material"),
            ("newmtl\n", 1, "no name"),
            ("newmtl a\nNs -3\n", 2, "is none"),
            ("newmtl a\nNs 1 2\n", 2, "write Ns n"),
            ("newmtl a\n\nKd 1 2\n", 3, "write Kd r g b"),
            ("newmtl a\nKs 1,0 2 3\n", 2, "is not a number"),
            ("newmtl a\nKs NaN 2 3\n", 2, "is not a number"),
            ("newmtl a\nKs spectral a.rfl\n", 2, "is not read"),
            ("newmtl a\nillum two\n", 2, "illum 2"),
        ] {
            let (found, problem) = read(text).unwrap_err();
            assert_eq!(found, line, "{text}");
            assert!(problem.contains(says), "{text}: {problem}");
        }
    }
}
