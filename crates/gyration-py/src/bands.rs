//! Waves through lattices: the program's numbers, as arrays.

use crate::convert::{array, object, to_python};
use crate::errors;
use crate::modes::describe_place;
use crate::monitor::interruptibly;
use crate::scene::Scene;
use gyration_sim::modes::PARTS;
use gyration_sim::modes::bands::{BandShape, StrainPath, Zone};
use gyration_sim::survey::{
    BandOptions, BandSurvey, CellRestSurvey, ComplexBandOptions, ComplexBandSurvey, InstabilitySurvey, Named,
    StrainSurvey, TopologySurvey, USUAL_MESH,
};
use gyration_sim::within_wall_time;
use numpy::Complex64;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use serde_json::json;

/// The waves of a lattice, as ``gyration bands`` has them: along a path, all those of a frequency, or under strain.
///
/// Along ``path``, ``points`` wave vectors a segment, with rows r, branches b and roots: ``kappa``, ``k`` [1/m] (r, 3);
/// ``omega`` [rad/s], ``decay`` [1/s] (r, b); ``lambda`` complex (r, roots); ``velocity`` [m/s] (r, b, 3), nan where ω
/// has no derivative; ``participation`` (r, b, 5); of a ribbon ``edges``, a list with ``direction``, ``cells`` and
/// ``shares`` (r, b, 2); ``rest`` with ``force``, ``stress``, ``cell`` and ``bodies``; ``sound``, ``labels``,
/// ``begins``, ``warnings``. ``mesh`` adds ``gaps`` and ``dos``; ``shapes`` adds ``shapes``, by body complex
/// ``translation`` (r, b, 3) and ``gradient`` (r, b, 3, 3). ``strain``, ``"xx=-0.05"``, deforms the cell first.
///
/// ``derivatives``, keys of numbers of the scene as to ``sensitivities``, adds ``derivatives``, a dictionary of ∂ω (r,
/// b) by key, nan where ω has no derivative. ``bound`` adds ``bound`` [rad/s] (r, b), by how much ω may be off, nan
/// where that is not known. ``topology`` gives Zak phases and Chern numbers of a mesh of ``mesh`` (24) wave vectors
/// instead: ``zak`` (directions, b), ``chern``, ``gaps``, ``directions``, ``warnings``.
///
/// ``complex`` gives all κ along ``direction`` (1, 2, 3) at ``points`` frequencies between the two of ``omega``
/// [rad/s]: ``omega`` (n), and ``kappa``, a list of n complex arrays.
///
/// ``along``, ``"xx=0..-0.2"``, deforms the cell in so many ``steps``: ``path`` with arrays ``s``, ``F``, ``force``,
/// ``stress``, ``least_omega2`` (nan where there is none), ``at_kappa``, ``branch``, and ``instability``, where the
/// lattice first becomes unstable, or None.
#[pyfunction]
#[pyo3(signature = (scene, path=None, *, points=101, mesh=None, shapes=false, strain=None, complex=false, direction=1,
                    omega=None, along=None, steps=21, derivatives=None, bound=false, topology=false))]
