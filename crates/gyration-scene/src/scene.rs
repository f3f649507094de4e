//! A scene: read → check → build, all errors at once.

use crate::assemble::{Built, WaveRun, WaveStart};
use crate::document::Diagnostics;
use crate::error::{ErrorKind, NotToml, SceneErrors};
use crate::file::{Behaviour, LatticeWave, OneOrMany, SceneFile};
use crate::file_sum::FileSum;
use crate::key::Key;
use crate::overriding::Override;
use crate::turn::WrittenTurn;
use crate::units::without_rounding;
use crate::unknown::{FIX, GIVEN_UP, NoForm, NoWave, PATIENCE, Unknown, UnknownForm};
use gyration::body::Body;
use gyration::fluid::Form;
use gyration::model::Model;
use gyration_files::Files;
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::Path;

/// A scene without errors, with its text, its resolved form and its model.
#[derive(Debug, Clone)]
pub struct Scene {
    pub(crate) name: String,
    pub(crate) text: String,
    pub(crate) files: Files,
    pub(crate) file_sums: Vec<FileSum>,
    pub(crate) overrides: Vec<Override>,
    pub(crate) file: SceneFile,
    /// What contacts of these indices do, instead of laws.
    pub(crate) behaviours: Vec<(usize, Behaviour)>,
    /// How bodies of these indices are turned and turn, where the resolved form has matrices instead.
    pub(crate) turns: Vec<(usize, WrittenTurn)>,
    pub(crate) built: Built,
    pub(crate) unknown: Option<Box<Unknown>>,
}

impl Scene {
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

    /// The folder to which paths in it are relative; empty where its files were handed over.
    pub fn base(&self) -> &Path {
        self.files.folder()
    }

