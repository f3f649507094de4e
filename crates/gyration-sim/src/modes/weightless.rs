//! Small motions in which some bodies have no inertia: their places are states of first order.
//!
//!   ξ̈ + C ξ̇ + K ξ = B γ,   γ̇ = D ξ + E ξ̇ + H γ,   and of the coordinates t without inertia   C ξ̇ + K ξ = B γ
//!
//! gives their rates, with s the others, and C_tt positive where a fluid resists,
//!
//!   ξ̇_t = −C_tt⁻¹ (K_ts ξ_s + C_ts ξ̇_s + K_tt ξ_t − B_t γ)
//!
//! which leaves the same equations of ξ_s with the states (ξ_t | γ). K and C are those of the bodies with inertia, a
//! factor of whose rows drops out. Derivatives go along: a matrix stands with its changes, (A, ∂₁A, ∂₂A, …).

use super::spectrum::FirstOrder;
use nalgebra::{Complex, DMatrix, DVector};

type C64 = Complex<f64>;

/// K, C, B, D, E and H.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct MotionMatrices {
    /// K.
    pub stiffness: DMatrix<C64>,
    /// C.
    pub resistance: DMatrix<C64>,
    /// B.
    pub forces: DMatrix<C64>,
    /// D.
    pub by_place: DMatrix<C64>,
    /// E.
    pub by_rate: DMatrix<C64>,
    /// H.
    pub own: DMatrix<C64>,
}

impl MotionMatrices {
    /// Of so many ξ and γ, which do nothing to each other.
    pub fn zeros([size, own]: [usize; 2]) -> Self {
        Self {
            stiffness: DMatrix::zeros(size, size),
            resistance: DMatrix::zeros(size, size),
            forces: DMatrix::zeros(size, own),
            by_place: DMatrix::zeros(own, size),
            by_rate: DMatrix::zeros(own, size),
            own: DMatrix::zeros(own, own),
        }
    }
}

/// Which coordinates have inertia, and which have none.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Inertial {
    /// s, ascending.
    pub moving: Vec<usize>,
    /// t, ascending.
    pub weightless: Vec<usize>,
}

/// One of the matrices.
type MatrixOf = fn(&MotionMatrices) -> &DMatrix<C64>;

/// A matrix, then its changes.
#[derive(Debug, Clone)]
struct Changing(Vec<DMatrix<C64>>);

impl Changing {
    fn times(&self, other: &Self) -> Self {
        let (Self(own), Self(others)) = (self, other);
        let change = |(one, two): (&DMatrix<C64>, &DMatrix<C64>)| one * &others[0] + &own[0] * two;
        let changes = own.iter().zip(others).skip(1).map(change);
        Self(std::iter::once(&own[0] * &others[0]).chain(changes).collect())
    }

    fn plus(&self, other: &Self) -> Self {
        Self(self.0.iter().zip(&other.0).map(|(one, two)| one + two).collect())
    }

    fn negative(&self) -> Self {
        Self(self.0.iter().map(|matrix| -matrix).collect())
    }

    fn inverse(&self) -> Option<Self> {
        let value = self.0[0].clone().try_inverse()?;
        let changes: Vec<_> = self.0[1..].iter().map(|change| -(&value * change * &value)).collect();
        Some(Self(std::iter::once(value).chain(changes).collect()))
    }
}

impl Inertial {
    /// The order of ξ_s and the states that are places: where each stands among all coordinates.
    pub fn places(&self) -> Vec<usize> {
        self.moving.iter().chain(&self.weightless).copied().collect()
    }

    /// ξ_s of ξ, of length one unless it is nothing.
    pub fn moving_part(&self, whole: DVector<f64>) -> DVector<f64> {
        if self.weightless.is_empty() {
            return whole;
        }
        let part = DVector::from_fn(self.moving.len(), |i, _| whole[self.moving[i]]);
        let norm = part.norm();
        if norm > 0.0 { part / norm } else { part }
    }

    /// ξ of ξ_s and (ξ_t, γ).
    pub fn placed(&self, moving: &DVector<C64>, states: &DVector<C64>) -> DVector<C64> {
        let mut whole = DVector::zeros(self.moving.len() + self.weightless.len());
        self.places().iter().zip(moving.iter().chain(states.iter())).for_each(|(at, value)| whole[*at] = *value);
        whole
    }

    /// γ of (ξ_t, γ).
    pub fn contractions(&self, states: &DVector<C64>) -> DVector<C64> {
        let first = self.weightless.len();
        states.rows(first, states.len() - first).into_owned()
    }

