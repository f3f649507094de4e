//! Where the columns of a recording stand in a row of the run.

use super::column::ColumnSource;
use gyration::model::Model;
use gyration_record::ArraySpec;
use gyration_scene::input::fix;
use gyration_sim::RunPlan;
use gyration_sim::rows::Fields;

/// The columns of a model and their places.
#[derive(Debug, Clone)]
pub(crate) struct ColumnPlaces {
    arrays: Vec<ArraySpec>,
    bodies: Vec<String>,
    /// Where the arrays of position and placement gradient begin.
    pub position: usize,
    pub gradient: usize,
}

impl ColumnPlaces {
    /// The layout of the rows of a model.
    pub fn new(model: &Model, plan: &RunPlan) -> Self {
        let (arrays, _) = Fields::new(model, &plan.extras).arrays(model);
        let start = |name: &str| arrays.iter().take_while(|array| array.name != name).map(ArraySpec::row_len).sum();
        let (position, gradient) = (start("position"), start("placement_gradient"));
        let bodies = model.names().map(str::to_owned).collect();
        Self { arrays, bodies, position, gradient }
    }

    /// The place of a body.
    ///
    /// # Errors
    /// The fix, if there is none of this name.
    pub fn body(&self, name: &str) -> Result<usize, String> {
        let found = self.bodies.iter().position(|body| body == name);
        found.ok_or_else(|| fix(name, self.bodies.iter().map(String::as_str), "bodies"))
    }

    /// Where a column comes from.
    ///
    /// # Errors
    /// The fix, if there is none of this name.
    pub fn source(&self, column: &str) -> Result<ColumnSource, String> {
        if column == "t" {
            return Ok(ColumnSource::Time);
        }
        let mut start = 0;
        for array in &self.arrays {
            if let Some(index) = array.columns.iter().position(|name| name == column) {
                return Ok(ColumnSource::Row(start + index));
            }
            start += array.row_len();
        }
        let known = self.arrays.iter().flat_map(|array| &array.columns).filter(|name| !name.is_empty());
        Err(fix(column, std::iter::once("t").chain(known.map(String::as_str)), "columns"))
    }

    /// The unit of a column.
    pub fn unit(&self, column: &str) -> Option<&str> {
        if column == "t" {
            return Some("s");
        }
        let holds = |array: &&ArraySpec| array.columns.iter().any(|name| name == column);
        self.arrays.iter().find(holds).map(|array| array.units.as_str())
    }
}
