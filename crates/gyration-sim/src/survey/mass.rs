//! Mass properties in a form to print: principal values and axes instead of a matrix.

use gyration::mass::MassProperties;
use serde::Serialize;

/// Mass properties of a body.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MassSurvey {
    /// m [kg].
    pub mass: f64,
    /// V [m³]; 0 for mass points.
    pub volume: f64,
    /// X₀, the centre of mass in the shape's frame [m].
    pub center: [f64; 3],
    /// Principal values of the Euler tensor, ascending [kg m²].
    pub euler_principal: [f64; 3],
    /// Principal moments of inertia about the same axes, J₂+J₃, J₃+J₁, J₁+J₂ [kg m²].
    pub inertia_principal: [f64; 3],
    /// The principal axes in the shape's frame, one a row.
    pub axes: [[f64; 3]; 3],
}

impl MassSurvey {
    /// From the body's own mass properties.
    pub fn of(mass: &MassProperties) -> Self {
        let principal = mass.principal();
        let [first, second, third]: [f64; 3] = principal.values.into();
        Self {
            mass: mass.mass,
            volume: mass.volume,
            center: mass.center.into(),
            euler_principal: [first, second, third],
            inertia_principal: [second + third, third + first, first + second],
            axes: [0, 1, 2].map(|k| principal.axes.column(k).into_owned().into()),
        }
    }
}
