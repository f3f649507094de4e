//! `Scene`: a scene without errors, and what can be done with it.

use crate::convert::{self, json, object, overrides, shown, to_python};
use crate::errors;
use crate::monitor::interruptibly;
use crate::picture::Picture;
use crate::recording::Recording;
use crate::run::{RecordOptions, run};
use gyration_scene::{Scene as Inner, gallery, gallery_scene, listed};
use gyration_sim::survey::Survey;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyIterator, PyType};
use serde_json::Value;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// What a scene is made of again elsewhere: its name in messages, text, folder, overrides.
pub type SceneParts = (String, String, PathBuf, Vec<String>);

/// A scene: bodies, supports, laws, how long to run and how precisely. It has no errors, and does not change: `edit`
/// gives another one.
#[pyclass(frozen, from_py_object, module = "gyration", name = "Scene")]
#[derive(Clone)]
pub struct Scene {
    pub inner: Arc<Inner>,
    /// What messages call it, and the folder to which its paths are relative.
    file: String,
    base: PathBuf,
}

impl Scene {
    /// What it is made of, for whoever works in another folder: name, text, folder, edits.
    pub fn parts(&self) -> SceneParts {
        let base = convert::elsewhere(&self.base);
        (self.file.clone(), self.inner.text().to_owned(), base, self.inner.overrides())
    }

    /// Reads a text without the lock: a mesh may take a while.
    pub fn parse(py: Python<'_>, file: String, text: &str, base: PathBuf, overrides: &[String]) -> PyResult<Self> {
        let inner =
            py.detach(|| Inner::parse(&file, text, &base, overrides)).map_err(|error| errors::content(&error))?;
        Ok(Self { inner: Arc::new(inner), file, base })
    }

    /// The scene of an argument, ready to run: with the resistances that boundary elements tell.
    pub fn ready(argument: &Bound<'_, PyAny>) -> PyResult<Arc<Inner>> {
        completed(argument.py(), Self::of(argument)?)
    }

    /// The scene that an argument stands for: a scene, a dictionary, a path or the name of one in the gallery.
    pub fn of(argument: &Bound<'_, PyAny>) -> PyResult<Arc<Inner>> {
        Ok(Self::from_argument(argument)?.inner)
    }

    /// The same with its name and folder.
    pub fn from_argument(argument: &Bound<'_, PyAny>) -> PyResult<Self> {
        let py = argument.py();
        if let Ok(scene) = argument.cast::<Self>() {
            return Ok(scene.get().clone());
        }
        if let Ok(data) = argument.cast::<PyDict>() {
            return Self::from_dict(&py.get_type::<Self>(), data, "scene", None, None);
        }
        let name: PathBuf = argument.extract().map_err(|_| {
            errors::arguments(format!(
                "{} is no scene\n  fix: give a Scene, a path, a name of the gallery, or a dictionary",
                shown(argument)
            ))
        })?;
        let opened = py.detach(|| Inner::open(&name.to_string_lossy(), &[]));
        let inner = Arc::new(opened.map_err(errors::load)?);
        let base = name.parent().unwrap_or(Path::new("")).to_path_buf();
        // One of the gallery is called so by itself.
        let file = if name.exists() { name.display().to_string() } else { format!("{}.toml", name.display()) };
        Ok(Self { inner, file, base })
    }

    /// The same, ready to run.
    pub fn complete(self, py: Python<'_>) -> PyResult<Self> {
        Ok(Self { inner: completed(py, self.inner.clone())?, ..self })
    }
}

#[pymethods]
impl Scene {
    /// A scene from a path, the name of one in the gallery, or a dictionary; see :meth:`from_file`, :meth:`gallery` and
    /// :meth:`from_dict`, which take more.
    #[new]
    fn new(scene: &Bound<'_, PyAny>) -> PyResult<Self> {
        Self::from_argument(scene)
    }

    /// A scene from a file, TOML or JSON; paths in it are relative to its folder.
    ///
    /// ``overrides`` are changes by dotted key, as for :meth:`edit`. Raises ``SceneError`` with everything that is
    /// wrong, ``FileError`` if the file cannot be read.
    #[classmethod]
    #[pyo3(signature = (path, overrides=None))]
    fn from_file(kind: &Bound<'_, PyType>, path: PathBuf, overrides: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let (py, changes) = (kind.py(), convert::overrides(overrides)?);
        let inner = py.detach(|| Inner::load(&path, &changes)).map_err(errors::load)?;
        let base = path.parent().unwrap_or(Path::new("")).to_path_buf();
        Ok(Self { inner: Arc::new(inner), file: path.display().to_string(), base })
    }

    /// A scene from a text, TOML or JSON. ``name`` is what messages call it, ``base`` the folder of its paths.
    #[classmethod]
    #[pyo3(signature = (text, name="scene.toml", base=None, overrides=None))]
    fn from_text(
        kind: &Bound<'_, PyType>,
        text: &str,
        name: &str,
        base: Option<PathBuf>,
        overrides: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let changes = convert::overrides(overrides)?;
        Self::parse(kind.py(), name.to_owned(), text, base.unwrap_or_default(), &changes)
    }

