//! Values of Python and of JSON into each other, and into the text of an override.
//!
//! Whatever has `tolist` (arrays and numbers of NumPy) is taken as the list or number that it stands for. A number that
//! is not finite has no place in JSON: it is left to the scene to refuse, where there is a text to say so, and is
//! refused here else.

use crate::errors;
use numpy::{Element, PyArray, PyArrayMethods};
use pyo3::IntoPyObjectExt;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyString, PyTuple};
use serde::{Serialize, Serializer};
use serde_json::{Map, Number, Value};
use std::fmt;
use std::path::{Path, PathBuf};

/// The deepest nesting; a scene needs less than twenty.
const DEEPEST: usize = 64;

/// A folder as whoever works in another one knows it.
pub fn elsewhere(base: &Path) -> PathBuf {
    let here = if base.as_os_str().is_empty() { Path::new(".") } else { base };
    std::path::absolute(here).unwrap_or_else(|_| base.to_owned())
}

/// JSON as Python's objects.
pub fn to_python<'py>(py: Python<'py>, value: &Value) -> PyResult<Bound<'py, PyAny>> {
    match value {
        Value::Null => Ok(py.None().into_bound(py)),
        Value::Bool(value) => value.into_bound_py_any(py),
        Value::Number(number) => match number.as_i64() {
            Some(whole) => whole.into_bound_py_any(py),
            None => number.as_f64().into_bound_py_any(py),
        },
        Value::String(text) => text.into_bound_py_any(py),
        Value::Array(items) => {
            let items = items.iter().map(|item| to_python(py, item)).collect::<PyResult<Vec<_>>>()?;
            PyList::new(py, items)?.into_bound_py_any(py)
        }
        Value::Object(entries) => object(py, entries),
    }
}

/// An object of JSON as a dictionary.
pub fn object<'py>(py: Python<'py>, entries: &Map<String, Value>) -> PyResult<Bound<'py, PyAny>> {
    let dict = PyDict::new(py);
    for (key, value) in entries {
        dict.set_item(key, to_python(py, value)?)?;
    }
    dict.into_bound_py_any(py)
}

/// Whether what a callback returned asks to stop: False does, of Python or of NumPy, as comparisons of arrays have it.
/// A function that returns nothing goes on.
#[pyfunction]
#[pyo3(name = "_says_stop")]
pub fn says_stop(answer: &Bound<'_, PyAny>) -> PyResult<bool> {
    let is_boolean = answer.is_instance_of::<PyBool>() || {
        let kind = answer.get_type();
        kind.module()? == "numpy" && ["bool", "bool_"].iter().any(|name| kind.name().is_ok_and(|own| own == *name))
    };
    Ok(is_boolean && !answer.is_truthy()?)
}

/// What a Python object stands for.
enum Plain<'py> {
    Bool(bool),
    Whole(String),
    Real(f64),
    Text(String),
    List(Vec<Bound<'py, PyAny>>),
    Table(Vec<(String, Bound<'py, PyAny>)>),
}

fn plain<'py>(object: &Bound<'py, PyAny>) -> PyResult<Plain<'py>> {
    if let Ok(value) = object.cast::<PyBool>() {
        Ok(Plain::Bool(value.is_true()))
    } else if object.is_instance_of::<PyInt>() {
        Ok(Plain::Whole(object.str()?.to_string()))
    } else if object.is_instance_of::<PyFloat>() {
        Ok(Plain::Real(object.extract()?))
    } else if object.is_instance_of::<PyString>() {
        Ok(Plain::Text(object.extract()?))
    } else if object.is_instance_of::<PyList>() || object.is_instance_of::<PyTuple>() {
        Ok(Plain::List(object.try_iter()?.collect::<PyResult<_>>()?))
    } else if let Ok(table) = object.cast::<PyDict>() {
        let named = |(key, value): (Bound<'py, PyAny>, _)| match key.extract::<String>() {
            Ok(key) => Ok((key, value)),
            Err(_) => Err(errors::arguments(format!("the keys of a table are strings, not {key}"))),
        };
        Ok(Plain::Table(table.iter().map(named).collect::<PyResult<_>>()?))
    } else if object.hasattr("tolist")? {
        plain(&object.call_method0("tolist")?)
    } else if object.hasattr("__fspath__")? {
        Ok(Plain::Text(object.call_method0("__fspath__")?.extract()?))
    } else {
        let kind = object.get_type().name()?;
        let fix = match kind.to_str()? {
            "Scene" => "name the scene by its path, or as in the gallery, and write changes under `set`",
            _ => "give numbers, strings, booleans, lists, arrays or dictionaries",
        };
        Err(errors::arguments(format!("a value of type {kind} has no meaning here\n  fix: {fix}")))
    }
}

/// A name, or several.
#[derive(FromPyObject)]
pub enum Names {
    /// One alone.
    One(String),
    /// A list of them.
    Many(Vec<String>),
}

