//! Systems of many coupled blocks: a chain of oscillators with known normal modes, and balls that come to touch.

use gyration_ode::{BlockMatrix, Components, Pattern, System};
use std::convert::Infallible;
use std::f64::consts::PI;
use std::ops::Range;

/// How a system of many bodies is shown to a stepper.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shown {
    /// As blocks that couple.
    Coupled,
    /// As blocks that couple, of which the rates x' = v are local.
    Reduced,
    /// As one dense block.
    Whole,
}

/// Blocks of (x, v), one a body; or all bodies in one block.
fn blocks(bodies: usize, shown: Shown) -> Vec<Range<usize>> {
    match shown {
        Shown::Coupled | Shown::Reduced => (0..bodies).map(|i| 2 * i..2 * i + 2).collect(),
        Shown::Whole => std::iter::once(0..2 * bodies).collect(),
    }
}

/// Adds ∂v̇_i/∂(x_j, v_j).
fn add(jacobian: &mut BlockMatrix, shown: Shown, (i, j): (usize, usize), slopes: (f64, f64)) {
    let (block, i, j) = match shown {
        Shown::Coupled | Shown::Reduced => (jacobian.block_mut(i, j).unwrap(), 0, 0),
        Shown::Whole => (&mut jacobian.diagonal_mut()[0], 2 * i, 2 * j),
    };
    block[(i + 1, j)] += slopes.0;
    block[(i + 1, j + 1)] += slopes.1;
}

/// Sets ∂ẋ_i/∂v_i.
fn add_velocities(jacobian: &mut BlockMatrix, shown: Shown, bodies: usize) {
    for i in 0..bodies {
        match shown {
            Shown::Coupled | Shown::Reduced => jacobian.diagonal_mut()[i][(0, 1)] = 1.0,
            Shown::Whole => jacobian.diagonal_mut()[0][(2 * i, 2 * i + 1)] = 1.0,
        }
    }
}

/// Unit masses between two walls, x_i'' = Δ(k x + c x')_i with Δx_i = x_{i−1} − 2x_i + x_{i+1}; w' = Σ x_i².
pub struct Chain {
    pub bodies: usize,
    pub stiffness: f64,
    pub damping: f64,
    pub atol: f64,
    shown: Shown,
    blocks: Vec<Range<usize>>,
    pattern: Pattern,
    components: Components,
}

impl Chain {
    /// Stiff: rates from 30 to 4e4 for long chains, and waves at 2e3.
    pub fn new(bodies: usize, shown: Shown) -> Self {
        let neighbours = (1..bodies).flat_map(|i| [(i - 1, i), (i, i - 1)]);
        let pattern = match shown {
            Shown::Coupled => Pattern::new(bodies, neighbours),
            Shown::Reduced => Pattern::new(bodies, neighbours).with_local_rates(vec![1; bodies]),
            Shown::Whole => Pattern::uncoupled(),
        };
        let (stiffness, damping, atol, blocks) = (1e6, 1e4, 1e-7, blocks(bodies, shown));
        let components = Components::of(&pattern, blocks.len());
        Self { bodies, stiffness, damping, atol, shown, blocks, pattern, components }
    }

    /// x_i = a sin(m π i/(N + 1)) of mode m, at rest at t = 0: a'' = −λ (k a + c a'), λ = 4 sin²(m π/(2(N + 1))).
    pub fn mode(&self, m: usize, t: f64) -> Vec<f64> {
        let angle = m as f64 * PI / (self.bodies + 1) as f64;
        let eigenvalue = 4.0 * (0.5 * angle).sin().powi(2);
        let (decay, square) = (0.5 * self.damping * eigenvalue, self.stiffness * eigenvalue);
        let discriminant = decay * decay - square;
        let (a, rate) = if discriminant > 0.0 {
            let root = discriminant.sqrt();
            // The slow root without cancellation.
            let (fast, slow) = (-decay - root, -square / (decay + root));
            let (f, s) = ((fast * t).exp(), (slow * t).exp());
            ((fast * s - slow * f) / (fast - slow), square * (s - f) / (fast - slow))
        } else {
            let omega = (-discriminant).sqrt();
            let (sin, cos) = (omega * t).sin_cos();
            ((-decay * t).exp() * (cos + decay / omega * sin), -(-decay * t).exp() * square / omega * sin)
        };
        (1..=self.bodies).flat_map(|i| [a, rate].map(|value| value * (angle * i as f64).sin())).collect()
    }

    /// Two of the slowest modes and the fastest together.
    pub fn exact(&self, t: f64) -> Vec<f64> {
        let modes = [1, 3, self.bodies].map(|m| self.mode(m, t));
        (0..2 * self.bodies).map(|i| modes[0][i] + 0.5 * modes[1][i] + 0.1 * modes[2][i]).collect()
    }
}

impl System for Chain {
    type Inadmissible = Infallible;

    fn dimension(&self) -> usize {
        2 * self.bodies
    }

    fn quadratures(&self) -> usize {
        1
    }

    fn blocks(&self) -> &[Range<usize>] {
        &self.blocks
    }

    fn components(&self) -> &Components {
        &self.components
    }

    fn rates(&mut self, _: f64, y: &[f64], dy: &mut [f64], dw: &mut [f64]) -> Result<(), Infallible> {
        let n = self.bodies;
        let pull = |i: usize| self.stiffness * y[2 * i] + self.damping * y[2 * i + 1];
        for i in 0..n {
            let before = if i > 0 { pull(i - 1) } else { 0.0 };
            let after = if i + 1 < n { pull(i + 1) } else { 0.0 };
            (dy[2 * i], dy[2 * i + 1]) = (y[2 * i + 1], before - 2.0 * pull(i) + after);
        }
        dw[0] = y.iter().step_by(2).map(|x| x * x).sum();
        Ok(())
    }

