//! How the rates depend on a number, where that is known from what the number is.
//!
//!   f = a + b p^k:   ∂f/∂p = w (f(p₁) − f(p)),   w = (k/p)/((p₁/p)^k − 1)
//!
//! whatever p₁ is, with one neighbour instead of four, and far away: p^k doubles, at k = 1 it changes by |p|. Rounding
//! leaves that of f over b p^k. Loads are sums, and accelerations are linear in them where every body has inertia and
//! there is no fluid. So k = 1 for strengths of laws, moduli, viscosities and gravity; ν for the reference gap of a law
//! α (d/d₀)^−ν; −1 for the density of a body that nothing guides or joins to others, if no part of it weighs by itself.
//! Powers of the ledger go as the rates do, but for the density.
//!
//! It is known of no scene in which other numbers follow from this one: laws from what a contact does, reaches from
//! gaps, a lattice from its rest.

use super::number::SceneNumber;
use gyration::Inadmissible;
use gyration::dynamics::{Workspace, rates};
use gyration::extended::Numbers;
use gyration::model::Model;
use gyration_scene::Scene;

/// The exponent of a density.
const INVERSE: f64 = -1.0;
/// Keys of a material that are moduli, in which its energy is linear.
const MODULI: [&str; 8] = ["bulk", "c1", "c2", "kappa", "lambda", "mu", "shear", "youngs_modulus"];

/// The exponent k, and the neighbour at p₁.
#[derive(Debug)]
pub(super) struct KnownDependence {
    exponent: f64,
    weight: f64,
    neighbour: Box<Scene>,
    workspace: Workspace,
    values: Vec<f64>,
}

/// Rates and powers of the scene itself at one state, for all numbers that ask for them.
#[derive(Debug, Default)]
pub(crate) struct BaseRates {
    /// The time for which they are known \[s\].
    time: Option<f64>,
    values: Vec<f64>,
    workspace: Workspace,
    evaluations: u64,
}

impl BaseRates {
    /// How often they were computed.
    pub fn evaluations(&self) -> u64 {
        self.evaluations
    }

    /// Forgets them: the state is another one.
    pub fn leave(&mut self) {
        self.time = None;
    }

    /// f and g at a time.
    fn at(&mut self, model: &Model, time: f64, bodies: Numbers, works: usize) -> Result<&[f64], Inadmissible> {
        if self.time != Some(time) {
            self.time = None;
            self.evaluations += 1;
            fill(model, &mut self.workspace, (time, bodies, works), &mut self.values)?;
            self.time = Some(time);
        }
        Ok(&self.values)
    }
}

/// f and, behind it, g.
fn fill(
    model: &Model,
    workspace: &mut Workspace,
    (time, bodies, works): (f64, Numbers, usize),
    out: &mut Vec<f64>,
) -> Result<(), Inadmissible> {
    let n = bodies.high.len();
    out.resize(n + works, 0.0);
    let (slopes, powers) = out.split_at_mut(n);
    rates(model, workspace, time, bodies, slopes, powers)
}

impl KnownDependence {
    /// Of a number of a scene, whose change by `scale` counts as one; none where it is not known, or where the number
    /// cannot be moved so far.
    pub fn of(scene: &Scene, number: &SceneNumber, scale: f64) -> Option<Self> {
        let (exponent, value) = (exponent(scene, number)?, number.value);
        let (moved, weight) = if exponent == 1.0 {
            let moved = value + scale;
            (moved, 1.0 / (moved - value))
        } else {
            let moved = value * libm::pow(2.0, 1.0 / exponent);
            (moved, exponent / value / (libm::pow(moved / value, exponent) - 1.0))
        };
        let neighbour = Box::new(number.scene_at(scene, moved).ok()?);
        let is_known = weight.is_finite() && super::levels::have_same_equations(scene, &neighbour);
        let (workspace, values) = (Workspace::default(), Vec::new());
        is_known.then_some(Self { exponent, weight, neighbour, workspace, values })
    }

    /// The neighbour.
    pub fn scene(&self) -> &Scene {
        &self.neighbour
    }

    /// Whether powers go as the rates do.
    pub fn holds_of_powers(&self) -> bool {
        self.exponent != INVERSE
    }

    /// ∂f/∂p and ∂g/∂p, and the largest of f over its scale times the weight, of which rounding is a part.
    ///
    /// # Errors
    /// [`Inadmissible`] where one of the two scenes does not know the state.
    pub fn derivative(
        &mut self,
        model: &Model,
        base: &mut BaseRates,
        (time, bodies, scales): (f64, Numbers, &[f64]),
    ) -> Result<(Vec<f64>, f64), Inadmissible> {
        let works = scales.len() - bodies.high.len();
        let here = base.at(model, time, bodies, works)?;
        let Self { weight, neighbour, workspace, values, .. } = self;
        fill(&neighbour.built().model, workspace, (time, bodies, works), values)?;
        let magnitude = here.iter().zip(scales).map(|(value, scale)| value.abs() / scale).fold(0.0, f64::max);
        let derivative = values.iter().zip(here).map(|(there, here)| *weight * (there - here)).collect();
        Ok((derivative, weight.abs() * magnitude))
    }
}

