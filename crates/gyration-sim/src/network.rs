//! The network of forces: the contacts that count at an instant, each once.
//!
//!   F_n = f·n > 0       where two push each other, n towards the first
//!
//! A contact counts as in a crowd (`crowd`): by the mean force of those that count, and by the mean weight.

use crate::crowd::keep_counted;
use gyration::dynamics::Exchange;
use gyration::lattice::Cell;
use gyration::model::Model;
use gyration::tensor::Vec3;

/// Two that push each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Push {
    /// The first body.
    pub body: usize,
    /// The body that pushes it; none for a support, or for a body that is seen in an image.
    pub other: Option<usize>,
    /// F_n \[N\].
    pub force: f64,
    /// The foot of the force \[m\], in space.
    pub point: Vec3,
}

/// Those that push each other, of all that parties do to each other at an instant; contacts that do not count are left
/// out, and a contact with an image stands for both of its bodies.
pub fn network(model: &Model, mut exchanges: Vec<Exchange>) -> Vec<Push> {
    let weight: f64 = model.bodies.iter().map(|body| body.solid.mass.mass).sum::<f64>() * model.gravity.norm();
    keep_counted(&mut exchanges, weight / model.bodies.len().max(1) as f64);
    exchanges.iter().flat_map(|exchange| pushes(model, exchange)).flatten().collect()
}

/// The push of a contact, on one body or, where the second is seen in an image, on both.
fn pushes(model: &Model, exchange: &Exchange) -> [Option<Push>; 2] {
    let (Some(body), Some(normal), Some(point)) = (exchange.parties[0].body(), exchange.normal, exchange.point) else {
        return [None, None];
    };
    let force = exchange.force.dot(&normal);
    if force <= 0.0 {
        return [None, None];
    }
    let Some(second) = exchange.parties[1].body() else {
        return [Some(Push { body, other: None, force, point }), None];
    };
    if is_beside(model, [body, second], exchange.cell) {
        return [Some(Push { body, other: Some(second), force, point }), None];
    }
    let seen = model.in_cell(body, &point) - model.lattice.place(exchange.cell);
    let image = Push { body: second, other: None, force, point: model.in_space(second, &seen) };
    [Some(Push { body, other: None, force, point }), Some(image)]
}

/// Whether a body is in space where it is seen from the cell of another, and not one of its images.
fn is_beside(model: &Model, [one, other]: [usize; 2], cell: Cell) -> bool {
    let [from, to] = [one, other].map(|body| model.in_space(body, &Vec3::zeros()));
    let vectors = model.lattice.vectors().iter().map(Vec3::norm);
    // Whole cells lie between a body and its image.
    (to - from - model.lattice.place(cell)).norm() < 0.5 * vectors.fold(f64::INFINITY, f64::min)
}
