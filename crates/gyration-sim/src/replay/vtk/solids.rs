//! The supports with a shape as surfaces, where they are.

use super::support_surfaces::{Owners, support_surfaces};
use gyration::model::Model;
use gyration::solid_support::SolidSupport;
use gyration::tensor::Vec3;
use gyration_record::export::vtk::{PolyData, Topology};
use std::sync::Arc;

/// Triangles of a support.
const TRIANGLES: usize = 1600;

/// The surfaces of all supports with a shape.
#[derive(Debug, Clone)]
pub(super) struct SolidFigures {
    supports: Arc<[SolidSupport]>,
    /// The points of each, from its centre of mass.
    points: Vec<Vec<Vec3>>,
    /// The support of each triangle.
    owners: Vec<i32>,
    topology: Topology,
}

impl SolidFigures {
    /// Of a model; none without any.
    pub(super) fn of(model: &Model) -> Option<Self> {
        if model.solid_supports.is_empty() {
            return None;
        }
        let (mut points, mut owners, mut triangles): (Vec<Vec<Vec3>>, Vec<i32>, Vec<i32>) = Default::default();
        let mut count = 0;
        for (index, support) in model.solid_supports.iter().enumerate() {
            let surface = support.solid.shape.triangulation(TRIANGLES);
            triangles.extend(surface.triangles.iter().flatten().map(|corner| (count + corner) as i32));
            owners.extend(surface.triangles.iter().map(|_| index as i32));
            count += surface.points.len();
            points.push(surface.points.iter().map(|point| point - support.solid.mass.center).collect());
        }
        let topology = Topology::new(count, &[], &triangles, 3);
        Some(Self { supports: Arc::clone(&model.solid_supports), points, owners, topology })
    }

    /// Whether any of them moves.
    pub(super) fn move_with_time(&self) -> bool {
        self.supports.iter().any(|support| !support.motion.is_fixed())
    }

    /// The surfaces at a time \[s\].
    pub(super) fn at(&self, time: f64) -> PolyData<'_> {
        let place = |(support, points): (&SolidSupport, &Vec<Vec3>)| {
            let placement = support.at(time).placement;
            points.iter().map(|point| placement.place(point)).collect::<Vec<Vec3>>()
        };
        let places: Vec<Vec3> = self.supports.iter().zip(&self.points).flat_map(place).collect();
        let names = self.supports.iter().map(|support| support.name.clone()).collect();
        support_surfaces(&self.topology, &places, Owners { cells: self.owners.clone(), names }, time)
    }
}
