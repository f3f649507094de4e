//! The cell of a scene that has a lattice, and its waves.

use crate::modes::bands::{LatticeWaves, NoBands, StrainPath, StrainedCell};
use gyration::model::Model;
use gyration::state::State;
use gyration::tensor::Mat3;
use gyration_scene::{Built, Scene, UnitCell};

/// The cell of a scene whose bands are asked for.
///
/// # Errors
/// Why it has none, in words.
pub fn unit_cell(scene: &Scene) -> Result<&UnitCell, String> {
    let Some(cell) = &scene.built().cell else {
        return Err("the scene has no `[lattice]`, so that no waves run through it: `gyration modes` has the small \
                    motions of single bodies and of bodies that are joined"
            .to_owned());
    };
    if !cell.periodic.contains(&true) {
        return Err(
            "the lattice is periodic along no direction, so that no waves run through it: `gyration modes` has \
                    its small motions"
                .to_owned(),
        );
    }
    Ok(cell)
}

/// The waves of a cell, deformed or as it is written.
pub(super) fn waves_of(cell: &UnitCell, strain: Option<&StrainPath>) -> Result<LatticeWaves, NoBands> {
    match (strain, cell.load) {
        (None, None) => LatticeWaves::new(&cell.model, &cell.state, cell.relaxes),
        (None, Some(_)) => Ok(beginning(cell)?.at(&Mat3::identity())?.1),
        (Some(strain), _) => Ok(beginning(cell)?.at(&strain.at(0.0))?.1),
    }
}

/// The model of a run and its start where the vectors of its cells rest, if they are to: `relax` with "cell".
///
/// # Errors
/// Why they have no rest, in words.
pub(super) fn at_rest(built: &Built) -> Result<Option<(Model, State)>, String> {
    let cell = built.cell.as_ref().filter(|cell| cell.load.is_some() && cell.periodic.contains(&true));
    let Some(cell) = cell else { return Ok(None) };
    let rest = beginning(cell).map_err(|none| none.to_string())?;
    Ok(Some(rest.carry(&built.model, &built.state)))
}

/// The cell that strains are of: as it is written, or as it rests under its stress.
pub(super) fn beginning(cell: &UnitCell) -> Result<StrainedCell, NoBands> {
    let written = StrainedCell::new(&cell.model, &cell.state);
    cell.load.map_or(Ok(written.clone()), |load| written.at_rest(load))
}
