//! How a body may deform, and what it is made of, in words.

use super::contraction::contraction;
use crate::format::significant;
use gyration::affine::{Kinetic, Viscosity};
use gyration::body::{Affine, Body, BodyKind};
use gyration::load::OwnForces;
use gyration::material::Material;
use serde::Serialize;

/// The kind of a body.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct KindSurvey {
    /// The word of the scene.
    pub kind: &'static str,
    /// Whether its volume is kept.
    pub incompressible: bool,
    /// Its material and moduli; none of a rigid body.
    pub material: Option<String>,
    /// What resists its deformation and motion, acts on it besides contacts and springs, or makes it contract; one
    /// entry each.
    pub loads: Vec<String>,
}

impl KindSurvey {
    /// The kind of a body.
    pub fn of(body: &Body) -> Self {
        let kind = match &body.kind {
            BodyKind::Rigid(_) => "rigid",
            BodyKind::Affine(_) => "affine",
            BodyKind::Contractile(_) => "contractile",
        };
        let own = own_forces(body);
        match body.affine() {
            None => Self { kind, incompressible: false, material: None, loads: own },
            Some(affine) => {
                let material = affine.interior.material.as_ref();
                Self {
                    kind,
                    incompressible: affine.interior.is_incompressible(),
                    material: Some(
                        material.map_or_else(|| "no material: deforms freely".to_owned(), material_in_words),
                    ),
                    loads: [loads(affine), own, body.contraction().map(contraction).unwrap_or_default()].concat(),
                }
            }
        }
    }
}

fn pascals(value: f64) -> String {
    format!("{} Pa", significant(value, 5))
}

fn material_in_words(material: &Material) -> String {
    let with_bulk = |words: String, bulk: Option<f64>| match bulk {
        Some(bulk) => format!("{words}, bulk modulus {}", pascals(bulk)),
        None => words,
    };
    match material {
        Material::MooneyRivlin(it) if it.c1 == 0.0 && it.c2 == 0.0 && it.bulk.is_none() => {
            "incompressible without elasticity".to_owned()
        }
        Material::MooneyRivlin(it) if it.c2 == 0.0 => {
            with_bulk(format!("neo-Hookean, shear modulus {}", pascals(2.0 * it.c1)), it.bulk)
        }
        Material::MooneyRivlin(it) => {
            with_bulk(format!("Mooney–Rivlin, c1 {}, c2 {}", pascals(it.c1), pascals(it.c2)), it.bulk)
        }
        Material::Fung(it) => {
            let shear = pascals(it.shear);
            with_bulk(format!("Fung, shear modulus {shear}, exponent {}", significant(it.exponent, 5)), it.bulk)
        }
        Material::Ogden(it) => {
            let term = |term: &gyration::material::OgdenTerm| {
                format!("{} to {}", pascals(term.mu), significant(term.alpha, 5))
            };
            let terms: Vec<String> = it.terms.iter().map(term).collect();
            with_bulk(format!("Ogden, {}", terms.join(", ")), it.bulk)
        }
        Material::NeoHookeanLog(it) => {
            format!("neo-Hookean with logarithm, mu {}, lambda {}", pascals(it.mu), pascals(it.lambda))
        }
        Material::StVenantKirchhoff(it) if it.lambda == 0.0 => {
            format!("orthogonality energy, kappa {}", pascals(it.mu / 4.0))
        }
        Material::StVenantKirchhoff(it) => {
            format!("St Venant–Kirchhoff, lambda {}, mu {}", pascals(it.lambda), pascals(it.mu))
        }
        Material::Hencky(it) => {
            format!("Hencky, shear modulus {}, bulk modulus {}", pascals(it.shear), pascals(it.bulk))
        }
    }
}

fn own_forces(body: &Body) -> Vec<String> {
    let OwnForces { potential, body_force, point_forces, resistance, frictions, absorption, self_gravity } = &body.own;
    let potential = potential.as_ref().map(|potential| match potential.is_energy() {
        true => "potential".to_owned(),
        false => "potential that changes in time".to_owned(),
    });
    let body_force = body_force.as_ref().map(|force| match force.error() {
        None => "body force, integrated exactly".to_owned(),
        Some(error) => {
            let (points, error) = (force.points(), significant(error, 2));
            format!("body force over {points} points, wrong by {error} of it at the start")
        }
    });
    let constant = resistance.as_ref().map(|_| "linear friction".to_owned());
    let varying = (!frictions.is_empty()).then(|| "linear friction that changes with place or time".to_owned());
    let absorption = absorption.map(|it| format!("absorption, rate {} 1/s", significant(it.rate, 5)));
    let forces = (!point_forces.is_empty()).then(|| match point_forces.len() {
        1 => "a force on a point".to_owned(),
        count => format!("forces on {count} points"),
    });
    let gravity = self_gravity.map(|_| "gravity of its own".to_owned());
    [potential, body_force, forces, constant, varying, absorption, gravity].into_iter().flatten().collect()
}

fn loads(affine: &Affine) -> Vec<String> {
    let Viscosity { kirchhoff, shear, bulk } = affine.interior.viscosity;
    let per_second = |value: f64| format!("{} Pa s", significant(value, 5));
    let resisting = affine.resistances.iter().filter(|load| load.dissipates()).count();
    let entries = [
        (kirchhoff != 0.0).then(|| format!("viscosity {}", per_second(kirchhoff))),
        (shear != 0.0 || bulk != 0.0)
            .then(|| format!("internal friction: shear {}, bulk {}", per_second(shear), per_second(bulk))),
        affine.interior.anisotropic.map(|_| "internal friction with directions".to_owned()),
        (resisting > 0).then(|| "linear friction".to_owned()),
        (affine.resistances.len() > resisting).then(|| "gyroscopic load".to_owned()),
        affine.couple.as_ref().map(|_| "couple".to_owned()),
        affine.interior.kinetic.map(|kinetic| match kinetic {
            Kinetic::Comoving => "comoving kinetic energy".to_owned(),
            Kinetic::Invariant { square, trace } => {
                let [a, b] = [square, trace].map(|value| significant(value, 5));
                format!("invariant kinetic energy, A {a} kg m^2, B {b} kg m^2")
            }
        }),
    ];
    entries.into_iter().flatten().collect()
}
