//! Inertia that a fluid adds to a sphere that deforms, and the balance with it:
//!
//!   P̈ J + 𝒦:(P̈ P⁻¹) P⁻ᵀ = M̂ + q P⁻ᵀ,     𝒦:X = a_W skw X + a_E dev sym X + a_V ⅓ tr(X) I
//!
//! M̂ = M − V S, with 𝒦:L² P⁻ᵀ in M, since L̇ = P̈ P⁻¹ − L². Its kinetic energy is ½ L·𝒦:L. q is what the pressure of
//! an incompressible body grows by, over V, so that tr(P̈ P⁻¹) = tr(L²). The left side is a symmetric positive definite
//! matrix of nine rows on P̈,
//!
//!   K δP̈ = δM̂ + q δ(P⁻ᵀ) + δq P⁻ᵀ − δK P̈
//!
//! Source: `docs/fluid-memory.md`.

use super::{AffineBody, Gyration};
use crate::load::unit;
use crate::tensor::Mat3;
use nalgebra::{SMatrix, SVector};

type Mat9 = SMatrix<f64, 9, 9>;

/// 𝒦, an isotropic inertia against changes of L.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AddedInertia {
    /// a_W, against skw L̇ [kg m²].
    pub spin: f64,
    /// a_E, against dev sym L̇ [kg m²].
    pub strain: f64,
    /// a_V, against ⅓ tr(L̇) I [kg m²].
    pub growth: f64,
}

impl AddedInertia {
    /// 𝒦:X.
    pub fn of(&self, x: &Mat3) -> Mat3 {
        let mean = x.trace() / 3.0;
        let (turning, straining) = (0.5 * (x - x.transpose()), 0.5 * (x + x.transpose()));
        self.spin * turning + self.strain * straining + Mat3::from_diagonal_element((self.growth - self.strain) * mean)
    }
}

/// P̈ of such a body, and by how much its pressure changes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Accelerated {
    /// P̈ [1/s²].
    pub acceleration: Mat3,
    /// q [N m].
    pub push: f64,
}

/// The balance with added inertia at P and Ṗ.
#[derive(Debug, Clone, Copy)]
pub(crate) struct AddedBalance<'a> {
    at: &'a Gyration,
    added: AddedInertia,
    /// K⁻¹.
    inverse: Mat9,
    /// K⁻¹ P⁻ᵀ, and one over its product with P⁻ᵀ, of an incompressible body.
    way: Option<(Mat3, f64)>,
}

impl<'a> AddedBalance<'a> {
    /// Of a body.
    pub fn of(body: &AffineBody, at: &'a Gyration, added: AddedInertia) -> Self {
        let across = at.inverse.transpose();
        let columns: [SVector<f64, 9>; 9] = std::array::from_fn(|entry| {
            let unit = unit(entry);
            let moment = unit * body.euler_tensor + added.of(&(unit * at.inverse)) * across;
            SVector::from_column_slice(moment.as_slice())
        });
        // Positive definite, as J is, unless a number is none.
        let factors = Mat9::from_columns(&columns).cholesky();
        let inverse = factors.map_or(Mat9::from_element(f64::NAN), |factors| factors.inverse());
        let way = body.is_incompressible().then(|| {
            let way = image(&inverse, &across);
            (way, 1.0 / way.dot(&across))
        });
        Self { at, added, inverse, way }
    }

    /// P̈ and q of M̂.
    pub fn solve(&self, moment: &Mat3) -> Accelerated {
        let l = &self.at.velocity_gradient;
        self.pushed(image(&self.inverse, moment), (l * l).trace())
    }

    /// A and what takes tr(A P⁻¹) to the number asked for.
    fn pushed(&self, free: Mat3, asked: f64) -> Accelerated {
        let Some((way, compliance)) = &self.way else { return Accelerated { acceleration: free, push: 0.0 } };
        let push = (asked - free.dot(&self.at.inverse.transpose())) * compliance;
        Accelerated { acceleration: free + push * way, push }
    }

    /// δP̈ of δM̂ alone.
    pub fn along_moment(&self, moment: &Mat3) -> Mat3 {
        self.pushed(image(&self.inverse, moment), 0.0).acceleration
    }

    /// δP̈ along δṖ, with the δM̂ that it makes.
    pub fn along_rate(&self, rate: &Mat3, moment: &Mat3) -> Mat3 {
        let change = rate * self.at.inverse;
        let asked = 2.0 * (self.at.velocity_gradient * change).trace();
        self.pushed(image(&self.inverse, moment), asked).acceleration
    }

    /// δP̈ along δP, with the δM̂ that it makes.
    pub fn along_gradient(&self, at: &Accelerated, gradient: &Mat3, moment: &Mat3) -> Mat3 {
        let Gyration { inverse, velocity_gradient: l, .. } = self.at;
        let spread = gradient * inverse;
        // δ(P⁻ᵀ) = −(δP P⁻¹)ᵀ P⁻ᵀ, at fixed P̈ δ(P̈ P⁻¹) = −P̈ P⁻¹ δP P⁻¹, δL = −L δP P⁻¹.
        let across = inverse.transpose();
        let turned = -(spread.transpose() * across);
        let drawn = at.acceleration * inverse;
        let inertia = self.added.of(&drawn) * turned - self.added.of(&(drawn * spread)) * across;
        let asked = -2.0 * (l * l * spread).trace() - turned.dot(&at.acceleration);
        self.pushed(image(&self.inverse, &(moment + at.push * turned - inertia)), asked).acceleration
    }
}

/// The image of a matrix, column by column.
fn image(map: &Mat9, matrix: &Mat3) -> Mat3 {
    Mat3::from_column_slice((map * SVector::<f64, 9>::from_column_slice(matrix.as_slice())).as_slice())
}
