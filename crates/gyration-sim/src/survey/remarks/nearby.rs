//! Which of many balls are near one another: by their places along an axis.

use gyration::tensor::Vec3;

/// Balls that are compared; a second for the most unlucky scene.
const MOST_COMPARED: usize = 1_000_000;

/// A ball around a body.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ball {
    pub body: usize,
    pub center: Vec3,
    pub radius: f64,
}

/// Hands each pair of balls that overlap to `each`, the first by its number first, until it returns false; false if not
/// all were compared.
pub(super) fn overlapping(balls: &mut [Ball], mut each: impl FnMut(&Ball, &Ball) -> bool) -> bool {
    let mut compared = 0;
    // Along the axis in which they are spread most.
    let spread = |axis: usize| {
        let places = balls.iter().map(|ball| ball.center[axis]);
        let (least, most) = places.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), c| (a.min(c), b.max(c)));
        most - least
    };
    let axis = (0..3).max_by(|one, other| spread(*one).total_cmp(&spread(*other))).unwrap_or(0);
    let begin = |ball: &Ball| ball.center[axis] - ball.radius;
    balls.sort_by(|one, other| begin(one).total_cmp(&begin(other)).then(one.body.cmp(&other.body)));
    for (place, one) in balls.iter().enumerate() {
        let end = one.center[axis] + one.radius;
        for other in balls[place + 1..].iter().take_while(|other| begin(other) <= end) {
            compared += 1;
            if compared > MOST_COMPARED {
                return false;
            }
            let (first, second) = if one.body < other.body { (one, other) } else { (other, one) };
            let reach = one.radius + other.radius;
            if (one.center - other.center).norm_squared() <= reach * reach && !each(first, second) {
                return false;
            }
        }
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn balls_that_overlap_are_found_once_each() {
        let centers = [[0.0, 0.0, 5.0], [0.0, 0.0, 0.0], [0.0, 0.3, 5.9], [0.0, 0.0, 2.5]];
        let ball = |(body, center): (usize, &[f64; 3])| Ball { body, center: (*center).into(), radius: 0.5 };
        let mut found = Vec::new();
        let mut balls: Vec<Ball> = centers.iter().enumerate().map(ball).collect();
        assert!(overlapping(&mut balls, |one, other| {
            found.push([one.body, other.body]);
            true
        }));
        assert_eq!(found, [[0, 2]]);
        assert!(!overlapping(&mut balls, |_, _| false));
    }
}
