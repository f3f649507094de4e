//! Fields as one number a point, as pictures show them.
//!
//!   ρ;   |j|/ρ;   p = −tr σ/3;   τ = √(½ s:s), s = sym σ − ⅓ tr σ;   power of pairs

use super::local::LocalFields;
use gyration::tensor::Mat3;

/// The part of the largest density at which there is something that moves: farther out the speed is that of the nearest
/// body, whatever there is.
const THIN: f64 = 1e-3;

/// A field as one number a point.
#[derive(Debug, Clone, Copy)]
pub struct FieldScalar {
    /// In one word.
    pub key: &'static str,
    /// The name.
    pub name: &'static str,
    /// The unit.
    pub unit: &'static str,
    /// Whether it is of the mass that is there.
    of_mass: bool,
    of: fn(&LocalFields) -> f64,
}

/// All that are shown.
pub const FIELD_SCALARS: [FieldScalar; 5] = [
    FieldScalar { key: "density", name: "density", unit: "kg/m^3", of_mass: false, of: |it| it.density },
    FieldScalar { key: "speed", name: "speed", unit: "m/s", of_mass: true, of: LocalFields::speed },
    FieldScalar { key: "pressure", name: "pressure −tr σ/3", unit: "Pa", of_mass: false, of: LocalFields::pressure },
    FieldScalar { key: "shear", name: "shear stress", unit: "Pa", of_mass: false, of: LocalFields::shear },
    FieldScalar { key: "power", name: "power of pairs", unit: "W/m^3", of_mass: false, of: |it| it.power },
];

impl FieldScalar {
    /// At each point; not a number where too little is there to have one.
    pub fn values(&self, fields: &[LocalFields]) -> Vec<f64> {
        let most = fields.iter().map(|it| it.density).fold(0.0, f64::max);
        let is_there = |it: &LocalFields| !self.of_mass || it.density > THIN * most;
        fields.iter().map(|it| if is_there(it) { (self.of)(it) } else { f64::NAN }).collect()
    }
}

impl LocalFields {
    /// p = −tr σ/3 \[Pa\].
    pub fn pressure(&self) -> f64 {
        -self.stress.trace() / 3.0
    }

    /// √(½ s:s) of the symmetric deviator s of σ \[Pa\].
    pub fn shear(&self) -> f64 {
        let symmetric = 0.5 * (self.stress + self.stress.transpose());
        let deviator = symmetric - Mat3::identity() * (symmetric.trace() / 3.0);
        libm::sqrt(0.5 * deviator.norm_squared())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gyration::tensor::Vec3;

    #[test]
    fn shear_of_pure_pressure_is_none_and_of_simple_shear_itself() {
        let under = |stress| LocalFields { stress, ..LocalFields::default() };
        let pressed = under(Mat3::identity() * -3.0);
        assert_eq!((pressed.shear(), pressed.pressure()), (0.0, 3.0));
        let mut stress = Mat3::zeros();
        (stress[(0, 1)], stress[(1, 0)]) = (2.0, 2.0);
        assert!((under(stress).shear() - 2.0).abs() < 1e-15);
        assert_eq!(under(stress).pressure(), 0.0);
    }

    #[test]
    fn a_speed_is_known_where_something_is() {
        let moving = |density: f64| LocalFields { density, momentum: Vec3::x() * density, ..LocalFields::default() };
        let fields = [moving(2.0), moving(1e-4), moving(0.0)];
        let [density, speed] = [0, 1].map(|index| FIELD_SCALARS[index].values(&fields));
        assert_eq!(density, [2.0, 1e-4, 0.0]);
        assert_eq!(speed.iter().map(|speed| speed.is_nan()).collect::<Vec<_>>(), [false, true, true]);
    }
}
