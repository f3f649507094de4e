//! A scene read once, of which many are made: its text is parsed, its overrides are not yet applied.
//!
//! [`Scene::parse`] is [`Template::parse`] and [`Template::scene`]; the errors are the same either way. A study opens a
//! scene thousands of times, each with other numbers.

use crate::assemble::{SceneContext, assemble, salvage};
use crate::check::{PartialScene, Placed, RULES, Reporter, structure, values};
use crate::document::{Diagnostics, Document};
use crate::error::{ErrorKind, LoadError, ReadError, SceneErrors};
use crate::file::{Body, Contact};
use crate::gallery;
use crate::key::name_of;
use crate::overriding::Override;
use crate::read;
use crate::scene::Scene;
use crate::suggest;
use crate::tree::Node;
use crate::turn::WrittenTurn;
use crate::unknown::Unknown;
use gyration_files::Files;
use std::borrow::Cow;
use std::path::{Path, PathBuf};

/// A scene whose text is read.
#[derive(Debug, Clone)]
pub struct Template {
    document: Document,
    files: Files,
    /// The name of its file without folder and ending.
    stem: String,
}

impl Template {
    /// Reads a scene by its path or, if there is no such file, by its name in the gallery.
    ///
    /// # Errors
    /// [`LoadError::Read`] if the file cannot be read, [`LoadError::Content`] if its text has errors of syntax.
    pub fn open(path_or_name: &str) -> Result<Self, LoadError> {
        let path = Path::new(path_or_name);
        if path.is_file() {
            return Self::load(path);
        }
        match gallery::find(path_or_name) {
            Some(text) => Ok(Self::parse(&format!("{path_or_name}.toml"), text, Path::new(""))?),
            None if path.exists() => Self::load(path),
            None => {
                let names = gallery::gallery().iter().map(|(name, _)| *name);
                let help = suggest::fix(path_or_name, names, "the gallery has");
                Err(ReadError::NotFound { path: PathBuf::from(path), help }.into())
            }
        }
    }

    /// Reads a scene from a file; paths in it are relative to its folder.
    ///
    /// # Errors
    /// As of [`Template::open`].
    pub fn load(path: &Path) -> Result<Self, LoadError> {
        let (name, text) = read::text(path)?;
        let base = path.parent().unwrap_or(Path::new(""));
        Ok(Self::parse(&name, &text, base)?)
    }

    /// Reads a scene from a text; `name` is what messages call it, paths in it are relative to `base`.
    ///
    /// The text is TOML, or JSON if the name ends in `.json` or the text begins with a brace.
    ///
    /// # Errors
    /// All errors of its syntax. Behind one the tree is a guess: nothing more can be said about it.
    pub fn parse(name: &str, text: &str, base: &Path) -> Result<Self, SceneErrors> {
        Self::among(name, text, base.into())
    }

    /// The same of a text that names some of these files.
    ///
    /// # Errors
    /// As of [`Template::parse`].
    pub fn among(name: &str, text: &str, files: Files) -> Result<Self, SceneErrors> {
        let document = read::document(name, text)?;
        Ok(Self { document, files, stem: stem(name) })
    }

    /// The scene with these overrides.
    ///
    /// # Errors
    /// Everything that is wrong in it, in the order of the text.
    pub fn scene(&self, overrides: &[Override]) -> Result<Scene, SceneErrors> {
        let found = self.checked(overrides);
        match &found {
            // Errors have their places in overrides as they would be written.
            Err(_) if !overrides.iter().all(Override::is_text) => {
                let written: Vec<_> = overrides.iter().map(|one| Override::parse(&one.to_string())).collect();
                self.checked(&written)
            }
            _ => found,
        }
    }

    fn checked(&self, overrides: &[Override]) -> Result<Scene, SceneErrors> {
        let mut document = Cow::Borrowed(&self.document);
        let mut diagnostics = Diagnostics::of(ErrorKind::Structure);
        if !overrides.is_empty() {
            read::apply(document.to_mut(), overrides, &mut diagnostics);
        }
        structure(&document.root, &RULES, &mut diagnostics);
        let mut partial = PartialScene::new(&document, &self.files, &mut diagnostics);
        let mut reporter = Reporter::new(&document, &mut diagnostics);
        values(&partial, &mut reporter);
        let constants = partial.constants.clone();
        let context = SceneContext::new(&partial, &document, &self.files, constants.as_ref());
        let said = |(index, contact): (usize, &Placed<Contact>)| Some((index, contact.value.from?));
        let behaviours = partial.contacts.iter().enumerate().filter_map(said).collect();
        let turned = |(index, body): (usize, &Placed<Body>)| Some((index, WrittenTurn::of(&body.value)?));
        let turns = partial.bodies.iter().enumerate().filter_map(turned).collect();
        let built = assemble(&mut partial, &context, &mut reporter);
        salvage(&document, &context, &mut diagnostics);
        match (partial.complete(), built) {
            (Some(file), Some((built, forms))) if diagnostics.is_empty() => {
                let (name, text, files) = (self.stem.clone(), self.text().to_owned(), self.files.clone());
                let (overrides, file_sums) = (overrides.to_vec(), diagnostics.into_files());
                let unknown = (!forms.is_empty() || built.waves.is_some())
                    .then(|| Box::new(Unknown { forms, document: document.into_owned() }));
                Ok(Scene { name, text, files, file_sums, overrides, file, behaviours, turns, built, unknown })
            }
            _ => Err(document.errors(diagnostics)),
        }
    }

    /// A dotted key with items of arrays by their indices, as far as the text has what it names: two keys of one place
    /// are the same then.
    pub fn by_index(&self, key: &str) -> String {
        let mut at = Some(&self.document.root);
        let word = |word: &str| {
            let word = word.trim().trim_matches('"');
            let items = at.map(Node::items).unwrap_or_default();
            let named = items.iter().position(|item| name_of(item) == Some(word));
            let index = named.or_else(|| word.parse().ok().filter(|index| *index < items.len()));
            at = match index {
                Some(index) => items.get(index),
                None => at.and_then(|node| node.get(word)),
            };
            index.map_or_else(|| word.to_owned(), |index| index.to_string())
        };
        key.split('.').map(word).collect::<Vec<_>>().join(".")
    }

    /// The name of its file without folder and ending.
    pub fn name(&self) -> &str {
        &self.stem
    }

    /// What messages call its file.
    pub fn file_name(&self) -> &str {
        self.document.texts.first().map_or("", |text| &text.name)
    }

    /// The folder that paths in it are relative to; empty where its files were handed over.
    pub fn base(&self) -> &Path {
        self.files.folder()
    }

    /// Its text, verbatim.
    pub fn text(&self) -> &str {
        self.document.texts.first().map_or("", |text| &text.content)
    }

    /// What it says, without overrides and defaults, comments and layout.
    pub fn written(&self) -> serde_json::Value {
        self.document.root.to_json()
    }
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

    /// The same of a text that names some of these files.
    ///
    /// # Errors
    /// As of [`Scene::parse`].
    pub fn among(name: &str, text: &str, files: Files, overrides: &[String]) -> Result<Self, SceneErrors> {
        Template::among(name, text, files)?.scene(&Override::parse_all(overrides))
    }
}

fn stem(name: &str) -> String {
    Path::new(name).file_stem().map_or_else(|| name.to_owned(), |stem| stem.to_string_lossy().into_owned())
}

/// The SI unit of the quantity at a dotted key of a scene, `"m"` of `body.die.position.2`; none of what is no quantity.
pub fn unit_of(key: &str) -> Option<&'static str> {
    RULES.unit_of(key)
}