    /// The matrices of (ξ_s | ξ_t, γ), then their changes, given those of (ξ | γ); none where nothing resists.
    pub fn condensed(&self, given: &[&MotionMatrices]) -> Option<Vec<MotionMatrices>> {
        let (s, t) = (&self.moving[..], &self.weightless[..]);
        let contractions: Vec<usize> = (0..given[0].own.nrows()).collect();
        let g = &contractions[..];
        let part = |of: MatrixOf, rows: &[usize], columns: &[usize]| {
            let taken = |matrix: &DMatrix<C64>| {
                DMatrix::from_fn(rows.len(), columns.len(), |i, j| matrix[(rows[i], columns[j])])
            };
            Changing(given.iter().map(|matrices| taken(of(matrices))).collect())
        };
        let [k, c, b]: [MatrixOf; 3] = [|it| &it.stiffness, |it| &it.resistance, |it| &it.forces];
        let [d, e, h]: [MatrixOf; 3] = [|it| &it.by_place, |it| &it.by_rate, |it| &it.own];
        let mobility = part(c, t, t).inverse()?;
        // ξ̇_t by ξ_s, ξ̇_s, ξ_t and γ.
        let by_place = mobility.times(&part(k, t, s)).negative();
        let by_rate = mobility.times(&part(c, t, s)).negative();
        let own = mobility.times(&part(k, t, t)).negative();
        let driven = mobility.times(&part(b, t, g));
        let (pulled, answers) = (part(c, s, t), part(e, g, t));
        let stiffness = part(k, s, s).plus(&pulled.times(&by_place));
        let resistance = part(c, s, s).plus(&pulled.times(&by_rate));
        let forces =
            [part(k, s, t).plus(&pulled.times(&own)).negative(), part(b, s, g).plus(&pulled.times(&driven).negative())];
        let own_of_contractions =
            [part(d, g, t).plus(&answers.times(&own)), part(h, g, g).plus(&answers.times(&driven))];
        let rows_of_contractions =
            [part(d, g, s).plus(&answers.times(&by_place)), part(e, g, s).plus(&answers.times(&by_rate))];
        let reduced = |number: usize| {
            let beside = |left: &Changing, right: &Changing| joined([[&left.0[number], &right.0[number]]]);
            let above = |upper: &Changing, lower: &Changing| joined([[&upper.0[number]], [&lower.0[number]]]);
            let of = |matrix: &Changing| matrix.0[number].clone();
            MotionMatrices {
                stiffness: of(&stiffness),
                resistance: of(&resistance),
                forces: beside(&forces[0], &forces[1]),
                by_place: above(&by_place, &rows_of_contractions[0]),
                by_rate: above(&by_rate, &rows_of_contractions[1]),
                own: joined([
                    [&own.0[number], &driven.0[number]],
                    [&own_of_contractions[0].0[number], &own_of_contractions[1].0[number]],
                ]),
            }
        };
        Some((0..given.len()).map(reduced).collect())
    }

    /// The same of real matrices, without changes.
    pub fn condensed_real(
        &self,
        (stiffness, resistance): (&DMatrix<f64>, &DMatrix<f64>),
        first: &FirstOrder,
    ) -> Option<(DMatrix<f64>, DMatrix<f64>, FirstOrder)> {
        let complex = |matrix: &DMatrix<f64>| matrix.map(|entry| C64::new(entry, 0.0));
        let real = |matrix: &DMatrix<C64>| matrix.map(|entry| entry.re);
        let at = MotionMatrices {
            stiffness: complex(stiffness),
            resistance: complex(resistance),
            forces: complex(&first.forces),
            by_place: complex(&first.by_place),
            by_rate: complex(&first.by_rate),
            own: complex(&first.own),
        };
        let found = self.condensed(&[&at])?.swap_remove(0);
        let turns = self.weightless.iter().map(|_| false).chain(first.turns.iter().copied()).collect();
        let first = FirstOrder {
            forces: real(&found.forces),
            by_place: real(&found.by_place),
            by_rate: real(&found.by_rate),
            own: real(&found.own),
            turns,
        };
        Some((real(&found.stiffness), real(&found.resistance), first))
    }
}

/// A matrix of blocks.
fn joined<const ROWS: usize, const COLUMNS: usize>(blocks: [[&DMatrix<C64>; COLUMNS]; ROWS]) -> DMatrix<C64> {
    let high: usize = blocks.iter().map(|row| row[0].nrows()).sum();
    let wide: usize = blocks[0].iter().map(|block| block.ncols()).sum();
    let mut whole = DMatrix::zeros(high, wide);
    let mut top = 0;
    for row in blocks {
        let mut left = 0;
        for block in row {
            whole.view_mut((top, left), block.shape()).copy_from(block);
            left += block.ncols();
        }
        top += row[0].nrows();
    }
    whole
}
