//! A scene: read → check → build, all errors at once.

use crate::build::{Built, Setting, build, salvage};
use crate::check::{Draft, Judge, structure, values};
use crate::document::{Document, Findings};
use crate::error::{LoadError, ReadError, SceneErrors};
use crate::file::SceneFile;
use crate::gallery;
use crate::key::Key;
use crate::read;
use crate::suggest;
use crate::tree::Span;
use serde_json::Value;
use std::path::{Path, PathBuf};

/// A scene without errors, with its text, its resolved form and its model.
#[derive(Debug, Clone)]
pub struct Scene {
    name: String,
    text: String,
    base: PathBuf,
    overrides: Vec<String>,
    file: SceneFile,
    built: Built,
}

impl Scene {
    /// Opens a scene by its path or, if there is no such file, by its name in the gallery.
    ///
    /// Each override is `KEY=VALUE`, `body.die.velocity=[1, 0, 0]`, as in `--set`.
    ///
    /// # Errors
    /// [`LoadError::Read`] if the file cannot be read, [`LoadError::Content`] with everything that is wrong in it.
    pub fn open(path_or_name: &str, overrides: &[String]) -> Result<Self, LoadError> {
        let path = Path::new(path_or_name);
        if path.is_file() {
            return Self::load(path, overrides);
        }
        match gallery::find(path_or_name) {
            Some(text) => Ok(Self::parse(&format!("{path_or_name}.toml"), text, Path::new(""), overrides)?),
            None if path.exists() => Self::load(path, overrides),
            None => {
                let names = gallery::gallery().iter().map(|(name, _)| *name);
                let help = suggest::fix(path_or_name, names, "the gallery has");
                Err(ReadError::NotFound { path: PathBuf::from(path), help }.into())
            }
        }
    }

    /// Loads a scene from a file; paths in it are relative to its folder.
    ///
    /// # Errors
    /// [`LoadError::Read`] if the file cannot be read, [`LoadError::Content`] with everything that is wrong in it.
    pub fn load(path: &Path, overrides: &[String]) -> Result<Self, LoadError> {
        let bytes = read::bytes(path)?;
        let name = path.display().to_string();
        let text = String::from_utf8(bytes).map_err(|error| not_utf8(&name, &error))?;
        let base = path.parent().unwrap_or(Path::new(""));
        Ok(Self::parse(&name, &text, base, overrides)?)
    }

    /// Reads a scene from a text; `name` is what messages call it, paths in it are relative to `base`.
    ///
    /// The text is TOML, or JSON if the name ends in `.json` or the text begins with a brace.
    ///
    /// # Errors
    /// Everything that is wrong in it, in the order of the text.
    pub fn parse(name: &str, text: &str, base: &Path, overrides: &[String]) -> Result<Self, SceneErrors> {
        let mut document = Document::new(name, text);
        let mut findings = Findings::default();
        read::tree(&mut document, &mut findings);
        // Behind an error of syntax the tree is a guess: nothing more can be said about it.
        if !findings.is_empty() {
            return Err(document.settle(findings));
        }
        read::apply(&mut document, overrides, &mut findings);
        structure(&document.root, &mut findings);
        let mut draft = Draft::new(&document, &mut findings);
        let mut judge = Judge { document: &document, findings: &mut findings };
        values(&draft, &mut judge);
        let setting = Setting::new(&draft, &document, base);
        let built = build(&mut draft, &setting, &mut judge);
        salvage(&document, &setting, &mut findings);
        match (draft.complete(), built) {
            (Some(file), Some(built)) if findings.is_empty() => {
                let (text, base) = (text.to_owned(), base.to_path_buf());
                Ok(Self { name: stem(name), text, base, overrides: overrides.to_vec(), file, built })
            }
            _ => Err(document.settle(findings)),
        }
    }

    /// The name of its file without folder and ending.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Its text, verbatim.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The folder to which paths in it are relative.
    pub fn base(&self) -> &Path {
        &self.base
    }

    /// The overrides, in their order.
    pub fn overrides(&self) -> &[String] {
        &self.overrides
    }

    /// What the file says, overrides and defaults included.
    pub fn file(&self) -> &SceneFile {
        &self.file
    }

    /// The model, its first state and the plan of the run.
    pub fn built(&self) -> &Built {
        &self.built
    }

    /// The resolved form: SI units, every default in its place. It is itself a scene, which resolves to itself.
    pub fn resolved(&self) -> Value {
        // The file's types hold strings, finite numbers, arrays and tables only, all of which JSON has.
        serde_json::to_value(&self.file).unwrap_or_default()
    }
}

fn stem(name: &str) -> String {
    Path::new(name).file_stem().map_or_else(|| name.to_owned(), |stem| stem.to_string_lossy().into_owned())
}

fn not_utf8(name: &str, error: &std::string::FromUtf8Error) -> SceneErrors {
    let document = Document::new(name, &String::from_utf8_lossy(error.as_bytes()));
    // Up to the first bad byte the text is as it was.
    let at = error.utf8_error().valid_up_to();
    let mut findings = Findings::default();
    let span = Span { text: 0, start: at, end: at + 1 };
    findings.at(span, &Key::root(), "not valid UTF-8", "save the file as UTF-8 text");
    document.settle(findings)
}