    /// A scene from a dictionary of the keys of a scene file. Numbers are in SI units, texts may have units: ``"30
    /// deg"``. Arrays of NumPy are lists.
    #[classmethod]
    #[pyo3(signature = (data, name="scene", base=None, overrides=None))]
    fn from_dict(
        kind: &Bound<'_, PyType>,
        data: &Bound<'_, PyDict>,
        name: &str,
        base: Option<PathBuf>,
        overrides: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let text = json(data)?;
        let changes = convert::overrides(overrides)?;
        Self::parse(kind.py(), format!("{name}.json"), &text, base.unwrap_or_default(), &changes)
    }

    /// A scene of the built-in gallery by its name, see :func:`scenes`.
    #[classmethod]
    #[pyo3(signature = (name, overrides=None))]
    fn gallery(kind: &Bound<'_, PyType>, name: &str, overrides: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let (py, changes) = (kind.py(), convert::overrides(overrides)?);
        let text = gallery_scene(name).map_err(|unknown| errors::arguments(unknown.to_string()))?;
        Self::parse(py, format!("{name}.toml"), text, PathBuf::new(), &changes)
    }

    /// Another scene with changes by dotted key: ``scene.edit({"body.die.velocity": [1, 0, 0]})``.
    ///
    /// Items of lists are named by their ``name`` or their index from zero. Numbers are in SI units.
    #[pyo3(signature = (changes=None, /, **keys))]
    fn edit(
        &self,
        py: Python<'_>,
        changes: Option<&Bound<'_, PyDict>>,
        keys: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let mut all = self.inner.overrides();
        all.extend(overrides(changes)?);
        all.extend(overrides(keys)?);
        Self::parse(py, self.file.clone(), self.inner.text(), self.base.clone(), &all)
    }

    /// A value of the resolved scene by its dotted key, in SI units: ``scene["body.die.velocity"]``.
    fn __getitem__<'py>(&self, py: Python<'py>, key: &str) -> PyResult<Bound<'py, PyAny>> {
        to_python(py, find(&self.inner.resolved(), key)?)
    }

    /// Whether the resolved scene has a value of this dotted key.
    fn __contains__(&self, key: &str) -> bool {
        find(&self.inner.resolved(), key).is_ok()
    }

    /// The dotted keys of the resolved scene.
    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyIterator>> {
        self._ipython_key_completions_().into_pyobject(py)?.try_iter()
    }

    fn _ipython_key_completions_(&self) -> Vec<String> {
        let mut keys = Vec::new();
        add_keys(&self.inner.resolved(), "", &mut keys);
        keys
    }

    /// The name of the scene: that of its file without folder and ending.
    #[getter]
    fn name(&self) -> &str {
        self.inner.name()
    }

    /// The title of the scene, if it has one.
    #[getter]
    fn title(&self) -> Option<&str> {
        self.inner.file().title.as_deref()
    }

    /// The text of the scene as it was read; edits are not in it.
    #[getter]
    fn text(&self) -> &str {
        self.inner.text()
    }

    /// The edits, ``KEY=VALUE``, in their order.
    #[getter]
    fn overrides(&self) -> Vec<String> {
        self.inner.overrides()
    }

    /// The scene with units resolved to SI, edits made and every default in its place; itself a scene.
    #[getter]
    fn resolved<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        match self.inner.resolved() {
            Value::Object(entries) => object(py, &entries),
            other => to_python(py, &other),
        }
    }

    /// The names of the bodies, in order.
    #[getter]
    fn bodies(&self) -> Vec<String> {
        self.inner.built().model.names().map(str::to_owned).collect()
    }

    /// The names of the supports, in order.
    #[getter]
    fn supports(&self) -> Vec<String> {
        let model = &self.inner.built().model;
        let planes = model.supports.iter().map(|support| support.name.clone());
        planes.chain(model.solid_supports.iter().map(|support| support.name.clone())).collect()
    }

    /// What can be said of the scene before it runs, as ``gyration check`` prints it: mass, rest gaps, time scales,
    /// whether laws forbid touching, resolved form.
    fn check(&self, py: Python<'_>) -> PyResult<String> {
        let survey = interruptibly(py, || Survey::of(&self.inner))?.map_err(|error| errors::content(&error))?;
        survey.text(&self.inner).map_err(|error| errors::arguments(error.to_string()))
    }

    /// Runs the scene into a recording.
    ///
    /// ``output`` is its folder; without it the recording lives in a temporary folder, for as long as the object does.
    /// ``progress`` is True for a line on stderr, or a function of (time [s], end [s]); if it returns False the run
    /// stops and can be resumed. ``resume`` goes on with the recording that is there, ``force`` replaces it.
    ///
    /// A run that ends early for a physical reason raises nothing: see :attr:`Recording.outcome`. Ctrl-C closes the
    /// recording at the end of a step and raises ``KeyboardInterrupt``. Other threads of Python go on meanwhile.
    #[pyo3(signature = (output=None, *, progress=None, resume=false, force=false))]
    fn run(
        &self,
        py: Python<'_>,
        output: Option<PathBuf>,
        progress: Option<&Bound<'_, PyAny>>,
        resume: bool,
        force: bool,
    ) -> PyResult<Recording> {
        let scene = completed(py, self.inner.clone())?;
        run(py, &scene, RecordOptions { output, resume, force }, progress)
    }

    /// The laws of its contacts against distance.
    fn plot(&self, py: Python<'_>) -> PyResult<Picture> {
        py.detach(|| Picture::of_laws(self.inner.clone()))
    }

    /// Whether it is made of the same: text, edits, name, folder.
    fn __eq__(&self, other: &Self) -> bool {
        self.parts() == other.parts()
    }

    /// Without the folder: as seen from elsewhere it has another name.
    fn __hash__(&self) -> u64 {
        let mut hasher = DefaultHasher::new();
        (&self.file, self.inner.text(), self.inner.overrides()).hash(&mut hasher);
        hasher.finish()
    }

    /// For pickle.
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, SceneParts)> {
        let again = py.import("gyration._gyration")?.getattr("_scene")?;
        Ok((again, self.parts()))
    }

    fn __repr__(&self) -> String {
        // Copies have one name here.
        let bodies: Vec<&str> = self.inner.file().body.iter().map(|body| body.name.as_str()).collect();
        let title = self.title().map(|title| format!(" {title:?}")).unwrap_or_default();
        format!("<gyration.Scene {}{title}: {}>", self.inner.name(), listed(bodies))
    }
}

