//! Surfaces of supports at a time, with the support of each cell.

use gyration::tensor::Vec3;
use gyration_record::export::vtk::{CompressedNumbers, DataArray, PolyData, Topology, Whole, WholeValues};

/// Whose the cells of a surface are.
pub(super) struct Owners {
    /// The support of each cell, from zero.
    pub cells: Vec<i32>,
    /// The names of the supports.
    pub names: Vec<String>,
}

/// Surfaces with their points at these places [m], at a time [s].
pub(super) fn support_surfaces<'a>(topology: &'a Topology, places: &[Vec3], owners: Owners, time: f64) -> PolyData<'a> {
    PolyData {
        topology,
        points: CompressedNumbers::floats(places.iter().flatten().copied()),
        point_data: Vec::new(),
        cell_data: vec![DataArray {
            name: "support",
            units: "",
            components: 1,
            values: CompressedNumbers::integers(owners.cells),
        }],
        field_data: vec![
            Whole { name: "TimeValue".into(), values: WholeValues::Numbers(1, vec![time]) },
            Whole { name: "support_names".into(), values: WholeValues::Names(owners.names) },
        ],
    }
}
