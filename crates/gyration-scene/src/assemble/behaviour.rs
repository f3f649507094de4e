//! `[[contact]] from`: the laws by which a contact does what is said of it.
//!
//! Over a level plane, on the side on which its centre is lowest, a body of weight m g lies at the gap d₀ if
//!
//!   α = m g/F₁(d₀, ν),
//!
//! F₁ the force there of a repulsion of strength 1. Of several bodies the one that needs the largest α counts. A layer
//! of modulus M = E(1 − ν_P)/((1 + ν_P)(1 − 2ν_P)) between wide faces yields by h/M per traction; the repulsion is as
//! stiff at d₀ where
//!
//!   ν α(d₀, ν)/d₀ = M/h,
//!
//! which gives d₀, or ν where d₀ is said. Damping c = β/α of the same exponent lets a flat impact at v₀ return with e
//! v₀,
//!
//!   x − ln(1 + x) = −y − ln(1 − y),   x = c v₀,   y = e x,
//!
//! whatever masses and shapes. Friction with the bound μ = tan θ has c = μ/v at the sliding speed v.

use super::body::AssembledBody;
use super::partners::{Names, Partners};
use crate::check::{PartialScene, Placed, Reporter};
use crate::file::{Behaviour, Contact, Damping, EXPONENT, Friction, Layer, Repulsion};
use crate::key::Key;
use crate::pressing::{GAPS, Pressing, root_of_falling};
use crate::quantity::{Length, NonNegative, Positive, Pressure, SurfaceDamping, si};
use crate::units::shown;
use std::collections::HashSet;
use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

/// Exponents among which that of a layer is sought.
const EXPONENTS: [f64; 2] = [2.0, 200.0];

/// The largest |ln d₀^ν|: with a strength it stays in the range of numbers.
const LARGEST_POWER: f64 = 660.0;

/// Writes the laws of all contacts that say what they do; leaves out those of which that cannot be, which is noted.
pub(super) fn resolve(partial: &mut PartialScene, assembled: &[Option<AssembledBody>], reporter: &mut Reporter<'_>) {
    if partial.contacts.iter().all(|contact| contact.value.from.is_none()) {
        return;
    }
    let gravity = si(&partial.world.gravity).norm();
    let names = Names::of(partial);
    let resolved = |Placed { key, number, value }: &Placed<Contact>| {
        let laws = match value.from {
            None => value.clone(),
            Some(behaviour) => {
                let pressing = || pressing(&names.partners(value, assembled.len())?, gravity, assembled);
                Written { behaviour, contact: value, key: &key.key("from") }.laws(pressing, reporter)?
            }
        };
        Some(Placed { key: key.clone(), number: *number, value: laws })
    };
    partial.contacts = partial.contacts.iter().filter_map(resolved).collect();
}

/// The different bodies with a weight that a contact is of; none if something is wrong with one of them.
fn pressing<'a>(
    partners: &Partners,
    gravity: f64,
    assembled: &'a [Option<AssembledBody>],
) -> Option<Vec<Pressing<'a>>> {
    let bodies: Vec<usize> = match partners {
        Partners::Support { bodies, .. } => bodies.clone(),
        Partners::Bodies(sets) => sets.concat(),
        Partners::Supports => Vec::new(),
    };
    let mut seen = HashSet::new();
    let mut pressing = Vec::new();
    for body in bodies {
        let solid = &assembled[body].as_ref()?.body.solid;
        if seen.insert(Arc::as_ptr(solid)) {
            pressing.extend(Pressing::new(solid, gravity));
        }
    }
    Some(pressing)
}

/// α \[Pa\] with which none of these comes nearer.
fn strength(pressing: &[Pressing<'_>], gap: f64, exponent: f64) -> f64 {
    pressing.iter().map(|body| body.strength(gap, exponent)).fold(f64::NAN, f64::max)
}

/// What is said of a contact, beside the laws that are written.
struct Written<'a> {
    behaviour: Behaviour,
    contact: &'a Contact,
    /// Of `from`.
    key: &'a Key,
}