    /// The files that it names, tables and meshes, by their keys, with a checksum of what was found in each.
    pub fn file_sums(&self) -> &[FileSum] {
        &self.file_sums
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

    /// Every number that can be set: the resolved form, with what contacts do beside the laws that follow from it, and
    /// orientation and angular velocity of bodies that deform beside the matrices.
    ///
    /// It is no scene: a law and what it follows from exclude one another.
    pub fn numbers(&self) -> Value {
        let mut all = self.resolved();
        for (contact, behaviour) in &self.behaviours {
            all["contact"][contact]["from"] = serde_json::to_value(behaviour.with_exponent()).unwrap_or_default();
        }
        for (body, turn) in &self.turns {
            turn.put(&mut all["body"][body]);
        }
        all
    }

    /// The resolved form in TOML, for people: without what a change of units has left in the last digit of a number.
    ///
    /// # Errors
    /// [`NotToml`] if it has none.
    pub fn to_toml(&self) -> Result<String, NotToml> {
        Ok(numbers_as_shown(&toml::to_string(&self.file)?))
    }

    /// The resolved form in TOML with only those of its bodies that these of the model come from; where contacts name
    /// others, it is no scene.
    ///
    /// # Errors
    /// [`NotToml`] if it has none.
    pub fn excerpt(&self, bodies: &[usize]) -> Result<String, NotToml> {
        let numbers: BTreeSet<usize> =
            bodies.iter().filter_map(|body| self.built.written.get(*body).copied()).collect();
        let body = numbers.iter().map(|number| self.file.body[*number].clone()).collect();
        Ok(numbers_as_shown(&toml::to_string(&SceneFile { body, ..self.file.clone() })?))
    }

    /// The forms whose resistance is not known.
    pub fn unknown_forms(&self) -> &[UnknownForm] {
        self.unknown.as_ref().map_or(&[], |unknown| &unknown.forms)
    }

    /// Whether it can run: all forms are known, and it starts with the waves that it asks for.
    pub fn is_complete(&self) -> bool {
        self.unknown.is_none()
    }

    /// The scene with the forms that are asked for here, each of a body of the model, and with its waves, which are
    /// asked for at last: how the run begins with them.
    ///
    /// # Errors
    /// Why a surface has no resistance, at the key of its shape; why a wave is none, at its key.
    pub fn complete(
        mut self,
        mut form: impl FnMut(&Body, &UnknownForm) -> Result<Form, NoForm>,
        start: impl FnOnce(&Model, &WaveStart) -> Result<WaveRun, NoWave>,
    ) -> Result<Self, SceneErrors> {
        let Some(Unknown { forms, document }) = self.unknown.take().map(|unknown| *unknown) else { return Ok(self) };
        let mut diagnostics = Diagnostics::of(ErrorKind::Value);
        for asked in forms {
            let number = self.built.written[asked.body];
            match form(&self.built.model.bodies[asked.body], &asked) {
                Ok(found) => self.built.give_form(asked.body, &found),
                Err(error) => {
                    let key = Key::root().key("body").index(number).key("shape");
                    match error {
                        NoForm::Surface(problem) => diagnostics.at(key.span(&document.root), &key, problem, FIX),
                        NoForm::Interrupted => {
                            diagnostics.look_at(ErrorKind::Interrupted);
                            diagnostics.at(key.span(&document.root), &key, GIVEN_UP, PATIENCE);
                        }
                    }
                }
            }
        }
        if let Some(waves) = self.built.waves.take().filter(|_| diagnostics.is_empty()) {
            match start(&self.built.model, &waves) {
                Ok(WaveRun { model, state, strain }) => {
                    self.built.model = model;
                    self.built.state = state;
                    if let (Some(strain), Some(cell)) = (strain, &mut self.built.cell) {
                        *cell = cell.at_rest(&strain);
                    }
                }
                Err(NoWave { wave, key: word, problem, help, is_interrupted }) => {
                    let mut key = Key::root().key("lattice").key("wave");
                    if let (Some(index), Some(OneOrMany::Many(_))) = (wave, self.written_waves()) {
                        key = key.index(index);
                    }
                    let key = word.map_or(key.clone(), |word| key.key(word));
                    if is_interrupted {
                        diagnostics.look_at(ErrorKind::Interrupted);
                    }
                    diagnostics.at(key.span(&document.root), &key, problem, help);
                }
            }
        }
        if diagnostics.is_empty() { Ok(self) } else { Err(document.errors(diagnostics)) }
    }

    /// The scene as it is without the waves with which its run starts.
    #[must_use]
    pub fn without_waves(mut self) -> Self {
        self.built.waves = None;
        self
    }

    /// The waves as the file has them.
    fn written_waves(&self) -> Option<&OneOrMany<LatticeWave>> {
        self.file.lattice.as_ref()?.wave.as_ref()
    }
}

/// Digits from which on a number may end with rounding.
const MANY_DIGITS: usize = 15;

/// A text of TOML with the numbers that its long numbers stand for.
fn numbers_as_shown(text: &str) -> String {
    let is_of_number = |c: char| c.is_ascii_alphanumeric() || matches!(c, '.' | '+' | '-' | '_');
    let mut shown = String::with_capacity(text.len());
    let mut quote = None;
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let word = rest.find(|c| !is_of_number(c)).unwrap_or(rest.len());
        if quote.is_none() && word > MANY_DIGITS {
            let (word, behind) = rest.split_at(word);
            match word.parse::<f64>().map(without_rounding) {
                Ok(value) if value.is_finite() => shown.push_str(&format!("{value:?}")),
                _ => shown.push_str(word),
            }
            rest = behind;
            continue;
        }
        quote = match (quote, first) {
            (None, '"' | '\'') => Some(first),
            // A quote within double quotes stands behind a backslash.
            (Some(open), _) if open == first && (open == '\'' || !shown.ends_with('\\')) => None,
            (open, _) => open,
        };
        let length = if quote.is_none() { word.max(first.len_utf8()) } else { first.len_utf8() };
        let (piece, behind) = rest.split_at(length);
        shown.push_str(piece);
        rest = behind;
    }
    shown
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_a_text_are_shown_without_rounding_and_strings_stay() {
        let text = "title = \"of 1249.9999999999998\"\nx = [1249.9999999999998, -0.30000000000000004, 1e-5]\n\
                    key-0.30000000000000004 = 0.3333333333333333\n";
        let shown = "title = \"of 1249.9999999999998\"\nx = [1250.0, -0.3, 1e-5]\n\
                     key-0.30000000000000004 = 0.3333333333333333\n";
        assert_eq!(numbers_as_shown(text), shown);
    }
}
