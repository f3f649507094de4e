//! Waves of a lattice for the page: its bands, and a wave as rows of one period.
//!
//! ```text
//! bands   JSON: kappa, k, omega, decay, participation, edges, labels, vertices, begins, warnings
//! wave    binary message, head { rows, omega, decay, cell, repeat, bodies: [{ name, like }] },
//!         payload: times f64[rows], positions f32[rows·3·bodies], P f32[rows·9·bodies]
//! ```
//!
//! `like` is the body of the run whose shape one of the wave has.

use gyration_page::binary;
use gyration_page::blob;
use gyration_scene::Scene;
use gyration_sim::survey::{BandOptions, BandSurvey, passing_waves};
use gyration_sim::waves::PassingWaves;
use gyration_sim::within_wall_time;
use serde_json::{Value, json};
use std::sync::Arc;

/// Wave vectors of a segment of the path.
const POINTS: usize = 41;

/// The waves of the lattice of a scene.
#[derive(Debug)]
pub(crate) struct Waves {
    scene: Arc<Scene>,
    passing: PassingWaves,
}

impl Waves {
    /// Of a scene that is ready to run; what takes longer than its run may is given up.
    ///
    /// # Errors
    /// Why it has none, in words.
    pub fn of(scene: Arc<Scene>) -> Result<Self, String> {
        let passing = within_wall_time(&scene, || passing_waves(&scene))?;
        Ok(Self { scene, passing })
    }

    /// The scene whose waves they are.
    pub fn scene(&self) -> &Arc<Scene> {
        &self.scene
    }

    /// Its bands along a path, or along the usual one.
    ///
    /// # Errors
    /// Why there are none, in words.
    pub fn bands(&self, path: Option<&str>) -> Result<Value, String> {
        let options = BandOptions { points: POINTS, ..BandOptions::default() };
        let found = within_wall_time(&self.scene, || BandSurvey::of(&self.scene, path, options))?;
        let BandSurvey { kappa, k, omega, decay, participation, edges, labels, vertices, begins, warnings, .. } = found;
        Ok(json!({
            "kappa": kappa, "k": k, "omega": omega, "decay": decay, "participation": participation,
            "edges": edges, "labels": labels, "vertices": vertices, "begins": begins, "warnings": warnings,
        }))
    }

    /// A wave as rows of one period, as of [`PassingWaves::passing`].
    ///
    /// # Errors
    /// Why there is none, in words.
    pub fn wave(&self, path: &str, branch: usize, part: f64) -> Result<Vec<u8>, String> {
        let found = within_wall_time(&self.scene, || self.passing.passing(path, branch, part))?;
        let file = self.scene.file();
        let [copies, cells] =
            [file.lattice.as_ref().map(|it| it.repeat.map(|it| it.0 as u32)).unwrap_or([1; 3]), self.passing.repeat()]
                .map(|repeat| repeat.iter().map(|many| *many as usize).product::<usize>());
        let bodies = file.body.iter().enumerate().flat_map(|(kind, body)| {
            let named = move |cell| if cells > 1 { format!("{}-{cell}", body.name) } else { body.name.clone() };
            (0..cells).map(move |cell| json!({ "name": named(cell), "like": kind * copies }))
        });
        let head = json!({
            "rows": found.times.len(), "omega": found.omega, "decay": found.decay,
            "cell": self.passing.cell().iter().map(|vector| <[f64; 3]>::from(*vector)).collect::<Vec<_>>(),
            "repeat": self.passing.repeat(), "bodies": bodies.collect::<Vec<_>>(),
        });
        let mut payload = blob::doubles(found.times.iter().copied());
        for placement in found.placements.iter().flatten() {
            payload.extend(blob::singles(placement.position.as_slice()));
        }
        for placement in found.placements.iter().flatten() {
            // nalgebra stores columns; rows are sent.
            payload.extend(blob::singles(placement.gradient.transpose().as_slice()));
        }
        Ok(binary::encode(&head, &payload))
    }
}
