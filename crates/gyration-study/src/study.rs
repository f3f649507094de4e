//! A study: a scene, what is varied in it, and what is kept of each run.
//!
//! ```text
//! text → input → read (all errors at once) → probe (the scene of the first run) → Study
//! run number → point, repetition → values → overrides of the scene → run → row
//! ```
//!
//! Run = point · repetitions + repetition; the points of the grid are counted with the first axis slowest. A row
//! depends on the study and the number of its run alone.

use crate::column::{Column, ending, leading};
use crate::extract::{ColumnPlaces, Extractor};
use crate::fingerprint::fingerprint;
use crate::gallery;
use crate::keep::Keep;
use crate::parameter::{Dice, Parameter, RunPlace, Variation};
use crate::random::Sobol;
use crate::read::{self, Read};
use crate::value::Value;
use gyration_scene::input::{InputFile, fix};
use gyration_scene::{LoadError, Override, OverrideValue, ReadError, Scene, SceneErrors, Template};
use gyration_sim::{RunPlan, complete};
use serde_json::Value as Json;
use std::path::{Path, PathBuf};

pub use crate::file::{Recordings, Sampling};

/// A study without errors.
#[derive(Debug, Clone)]
pub struct Study {
    source: StudySource,
    pub(crate) read: Read,
    pub(crate) template: Template,
    pub(crate) dice: Dice,
    columns: Vec<Column>,
    fingerprint: String,
}

/// Where a study comes from: enough to open it again on another machine that has its scene.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StudySource {
    /// What messages call its file.
    pub name: String,
    /// Its text, verbatim.
    pub text: String,
    /// The folder that the path of its scene is relative to.
    pub base: PathBuf,
    /// What is changed in it, each `KEY=VALUE`.
    pub overrides: Vec<String>,
}

impl Study {
    /// Opens a study by its path or, if there is no such file, by its name among the ready ones.
    ///
    /// Each override is `KEY=VALUE`, `repetitions=100` or `parameter.height.uniform.to=0.5`.
    ///
    /// # Errors
    /// [`LoadError::Read`] if the file cannot be read, [`LoadError::Content`] with everything that is wrong in it or in
    /// its scene.
    pub fn open(path_or_name: &str, overrides: &[String]) -> Result<Self, LoadError> {
        let path = Path::new(path_or_name);
        if path.is_file() {
            let base = path.parent().unwrap_or(Path::new(""));
            let input = InputFile::load(path, &read::RULES, overrides)?;
            return Self::new(input, &path.display().to_string(), base, overrides);
        }
        match gallery::find(path_or_name) {
            Some(text) => Self::parse(&format!("{path_or_name}.toml"), text, Path::new(""), overrides),
            None if path.exists() => {
                InputFile::load(path, &read::RULES, overrides)?;
                Err(not_found(path_or_name))
            }
            None => Err(not_found(path_or_name)),
        }
    }

    /// Reads a study from a text; `name` is what messages call it, the path of its scene is relative to `base`.
    ///
    /// # Errors
    /// Everything that is wrong in it or in its scene.
    pub fn parse(name: &str, text: &str, base: &Path, overrides: &[String]) -> Result<Self, LoadError> {
        let input = InputFile::parse(name, text, &read::RULES, overrides)?;
        Self::new(input, name, base, overrides)
    }

    /// Opens a study again from where it came from.
    ///
    /// # Errors
    /// As of [`Study::parse`].
    pub fn again(source: &StudySource) -> Result<Self, LoadError> {
        Self::parse(&source.name, &source.text, &source.base, &source.overrides)
    }

    fn new(mut input: InputFile, name: &str, base: &Path, overrides: &[String]) -> Result<Self, LoadError> {
        let source = StudySource {
            name: name.to_owned(),
            text: input.text().to_owned(),
            base: base.to_owned(),
            overrides: overrides.to_vec(),
        };
        let read = read::read(&mut input);
        let template = read::scene(&mut input, &read.scene, base);
        if let Some(Ok(template)) = &template {
            read::keys_once(&read, template, &mut input);
        }
        let template = match (template, input.is_sound()) {
            (Some(template), true) => template?,
            // What is wrong with the study may be what is wrong with its scene.
            (template, _) => {
                if let Some(Ok(template)) = template {
                    look_further(&template, &read, &mut input);
                }
                return Err(input.refused().into());
            }
        };
        let dice = dice(&read);
        let values = values(&read, &dice, place(&read, 0));
        let overrides = overrides_of(&read, &values);
        let Some(scene) = read::probe(&template, &read, &overrides, &mut input)? else {
            return Err(input.refused().into());
        };
        let columns = columns(&read, &scene, &mut input);
        input.finish()?;
        let fingerprint = fingerprint(&read, &columns, &template, &scene);
        Ok(Self { source, read, template, dice, columns, fingerprint })
    }

    /// Where it comes from.
    pub fn source(&self) -> &StudySource {
        &self.source
    }

    /// The name of its file without folder and ending.
    pub fn name(&self) -> String {
        let stem = Path::new(&self.source.name).file_stem();
        stem.map_or_else(|| "study".to_owned(), |stem| stem.to_string_lossy().into_owned())
    }

    /// What it asks, if it says so.
    pub fn title(&self) -> Option<&str> {
        self.read.title.as_deref()
    }

    /// How many runs it has.
    pub fn runs(&self) -> u64 {
        self.points() * self.repetitions()
    }

    /// How many points its grid has.
    pub fn points(&self) -> u64 {
        self.read.axes.iter().product()
    }