impl Names {
    /// All of them.
    pub fn list(self) -> Vec<String> {
        match self {
            Self::One(name) => vec![name],
            Self::Many(names) => names,
        }
    }
}

/// A Python object as a text of JSON, lines indented; tables keep their order, which tells the axes of a study.
pub fn json(object: &Bound<'_, PyAny>) -> PyResult<String> {
    let text = serde_json::to_string_pretty(&tree(object, &mut Vec::new())?);
    text.map(|text| text + "\n").map_err(|error| errors::arguments(error.to_string()))
}

/// JSON whose tables are in order.
enum OrderedJson {
    Leaf(Value),
    List(Vec<Self>),
    Table(Vec<(String, Self)>),
}

impl Serialize for OrderedJson {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Leaf(value) => value.serialize(serializer),
            Self::List(items) => serializer.collect_seq(items),
            Self::Table(entries) => serializer.collect_map(entries.iter().map(|(key, value)| (key, value))),
        }
    }
}

/// A step down from a table or a list.
enum KeyPart {
    Entry(String),
    Item(usize),
}

fn tree(object: &Bound<'_, PyAny>, place: &mut Vec<KeyPart>) -> PyResult<OrderedJson> {
    check_depth(place.len())?;
    Ok(OrderedJson::Leaf(match plain(object)? {
        Plain::Bool(value) => value.into(),
        Plain::Whole(digits) => match digits.parse::<i64>() {
            Ok(whole) => whole.into(),
            Err(_) => real(digits.parse().unwrap_or(f64::NAN), place)?,
        },
        Plain::Real(value) => real(value, place)?,
        Plain::Text(text) => text.into(),
        Plain::List(items) => {
            let item = |(number, item)| below(item, KeyPart::Item(number), place);
            return Ok(OrderedJson::List(items.iter().enumerate().map(item).collect::<PyResult<_>>()?));
        }
        Plain::Table(entries) => {
            let entry = |(key, value): (String, Bound<'_, PyAny>)| {
                let value = below(&value, KeyPart::Entry(key.clone()), place)?;
                Ok((key, value))
            };
            return Ok(OrderedJson::Table(entries.into_iter().map(entry).collect::<PyResult<_>>()?));
        }
    }))
}

fn below(object: &Bound<'_, PyAny>, step: KeyPart, place: &mut Vec<KeyPart>) -> PyResult<OrderedJson> {
    place.push(step);
    let found = tree(object, place);
    place.pop();
    found
}

fn real(value: f64, place: &[KeyPart]) -> PyResult<Value> {
    let number = Number::from_f64(value).map(Value::Number);
    number.ok_or_else(|| {
        let steps: Vec<String> = place.iter().map(ToString::to_string).collect();
        let key = if steps.is_empty() { String::new() } else { format!("{}: ", steps.join(".")) };
        errors::arguments(format!("{key}{value} is not a finite number\n  fix: give a finite one"))
    })
}

impl fmt::Display for KeyPart {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Entry(key) => formatter.write_str(key),
            Self::Item(number) => number.fmt(formatter),
        }
    }
}

fn check_depth(depth: usize) -> PyResult<()> {
    if depth > DEEPEST { Err(errors::arguments("nested too deep: a scene never nests that deep")) } else { Ok(()) }
}

/// A Python object as a value of TOML on one line.
pub fn toml(object: &Bound<'_, PyAny>) -> PyResult<String> {
    inline(object, 0)
}

fn inline(object: &Bound<'_, PyAny>, depth: usize) -> PyResult<String> {
    check_depth(depth)?;
    Ok(match plain(object)? {
        Plain::Bool(value) => value.to_string(),
        Plain::Whole(digits) => digits,
        // Shortest digits that read back the same.
        Plain::Real(value) if value.is_nan() => "nan".to_owned(),
        Plain::Real(value) => format!("{value:?}"),
        // Escapes of JSON are escapes of TOML.
        Plain::Text(text) => Value::String(text).to_string(),
        Plain::List(items) => {
            let items = items.iter().map(|item| inline(item, depth + 1)).collect::<PyResult<Vec<_>>>()?;
            format!("[{}]", items.join(", "))
        }
        Plain::Table(entries) => {
            let entry = |(key, value): (String, Bound<'_, PyAny>)| {
                Ok(format!("{} = {}", Value::String(key), inline(&value, depth + 1)?))
            };
            format!("{{{}}}", entries.into_iter().map(entry).collect::<PyResult<Vec<_>>>()?.join(", "))
        }
    })
}