/// A scene ready to run; without the lock, since boundary elements may take a while.
fn completed(py: Python<'_>, scene: Arc<Inner>) -> PyResult<Arc<Inner>> {
    if scene.is_complete() {
        return Ok(scene);
    }
    let found = interruptibly(py, || gyration_sim::complete((*scene).clone()))?;
    Ok(Arc::new(found.map_err(|error| errors::content(&error))?))
}

/// A scene again, from what `__reduce__` gave.
#[pyfunction]
#[pyo3(name = "_scene")]
pub fn scene_again(py: Python<'_>, file: String, text: &str, base: PathBuf, overrides: Vec<String>) -> PyResult<Scene> {
    Scene::parse(py, file, text, base, &overrides)
}

/// The names of the built-in gallery.
#[pyfunction]
pub fn scenes() -> Vec<&'static str> {
    gallery().iter().map(|(name, _)| *name).collect()
}

/// A value of the resolved scene by its dotted key; items of arrays by name, else by index.
fn find<'a>(resolved: &'a Value, key: &str) -> PyResult<&'a Value> {
    let mut at = resolved;
    for (depth, word) in key.split('.').enumerate() {
        let next = match at {
            Value::Object(entries) => entries.get(word),
            Value::Array(items) => {
                let named = items.iter().find(|item| item.get("name").and_then(Value::as_str) == Some(word));
                named.or_else(|| items.get(word.parse::<usize>().ok()?))
            }
            _ => None,
        };
        at = next.ok_or_else(|| {
            let before = key.split('.').take(depth).collect::<Vec<_>>().join(".");
            let place = if before.is_empty() { "the scene".to_owned() } else { format!("`{before}`") };
            pyo3::exceptions::PyKeyError::new_err(format!("{place} has no `{word}`: it has {}", names(at)))
        })?;
    }
    Ok(at)
}

/// Adds the dotted keys of a value; items of arrays by name, else by index.
fn add_keys(value: &Value, before: &str, keys: &mut Vec<String>) {
    let parts: Vec<(String, &Value)> = match value {
        Value::Object(entries) => entries.iter().map(|(name, part)| (name.clone(), part)).collect(),
        Value::Array(items) if items.iter().all(Value::is_object) => items.iter().enumerate().map(item_name).collect(),
        _ => Vec::new(),
    };
    for (name, part) in parts {
        let key = if before.is_empty() { name } else { format!("{before}.{name}") };
        add_keys(part, &key, keys);
        keys.push(key);
    }
}

/// An item of an array with its name, or its index.
fn item_name((index, item): (usize, &Value)) -> (String, &Value) {
    (item.get("name").and_then(Value::as_str).map_or(index.to_string(), str::to_owned), item)
}

/// What a value has, in words.
fn names(value: &Value) -> String {
    match value {
        Value::Object(entries) => listed(entries.keys().map(String::as_str)),
        Value::Array(items) => {
            let names: Vec<String> = items.iter().enumerate().map(|item| item_name(item).0).collect();
            listed(names.iter().map(String::as_str))
        }
        other => format!("no parts, it is {other}"),
    }
}