    /// How many runs each point of the grid has.
    pub fn repetitions(&self) -> u64 {
        self.read.repetitions
    }

    /// The lengths of the axes of its grid, the slowest first.
    pub fn axes(&self) -> &[u64] {
        &self.read.axes
    }

    /// What is varied.
    pub fn parameters(&self) -> &[Parameter] {
        &self.read.parameters
    }

    /// What is kept, by the name of its column.
    pub fn keeps(&self) -> &[(String, Keep)] {
        &self.read.keeps
    }

    /// The columns of its table.
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// Which runs leave a recording.
    pub fn recordings(&self) -> Recordings {
        self.read.recordings
    }

    /// Its `[plot]`; null if it has none.
    pub fn plot(&self) -> &Json {
        &self.read.plot
    }

    /// The scene that its runs are made from.
    pub fn template(&self) -> &Template {
        &self.template
    }

    /// A word that tells it from every study with other rows.
    pub fn fingerprint(&self) -> &str {
        &self.fingerprint
    }

    /// The scene of a run, ready to run; `run` < [`Study::runs`].
    ///
    /// # Errors
    /// What is wrong with the values of this run.
    pub fn scene_of(&self, run: u64) -> Result<Scene, SceneErrors> {
        self.scene_with(&self.values(self.place(run)))
    }

    /// The scene with these values, ready to run.
    pub(crate) fn scene_with(&self, values: &[(OverrideValue, Vec<Value>)]) -> Result<Scene, SceneErrors> {
        complete(self.template.scene(&self.overrides(values))?)
    }

    pub(crate) fn overrides(&self, values: &[(OverrideValue, Vec<Value>)]) -> Vec<Override> {
        overrides_of(&self.read, values)
    }

    /// The value of each parameter in a run, and its cells.
    pub(crate) fn values(&self, place: RunPlace) -> Vec<(OverrideValue, Vec<Value>)> {
        values(&self.read, &self.dice, place)
    }

    pub(crate) fn place(&self, run: u64) -> RunPlace {
        place(&self.read, run)
    }

    /// Whether something that is kept takes the samples of the run.
    pub(crate) fn needs_samples(&self) -> bool {
        self.read.keeps.iter().any(|(_, keep)| keep.needs_samples())
    }
}

fn not_found(name: &str) -> LoadError {
    let names = gallery::studies().iter().map(|(name, _)| *name);
    let help = format!("nor a study that is ready; {}", fix(name, names, "there are"));
    ReadError::Missing { path: PathBuf::from(name), help }.into()
}

/// Notes what else is wrong with a study: keys and columns that its scene does not have, as far as its sound parts
/// tell.
fn look_further(template: &Template, read: &Read, input: &mut InputFile) {
    let dice = Dice { seed: read.seed, sampling: Sampling::Random, repetitions: 1, sobol: Sobol::new(0) };
    let first = vec![0; read.axes.len().max(1)];
    let values: Vec<_> = read.parameters.iter().map(|p| p.at(&dice, place(read, 0), &first)).collect();
    if let Ok(Some(scene)) = read::probe(template, read, &overrides_of(read, &values), input) {
        columns(read, &scene, input);
    }
}

fn dice(read: &Read) -> Dice {
    let random = read.parameters.iter().map(|parameter| match &parameter.variation {
        Variation::Random { distribution, .. } => distribution.dimensions(),
        Variation::Axis { .. } => 0,
    });
    let sobol = if read.sampling == Sampling::Sobol { Sobol::new(random.sum()) } else { Sobol::new(0) };
    Dice { seed: read.seed, sampling: read.sampling, repetitions: read.repetitions, sobol }
}

fn place(read: &Read, run: u64) -> RunPlace {
    RunPlace { run, point: run / read.repetitions, repetition: run % read.repetitions }
}

fn values(read: &Read, dice: &Dice, place: RunPlace) -> Vec<(OverrideValue, Vec<Value>)> {
    let mut rest = place.point;
    let mut indices = vec![0; read.axes.len()];
    for (index, length) in indices.iter_mut().zip(&read.axes).rev() {
        *index = rest % length;
        rest /= length;
    }
    read.parameters.iter().map(|parameter| parameter.at(dice, place, &indices)).collect()
}

fn overrides_of(read: &Read, values: &[(OverrideValue, Vec<Value>)]) -> Vec<Override> {
    let settings = read.settings.iter().map(|(key, value)| Override::new(key, value.as_str()));
    let varied = read.parameters.iter().zip(values);
    let varied =
        varied.flat_map(|(parameter, (value, _))| parameter.keys.iter().map(|key| Override::new(key, value.clone())));
    settings.chain(varied).collect()
}

/// The columns of the table; what is kept of a column or a body that is not there is noted.
fn columns(read: &Read, scene: &Scene, input: &mut InputFile) -> Vec<Column> {
    let built = scene.built();
    let layout = ColumnPlaces::new(&built.model, &RunPlan::from(built));
    let mut columns: Vec<Column> = leading().into();
    columns.extend(read.parameters.iter().flat_map(|parameter| parameter.columns.iter().cloned()));
    columns.extend(ending());
    for (index, (name, keep)) in read.keeps.iter().enumerate() {
        if let Err(message) = Extractor::new(&read.keeps[index..=index], &built.model, &layout) {
            let (message, help) = message.split_once(": ").unwrap_or((&message, ""));
            input.note(&["keep", name], message, help);
        }
        columns.push(keep.table_column(name, keep.column().and_then(|column| layout.unit(column))));
    }
    columns
}
