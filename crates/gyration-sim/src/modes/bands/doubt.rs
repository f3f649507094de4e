//! By how much frequencies may be off, given by how much the matrices may be.

/// How far the matrices of a lattice may be off, at any wave vector.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MatrixDoubt {
    /// |δK| [1/s²].
    pub(super) stiffness: f64,
    /// |δC| [1/s].
    pub(super) resistance: f64,
    /// Whether there are more matrices, of which nothing is known.
    pub(super) is_open: bool,
}

impl MatrixDoubt {
    /// Of |δK| and |δC|.
    pub(super) fn of([stiffness, resistance]: [f64; 2]) -> Self {
        Self { stiffness, resistance, is_open: false }
    }

    /// By how much ω may be off [rad/s], given ω² [1/s²], the residual of its shape, and how far the next one is.
    pub(super) fn of_square(&self, square: f64, residual: f64, gap: f64) -> f64 {
        let apart = gap - residual;
        let nearer = if apart > residual { residual * residual / apart } else { residual };
        let error = nearer + self.stiffness;
        match square > 0.0 {
            true => error / (libm::sqrt(square) + libm::sqrt((square - error).max(0.0))),
            false => libm::sqrt((square + error).max(0.0)),
        }
    }

    /// The same with what a deformation of the cell leaves open.
    #[must_use]
    pub fn with(self, cell: Self) -> Self {
        Self {
            stiffness: self.stiffness + cell.stiffness,
            resistance: self.resistance + cell.resistance,
            is_open: self.is_open || cell.is_open,
        }
    }
}
