//! Deformed surfaces above a plane, for the tests of their moments.

#![allow(dead_code, reason = "each test uses its part")]

pub mod charts;
pub mod quadrature;

use gyration::surface::{GapField, Kernel, Surface};
use gyration::tensor::{Mat3, Vec3};

/// A surface under a gradient above a plane, and a kernel.
pub struct Case {
    pub shape: &'static str,
    pub surface: Surface,
    pub gradient: Mat3,
    pub field: GapField,
    pub gap: f64,
    pub kernel: Kernel,
}

impl std::fmt::Display for Case {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let (m, p) = (self.field.direction.as_slice().to_vec(), self.gradient.as_slice().to_vec());
        write!(f, "{:?}, gap {:e}, m {m:?}, P {p:?}", self.kernel, self.gap)
    }
}

/// det P P⁻ᵀ.
pub fn cofactor(p: &Mat3) -> Mat3 {
    let (x, y, z): (Vec3, Vec3, Vec3) = (p.column(0).into(), p.column(1).into(), p.column(2).into());
    Mat3::from_columns(&[y.cross(&z), z.cross(&x), x.cross(&y)])
}

pub const SHAPES: [&str; 9] =
    ["sphere", "ellipsoid", "disc", "cylinder", "cone", "capsule", "torus", "needle", "cuboid"];

/// Size 1, about.
pub fn surface(name: &str) -> Surface {
    match name {
        "sphere" => Surface::sphere(0.5),
        "ellipsoid" => Surface::ellipsoid(&Vec3::new(0.5, 0.35, 0.2)),
        "disc" => Surface::ellipsoid(&Vec3::new(0.1, 0.5, 0.5)),
        "needle" => Surface::ellipsoid(&Vec3::new(0.5, 0.1, 0.1)),
        "cylinder" => Surface::cylinder(0.5, 1.0),
        "cone" => Surface::cone(0.4, 1.0),
        "capsule" => Surface::capsule(0.25, 0.5),
        "torus" => Surface::torus(0.35, 0.15),
        _ => Surface::cuboid(&Vec3::new(1.0, 0.5, 0.3)),
    }
}

/// Numbers in [0, 1) that look random, from a fixed start: Weyl's sequence.
pub struct Numbers(pub f64);

impl Numbers {
    pub fn draw(&mut self) -> f64 {
        self.0 = (self.0 * 997.0 + std::f64::consts::PI * 0.31).fract();
        self.0
    }

    pub fn vector(&mut self) -> Vec3 {
        Vec3::from_fn(|_, _| 2.0 * self.draw() - 1.0)
    }

    pub fn rotation(&mut self) -> Mat3 {
        *nalgebra::Rotation3::new(3.0 * self.vector()).matrix()
    }

    /// Stretches between 0.58 and 1.73, so that their ratio is 3 at most, in any axes, and a rotation.
    pub fn gradient(&mut self) -> Mat3 {
        let stretches = Vec3::from_fn(|_, _| 3f64.powf(self.draw() - 0.5));
        self.rotation() * Mat3::from_diagonal(&stretches) * self.rotation()
    }
}

/// The field with this direction and smallest gap.
pub fn field_above(surface: &Surface, direction: Vec3, gap: f64) -> GapField {
    let (lowest, _) = surface.smallest_gap(&GapField::new(0.0, direction));
    GapField::new(gap - lowest, direction)
}

/// Gaps from a thousandth of the size on, mild and sharp kernels, the axis of symmetry upright and any attitude.
pub fn cases(shape: &'static str) -> Vec<Case> {
    let mut numbers = Numbers(0.123);
    let kernels = [Kernel::Power(2.5), Kernel::Power(13.0), Kernel::Log, Kernel::Power(6.0), Kernel::Power(1.0)];
    let gaps = [1e-3, 1e-3, 0.05, 0.05, 1.0];
    let cases = kernels.into_iter().zip(gaps).enumerate().map(|(place, (kernel, gap))| {
        let surface = surface(shape);
        let gradient = numbers.gradient();
        let normal = numbers.vector().normalize();
        let direction = if place == 3 { Vec3::z() } else { gradient.tr_mul(&normal) };
        let field = field_above(&surface, direction, gap);
        Case { shape, surface, gradient, field, gap, kernel }
    });
    cases.collect()
}
