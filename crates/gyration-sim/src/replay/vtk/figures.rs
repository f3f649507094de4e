//! The surfaces of all bodies as one: points and cells in the order of the bodies.
//!
//! Flat faces are divided, so that tractions show where on a face they act; their sums do not depend on it.

use crate::record::surfaces::Surfaces;
use crate::replay::SurfaceCells;
use gyration::body::Body;
use gyration::model::Model;
use gyration::tensor::Vec3;
use gyration_record::export::vtk::Topology;
use std::sync::Arc;

/// Triangles of a body where there are few bodies.
const TRIANGLES: usize = 1600;
/// Triangles of all bodies together, about, where there are many; none has fewer than its shape asks for.
const ALL_TRIANGLES: usize = 400_000;

/// All bodies.
#[derive(Debug, Clone)]
pub(super) struct Figures {
    /// The distinct surfaces.
    skins: Vec<SurfaceCells>,
    of_body: Vec<Representation>,
    topology: Topology,
}

/// How a body is shown: by its skin, or by points that stand for it.
#[derive(Debug, Clone)]
enum Representation {
    Skin(usize),
    Points(Vec<Vec3>),
}

impl Figures {
    pub(super) fn of(model: &Model) -> Self {
        let (surfaces, bodies) = (Surfaces::of(model), &model.bodies);
        let each = (ALL_TRIANGLES / bodies.len().max(1)).clamp(1, TRIANGLES);
        let skins: Vec<SurfaceCells> = surfaces.distinct().iter().map(|solid| SurfaceCells::of(solid, each)).collect();
        let figure = |(body, surface): (&Arc<Body>, &Option<usize>)| match surface {
            Some(surface) => Representation::Skin(*surface),
            None => Representation::Points(
                body.solid.shape.outline().points.iter().map(|p| p - body.solid.mass.center).collect(),
            ),
        };
        let of_body: Vec<Representation> = bodies.iter().zip(surfaces.of_bodies()).map(figure).collect();
        let topology = topology(&skins, &of_body);
        Self { skins, of_body, topology }
    }

    pub(super) fn topology(&self) -> &Topology {
        &self.topology
    }

    /// The material points of each body, from its centre of mass.
    pub(super) fn points(&self) -> impl Iterator<Item = &[Vec3]> {
        self.of_body.iter().map(|figure| match figure {
            Representation::Skin(skin) => self.skins[*skin].surface().points.as_slice(),
            Representation::Points(points) => points,
        })
    }

    /// The skin of each body, if it has one.
    pub(super) fn skins(&self) -> impl Iterator<Item = Option<&SurfaceCells>> {
        self.of_body.iter().map(|figure| match figure {
            Representation::Skin(skin) => Some(&self.skins[*skin]),
            Representation::Points(_) => None,
        })
    }

    /// The body of each cell: single points come first, then triangles.
    pub(super) fn bodies_of_cells(&self) -> Vec<usize> {
        let single = self.of_body.iter().map(|figure| match figure {
            Representation::Skin(_) => 0,
            Representation::Points(points) => points.len(),
        });
        let triangles = self.skins().map(|skin| skin.map_or(0, SurfaceCells::len));
        let repeated = |(body, count): (usize, usize)| std::iter::repeat_n(body, count);
        single.enumerate().flat_map(repeated).chain(triangles.enumerate().flat_map(repeated)).collect()
    }
}

fn topology(skins: &[SurfaceCells], of_body: &[Representation]) -> Topology {
    let (mut points, mut verts, mut triangles) = (0, Vec::new(), Vec::new());
    for figure in of_body {
        let own = match figure {
            Representation::Skin(skin) => {
                let surface = skins[*skin].surface();
                triangles.extend(surface.triangles.iter().flatten().map(|corner| (points + corner) as i32));
                surface.points.len()
            }
            Representation::Points(own) => {
                verts.extend((points..points + own.len()).map(|point| point as i32));
                own.len()
            }
        };
        points += own;
    }
    Topology::new(points, &verts, &triangles, 3)
}