#[expect(clippy::too_many_arguments, reason = "the arguments of the command")]
pub fn bands<'py>(
    py: Python<'py>,
    scene: &Bound<'py, PyAny>,
    path: Option<&str>,
    points: i64,
    mesh: Option<i64>,
    shapes: bool,
    strain: Option<&str>,
    complex: bool,
    direction: i64,
    omega: Option<[f64; 2]>,
    along: Option<&str>,
    steps: i64,
    derivatives: Option<Vec<String>>,
    bound: bool,
    topology: bool,
) -> PyResult<Bound<'py, PyDict>> {
    let derivatives = derivatives.unwrap_or_default();
    let besides = [("shapes", shapes), ("derivatives", !derivatives.is_empty()), ("bound", bound)];
    let refuse_besides = |name, given| refuse_together(name, given, &besides);
    refuse_together(
        "complex",
        complex,
        &[("mesh", mesh.is_some()), ("along", along.is_some()), ("topology", topology)],
    )?;
    refuse_besides("complex", complex)?;
    refuse_besides("topology", topology)?;
    refuse_besides("along", along.is_some())?;
    refuse_together(
        "along",
        along.is_some(),
        &[("path", path.is_some()), ("topology", topology), ("strain", strain.is_some())],
    )?;
    refuse_together("omega", omega.is_some(), &[("complex=False", !complex)])?;
    let scene = Scene::ready(scene)?;
    let mesh = mesh.map(|mesh| counted("mesh", mesh)).transpose()?;
    if let Some(along) = along {
        let (along, steps) = (strains(along)?, counted("steps", steps)?);
        let found = interruptibly(py, || within_wall_time(&scene, || StrainSurvey::of(&scene, &along, steps, mesh)))?
            .map_err(errors::arguments)?;
        return strained(py, &found);
    }
    let strain =
        strain.map(StrainPath::parse_value).transpose().map_err(|error| errors::arguments(error.to_string()))?;
    if topology {
        let mesh = mesh.unwrap_or(USUAL_MESH);
        let found =
            interruptibly(py, || within_wall_time(&scene, || TopologySurvey::of(&scene, path, mesh, strain.as_ref())))?;
        return phases(py, &found.map_err(errors::arguments)?);
    }
    let options = BandOptions { points: counted("points", points)?, mesh, shapes, strain, derivatives, bound };
    if complex {
        let wrong = || errors::arguments(format!("{direction} is no direction\n  fix: give 1, 2 or 3"));
        let direction = usize::try_from(direction).ok().filter(|it| (1..=3).contains(it)).ok_or_else(wrong)? - 1;
        let complex = ComplexBandOptions { direction, omega: omega.map(frequencies).transpose()? };
        let found =
            interruptibly(py, || within_wall_time(&scene, || ComplexBandSurvey::of(&scene, path, options, complex)))?;
        return complex_bands(py, &found.map_err(errors::arguments)?);
    }
    let found = interruptibly(py, || within_wall_time(&scene, || BandSurvey::of(&scene, path, options)))?
        .map_err(errors::arguments)?;
    along_path(py, &found)
}

/// Refuses arguments that do not go together.
fn refuse_together(name: &str, given: bool, others: &[(&str, bool)]) -> PyResult<()> {
    match others.iter().find(|(_, other_given)| given && *other_given) {
        Some((other, _)) => Err(errors::arguments(format!("`{name}` and `{other}` do not go together"))),
        None => Ok(()),
    }
}

fn counted(name: &str, count: i64) -> PyResult<usize> {
    let problem = || errors::arguments(format!("`{name}` is {count}\n  fix: give a whole number above zero"));
    usize::try_from(count).ok().filter(|count| *count > 0).ok_or_else(problem)
}

fn strains(text: &str) -> PyResult<StrainPath> {
    StrainPath::parse(text).map_err(|error| errors::arguments(error.to_string()))
}

fn frequencies(ends: [f64; 2]) -> PyResult<[f64; 2]> {
    if ends.iter().all(|end| end.is_finite() && *end >= 0.0) {
        return Ok(ends);
    }
    let [from, to] = ends;
    Err(errors::arguments(format!("({from}, {to}) is no range of frequencies\n  fix: give two, as (0, 20)")))
}