impl Written<'_> {
    /// The contact with all its laws; notes what is missing, said twice or impossible.
    fn laws<'b>(
        &self,
        pressing: impl FnOnce() -> Option<Vec<Pressing<'b>>>,
        reporter: &mut Reporter<'_>,
    ) -> Option<Contact> {
        let Behaviour { restitution, at_speed, friction_angle, sliding_speed, .. } = self.behaviour;
        let bounce = [("restitution", restitution.is_some()), ("at_speed", at_speed.is_some())];
        let slide = [("friction_angle", friction_angle.is_some()), ("sliding_speed", sliding_speed.is_some())];
        let places = [
            self.is_alone("damping", self.contact.damping.is_some(), bounce[0], reporter),
            self.is_alone("friction", self.contact.friction.is_some(), slide[0], reporter),
            self.are_both(bounce, reporter),
            self.are_both(slide, reporter),
        ];
        let repulsion = self.repulsion(pressing, reporter);
        let damping = restitution.zip(at_speed).map(|(restitution, speed)| (restitution.0, speed.value()));
        if let Some((restitution, _)) = damping.filter(|(restitution, _)| *restitution > 1.0) {
            let message = format!("a restitution of {restitution} would add energy");
            reporter.note(&self.key.key("restitution"), message, "write a number above 0 and at most 1");
            return None;
        }
        let friction = friction_angle.zip(sliding_speed).map(|(angle, speed)| (angle.value(), speed.value()));
        if let Some((angle, _)) = friction.filter(|(angle, _)| *angle >= FRAC_PI_2) {
            let message = format!("the slope is {} deg", shown(angle.to_degrees()));
            reporter.note(&self.key.key("friction_angle"), message, "write an angle below 90 deg");
            return None;
        }
        let repulsion = repulsion.filter(|_| places.iter().all(|place| *place))?;
        let Repulsion { alpha, nu, d0 } = repulsion;
        let beta = |c: f64| NonNegative(SurfaceDamping(c * alpha.value()));
        let damping = damping.map(|(restitution, speed)| Damping {
            beta: beta(impact_number(restitution) / speed),
            nu,
            d0,
            one_sided: false,
        });
        let friction = friction.map(|(angle, speed)| {
            let mu = libm::tan(angle);
            Friction { beta: beta(mu / speed), nu, d0, mu: Some(NonNegative(mu)) }
        });
        Some(Contact {
            from: None,
            repulsion: Some(repulsion),
            damping: damping.filter(|law| law.beta.value() > 0.0).or(self.contact.damping),
            friction: friction.filter(|law| law.beta.value() > 0.0).or(self.contact.friction),
            ..self.contact.clone()
        })
    }

    /// Whether a law is written, or follows, and not both, which is noted.
    fn is_alone(
        &self,
        law: &str,
        is_written: bool,
        (word, is_said): (&str, bool),
        reporter: &mut Reporter<'_>,
    ) -> bool {
        if is_written && is_said {
            let message = format!("`{law}` is written beside it, and would follow from it");
            reporter.note(&self.key.key(word), message, format!("keep `{law}` or `{word}`"));
        }
        !(is_written && is_said)
    }

    /// Whether two words stand together or not at all; notes otherwise.
    fn are_both(&self, [(one, has_one), (other, has_other)]: [(&str, bool); 2], reporter: &mut Reporter<'_>) -> bool {
        let (there, missing) = if has_one { (one, other) } else { (other, one) };
        if has_one != has_other {
            let message = format!("`{there}` is given without `{missing}`");
            reporter.note(&self.key.key(there), message, format!("add `{missing}`"));
        }
        has_one == has_other
    }

    /// The repulsion that is written or follows.
    fn repulsion<'b>(
        &self,
        pressing: impl FnOnce() -> Option<Vec<Pressing<'b>>>,
        reporter: &mut Reporter<'_>,
    ) -> Option<Repulsion> {
        let Behaviour { rest_gap, nu, layer, .. } = self.behaviour;
        let words = [("rest_gap", rest_gap.is_some()), ("layer", layer.is_some()), ("nu", nu.is_some())];
        if let Some(repulsion) = self.contact.repulsion {
            let twice = words.map(|word| self.is_alone("repulsion", true, word, reporter));
            let is_still = repulsion.alpha.value() == 0.0;
            if is_still {
                reporter.note(self.key, "laws follow from a repulsion, and alpha is 0", "write an alpha above 0");
            }
            return Some(repulsion).filter(|_| !is_still && twice.iter().all(|once| *once));
        }
        if rest_gap.is_none() && layer.is_none() {
            let message = "nothing says how strongly the contact repels";
            reporter.note(self.key, message, "add `rest_gap`, the gap at which a body lies, or write a `repulsion`");
            return None;
        }
        if rest_gap.is_some() && layer.is_some() && nu.is_some() {
            let message = "`rest_gap` and `layer` together give the exponent";
            reporter.note(&self.key.key("nu"), message, "leave out one of the three");
            return None;
        }
        let layer = layer.map(|layer| self.layer(layer, reporter).ok_or(())).transpose().ok()?;
        let pressing = pressing()?;
        if pressing.is_empty() {
            let message = "no body of this contact has a surface and a weight that it rests with";
            let help = "give it a body and [world] gravity, or write a `repulsion`";
            reporter.note(&self.key.key(if rest_gap.is_some() { "rest_gap" } else { "layer" }), message, help);
            return None;
        }
        let exponent = nu.map_or(EXPONENT, |nu| nu.0);
        let rest_gap = rest_gap.map(|gap| gap.value());
        let (gap, exponent) = match (rest_gap, layer) {
            (Some(gap), None) => (gap, exponent),
            (None, stiffness) => (self.gap(&pressing, stiffness?, exponent, reporter)?, exponent),
            (Some(gap), Some(stiffness)) => (gap, self.exponent(&pressing, stiffness, gap, reporter)?),
        };
        let alpha = strength(&pressing, gap, exponent);
        if !alpha.is_normal() {
            let message = format!("with a gap of {} m alpha is {alpha:e}, which is no strength", shown(gap));
            reporter.note(self.key, message, "write a gap nearer to a thousandth of the body's size");
            return None;
        }
        Some(Repulsion { alpha: NonNegative(Pressure(alpha)), nu: Positive(exponent), d0: Positive(Length(gap)) })
    }

    /// M/h \[Pa/m\] of a layer.
    fn layer(&self, layer: Layer, reporter: &mut Reporter<'_>) -> Option<f64> {
        let ratio = layer.poissons_ratio;
        if !(ratio > -1.0 && ratio < 0.5) {
            let message = format!("Poisson's ratio is {ratio:?}");
            let help =
                "write a number above -1 and below 0.5: what is incompressible does not yield between wide faces";
            reporter.note(&self.key.key("layer").key("poissons_ratio"), message, help);
            return None;
        }
        let modulus = layer.youngs_modulus.value() * (1.0 - ratio) / ((1.0 + ratio) * (1.0 - 2.0 * ratio));
        Some(modulus / layer.thickness.value())
    }

    /// The gap \[m\] at which the repulsion has this stiffness \[Pa/m\].
    fn gap(
        &self,
        pressing: &[Pressing<'_>],
        stiffness: f64,
        exponent: f64,
        reporter: &mut Reporter<'_>,
    ) -> Option<f64> {
        let size = pressing.iter().map(|body| body.solid.shape.size()).fold(0.0, f64::max);
        let [least, largest] = GAPS.map(|gap| libm::log(gap * size));
        let excess = |logarithm: f64| {
            let gap = libm::exp(logarithm);
            exponent * strength(pressing, gap, exponent) / gap - stiffness
        };
        let found = root_of_falling([least, largest], excess).map(libm::exp);
        if found.is_none() {
            let message = "at no gap is the repulsion as stiff as this layer";
            let help = "write a layer whose stiffness is nearer to the weight over the area and the size";
            reporter.note(&self.key.key("layer"), message, help);
        }
        found
    }

    /// The exponent with which the repulsion has this stiffness \[Pa/m\] at this gap \[m\].
    fn exponent(
        &self,
        pressing: &[Pressing<'_>],
        stiffness: f64,
        gap: f64,
        reporter: &mut Reporter<'_>,
    ) -> Option<f64> {
        let lack = |exponent: f64| stiffness - exponent * strength(pressing, gap, exponent) / gap;
        let [least, most] = EXPONENTS;
        let most = most.min(LARGEST_POWER / libm::log(gap).abs());
        let found = root_of_falling([least, most], lack);
        if found.is_none() {
            let is_soft = lack(least) < 0.0;
            let way = if is_soft { "larger" } else { "smaller" };
            let bound = if is_soft { format!("less than {least}") } else { format!("above {}", most.floor()) };
            let message = format!("with this layer the exponent would be {bound}");
            let help = format!("write a {way} `rest_gap`, or leave it out: it then follows from the layer");
            reporter.note(&self.key.key("rest_gap"), message, help);
        }
        found
    }
}

/// c v₀ of a flat impact with this restitution, 0 < e ≤ 1.
fn impact_number(restitution: f64) -> f64 {
    let e = restitution;
    let excess = |x: f64| loss(x) - e * e * loss(-e * x);
    root_of_falling([0.0, 1.0 / e], excess).unwrap_or(0.0)
}

/// (x − ln(1 + x))/x², ½ at x = 0.
fn loss(x: f64) -> f64 {
    /// Where the series is as good as the difference.
    const SMALL: f64 = 0.1;
    if x.abs() > SMALL {
        return (x - libm::log1p(x)) / (x * x);
    }
    // Terms (−x)^k/(k + 2): the sixteenth is below rounding.
    (0..16).rev().fold(0.0, |sum, k| 1.0 / f64::from(k + 2) - x * sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_number_of_an_impact_is_that_of_its_restitution() {
        // The two of the recipes, at ten digits of their closed form.
        assert!((impact_number(0.593_624_260_0) - 1.0).abs() < 1e-9);
        assert!((impact_number(0.937_475_579_95) - 0.1).abs() < 1e-9);
        assert_eq!(impact_number(1.0), 0.0);
        // Next to nothing is left of y = 1.
        assert!((impact_number(1e-3) - 1e3).abs() < 1e-9);
        for e in [0.1, 0.5, 0.9, 0.999, 1.0 - 1e-9] {
            let x = impact_number(e);
            let (gained, lost) = (x * x * loss(x), e * e * x * x * loss(-e * x));
            assert!((gained / lost - 1.0).abs() < 1e-12, "{e}: {x}");
        }
        // c v₀ ≈ ¾ (1 − e²) of hardly damped ones.
        assert!((impact_number(1.0 - 1e-6) / 1.5e-6 - 1.0).abs() < 1e-5);
    }
}
