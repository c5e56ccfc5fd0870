//! What a scene makes of a material of a file, and what it says of it.

use hw_model::exponents::MAX_EXPONENT;

use crate::scene::MaterialDescription as Material;

/// The greatest exponent that the presets have a row for.
const MOST_OF_PRESETS: f64 = 256.0;

/// What became of a material.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Treated {
    /// Its name.
    pub name: String,
    /// What the file says of the highlight: `Ns 96.078431`, `roughness 0.4`.
    pub said: String,
    /// What the scene has otherwise than the file, a sentence each.
    pub remarks: Vec<String>,
}

/// A material on its way into a scene.
pub(super) struct Draft {
    pub name: String,
    /// What the file says of the highlight.
    pub said: String,
    /// The exponent, as the file has it; none where it has none.
    pub exponent: Option<f64>,
    pub ambient: [f64; 3],
    pub diffuse: [f64; 3],
    pub specular: [f64; 3],
    pub remarks: Vec<String>,
}

impl Draft {
    /// A grey without a highlight, for what no library tells of; `line` is where the model names it.
    pub(super) fn unknown(name: &str, line: Option<usize>) -> Self {
        let place = line.map_or_else(String::new, |line| format!(" (line {line})"));
        let remarks = vec![format!("no library tells of this material{place}, so it is grey and has no highlight")];
        let (dark, grey) = ([0.0; 3], [0.6; 3]);
        Self {
            name: name.into(),
            said: "-".into(),
            exponent: None,
            ambient: grey,
            diffuse: grey,
            specular: dark,
            remarks,
        }
    }

    /// The material as a scene can have it.
    pub(super) fn finish(mut self) -> (Material, Treated) {
        let exponent = self.exponent();
        let mut colour = |what: &str, colour: [f64; 3]| {
            let clamped = colour.map(|part| part.clamp(0.0, 1.0));
            if clamped != colour {
                let [r, g, b] = colour;
                self.remarks.push(format!("{what} {r} {g} {b} is brought into 0 to 1"));
            }
            clamped
        };
        let ambient = colour("the ambient colour", self.ambient);
        let diffuse = colour("the diffuse colour", self.diffuse);
        let specular = colour("the specular colour", self.specular);
        let material = Material { name: self.name.clone(), exponent, ambient, diffuse, specular };
        (material, Treated { name: self.name, said: self.said, remarks: self.remarks })
    }

    /// An exponent from 1 to 10^15. 0 means "no highlight" to those who write it: x^0 would be bright everywhere.
    fn exponent(&mut self) -> f64 {
        let Some(given) = self.exponent else {
            self.drop_highlight("there is no exponent, so there is no highlight");
            return 1.0;
        };
        if given == 0.0 {
            self.drop_highlight("an exponent of 0 is taken as no highlight");
            1.0
        } else if given < 1.0 {
            self.remarks.push("the exponent is below 1, and 1 is taken".into());
            1.0
        } else if given > MAX_EXPONENT {
            self.remarks.push("the exponent is above 1e15, and 1e15 is taken".into());
            MAX_EXPONENT
        } else {
            given
        }
    }

    /// The highlight goes; that is said where there was one.
    pub(super) fn drop_highlight(&mut self, why: &str) {
        if self.specular != [0.0; 3] {
            self.specular = [0.0; 3];
            self.remarks.push(why.into());
        }
    }
}

/// How many of the exponents the presets have no row for, and what to do about it; none where they have all.
pub(super) fn without_rows(materials: &[Material]) -> Option<String> {
    let missing = materials.iter().filter(|material| {
        let n = material.exponent;
        n.fract() != 0.0 || n > MOST_OF_PRESETS
    });
    let (count, all) = (missing.count(), materials.len());
    let is = if count == 1 { "is no whole number" } else { "are no whole numbers" };
    (count > 0).then(|| {
        format!(
            "{count} of {all} exponents {is} from 1 to {MOST_OF_PRESETS}, so that presets have no row: see --nearest \
             of `blysk render` and `blysk specialise`"
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn draft(exponent: Option<f64>) -> Draft {
        let half = [0.5; 3];
        let (name, said) = ("m".into(), String::new());
        Draft { name, said, exponent, ambient: half, diffuse: half, specular: half, remarks: Vec::new() }
    }

    #[test]
    fn exponents_are_brought_into_range_and_that_is_said() {
        for (given, wanted, highlight, remarks) in [
            (Some(96.078431), 96.078431, true, 0),
            (Some(1.0), 1.0, true, 0),
            (Some(0.25), 1.0, true, 1),
            (Some(0.0), 1.0, false, 1),
            (None, 1.0, false, 1),
            (Some(1e16), 1e15, true, 1),
        ] {
            let (material, treated) = draft(given).finish();
            assert_eq!(material.exponent, wanted, "{given:?}");
            assert_eq!(material.specular != [0.0; 3], highlight, "{given:?}");
            assert_eq!(treated.remarks.len(), remarks, "{given:?} {:?}", treated.remarks);
        }
    }

    #[test]
    fn colours_are_brought_into_range_and_that_is_said() {
        let mut bright = draft(Some(2.0));
        bright.diffuse = [0.5, 1.5, -1.0];
        let (material, treated) = bright.finish();
        assert_eq!(material.diffuse, [0.5, 1.0, 0.0]);
        assert_eq!(treated.remarks, ["the diffuse colour 0.5 1.5 -1 is brought into 0 to 1"]);
    }
}
