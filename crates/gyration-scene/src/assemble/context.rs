//! What a body is built among: the files beside the scene, the length of the run, the supports, the fluid.

use crate::check::PartialScene;
use crate::document::Document;
use crate::file::{Flow, Fluid};
use crate::quantity::AnyQuantity;
use crate::tree::Node;
use gyration_files::Files;
use std::collections::BTreeMap;

/// What the rest of a scene says to a body.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SceneContext<'a> {
    /// The files that the scene names.
    pub(super) files: &'a Files,
    /// When the run ends \[s\], if the file says so without error.
    pub(super) end: Option<f64>,
    /// Whether there is a support that is a plane, well formed or not.
    pub(super) has_support: bool,
    /// Whether there is a fluid, well formed or not.
    pub(super) has_fluid: bool,
    /// Whether the bodies are those of a cell.
    pub(super) has_lattice: bool,
    /// Whether a support that is a plane moves.
    pub(super) supports_move: bool,
    /// Whether the undisturbed fluid has a flow.
    pub(super) fluid_flows: bool,
    /// Whether that flow has a gradient at a time.
    pub(super) fluid_has_gradient: bool,
    /// η \[Pa s\] and ρ_f \[kg/m³\], if the file says so without error.
    pub(super) fluid: Option<[f64; 2]>,
    /// G of bodies on themselves \[N m²/kg²\], if the scene has that gravity.
    pub(super) self_gravity: Option<f64>,
    /// Constants of expressions, if the file says them without error.
    pub(super) constants: Option<&'a BTreeMap<String, AnyQuantity>>,
}

impl<'a> SceneContext<'a> {
    /// The context of a scene that names these files, with the constants of its expressions.
    pub(crate) fn new(
        partial: &PartialScene,
        document: &Document,
        files: &'a Files,
        constants: Option<&'a BTreeMap<String, AnyQuantity>>,
    ) -> Self {
        let supports = document.root.get("support").map(Node::items).unwrap_or_default();
        Self {
            files,
            end: partial.time.as_ref().map(|time| time.end.value()),
            has_support: supports.iter().any(|support| support.get("shape").is_none()),
            has_lattice: document.root.get("lattice").is_some(),
            supports_move: supports
                .iter()
                .any(|support| support.get("shape").is_none() && support.get("motion").is_some()),
            fluid_flows: partial.fluid.as_ref().is_some_and(flows),
            fluid_has_gradient: partial.fluid.as_ref().is_some_and(has_gradient),
            has_fluid: document.root.get("fluid").is_some(),
            fluid: partial.fluid.as_ref().map(|fluid| [fluid.viscosity.value(), fluid.density.value()]),
            self_gravity: partial.world.self_gravity.map(|gravity| gravity.constant.value()),
            constants,
        }
    }
}

/// Whether the velocity of a fluid far from the bodies changes with the place.
fn has_gradient(fluid: &Fluid) -> bool {
    fluid.velocity_gradient != Flow::default()
}

/// Whether a fluid flows far from the bodies.
fn flows(fluid: &Fluid) -> bool {
    fluid.velocity != Flow::default() || has_gradient(fluid)
}
