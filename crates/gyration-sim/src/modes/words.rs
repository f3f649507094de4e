//! What a mode is, in words.
//!
//! With G = δP P⁻¹ = W + D + tr G/3 1, W skew, D symmetric without trace, the parts of a motion are the translation
//! δp₀, the rotation W, the stretch or shear D, and breathing. The one with the most kinetic energy names it, m|δp₀|²
//! and tr(A P J Pᵀ Aᵀ) each; another with a good part of the energy is named too. Axes are those of space, or the
//! body's own, where they are plain.

use super::participation::{Participation, euler_tensor};
use super::shape::{ModeShape, spread};
use gyration::body::Body;
use gyration::kinematics::Placement;
use gyration::tensor::{Mat3, Polar, Vec3, axial};
use std::sync::Arc;

/// A second part is named from this share of the energy on.
const NAMED: f64 = 0.1;
/// So many bodies of a system are named at most.
const MOST_NAMED: usize = 3;
/// A direction is an axis if their cosine is at least this: some half a degree.
const PLAIN: f64 = 0.99995;
/// D is a shear if its middle value is below this part of the largest.
const PLANE: f64 = 0.25;

const NAMES: [&str; 3] = ["x", "y", "z"];

/// What the bodies of a system do, those that move most first; of a motion that a contraction adds, what strains the
/// relaxed shapes.
pub(super) fn of_system(
    names: &[&str],
    bodies: &[Arc<Body>],
    placements: &[Placement],
    shapes: &[ModeShape],
    strains: &[Option<Mat3>],
) -> String {
    let contracts = strains.iter().any(Option::is_some);
    let words = |body: usize| match &strains[body] {
        Some(strain) => format!("contraction, {}", of_contraction(strain, &placements[body])),
        None => of(&shapes[body], &bodies[body], &placements[body]),
    };
    if bodies.len() == 1 {
        return words(0);
    }
    let weights: Vec<f64> = match contracts {
        true => strains.iter().map(|strain| strain.map_or(0.0, |strain| strain.norm_squared())).collect(),
        false => {
            let participation = Participation::of(bodies, placements, [shapes, &[]]);
            participation.bodies.iter().map(|shares| shares.iter().sum()).collect()
        }
    };
    let most: f64 = weights.iter().copied().fold(0.0, f64::max);
    let moving: Vec<usize> = (0..bodies.len()).filter(|body| weights[*body] > NAMED * most).collect();
    // Bodies that do the same are named together.
    let mut told: Vec<(String, Vec<usize>)> = Vec::new();
    for body in moving {
        let words = words(body);
        match told.iter_mut().find(|(known, _)| *known == words) {
            Some((_, bodies)) => bodies.push(body),
            None => told.push((words, vec![body])),
        }
    }
    let weight = |(_, bodies): &(String, Vec<usize>)| bodies.iter().map(|body| weights[*body]).sum::<f64>();
    told.sort_by(|a, b| weight(b).total_cmp(&weight(a)));
    let called = |named: &[usize]| match named {
        all if all.len() == bodies.len() => "all".to_owned(),
        [few @ .., last] if !few.is_empty() && named.len() <= MOST_NAMED => {
            let few: Vec<&str> = few.iter().map(|body| names[*body]).collect();
            format!("{} and {}", few.join(", "), names[*last])
        }
        [one] => names[*one].to_owned(),
        many => format!("{} and {} others", names[many[0]], many.len() - 1),
    };
    let lines: Vec<String> =
        told.iter().take(MOST_NAMED).map(|(words, bodies)| format!("{}: {words}", called(bodies))).collect();
    lines.join("; ")
}

/// The words.
pub(super) fn of(shape: &ModeShape, body: &Body, placement: &Placement) -> String {
    let spread = spread(shape, placement);
    let skew = 0.5 * (spread - spread.transpose());
    let round = Mat3::from_diagonal_element(spread.trace() / 3.0);
    let strain = 0.5 * (spread + spread.transpose()) - round;
    let current = placement.gradient * euler_tensor(body) * placement.gradient.transpose();
    let energy = |part: &Mat3| (part * current).dot(part);
    // The centre of a pinned body goes where the pin lets it.
    let translation = if body.pin.is_some() { 0.0 } else { body.solid.mass.mass * shape.translation.norm_squared() };
    let axes = NamedAxes { own: Polar::of(&placement.gradient).rotation };
    let mut parts = [
        (translation, format!("translation along {}", axes.name(&shape.translation))),
        (energy(&skew), format!("rotation about {}", axes.name(&axial(&skew)))),
        (energy(&strain), axes.strain(&strain)),
        (energy(&round), "breathing".to_owned()),
    ];
    let total: f64 = parts.iter().map(|(energy, _)| energy).sum();
    parts.sort_by(|a, b| b.0.total_cmp(&a.0));
    let [(_, first), (second_energy, second), ..] = parts;
    if second_energy > NAMED * total { format!("{first}, {second}") } else { first }
}

