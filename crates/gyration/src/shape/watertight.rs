//! Whether triangles bound a volume: every edge exactly twice, once in each sense.
//!
//! Everything else is a fault with a place.

use super::edges::{Edge, half_edges};
use super::error::PolyhedronError;
use crate::tensor::Vec3;

/// How many places a message lists.
const LISTED: usize = 3;

/// Edges with the same fault: how many, and the first few.
#[derive(Debug, Default)]
struct FaultyEdges {
    count: usize,
    first: Vec<Edge>,
}

impl FaultyEdges {
    fn add(&mut self, edge: Edge) {
        self.count += 1;
        if self.first.len() < LISTED {
            self.first.push(edge);
        }
    }
}

/// Refuses a surface, whose indices are valid, for the worst fault of its edges.
pub(super) fn check_edges(vertices: &[Vec3], triangles: &[[usize; 3]]) -> Result<(), PolyhedronError> {
    let (mut open, mut branching, mut misoriented) = <(FaultyEdges, FaultyEdges, FaultyEdges)>::default();
    for meeting in half_edges(triangles).chunk_by(|a, b| a.ends == b.ends) {
        let [from, to] = meeting[0].ends.map(|end| vertices[end]);
        match meeting {
            [a, b] if a.runs_back != b.runs_back => {}
            [_, _] => misoriented.add(Edge { from, to }),
            [_] => open.add(Edge { from, to }),
            _ => branching.add(Edge { from, to }),
        }
    }
    if open.count > 0 {
        return Err(PolyhedronError::Open { count: open.count, first: open.first });
    }
    if branching.count > 0 {
        return Err(PolyhedronError::NonManifold { count: branching.count, first: branching.first });
    }
    if misoriented.count > 0 {
        return Err(PolyhedronError::Misoriented { count: misoriented.count, first: misoriented.first });
    }
    Ok(())
}
