//! Fields on a grid as files for ParaView.

use super::FieldSurvey;
use crate::fields::{LocalFields, Third};
use gyration::tensor::{Mat3, Vec3};
use gyration_record::export::vtk::{CompressedNumbers, DataArray, ImageData, Whole, WholeValues};

impl FieldSurvey {
    /// The fields of a sample as numbers at the points of the grid; none of fields at points of no grid.
    pub fn image(&self, sample: usize) -> Option<ImageData> {
        let grid = self.grid?;
        let fields = self.fields.get(sample)?;
        let array = |name, units, components, numbers: fn(&LocalFields, &mut Vec<f64>)| {
            let mut all = Vec::with_capacity(components * fields.len());
            fields.iter().for_each(|it| numbers(it, &mut all));
            DataArray { name, units, components, values: CompressedNumbers::floats(all) }
        };
        let point_data = vec![
            array("density", "kg/m3", 1, |it, out| out.push(it.density)),
            array("velocity", "m/s", 3, |it, out| out.extend((it.momentum / it.density).iter())),
            array("momentum", "kg/(m2 s)", 3, |it, out| out.extend(it.momentum.iter())),
            array("affine_momentum", "kg/(m s)", 9, |it, out| matrix(&it.affine_momentum, out)),
            array("flux", "W/m2", 27, |it, out| third(&it.flux, out)),
            array("kinetic", "Pa", 9, |it, out| matrix(&it.kinetic, out)),
            array("micro_stress", "Pa", 9, |it, out| matrix(&it.micro_stress, out)),
            array("contact_stress", "Pa", 9, |it, out| matrix(&it.contact_stress, out)),
            array("hyperstress", "N/m", 27, |it, out| third(&it.hyperstress, out)),
            array("external", "Pa", 9, |it, out| matrix(&it.external, out)),
            array("rate", "Pa", 9, |it, out| matrix(&it.rate, out)),
            array("stress", "Pa", 9, |it, out| matrix(&it.stress, out)),
            array("momentum_rate", "N/m3", 3, |it, out| out.extend(it.momentum_rate.iter())),
            array("power", "W/m3", 1, |it, out| out.push(it.power)),
            array("residual", "Pa", 1, |it, out| out.push(it.residual)),
            array("momentum_residual", "N/m3", 1, |it, out| out.push(it.momentum_residual)),
        ];
        let time = Whole { name: "TimeValue".into(), values: WholeValues::Numbers(1, vec![self.times[sample]]) };
        let three = |vector: Vec3| vector.into();
        Some(ImageData {
            counts: grid.counts,
            origin: three(grid.origin),
            spacing: three(grid.spacing),
            point_data,
            field_data: vec![time],
        })
    }
}

/// Rows, where nalgebra has columns.
fn matrix(matrix: &Mat3, out: &mut Vec<f64>) {
    out.extend(matrix.transpose().iter());
}

/// The last index fastest.
fn third(third: &Third, out: &mut Vec<f64>) {
    out.extend((0..27).map(|n| third[n % 3][(n / 9, n / 3 % 3)]));
}