/// k, if it is known.
fn exponent(scene: &Scene, number: &SceneNumber) -> Option<f64> {
    let (file, model) = (scene.file(), &scene.built().model);
    let is_plain = !number.derives_laws && file.lattice.is_none() && model.fluid.is_none();
    if !is_plain || !model.bodies.iter().all(|body| body.has_inertia()) {
        return None;
    }
    // A reach may be one of gaps at rest, which go with weights.
    let reaches = file.contact.iter().any(|contact| contact.reach.is_some());
    match number.key.split('.').map(str::trim).collect::<Vec<_>>()[..] {
        ["contact", index, law, entry] => {
            let contact = file.contact.get(index.parse::<usize>().ok()?)?;
            let support = contact.support.as_ref()?;
            let is_plane = file.support.iter().any(|of| of.name == *support && of.plane.is_some());
            let is_bounded = contact.friction.as_ref().is_some_and(|friction| friction.mu.is_some())
                || contact.damping.as_ref().is_some_and(|damping| damping.one_sided);
            if !is_plane || is_bounded || contact.reach.is_some() {
                return None;
            }
            match (law, entry) {
                ("repulsion", "alpha") | ("damping" | "friction" | "adhesion", "beta") => Some(1.0),
                ("repulsion", "d0") => contact.repulsion.as_ref().map(|law| law.nu.0),
                ("damping", "d0") => contact.damping.as_ref().map(|law| law.nu.0),
                ("friction", "d0") => contact.friction.as_ref().map(|law| law.nu.0),
                _ => None,
            }
        }
        ["world", "gravity", _] if !reaches => Some(1.0),
        ["body", name, "density"] if !reaches && model.joints().is_empty() => {
            let named = file.body.iter().position(|body| body.name == name).or_else(|| name.parse().ok())?;
            let own = file.body.get(named)?;
            let has_own_kinetic = own.affine.as_ref().is_some_and(|affine| affine.kinetic.is_some());
            let attracts = file.world.self_gravity.is_some();
            let is_even = !own.shape.as_ref().is_some_and(|shape| shape.weighs());
            let is_inverse =
                is_even && !has_own_kinetic && !attracts && own.contractile.is_none() && own.keep.is_none();
            is_inverse.then_some(INVERSE)
        }
        ["body", _, "affine", "viscosity"] | ["body", _, "affine", "internal_friction", "shear" | "bulk"] => Some(1.0),
        ["body", _, "affine", "material", _, modulus] => MODULI.contains(&modulus).then_some(1.0),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::variation::SceneVariation;
    use std::path::Path;

    /// A rigid die and a soft one over a plane, both in motion.
    const SCENE: &str = r#"
        time = { end = 1, sample = 1 }
        [[support]]
        name = "table"
        plane = { normal = [0.1, 0, 1] }
        [[contact]]
        support = "table"
        repulsion = { alpha = 245, nu = 6, d0 = "0.6 mm" }
        damping = { beta = 1e4, nu = 3, d0 = "0.5 mm" }
        friction = { beta = 3e4, nu = 2.5, d0 = "0.7 mm" }
        adhesion = { beta = 100, nu_attractive = 3, nu_repulsive = 9, d0 = "0.6 mm" }
        [[body]]
        name = "die"
        shape = { box = { size = [0.02, 0.02, 0.02] } }
        density = 1250
        position = [0, 0, 0.018]
        orientation = { axis_angle = { axis = [1, 1, 0], angle = "30 deg" } }
        velocity = [0.5, 0, -0.2]
        angular_velocity = [0, 20, 3]
        [[body]]
        name = "soft"
        shape = { box = { size = [0.02, 0.03, 0.02] } }
        density = 1100
        affine = { material = { mooney_rivlin = { c1 = 3000, c2 = 1000 } }, viscosity = 20 }
        position = [0.1, 0, 0.0025]
        gradient = [[1.25, 0.1, 0], [0, 0.8, 0], [0, 0, 1]]
        velocity = [0.5, 0, -0.2]
        gradient_rate = [[1, 2, 0], [0, -0.64, 0], [3, 0, 0]]
    "#;

    fn scene(settings: &[&str]) -> Scene {
        let settings: Vec<String> = settings.iter().map(|setting| (*setting).to_owned()).collect();
        Scene::parse("scene", SCENE, Path::new(""), &settings).unwrap()
    }

    /// Compares what one neighbour tells with what four do.
    fn compare(scene: &Scene, key: &str) {
        let built = scene.built();
        let number = || SceneNumber::find(scene, key).unwrap();
        let works = if key.ends_with("density") { 0 } else { built.model.works().len() };
        let scales = vec![1.0; built.state.bodies.len() + works];
        let of = |variation: &mut SceneVariation| {
            let at = (0.0, Numbers::from(&built.state.bodies), scales.as_slice());
            variation.rates(&built.model, &mut BaseRates::default(), at).unwrap()
        };
        let by_four = of(&mut SceneVariation::new(scene, number()).unwrap());
        let mut variation = SceneVariation::along_run(scene, number()).unwrap();
        let by_one = of(&mut variation);
        // A neighbour and the scene itself, and no other one.
        assert!(variation.known.is_some() && variation.evaluations() == 1, "{key}");
        let mut base = BaseRates::default();
        let here = base.at(&built.model, 0.0, (&built.state.bodies).into(), works).unwrap();
        let fastest = here.iter().fold(0.0, |most: f64, entry| most.max(entry.abs()));
        // Roundings of the rates over a ten thousandth of the number.
        let rounding = 30.0 * f64::EPSILON * fastest / (1e-4 * variation.scale());
        let largest = by_four.iter().fold(0.0, |most: f64, entry| most.max(entry.abs()));
        let pairs = by_one.iter().zip(&by_four).take(scales.len());
        let off = pairs.fold(0.0, |most: f64, (one, four)| most.max((one - four).abs()));
        println!("{key}: {off:e} of {largest:e}, rounding {rounding:e}");
        assert!(largest > 0.0 && off < 1e-10 * largest + rounding, "{key}: {off:e}");
    }

    #[test]
    fn one_neighbour_tells_what_four_do() {
        let scene = scene(&[]);
        let keys = [
            "contact.0.repulsion.alpha",
            "contact.0.repulsion.d0",
            "contact.0.damping.beta",
            "contact.0.damping.d0",
            "contact.0.friction.beta",
            "contact.0.friction.d0",
            "contact.0.adhesion.beta",
            "world.gravity.0",
            "world.gravity.2",
            "body.die.density",
            "body.soft.density",
            "body.soft.affine.viscosity",
        ];
        keys.iter().for_each(|key| compare(&scene, key));
    }

    #[test]
    fn stresses_are_linear_in_all_moduli() {
        let materials: [(&str, &[&str]); 9] = [
            ("mooney_rivlin = { c1 = 3000, c2 = 1000, bulk = 9000 }", &["c1", "c2", "bulk"]),
            ("neo_hookean = { shear = 3000, bulk = 9000 }", &["shear", "bulk"]),
            ("neo_hookean = { youngs_modulus = 9000, poissons_ratio = 0.3 }", &["youngs_modulus"]),
            ("ogden = { mu = [3000], alpha = [2.5], bulk = 9000 }", &["bulk"]),
            ("fung = { shear = 3000, exponent = 2, bulk = 9000 }", &["shear", "bulk"]),
            ("neo_hookean_log = { mu = 3000, lambda = 9000 }", &["mu", "lambda"]),
            ("st_venant_kirchhoff = { mu = 3000, lambda = 9000 }", &["mu", "lambda"]),
            ("hencky = { shear = 3000, bulk = 9000 }", &["shear", "bulk"]),
            ("orthogonality = { kappa = 3000 }", &["kappa"]),
        ];
        for (material, moduli) in materials {
            let name = material.split(' ').next().unwrap();
            let scene = scene(&[
                &format!("body.soft.affine.material={{ {material} }}"),
                "body.soft.affine.internal_friction={ shear = 2, bulk = 3 }",
            ]);
            moduli.iter().for_each(|modulus| compare(&scene, &format!("body.soft.affine.material.{name}.{modulus}")));
            ["shear", "bulk"]
                .iter()
                .for_each(|key| compare(&scene, &format!("body.soft.affine.internal_friction.{key}")));
        }
    }

    #[test]
    fn what_is_no_sum_is_not_taken_for_one() {
        let unknown = |settings: &[&str], key: &str| {
            let scene = scene(settings);
            exponent(&scene, &SceneNumber::find(&scene, key).unwrap()).is_none()
        };
        assert!(unknown(&[], "contact.0.repulsion.nu") && unknown(&[], "contact.0.adhesion.d0"));
        assert!(unknown(&[], "body.die.shape.box.size.0") && unknown(&[], "body.die.position.2"));
        assert!(unknown(&["contact.0.friction.mu=0.3"], "contact.0.repulsion.alpha"));
        assert!(unknown(&["contact.0.damping.one_sided=true"], "contact.0.repulsion.alpha"));
        assert!(unknown(&["fluid={ viscosity = 1 }"], "world.gravity.2"));
        let kept = ["body.die.keep={ axis = [0, 0, 1] }", "body.die.angular_velocity=[0, 0, 3]"];
        assert!(unknown(&kept, "body.die.density"));
        let half = "shape = { box = { size = [0.02, 0.02, 0.01] } }, offset = [0, 0";
        let of_lead = |weight: &str| {
            let parts = format!("{{ {half}, 0.005] }}, {{ {half}, -0.005]{weight} }}");
            format!("body.die.shape={{ union = {{ parts = [{parts}] }} }}")
        };
        assert!(unknown(&[&of_lead(", density = 11000")], "body.die.density"));
        assert!(!unknown(&[&of_lead("")], "body.die.density"));
    }
}
