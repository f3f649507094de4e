//! Materials: from what the file calls them to energies; notes those without a stable rest state.

use super::mass;
use super::moduli::{Moduli, Ratios, WrittenModuli};
use crate::check::{PartialScene, Placed, Reporter};
use crate::file::Material as Written;
use crate::key::Key;
use crate::quantity::{Density, NonNegative, Positive, Pressure};
use gyration::material::{Fung, Hencky, Material, MooneyRivlin, NeoHookeanLog, Ogden, OgdenTerm, StVenantKirchhoff};

/// Writes the laws that names of materials stand for, and their density where nothing says what a body weighs.
pub(super) fn resolve_names(partial: &mut PartialScene) {
    for Placed { value: body, .. } in &mut partial.bodies {
        let contractile = body.contractile.iter_mut().map(|contractile| &mut contractile.affine);
        let affine = body.affine.iter_mut().map(|affine| &mut **affine).chain(contractile);
        let mut density = None;
        for written in affine.filter_map(|affine| affine.material.as_mut()) {
            if let Some((law, usual)) = written.named() {
                *written = law;
                density = Some(usual);
            }
        }
        if mass::is_unknown(body) {
            body.density = density.map(|density| Positive(Density(density)));
        }
    }
}

/// The material at a key.
pub(super) fn material(written: &Written, key: &Key, reporter: &mut Reporter<'_>) -> Option<Material> {
    let (name, made) = match written {
        Written::Rubber | Written::Silicone | Written::Nylon | Written::Glass | Written::Aluminium | Written::Steel => {
            return material(&written.named()?.0, key, reporter);
        }
        Written::MooneyRivlin(it) => {
            let bulk = it.bulk.map(|bulk| bulk.value());
            let made = MooneyRivlin { c1: it.c1.value(), c2: it.c2.value(), bulk };
            ("mooney_rivlin", Material::MooneyRivlin(made))
        }
        Written::NeoHookean(it) => {
            let own = [("shear", value(it.shear)), ("bulk", it.bulk.map(Positive::value))];
            let moduli = moduli(
                (&key.key("neo_hookean"), Ratios::ToIncompressible),
                own,
                (it.youngs_modulus, it.poissons_ratio),
                reporter,
            )?;
            let made = MooneyRivlin::neo_hookean(moduli.shear(), moduli.bulk());
            ("neo_hookean", Material::MooneyRivlin(made))
        }
        Written::Ogden(it) => ("ogden", Material::Ogden(ogden(it, &key.key("ogden"), reporter)?)),
        Written::Fung(it) => {
            let bulk = it.bulk.map(|bulk| bulk.value());
            ("fung", Material::Fung(Fung { shear: it.shear.value(), exponent: it.exponent.0, bulk }))
        }
        Written::NeoHookeanLog(it) => {
            let own = [("mu", value(it.mu)), ("lambda", value(it.lambda))];
            let moduli = moduli(
                (&key.key("neo_hookean_log"), Ratios::NotNegative),
                own,
                (it.youngs_modulus, it.poissons_ratio),
                reporter,
            )?;
            let made = NeoHookeanLog { mu: moduli.shear(), lambda: moduli.lambda() };
            ("neo_hookean_log", Material::NeoHookeanLog(made))
        }
        Written::StVenantKirchhoff(it) => {
            let own = [("mu", value(it.mu)), ("lambda", it.lambda.map(|lambda| lambda.0))];
            let moduli = moduli(
                (&key.key("st_venant_kirchhoff"), Ratios::Compressible),
                own,
                (it.youngs_modulus, it.poissons_ratio),
                reporter,
            )?;
            let made = StVenantKirchhoff { lambda: moduli.lambda(), mu: moduli.shear() };
            ("st_venant_kirchhoff", Material::StVenantKirchhoff(made))
        }
        Written::Hencky(it) => {
            let own = [("shear", value(it.shear)), ("bulk", value(it.bulk))];
            let moduli = moduli(
                (&key.key("hencky"), Ratios::Compressible),
                own,
                (it.youngs_modulus, it.poissons_ratio),
                reporter,
            )?;
            ("hencky", Material::Hencky(Hencky { shear: moduli.shear(), bulk: moduli.bulk().unwrap_or(0.0) }))
        }
        Written::Orthogonality(it) => {
            let made = StVenantKirchhoff::orthogonality(it.kappa.value());
            ("orthogonality", Material::StVenantKirchhoff(made))
        }
    };
    sound(made, &key.key(name), reporter)
}

fn value(modulus: Option<NonNegative<Pressure>>) -> Option<f64> {
    modulus.map(NonNegative::value)
}

/// The two moduli of a material, from its own or from E and ν.
fn moduli(
    (key, ratios): (&Key, Ratios),
    own: [(&'static str, Option<f64>); 2],
    (youngs_modulus, poissons_ratio): (Option<Positive<Pressure>>, Option<f64>),
    reporter: &mut Reporter<'_>,
) -> Option<Moduli> {
    let youngs_modulus = youngs_modulus.map(Positive::value);
    WrittenModuli { key, own, ratios, youngs_modulus, poissons_ratio }.read(reporter)
}

/// The material, if it has a stable rest state.
fn sound(made: Material, key: &Key, reporter: &mut Reporter<'_>) -> Option<Material> {
    match made.validate() {
        Ok(()) => Some(made),
        Err(error) => {
            let named = key.key(error.name);
            // Where the file has another word for the number, the material is to blame as a whole.
            let place = if named.is_written(&reporter.document.root) { &named } else { key };
            reporter.note(place, error.to_string(), format!("write a number that is {}", error.bound));
            None
        }
    }
}

/// The terms, as many α as μ; each is checked at its own place.
fn ogden(written: &crate::file::Ogden, key: &Key, reporter: &mut Reporter<'_>) -> Option<Ogden> {
    let (mu, alpha) = (&written.mu, &written.alpha);
    if mu.len() != alpha.len() {
        let message = format!("there are {} exponents for {} moduli", alpha.len(), mu.len());
        reporter.note(&key.key("alpha"), message, "write one `alpha` for each `mu`");
        return None;
    }
    let terms: Vec<OgdenTerm> = mu.iter().zip(alpha).map(|(mu, alpha)| OgdenTerm { mu: mu.0, alpha: *alpha }).collect();
    let mut are_sound = true;
    for (index, OgdenTerm { mu, alpha }) in terms.iter().enumerate() {
        if *alpha == 0.0 {
            let help = "write another exponent, or leave the term out";
            reporter.note(&key.key("alpha").index(index), "the exponent is 0: the term has no energy", help);
            are_sound = false;
        } else if mu * alpha < 0.0 {
            let message =
                format!("{mu:?} has not the sign of its exponent, {alpha:?}: the term makes the rest state unstable");
            reporter.note(&key.key("mu").index(index), message, "give `mu` and `alpha` of a term the same sign");
            are_sound = false;
        }
    }
    are_sound.then(|| Ogden { terms, bulk: written.bulk.map(|bulk| bulk.value()) })
}