    fn jacobian(&mut self, _: f64, _: &[f64], jacobian: &mut BlockMatrix) -> Result<(), Infallible> {
        jacobian.arrange(&self.pattern);
        add_velocities(jacobian, self.shown, self.bodies);
        let (k, c) = (self.stiffness, self.damping);
        // Bond by bond, the last first: blocks may be added to in any order.
        for i in (0..=self.bodies).rev() {
            for (row, column, sign) in [(i, i, -1.0), (i + 1, i + 1, -1.0), (i, i + 1, 1.0), (i + 1, i, 1.0)] {
                if row.min(column) > 0 && row.max(column) <= self.bodies {
                    add(jacobian, self.shown, (row - 1, column - 1), (sign * k, sign * c));
                }
            }
        }
        Ok(())
    }

    fn error_scales(&mut self, _: f64, _: &[f64], _: &[f64], y_scale: &mut [f64], w_scale: &mut [f64]) {
        y_scale.chunks_exact_mut(2).for_each(|body| body.copy_from_slice(&[self.atol, 1e2 * self.atol]));
        w_scale.fill(self.atol);
    }

    fn project(&mut self, _: f64, _: &mut [f64], _: &mut [f64]) -> f64 {
        0.0
    }
}

/// Balls of unit size above each other, which fall on a floor and on each other, pushed apart by o³ (k + c o') at
/// overlap o.
pub struct Balls {
    pub bodies: usize,
    damping: f64,
    shown: Shown,
    blocks: Vec<Range<usize>>,
    pattern: Pattern,
    components: Components,
    /// How often the pattern has changed.
    pub changes: usize,
}

const STIFFNESS: f64 = 1e6;
/// Pairs nearer than this are part of the pattern.
const MARGIN: f64 = 0.02;

impl Balls {
    /// With this damping c: they bounce for 3e5, and creep for 1e8.
    pub fn new(bodies: usize, damping: f64, shown: Shown) -> Self {
        let (blocks, pattern) = (blocks(bodies, shown), Pattern::uncoupled());
        let components = Components::joined(blocks.len(), (1..blocks.len()).map(|i| [i - 1, i]));
        Self { bodies, damping, shown, blocks, pattern, components, changes: 0 }
    }

    /// The start: gaps that grow upwards, at rest.
    pub fn start(&self) -> Vec<f64> {
        (0..self.bodies).flat_map(|i| [i as f64 + 0.02 * ((i + 1) * (i + 2)) as f64, 0.0]).collect()
    }

    /// Finds the pattern of the pairs that are near each other.
    fn look(&mut self, y: &[f64]) {
        let near = (1..self.bodies).filter(|i| y[2 * i] - y[2 * i - 2] < 1.0 + MARGIN);
        let pattern = Pattern::new(self.bodies, near.flat_map(|i| [(i - 1, i), (i, i - 1)]));
        if self.shown == Shown::Coupled && pattern != self.pattern {
            self.pattern = pattern;
            self.changes += 1;
        }
    }

    /// Overlap of ball i with what is below, and its rate.
    fn overlap(y: &[f64], i: usize) -> (f64, f64) {
        let below = if i > 0 { (y[2 * i - 2] + 1.0, y[2 * i - 1]) } else { (0.0, 0.0) };
        ((below.0 - y[2 * i]).max(0.0), below.1 - y[2 * i + 1])
    }
}

impl System for Balls {
    type Inadmissible = Infallible;

    fn dimension(&self) -> usize {
        2 * self.bodies
    }

    fn quadratures(&self) -> usize {
        0
    }

    fn blocks(&self) -> &[Range<usize>] {
        &self.blocks
    }

    fn components(&self) -> &Components {
        &self.components
    }

    fn rates(&mut self, _: f64, y: &[f64], dy: &mut [f64], _: &mut [f64]) -> Result<(), Infallible> {
        for i in 0..self.bodies {
            (dy[2 * i], dy[2 * i + 1]) = (y[2 * i + 1], -1.0);
        }
        for i in 0..self.bodies {
            let (o, rate) = Self::overlap(y, i);
            let push = o.powi(3) * (STIFFNESS + self.damping * rate);
            dy[2 * i + 1] += push;
            if i > 0 {
                dy[2 * i - 1] -= push;
            }
        }
        Ok(())
    }

    fn jacobian(&mut self, _: f64, y: &[f64], jacobian: &mut BlockMatrix) -> Result<(), Infallible> {
        self.look(y);
        jacobian.arrange(&self.pattern);
        add_velocities(jacobian, self.shown, self.bodies);
        for i in 0..self.bodies {
            let (o, rate) = Self::overlap(y, i);
            if o == 0.0 {
                continue;
            }
            let slopes = (3.0 * o * o * (STIFFNESS + self.damping * rate), self.damping * o.powi(3));
            let minus = (-slopes.0, -slopes.1);
            add(jacobian, self.shown, (i, i), minus);
            if i > 0 {
                add(jacobian, self.shown, (i - 1, i - 1), minus);
                add(jacobian, self.shown, (i, i - 1), slopes);
                add(jacobian, self.shown, (i - 1, i), slopes);
            }
        }
        Ok(())
    }

    fn error_scales(&mut self, _: f64, _: &[f64], _: &[f64], y_scale: &mut [f64], _: &mut [f64]) {
        y_scale.fill(1e-7);
    }

    fn project(&mut self, _: f64, _: &mut [f64], _: &mut [f64]) -> f64 {
        0.0
    }
}
