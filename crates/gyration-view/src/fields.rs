//! Fields of a recording for the page: a map of one sample.
//!
//! ```text
//! binary message
//! head: { time, width, usual, counts: [across, up], origin, across, up, fields: [{ key, name, units }] }
//! payload: f32[across · up] of each field, across fastest
//! ```
//!
//! `origin` is the first point, `across` and `up` lead from it to the last along each side \[m\]; `usual` is the width
//! that is taken where none is given.

use gyration::tensor::Vec3;
use gyration_page::binary;
use gyration_page::blob;
use gyration_sim::fields::FIELD_SCALARS;
use gyration_sim::{FieldMaps, NoFields};
use serde_json::json;

/// The map of a sample, with a width \[m\] or the usual one.
///
/// # Errors
/// [`NoFields`].
pub(crate) fn message(maps: &mut FieldMaps, row: usize, width: Option<f64>) -> Result<Vec<u8>, NoFields> {
    let usual = maps.usual_width();
    let width = width.unwrap_or(usual);
    let map = maps.map(row, width)?;
    let grid = &map.grid;
    let side = |axis: usize| {
        let mut side = Vec3::zeros();
        side[axis] = grid.spacing[axis] * (grid.counts[axis] - 1) as f64;
        side
    };
    let three = |vector: Vec3| <[f64; 3]>::from(vector);
    let fields = FIELD_SCALARS.map(|it| json!({ "key": it.key, "name": it.name, "units": it.unit }));
    let head = json!({
        "time": map.time, "width": width, "usual": usual, "counts": map.along.map(|axis| grid.counts[axis]),
        "origin": three(grid.origin), "across": three(side(map.along[0])), "up": three(side(map.along[1])),
        "fields": fields,
    });
    Ok(binary::encode(&head, &blob::singles(&map.values.concat())))
}
