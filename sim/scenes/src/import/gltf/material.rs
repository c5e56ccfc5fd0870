//! Materials of a document, under names that an OBJ file can say.

use std::collections::BTreeMap;

use gltf::Material;
use gltf::material::{PbrMetallicRoughness, PbrSpecularGlossiness};

use crate::import::material::Draft;

/// What a surface that is no metal reflects straight ahead, as glTF 2.0 says (appendix B).
const DIELECTRIC: f64 = 0.04;

/// The names that materials get, and what each is.
pub(super) struct Names<'a> {
    /// By the material's index; the last is the default material.
    names: Vec<String>,
    materials: BTreeMap<String, Material<'a>>,
    default: String,
}

impl<'a> Names<'a> {
    pub(super) fn of(document: &'a gltf::Document) -> Self {
        let mut made = Self { names: Vec::new(), materials: BTreeMap::new(), default: String::new() };
        for (index, material) in document.materials().enumerate() {
            let name = made.free(&plain(material.name().unwrap_or_default(), index));
            made.names.push(name.clone());
            made.materials.insert(name, material);
        }
        made.default = made.free("default");
        made
    }

    /// The name of a primitive's material.
    pub(super) fn of_material(&mut self, material: Material<'a>) -> &str {
        match material.index().and_then(|index| self.names.get(index)) {
            Some(name) => name,
            None => {
                self.materials.entry(self.default.clone()).or_insert(material);
                &self.default
            }
        }
    }

    fn free(&self, name: &str) -> String {
        let taken = |name: &String| self.materials.contains_key(name);
        let numbered = (2..).map(|count| format!("{name}_{count}"));
        std::iter::once(name.to_owned()).chain(numbered).find(|name| !taken(name)).unwrap_or_default()
    }

    /// The material of this name, on its way into a scene.
    pub(super) fn draft(&self, name: &str) -> Draft {
        match self.materials.get(name) {
            Some(material) => draft(name, material),
            None => Draft::unknown(name, None),
        }
    }
}

/// A name without what ends one in an OBJ file: comments, continuations, line ends, spaces at its ends.
fn plain(name: &str, index: usize) -> String {
    let unfit = |c: char| c.is_control() || c == '#' || c == '\\' || c == '\u{feff}';
    let plain: Vec<&str> = name.split(unfit).flat_map(str::split_whitespace).collect();
    if plain.is_empty() { format!("material{index}") } else { plain.join(" ") }
}

fn draft(name: &str, material: &Material) -> Draft {
    let mut draft = match material.pbr_specular_glossiness() {
        Some(given) => specular_glossiness(&given),
        None => metallic_roughness(&material.pbr_metallic_roughness()),
    };
    draft.name = name.to_owned();
    let others = [
        (material.normal_texture().is_some(), "normals"),
        (material.occlusion_texture().is_some(), "occlusion"),
        (material.emissive_texture().is_some(), "emission"),
    ];
    let there: Vec<&str> = others.iter().filter(|(there, _)| *there).map(|&(_, what)| what).collect();
    if !there.is_empty() {
        draft.remarks.push(format!("textures are not read: {}", there.join(", ")));
    }
    if material.emissive_factor() != [0.0; 3] {
        draft.remarks.push("its own light is not taken".into());
    }
    draft
}

fn metallic_roughness(given: &PbrMetallicRoughness) -> Draft {
    let (metallic, roughness) = (f64::from(given.metallic_factor()), f64::from(given.roughness_factor()));
    let base = colour(given.base_color_factor());
    let mut draft = Draft {
        name: String::new(),
        said: format!("roughness {}", given.roughness_factor()),
        exponent: Some(exponent(roughness)),
        ambient: base.map(|part| part * (1.0 - metallic)),
        diffuse: base.map(|part| part * (1.0 - metallic)),
        specular: base.map(|part| DIELECTRIC * (1.0 - metallic) + part * metallic),
        remarks: Vec::new(),
    };
    if given.base_color_texture().is_some() || given.metallic_roughness_texture().is_some() {
        draft.remarks.push("textures of colour or roughness are not read: their factors alone count".into());
    }
    draft
}

fn specular_glossiness(given: &PbrSpecularGlossiness) -> Draft {
    let diffuse = colour(given.diffuse_factor());
    let mut draft = Draft {
        name: String::new(),
        said: format!("glossiness {}", given.glossiness_factor()),
        exponent: Some(exponent(1.0 - f64::from(given.glossiness_factor()))),
        ambient: diffuse,
        diffuse,
        specular: given.specular_factor().map(f64::from),
        remarks: Vec::new(),
    };
    if given.diffuse_texture().is_some() || given.specular_glossiness_texture().is_some() {
        draft.remarks.push("textures of colour or glossiness are not read: their factors alone count".into());
    }
    draft
}

fn colour(given: [f32; 4]) -> [f64; 3] {
    let [r, g, b, _alpha] = given.map(f64::from);
    [r, g, b]
}

/// n = 2/α² − 2 with α = r²: the exponent of Blinn's highlight whose lobe is as wide as that of roughness r (Walter and
/// others, "Microfacet models for refraction through rough surfaces", 2007, section 5.2).
pub(super) fn exponent(roughness: f64) -> f64 {
    let alpha = roughness * roughness;
    (2.0 / (alpha * alpha) - 2.0).max(0.0)
}
