//! What Python's readers make of recordings and exports: xarray, VTK and trimesh; and the recipes of the book.
//!
//! Needs a Python with the packages of `xtask/python-requirements.txt`, named by the environment variable
//! GYRATION_PYTHON:
//!
//! ```text
//! GYRATION_PYTHON=target/python/bin/python cargo test -p gyration-cli --test tests -- --ignored python::
//! ```

use crate::common::Sandbox;
use std::path::Path;
use std::process::Command;

/// VTK reads the files of the list: times, gaps, stresses and the sum of tractions are those of the recording.
const CHECK_SURFACES: &str = r#"
import sys, warnings
import xml.etree.ElementTree as ElementTree
import numpy as np, xarray
from vtkmodules.vtkCommonCore import vtkDataArray
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
from vtkmodules.util.numpy_support import vtk_to_numpy

def read(name):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(name)
    reader.Update()
    assert reader.GetErrorCode() == 0, name
    return reader.GetOutput()

stem, tolerance, every = sys.argv[1], float(sys.argv[2]), int(sys.argv[3])
run = xarray.open_zarr(f"{stem}.gyr").load()
body = run.attrs["bodies"][0]
entries = ElementTree.parse(f"{stem}.pvd").getroot().findall("Collection/DataSet")
series = [entry for entry in entries if entry.get("part") == "0"]
rows = list(range(0, run.time.size, every))
rows += [run.time.size - 1] * (rows[-1] != run.time.size - 1)
assert len(series) == len(rows) and len(entries) == 2 * len(series)
weight, worst = body["mass"] * 9.81, 0.0
for row, entry in zip(rows, series):
    sample = run.isel(time=row, body=0)
    assert float(entry.get("timestep")) == float(sample.time)
    data = read(entry.get("file"))
    points = vtk_to_numpy(data.GetPoints().GetData())
    assert points.dtype == np.float64
    corners = points[vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)]
    areas = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / 2
    cells, at = data.GetCellData(), data.GetPointData()
    force = (vtk_to_numpy(cells.GetArray("traction")) * np.linalg.norm(areas, axis=1)[:, None]).sum(axis=0)
    recorded = sample.contact_force.values
    worst = max(worst, np.linalg.norm(force - recorded) / max(np.linalg.norm(recorded), weight))
    # Outward: the enclosed volume is positive. The lowest of some points is no lower than the lowest of all.
    assert (areas * corners.mean(axis=1)).sum() > 0
    gaps = vtk_to_numpy(at.GetArray("gap"))
    assert -1e-15 < gaps.min() - float(sample.gap) < 0.02 * body["size"], (gaps.min(), float(sample.gap))
    assert at.GetArray("gap").GetInformation().Get(vtkDataArray.UNITS_LABEL()) == "m"
    whole = data.GetFieldData()
    assert whole.GetArray("TimeValue").GetValue(0) == float(sample.time)
    assert whole.GetArray("energy_kinetic").GetValue(0) == float(sample.energy_kinetic)
    assert np.array_equal(vtk_to_numpy(whole.GetArray("contact_force"))[0], recorded)
    assert whole.GetAbstractArray("body_names").GetValue(0) == body["name"]
    if "cauchy_stress" in run:
        stress = vtk_to_numpy(cells.GetArray("cauchy_stress")).reshape(-1, 3, 3)
        assert np.abs(stress - sample.cauchy_stress.values).max() < 1e-9 * (1 + np.abs(sample.cauchy_stress.values).max())
        part = stress[0] - np.eye(3) * np.trace(stress[0]) / 3
        assert abs(vtk_to_numpy(cells.GetArray("von_mises"))[0] - np.sqrt(1.5 * (part**2).sum())) < 1e-9 * 8e3
    assert (cells.GetArray("von_mises") is None) == (body["kind"] == "rigid")
support = read(next(entry for entry in entries if entry.get("part") == "1").get("file"))
assert support.GetNumberOfCells() == 1 and support.GetFieldData().GetAbstractArray("support_names").GetValue(0) == "table"
print(f"{stem}: {len(series)} samples, force within {worst:.1e}")
assert worst < tolerance, worst
"#;