fn along_path<'py>(py: Python<'py>, found: &BandSurvey) -> PyResult<Bound<'py, PyDict>> {
    let (rows, branches) = (found.kappa.len(), found.omega.first().map_or(0, Vec::len));
    let told = PyDict::new(py);
    told.set_item("kappa", array(py, found.kappa.concat(), &[rows, 3])?)?;
    told.set_item("k", array(py, found.k.concat(), &[rows, 3])?)?;
    told.set_item("omega", array(py, found.omega.concat(), &[rows, branches])?)?;
    told.set_item("decay", array(py, found.decay.concat(), &[rows, branches])?)?;
    let roots = found.lambda.first().map_or(0, Vec::len);
    told.set_item("lambda", array(py, complex(found.lambda.iter().flatten()), &[rows, roots])?)?;
    let velocity = found.velocity.iter().flatten().flat_map(|it| it.unwrap_or([f64::NAN; 3])).collect();
    told.set_item("velocity", array(py, velocity, &[rows, branches, 3])?)?;
    let shares = found.participation.concat().concat();
    told.set_item("participation", array(py, shares, &[rows, branches, PARTS])?)?;
    if !found.edges.is_empty() {
        told.set_item("edges", edges_of(py, found, [rows, branches])?)?;
    }
    if let Some(shapes) = &found.shapes {
        told.set_item("shapes", shapes_of_bodies(py, shapes, [rows, branches])?)?;
    }
    let numbers = |rows_of: &[Vec<Option<f64>>]| {
        let all = rows_of.iter().flatten().map(|number| number.unwrap_or(f64::NAN)).collect();
        array(py, all, &[rows, branches])
    };
    if let Some(derivatives) = &found.derivatives {
        let by_key = PyDict::new(py);
        derivatives.by_key.0.iter().try_for_each(|(key, changes)| by_key.set_item(key, numbers(changes)?))?;
        told.set_item("derivatives", by_key)?;
    }
    if let Some(bound) = &found.bound {
        told.set_item("bound", numbers(bound)?)?;
    }
    told.set_item("labels", &found.labels)?;
    told.set_item("begins", &found.begins)?;
    let sound = PyList::empty(py);
    for along in &found.sound {
        let one = PyDict::new(py);
        one.set_item("direction", array(py, along.direction.to_vec(), &[3])?)?;
        let speeds: Vec<f64> = along.speed.iter().map(|speed| speed.unwrap_or(f64::NAN)).collect();
        let count = speeds.len();
        one.set_item("speed", array(py, speeds, &[count])?)?;
        sound.append(one)?;
    }
    told.set_item("sound", sound)?;
    told.set_item("rest", rest(py, &found.rest)?)?;
    if let Some(Zone { gaps, dos }) = &found.zone {
        told.set_item("gaps", to_python(py, &json!(gaps))?)?;
        let both = PyDict::new(py);
        for (name, values) in [("omega", &dos.omega), ("density", &dos.density)] {
            both.set_item(name, array(py, values.clone(), &[values.len()])?)?;
        }
        told.set_item("dos", both)?;
    }
    told.set_item("warnings", &found.warnings)?;
    found.warnings.iter().try_for_each(|warning| errors::warn(py, Some(warning.clone())))?;
    Ok(told)
}

/// How much of each wave is at the edges of a ribbon.
fn edges_of<'py>(py: Python<'py>, found: &BandSurvey, [rows, branches]: [usize; 2]) -> PyResult<Bound<'py, PyList>> {
    let edges = PyList::empty(py);
    for along in &found.edges {
        let one = PyDict::new(py);
        one.set_item("direction", along.direction)?;
        one.set_item("cells", along.cells)?;
        one.set_item("shares", array(py, along.shares.concat().concat(), &[rows, branches, 2])?)?;
        edges.append(one)?;
    }
    Ok(edges)
}

/// δp₀ and δP of every body in every wave.
fn shapes_of_bodies<'py>(
    py: Python<'py>,
    shapes: &[Vec<Named<BandShape>>],
    [rows, branches]: [usize; 2],
) -> PyResult<Bound<'py, PyDict>> {
    let waves = || shapes.iter().flatten();
    let told = PyDict::new(py);
    for (body, (name, _)) in waves().next().into_iter().flat_map(|first| first.0.iter().enumerate()) {
        let of_body = || waves().map(move |wave| &wave.0[body].1);
        let shape = PyDict::new(py);
        let translation = complex(of_body().flat_map(|shape| &shape.translation));
        shape.set_item("translation", array(py, translation, &[rows, branches, 3])?)?;
        let gradient = complex(of_body().flat_map(|shape| shape.gradient.as_flattened()));
        shape.set_item("gradient", array(py, gradient, &[rows, branches, 3, 3])?)?;
        told.set_item(name, shape)?;
    }
    Ok(told)
}