/// Edits by dotted key as overrides, `body.die.velocity=[1, 0, 0]`.
pub fn overrides(edits: Option<&Bound<'_, PyDict>>) -> PyResult<Vec<String>> {
    let Some(edits) = edits else { return Ok(Vec::new()) };
    let one = |(key, value): (Bound<'_, PyAny>, Bound<'_, PyAny>)| {
        let key: String =
            key.extract().map_err(|_| errors::arguments(format!("a dotted key is a string, not {key}")))?;
        if key.contains('=') {
            return Err(errors::arguments(format!("{key:?} is not a dotted key\n  fix: write body.die.velocity")));
        }
        Ok(format!("{key}={}", toml(&value)?))
    };
    edits.iter().map(one).collect()
}

/// Longest that an object is shown in a message.
const SHOWN: usize = 80;

/// An object as messages show it: on one line, and not for ever.
pub fn shown(object: &Bound<'_, PyAny>) -> String {
    let text = object.repr().map_or_else(|_| "an object".to_owned(), |text| text.to_string());
    let words: Vec<&str> = text.split_whitespace().collect();
    let line = words.join(" ");
    match line.char_indices().nth(SHOWN) {
        Some((end, _)) => format!("{}…", &line[..end]),
        None => line,
    }
}

/// Numbers as an array of NumPy of this shape.
pub fn array<'py, T: Element>(py: Python<'py>, numbers: Vec<T>, shape: &[usize]) -> PyResult<Bound<'py, PyAny>> {
    Ok(PyArray::from_vec(py, numbers).reshape(shape.to_vec())?.into_any())
}

/// JSON as Python's objects, nested lists of numbers as arrays; null among numbers is nan.
pub fn with_arrays<'py>(py: Python<'py>, value: &Value) -> PyResult<Bound<'py, PyAny>> {
    if let Value::Object(entries) = value {
        let dict = PyDict::new(py);
        for (key, value) in entries {
            dict.set_item(key, with_arrays(py, value)?)?;
        }
        return dict.into_bound_py_any(py);
    }
    let Value::Array(items) = value else { return to_python(py, value) };
    match shape(value) {
        Some(shape) => {
            let mut numbers = Vec::with_capacity(shape.iter().product());
            flatten(value, &mut numbers);
            array(py, numbers, &shape)
        }
        None => {
            let items = items.iter().map(|item| with_arrays(py, item)).collect::<PyResult<Vec<_>>>()?;
            PyList::new(py, items)?.into_bound_py_any(py)
        }
    }
}

/// The shape of nested lists of numbers; none of anything else, and of lists that differ in length.
fn shape(value: &Value) -> Option<Vec<usize>> {
    match value {
        Value::Number(_) | Value::Null => Some(Vec::new()),
        Value::Array(items) => {
            let first = items.first().map_or_else(|| Some(Vec::new()), shape)?;
            let alike = items.iter().all(|item| shape(item).as_ref() == Some(&first));
            alike.then(|| [vec![items.len()], first].concat())
        }
        Value::Bool(_) | Value::String(_) | Value::Object(_) => None,
    }
}

fn flatten(value: &Value, out: &mut Vec<f64>) {
    match value {
        Value::Array(items) => items.iter().for_each(|item| flatten(item, out)),
        other => out.push(other.as_f64().unwrap_or(f64::NAN)),
    }
}

/// The numbers of an array of this shape, or of lists in its form.
pub fn numbers_of_shape(name: &str, object: &Bound<'_, PyAny>, shape: &[usize]) -> PyResult<Vec<f64>> {
    let read = || -> PyResult<(Vec<usize>, Vec<f64>)> {
        let array = object.py().import("numpy")?.call_method1("asarray", (object, "float64"))?;
        Ok((array.getattr("shape")?.extract()?, array.call_method0("ravel")?.extract()?))
    };
    match read() {
        Ok((found, numbers)) if found == shape => Ok(numbers),
        Ok((found, _)) => Err(errors::arguments(format!(
            "`{name}` has the shape {found:?}\n  fix: give an array of numbers of the shape {shape:?}"
        ))),
        Err(_) => Err(errors::arguments(format!(
            "`{name}` is {}\n  fix: give an array of numbers of the shape {shape:?}",
            shown(object)
        ))),
    }
}

/// The numbers of so many members, for each an array of this shape: one for all, or one for each.
pub fn numbers_of_members(name: &str, object: &Bound<'_, PyAny>, count: usize, of_one: &[usize]) -> PyResult<Vec<f64>> {
    if let Ok(numbers) = numbers_of_shape(name, object, of_one) {
        return Ok(numbers.repeat(count));
    }
    numbers_of_shape(name, object, &[&[count], of_one].concat())
}

/// The items of a list in an object of JSON.
pub fn list<'a>(value: &'a Value, name: &str) -> &'a [Value] {
    value[name].as_array().map_or(&[], Vec::as_slice)
}

/// All numbers in a value, in their order.
pub fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(items) => items.iter().flat_map(numbers).collect(),
        Value::Number(number) => number.as_f64().into_iter().collect(),
        _ => Vec::new(),
    }
}