/// trimesh places the bodies of an animation where the recording starts, y up.
const CHECK_ANIMATION: &str = r#"
import sys
import numpy as np, trimesh, xarray
stem, name = sys.argv[1:]
run = xarray.open_zarr(f"{stem}.gyr").load()
start = run.sel(body=name).isel(time=0)
scene = trimesh.load_scene(f"{stem}.glb")
# A node for the surface and one for the wireframe.
shown = [scene.graph[node] for node in scene.graph.nodes_geometry if scene.graph[node][1].split("_")[0] == name]
solid = [(matrix, mesh) for matrix, geometry in shown if isinstance(mesh := scene.geometry[geometry], trimesh.Trimesh)]
assert len(shown) == 2 and len(solid) == 1, scene.graph.nodes_geometry
matrix, mesh = solid[0]
mesh.merge_vertices(merge_norm=True)
assert mesh.is_watertight and mesh.volume > 0
up = np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]])
placed = up @ matrix[:3, :3] @ mesh.vertices.T + (up @ matrix[:3, 3])[:, None]
surface = run.attrs["bodies"][list(run.body.values).index(name)]["surface"]
points = run[f"surface_{surface}_points"].values
expected = start.position.values[:, None] + start.placement_gradient.values @ points.T
assert np.allclose(placed.min(axis=1), expected.min(axis=1), atol=1e-6) and np.allclose(placed.max(axis=1), expected.max(axis=1), atol=1e-6)
print(stem, "placed by trimesh", trimesh.__version__)
"#;

fn python(folder: &Path, script: &str, arguments: &[&str]) {
    let Some(python) = std::env::var_os("GYRATION_PYTHON") else {
        panic!("GYRATION_PYTHON is not set: it names a Python with the packages of xtask/python-requirements.txt");
    };
    // A relative one is relative to where the tests were started.
    let python = std::path::absolute(python).unwrap();
    let output = Command::new(python).current_dir(folder).args(["-c", script]).args(arguments).output().unwrap();
    let (told, wrong) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success(), "{told}\n{wrong}");
    print!("{told}");
}

#[test]
#[ignore = "needs GYRATION_PYTHON"]
fn vtk_reads_surfaces_whose_tractions_add_up_to_the_contact_force() {
    let sandbox = Sandbox::new();
    // Flat faces: rounding of 1600 terms. Curved ones: two thousandths of a triangle's own traction, and some more at
    // an edge.
    let cases = [
        ("dice", "0.5", "1e-12"),
        ("hop", "0.3", "1e-12"),
        ("elastic-bounce-tilted", "0.5", "3e-3"),
        ("shaker", "0.2", "3e-3"),
    ];
    for (scene, end, tolerance) in cases {
        let path = format!("{scene}.gyr");
        let end = format!("time.end={end}");
        let stress = if scene == "dice" || scene == "shaker" {
            "record.quantities=[]"
        } else {
            "record.quantities=[\"cauchy_stress\"]"
        };
        sandbox.done(&["run", scene, "-o", &path, "--quiet", "--set", &end, "--set", stress]);
        sandbox.done(&["export", &path, "--format", "vtk", "--every", "7"]);
        python(&sandbox.path("."), CHECK_SURFACES, &[scene, tolerance, "7"]);
    }
}

#[test]
#[ignore = "needs GYRATION_PYTHON"]
fn trimesh_places_the_bodies_of_an_animation() {
    let sandbox = Sandbox::new();
    for (scene, body) in [("dice", "die"), ("elastic-bounce-tilted", "egg"), ("hop", "block")] {
        let path = format!("{scene}.gyr");
        sandbox.done(&["run", scene, "-o", &path, "--quiet", "--set", "time.end=0.1"]);
        sandbox.done(&["export", &path, "--format", "gltf"]);
        python(&sandbox.path("."), CHECK_ANIMATION, &[scene, body]);
    }
}

/// The pieces of Python of a page, without what draws.
fn pieces(page: &str) -> String {
    let python = page.split("```python\n").skip(1).map(|rest| rest.split("```").next().unwrap_or_default());
    python
        .flat_map(str::lines)
        .filter(|line| !line.contains(".plot("))
        .fold(String::new(), |all, line| all + line + "\n")
}

#[test]
#[ignore = "needs GYRATION_PYTHON"]
fn recipes_of_the_book_run() {
    let sandbox = Sandbox::new();
    sandbox.done(&["run", "hop", "--quiet", "--set", "record.quantities=[\"cauchy_stress\"]"]);
    let page = include_str!("../../../docs/recipes-recordings.md");
    assert!(page.matches("```python").count() > 5);
    let script = format!("import warnings\nwarnings.simplefilter('error')\n{}", pieces(page));
    python(&sandbox.path("."), &script, &[]);
}