fn rest<'py>(py: Python<'py>, found: &CellRestSurvey) -> PyResult<Bound<'py, PyDict>> {
    let told = PyDict::new(py);
    for (name, vectors) in [("force", &found.force), ("cell", &found.cell)] {
        told.set_item(name, array(py, vectors.concat(), &[vectors.len(), 3])?)?;
    }
    told.set_item("stress", array(py, found.stress.concat(), &[3, 3])?)?;
    let bodies = PyDict::new(py);
    for (name, place) in &found.bodies.0 {
        let body = PyDict::new(py);
        describe_place(&body, &json!(place))?;
        bodies.set_item(name, body)?;
    }
    told.set_item("bodies", bodies)?;
    Ok(told)
}

fn phases<'py>(py: Python<'py>, found: &TopologySurvey) -> PyResult<Bound<'py, PyDict>> {
    let told = PyDict::new(py);
    let shape = [found.zak.len(), found.zak.first().map_or(0, Vec::len)];
    let zak = found.zak.iter().flatten().map(|phase| phase.unwrap_or(f64::NAN)).collect();
    told.set_item("zak", array(py, zak, &shape)?)?;
    told.set_item("chern", to_python(py, &json!(found.chern))?)?;
    told.set_item("gaps", to_python(py, &json!(found.gaps))?)?;
    told.set_item("directions", &found.directions)?;
    told.set_item("warnings", &found.warnings)?;
    found.warnings.iter().try_for_each(|warning| errors::warn(py, Some(warning.clone())))?;
    Ok(told)
}

fn complex_bands<'py>(py: Python<'py>, found: &ComplexBandSurvey) -> PyResult<Bound<'py, PyDict>> {
    let told = PyDict::new(py);
    told.set_item("omega", array(py, found.omega.clone(), &[found.omega.len()])?)?;
    let kappa = found.kappa.iter().map(|all| array(py, complex(all), &[all.len()]));
    told.set_item("kappa", kappa.collect::<PyResult<Vec<_>>>()?)?;
    Ok(told)
}

fn strained<'py>(py: Python<'py>, found: &StrainSurvey) -> PyResult<Bound<'py, PyDict>> {
    let (rows, count) = (&found.path, found.path.len());
    let path = PyDict::new(py);
    path.set_item("s", array(py, rows.iter().map(|row| row.s).collect(), &[count])?)?;
    let matrix = |matrix: &[[f64; 3]; 3]| matrix.concat();
    path.set_item("F", array(py, rows.iter().flat_map(|row| matrix(&row.gradient)).collect(), &[count, 3, 3])?)?;
    let vectors = rows.first().map_or(0, |row| row.force.len());
    path.set_item("force", array(py, rows.iter().flat_map(|row| row.force.concat()).collect(), &[count, vectors, 3])?)?;
    path.set_item("stress", array(py, rows.iter().flat_map(|row| matrix(&row.stress)).collect(), &[count, 3, 3])?)?;
    let least = rows.iter().map(|row| row.least_omega2.unwrap_or(f64::NAN)).collect();
    path.set_item("least_omega2", array(py, least, &[count])?)?;
    path.set_item("at_kappa", array(py, rows.iter().flat_map(|row| row.at_kappa).collect(), &[count, 3])?)?;
    path.set_item("branch", rows.iter().map(|row| row.branch).collect::<Vec<_>>())?;
    let told = PyDict::new(py);
    told.set_item("path", path)?;
    told.set_item("instability", found.instability.as_ref().map(|first| unstable(py, first)).transpose()?)?;
    Ok(told)
}

fn unstable<'py>(py: Python<'py>, first: &InstabilitySurvey) -> PyResult<Bound<'py, PyAny>> {
    let entries = json!(first).as_object().cloned().unwrap_or_default();
    let told = object(py, &entries)?;
    told.set_item("F", array(py, first.gradient.concat(), &[3, 3])?)?;
    told.set_item("kappa", array(py, first.kappa.to_vec(), &[3])?)?;
    Ok(told)
}

fn complex<'a>(numbers: impl IntoIterator<Item = &'a [f64; 2]>) -> Vec<Complex64> {
    numbers.into_iter().map(|[re, im]| Complex64::new(*re, *im)).collect()
}