/// A strain of the relaxed shape in words.
pub(super) fn of_contraction(strain: &Mat3, placement: &Placement) -> String {
    let round = Mat3::from_diagonal_element(strain.trace() / 3.0);
    let (deviator, turn) = (0.5 * (strain + strain.transpose()) - round, 0.5 * (strain - strain.transpose()));
    let axes = NamedAxes { own: Polar::of(&placement.gradient).rotation };
    if round.norm() > deviator.norm().max(turn.norm()) {
        "breathing".to_owned()
    } else if turn.norm() > deviator.norm() {
        format!("rotation about {}", axes.name(&axial(&turn)))
    } else {
        axes.strain(&deviator)
    }
}

/// Directions with names: those of space, and the columns of R.
struct NamedAxes {
    own: Mat3,
}

impl NamedAxes {
    /// The index of the axis that a direction is along.
    fn of_space(direction: &Vec3) -> Option<usize> {
        (0..3).find(|k| direction[*k].abs() > PLAIN * direction.norm())
    }

    fn of_body(&self, direction: &Vec3) -> Option<usize> {
        Self::of_space(&self.own.tr_mul(direction))
    }

    fn name(&self, direction: &Vec3) -> String {
        if let Some(axis) = Self::of_space(direction) {
            return NAMES[axis].to_owned();
        }
        if let Some(axis) = self.of_body(direction) {
            return format!("the body's {}", NAMES[axis]);
        }
        let unit = direction.try_normalize(0.0).unwrap_or(*direction);
        let sign = unit.iter().find(|c| c.abs() > 0.5).map_or(1.0, |c| c.signum());
        // Zero has no sign.
        let [x, y, z] = [0, 1, 2].map(|k| (1000.0 * sign * unit[k]).round() / 1000.0 + 0.0);
        format!("({x}, {y}, {z})")
    }

    /// D: a shear where one principal value is small beside the others, which are then nearly opposite; else a stretch.
    fn strain(&self, strain: &Mat3) -> String {
        let eigen = strain.symmetric_eigen();
        let mut order = [0, 1, 2];
        order.sort_by(|a, b| eigen.eigenvalues[*b].abs().total_cmp(&eigen.eigenvalues[*a].abs()));
        let axis = |k: usize| -> Vec3 { eigen.eigenvectors.column(order[k]).into() };
        let (first, second, third) = (axis(0), axis(1), axis(2));
        if eigen.eigenvalues[order[2]].abs() > PLANE * eigen.eigenvalues[order[0]].abs() {
            return format!("stretch along {}", self.name(&first));
        }
        let plain = |direction: &Vec3| Self::of_space(direction).or(self.of_body(direction));
        if plain(&first).is_some() && plain(&second).is_some() {
            return format!("stretch along {} against {}", self.name(&first), self.name(&second));
        }
        let sides = [first + second, first - second];
        let letters = |found: [Option<usize>; 2]| {
            let [Some(a), Some(b)] = found else { return None };
            Some(format!("{}{}", NAMES[a.min(b)], NAMES[a.max(b)]))
        };
        if let Some(plane) = letters(sides.map(|side| Self::of_space(&side))) {
            format!("shear in the plane {plane}")
        } else if let Some(plane) = letters(sides.map(|side| self.of_body(&side))) {
            format!("shear in the body's plane {plane}")
        } else {
            format!("shear across {}", self.name(&third))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn strain(rows: [f64; 9]) -> String {
        NamedAxes { own: *nalgebra::Rotation3::from_axis_angle(&Vec3::z_axis(), 0.3).matrix() }
            .strain(&Mat3::from_row_slice(&rows))
    }

    #[test]
    fn strains_have_the_name_of_their_principal_axes() {
        assert_eq!(strain([-1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 2.0]), "stretch along z");
        assert_eq!(strain([0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0]), "shear in the plane xz");
        let against = strain([1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -1.0]);
        assert!(["stretch along x against z", "stretch along z against x"].contains(&&*against), "{against}");
        let (sine, cosine) = 0.6f64.sin_cos();
        // A shear in the plane of the body's x and y: turned by 0.3 about z, so that its tensor turns by 0.6.
        assert_eq!(strain([-sine, cosine, 0.0, cosine, sine, 0.0, 0.0, 0.0, 0.0]), "shear in the body's plane xy");
    }
}
