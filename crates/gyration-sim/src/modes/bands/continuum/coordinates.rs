//! The coordinates (u, α) of a continuum: the translation of everything; how granules lie to one another in a cell, how
//! they turn and deform.
//!
//!   δp_i = u + w_i,   δP_i = A_i P_i,   Σ m_i w_i = 0
//!
//! u is the displacement of the centre of mass of a cell, w_j of the others is given relative to that of the first
//! body. A of an affine body has nine entries; of one of constant volume eight, A_zz = −A_xx − A_yy; of a rigid one it
//! is [θ]×.

use super::super::LatticeWaves;
use gyration::tensor::{Mat3, Vec3, cross_matrix};
use nalgebra::{DMatrix, DVector};

const AXES: [char; 3] = ['x', 'y', 'z'];

/// A coordinate.
#[derive(Debug, Clone)]
pub(super) struct Motion {
    /// What it is called.
    pub name: String,
    kind: Kind,
}

/// What it moves.
#[derive(Debug, Clone, Copy)]
enum Kind {
    /// u along an axis.
    Together(usize),
    /// The displacement of a body relative to the first, along an axis.
    Relative(usize, usize),
    /// θ of a body about an axis.
    Turn(usize, usize),
    /// A_ij of a body; where its volume is kept, A_zz follows.
    Gradient { body: usize, row: usize, column: usize, keeps_volume: bool },
}

/// The coordinates of the cell of some waves.
pub(super) fn motions(waves: &LatticeWaves, names: &[&str]) -> Vec<Motion> {
    let mut motions = Vec::new();
    let mut add = |name: String, kind: Kind| motions.push(Motion { name, kind });
    for (axis, letter) in AXES.into_iter().enumerate() {
        add(format!("u_{letter}"), Kind::Together(axis));
    }
    for (body, name) in names.iter().enumerate() {
        if body > 0 {
            for (axis, letter) in AXES.into_iter().enumerate() {
                add(format!("{name}.u_{letter}"), Kind::Relative(body, axis));
            }
        }
        let own = &waves.frozen.bodies()[body];
        if own.affine().is_none() {
            let turns = if own.is_point() { 0 } else { 3 };
            for (axis, letter) in AXES.into_iter().enumerate().take(turns) {
                add(format!("{name}.turn_{letter}"), Kind::Turn(body, axis));
            }
            continue;
        }
        // Three translations beside the entries of A.
        let entries = waves.coordinates.of(body).count() - 3;
        for (row, column) in (0..3).flat_map(|row| (0..3).map(move |column| (row, column))).take(entries) {
            let name = format!("{name}.A_{}{}", AXES[row], AXES[column]);
            add(name, Kind::Gradient { body, row, column, keeps_volume: entries < 9 });
        }
    }
    motions
}

/// The coordinates of mass one of the small motions, a column a coordinate.
pub(super) fn columns(waves: &LatticeWaves, motions: &[Motion]) -> DMatrix<f64> {
    let bodies = waves.frozen.bodies();
    let masses: Vec<f64> = bodies.iter().map(|body| body.solid.mass.mass).collect();
    let total: f64 = masses.iter().sum();
    let still = (Vec3::zeros(), Mat3::zeros());
    let column = |motion: &Motion| {
        let of_body = |index: usize| match motion.kind {
            Kind::Together(axis) => (Vec3::ith(axis, 1.0), Mat3::zeros()),
            Kind::Relative(body, axis) => {
                let own = if body == index { 1.0 } else { 0.0 };
                (Vec3::ith(axis, own - masses[body] / total), Mat3::zeros())
            }
            Kind::Turn(body, axis) if body == index => (Vec3::zeros(), cross_matrix(&Vec3::ith(axis, 1.0))),
            Kind::Gradient { body, row, column, keeps_volume } if body == index => {
                let mut gradient = Mat3::zeros();
                gradient[(row, column)] = 1.0;
                if keeps_volume && row == column {
                    gradient[(2, 2)] = -1.0;
                }
                (Vec3::zeros(), gradient)
            }
            Kind::Turn(..) | Kind::Gradient { .. } => still,
        };
        waves.coordinates.moved(&waves.frozen, |body| {
            let (translation, turned) = of_body(body);
            (translation, turned * waves.rest.bodies[body].placement.gradient)
        })
    };
    let columns: Vec<DVector<f64>> = motions.iter().map(column).collect();
    DMatrix::from_columns(&columns)
}

/// The coordinates in a rotation of everything about the first body, u left out.
pub(super) fn rotation(waves: &LatticeWaves, motions: &[Motion], spin: &Vec3) -> DVector<f64> {
    let turned = cross_matrix(spin);
    let of = |motion: &Motion| match motion.kind {
        Kind::Together(_) => 0.0,
        Kind::Relative(body, axis) => (turned * (waves.place(body) - waves.place(0)))[axis],
        Kind::Turn(_, axis) => spin[axis],
        Kind::Gradient { row, column, .. } => turned[(row, column)],
    };
    DVector::from_iterator(motions.len(), motions.iter().map(of))
}

/// The coordinates of which sym A = 0: a column for each that stays, three for the turns of a body that deforms.
pub(super) fn turning(motions: &[Motion]) -> DMatrix<f64> {
    let mut columns: Vec<DVector<f64>> = Vec::new();
    let unit = |number: usize| DVector::from_fn(motions.len(), |row, _| f64::from(u8::from(row == number)));
    let mut last = None;
    for (number, motion) in motions.iter().enumerate() {
        let Kind::Gradient { body, .. } = motion.kind else {
            columns.push(unit(number));
            continue;
        };
        if last.replace(body) == Some(body) {
            continue;
        }
        columns.extend((0..3).map(|axis| {
            let turned = cross_matrix(&Vec3::ith(axis, 1.0));
            let of = |motion: &Motion| match motion.kind {
                Kind::Gradient { body: other, row, column, .. } if other == body => turned[(row, column)],
                _ => 0.0,
            };
            DVector::from_iterator(motions.len(), motions.iter().map(of))
        }));
    }
    DMatrix::from_columns(&columns)
}
