//! A scene: read → check → build, all errors at once.

use crate::assemble::Built;
use crate::error::{LoadError, NotToml, SceneErrors};
use crate::file::SceneFile;
use crate::overriding::Override;
use crate::template::Template;
use crate::unknown::Unknown;
use serde_json::Value;
use std::path::{Path, PathBuf};

/// A scene without errors, with its text, its resolved form and its model.
#[derive(Debug, Clone)]
pub struct Scene {
    pub(crate) name: String,
    pub(crate) text: String,
    pub(crate) base: PathBuf,
    pub(crate) overrides: Vec<Override>,
    pub(crate) file: SceneFile,
    pub(crate) built: Built,
    pub(crate) unknown: Option<Box<Unknown>>,
}

impl Scene {
    /// Opens a scene by its path or, if there is no such file, by its name in the gallery.
    ///
    /// Each override is `KEY=VALUE`, `body.die.velocity=[1, 0, 0]`, as in `--set`.
    ///
    /// # Errors
    /// [`LoadError::Read`] if the file cannot be read, [`LoadError::Content`] with everything that is wrong in it.
    pub fn open(path_or_name: &str, overrides: &[String]) -> Result<Self, LoadError> {
        Ok(Template::open(path_or_name)?.scene(&Override::parse_all(overrides))?)
    }

    /// Loads a scene from a file; paths in it are relative to its folder.
    ///
    /// # Errors
    /// [`LoadError::Read`] if the file cannot be read, [`LoadError::Content`] with everything that is wrong in it.
    pub fn load(path: &Path, overrides: &[String]) -> Result<Self, LoadError> {
        Ok(Template::load(path)?.scene(&Override::parse_all(overrides))?)
    }

    /// Reads a scene from a text; `name` is what messages call it, paths in it are relative to `base`.
    ///
    /// The text is TOML, or JSON if the name ends in `.json` or the text begins with a brace.
    ///
    /// # Errors
    /// Everything that is wrong in it, in the order of the text.
    pub fn parse(name: &str, text: &str, base: &Path, overrides: &[String]) -> Result<Self, SceneErrors> {
        Template::parse(name, text, base)?.scene(&Override::parse_all(overrides))
    }

    /// The name of its file without folder and ending.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Its title; its name if it has none.
    pub fn title(&self) -> &str {
        self.file.title.as_deref().unwrap_or(&self.name)
    }

    /// Its text, verbatim.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The folder to which paths in it are relative.
    pub fn base(&self) -> &Path {
        &self.base
    }

    /// The overrides, in their order, as they would be written.
    pub fn overrides(&self) -> Vec<String> {
        self.overrides.iter().map(Override::to_string).collect()
    }

    /// What the file says, overrides and defaults included.
    pub fn file(&self) -> &SceneFile {
        &self.file
    }

    /// The model, its first state and the plan of the run. Nothing runs while forms are unknown
    /// ([`Scene::unknown_forms`]).
    pub fn built(&self) -> &Built {
        &self.built
    }

    /// The resolved form: SI units, every default in its place. It is itself a scene, which resolves to itself.
    pub fn resolved(&self) -> Value {
        // The file's types hold strings, finite numbers, arrays and tables only, all of which JSON has.
        serde_json::to_value(&self.file).unwrap_or_default()
    }
    /// The resolved form in TOML.
    ///
    /// # Errors
    /// [`NotToml`] if it has none.
    pub fn to_toml(&self) -> Result<String, NotToml> {
        Ok(toml::to_string(&self.file)?)
    }
}
