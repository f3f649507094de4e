//! Quantities by the names of their columns, and how they change: dr/dp = ∂r/∂y S + ∂r/∂p.

use super::SensitivityError;
use super::probe::along;
use crate::rows::{Extras, Fields, RowScratch};
use crate::variation::{NoDerivative, SceneVariation};
use gyration::Inadmissible;
use gyration::dynamics::Workspace;
use gyration::model::Model;
use gyration::state::State;
use gyration_scene::suggestion;

/// Columns of a recording, picked from its rows.
pub(crate) struct Quantities {
    fields: Fields,
    scratch: RowScratch,
    /// Where in a row each stands.
    places: Vec<usize>,
    /// Where in a row the works begin.
    first_work: usize,
    /// Whether works are among them.
    pub with_works: bool,
}

impl Quantities {
    /// Finds columns by their names.
    ///
    /// # Errors
    /// `SensitivityError::Quantity` if there is no such column, or none that depends on the motion.
    pub fn find(model: &Model, names: &[String]) -> Result<Self, SensitivityError> {
        let fields = Fields::new(model, &Extras::default());
        let (arrays, order) = fields.arrays(model);
        let mut columns: Vec<&str> = Vec::new();
        for array in &arrays {
            let from = columns.len();
            columns.extend(array.columns.iter().map(String::as_str));
            columns.resize(from + array.row_len(), "");
        }
        let place = |name: &String| {
            let fault = |help: String| SensitivityError::Quantity { name: name.clone(), help };
            if name == "energy.residual" || name == "work.constraint" {
                return Err(fault("it is the error of the run, which has no derivative".into()));
            }
            let found = columns.iter().position(|column| column == name);
            found.ok_or_else(|| fault(suggestion(name, order.iter().map(String::as_str), "columns")))
        };
        let places = names.iter().map(place).collect::<Result<_, _>>()?;
        let with_works = names.iter().any(|name| name.starts_with("work."));
        // The works stand at the end of a row but for the residual.
        let first_work = columns.len() - 1 - model.works().len();
        Ok(Self { fields, scratch: RowScratch::default(), places, first_work, with_works })
    }

    /// Their values in a row of the recording.
    pub fn of_row(&self, row: &[f64]) -> Vec<f64> {
        self.places.iter().map(|place| row[*place]).collect()
    }

    /// Their values in a state.
    ///
    /// # Errors
    /// `Inadmissible` where the state is outside the model.
    pub fn at(&mut self, model: &Model, state: &State) -> Result<Vec<f64>, Inadmissible> {
        let Self { fields, scratch, places, .. } = self;
        fields.fill(model, &mut Workspace::default(), state, None, scratch)?;
        Ok(places.iter().map(|place| scratch.row[*place]).collect())
    }

    /// dr/dp in a state that changes along S and W; `scales` are those of state and works.
    pub(super) fn derivative(
        &mut self,
        model: &Model,
        state: &State,
        direction: &[f64],
        scales: &[f64],
        variation: &mut SceneVariation,
    ) -> Result<Vec<f64>, NoDerivative> {
        let Self { fields, scratch, places, .. } = self;
        let mut fill = |model: &Model, workspace: &mut Workspace, state: &State| -> Result<Vec<f64>, Inadmissible> {
            fields.fill(model, workspace, state, None, scratch)?;
            Ok(places.iter().map(|place| scratch.row[*place]).collect())
        };
        let mut workspace = Workspace::default();
        let (n, mut moved) = (state.bodies.len(), state.clone());
        let mut total = along(&direction[..n], &scales[..n], |part| {
            for (i, value) in moved.bodies.iter_mut().enumerate() {
                *value = state.bodies[i] + part * direction[i];
            }
            fill(model, &mut workspace, &moved)
        })?;
        let own = variation.row(state, |model, workspace, state, out| {
            out.extend(fill(model, workspace, state)?);
            Ok(())
        })?;
        for (i, value) in total.iter_mut().enumerate() {
            // The works are columns themselves.
            let work = self.places[i].checked_sub(self.first_work).and_then(|at| direction[n..].get(at));
            *value += own[i] + work.unwrap_or(&0.0);
        }
        Ok(total)
    }
}
