//! From the text of a scene to a scene.

use std::io;

use vectors::output_text::json;
use vectors::text_file::decimal_comma;

use super::check;
use super::checked::Scene;
use super::description::{Description, Image};
use super::error::SceneError;

impl Scene {
    /// Reads a scene. `read` gives the text of a mesh file by the name the scene has for it.
    ///
    /// # Errors
    /// When the text is no scene, a value cannot be used, or a mesh cannot be read or used; with the way to it.
    pub fn from_json(text: &str, read: &mut dyn FnMut(&str) -> io::Result<String>) -> Result<Self, SceneError> {
        let wrong = |path, source: serde_json::Error| {
            let hint = decimal_comma(text, &source).unwrap_or_default();
            SceneError::Json { path, source, hint }
        };
        let mut deserializer = serde_json::Deserializer::from_str(text);
        let description: Description = serde_path_to_error::deserialize(&mut deserializer).map_err(|error| {
            // Where the text ends too early, the last step has no name.
            let path = error.path().to_string();
            let path = path.trim_end_matches('?').trim_end_matches('.').to_owned();
            wrong(path, error.into_inner())
        })?;
        let whole = |source| wrong(String::new(), source);
        deserializer.end().map_err(whole)?;
        check::scene(&description, read)
    }

    /// The same scene in a picture of another size; the field of view is that of its height.
    ///
    /// # Errors
    /// When the size is out of range; the scene is as it was.
    pub fn resize(&mut self, width: u32, height: u32) -> Result<(), SceneError> {
        let image = Image { width, height, ..self.image };
        check::image(&image, self.lights.len())?;
        self.image = image;
        Ok(())
    }
}

/// The JSON schema of scenes, as `docs/scene.schema.json` holds it.
#[must_use]
pub fn schema() -> String {
    // A schema made of types is plain JSON: serialising it cannot fail.
    let schema = schemars::schema_for!(Description);
    json(&schema).unwrap_or_default()
}
