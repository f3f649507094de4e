//! Coefficients of the resistance of two spheres in powers of the inverse distance.
//!
//!   Σ_k Σ_q P_{1(k−q)q} t_α^{k−q} t_β^q y^k,    y = (R_α + R_β)/r,   t = R/(R_α + R_β)
//!
//! Each power is one more reflection of the flow between the spheres. The P, V, Q of harmonics n follow from those of
//! fewer reflections; they are the same for all radii, and sums of few digits are lost: against fractions they are
//! right to 1e-15. Source: Jeffrey and Onishi, *J. Fluid Mech.* 139 (1984) 261, eqs. (3.6)–(3.9), (4.6)–(4.11), (6.7),
//! (7.7).

use std::sync::LazyLock;

/// The highest power of y.
pub(super) const POWERS: usize = 140;

/// For each power k the coefficients P_{1(k−q)q}, or Q, of q = 0, …, k.
pub(super) type Rows = Vec<Vec<f64>>;

/// The coefficients of all functions.
pub(super) struct Coefficients {
    /// Force of a motion along the line of centres.
    pub xa: Rows,
    /// Force and torque of a motion across it.
    pub ya: Rows,
    pub yb: Rows,
    /// Torque of a spin about the line.
    pub xc: Rows,
    /// Torque of a spin across it.
    pub yc: Rows,
}

/// They are found when first needed, in a tenth of a second.
pub(super) static COEFFICIENTS: LazyLock<Coefficients> = LazyLock::new(|| {
    let along = Reflections::of(Motion::Along);
    let across = Reflections::of(Motion::Across);
    let spin = Reflections::of(Motion::SpinAlong);
    let turn = Reflections::of(Motion::SpinAcross);
    Coefficients { xa: along.p.rows(), ya: across.p.rows(), yb: across.q.rows(), xc: spin.q.rows(), yc: turn.q.rows() }
});

/// How the first sphere moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Motion {
    Along,
    Across,
    SpinAlong,
    SpinAcross,
}

/// T_npq of n ≤ p + 1: what is summed over n at one p + n stands together.
struct Table(Vec<f64>);

/// Values of p + n, and of n, that are kept.
const SUMS: usize = POWERS + 2;
const HARMONICS: usize = SUMS / 2 + 2;

impl Table {
    fn zeros() -> Self {
        Self(vec![0.0; (POWERS + 1) * SUMS * HARMONICS])
    }

    fn start(q: usize, sum: usize) -> usize {
        (q * SUMS + sum) * HARMONICS
    }

    fn set(&mut self, (n, p, q): (usize, usize, usize), value: f64) {
        if p + n < SUMS {
            self.0[Self::start(q, p + n) + n] = value;
        }
    }

    /// T_s(sum−s)q of all s; none where an index is negative.
    fn along(&self, sum: Option<usize>, q: Option<usize>) -> Option<&[f64]> {
        let start = Self::start(q?, sum?);
        Some(&self.0[start..start + HARMONICS])
    }

    /// T_1(k−q)q.
    fn rows(&self) -> Rows {
        let row = |k: usize| (0..=k).map(|q| self.0[Self::start(q, k - q + 1) + 1]).collect();
        (0..=POWERS).map(row).collect()
    }
}

/// The harmonics of the flow by how often it has been reflected.
struct Reflections {
    p: Table,
    v: Table,
    q: Table,
}

/// The entry of a harmonic in a row; zero in none.
fn entry(row: Option<&[f64]>, s: usize) -> f64 {
    row.map_or(0.0, |row| row[s])
}

impl Reflections {
    fn of(motion: Motion) -> Self {
        let mut found = Self { p: Table::zeros(), v: Table::zeros(), q: Table::zeros() };
        match motion {
            Motion::Along | Motion::Across => {
                found.p.set((1, 0, 0), 1.0);
                found.v.set((1, 0, 0), 1.0);
            }
            Motion::SpinAlong | Motion::SpinAcross => found.q.set((1, 0, 0), 1.0),
        }
        for reflections in 1..=POWERS {
            for q in 1..=reflections {
                let p = reflections - q;
                let needed = |n: &usize| *n == 1 || p + n <= POWERS;
                for n in (1..=p + 1).filter(needed) {
                    let place = (n, p, q);
                    match motion {
                        Motion::Along => found.along(place),
                        Motion::SpinAlong => found.spinning(place),
                        Motion::Across | Motion::SpinAcross => found.across(place),
                    }
                }
            }
        }
        found
    }

    /// Eqs. (3.8), (3.9).
    fn along(&mut self, (n, p, q): (usize, usize, usize)) {
        let (up, down) = ((p + 1).checked_sub(n), p.checked_sub(n + 1));
        let ahead = self.p.along(Some(q), up);
        let behind = self.p.along(Some(q), down);
        let other = self.v.along(q.checked_sub(2), up);
        let (m, mut binomial) = (n as f64, 1.0);
        let (mut sum, mut of_v) = (0.0, 0.0);
        for s in 1..=q.div_ceil(2) {
            let k = s as f64;
            binomial *= (m + k) / k;
            let first = m * (2.0 * m + 1.0) * (2.0 * m * k - m - k + 2.0)
                / (2.0 * (m + 1.0) * (2.0 * k - 1.0) * (m + k))
                * entry(ahead, s);
            let second = m * (2.0 * m - 1.0) / (2.0 * (m + 1.0)) * entry(behind, s);
            let third = m * (4.0 * m * m - 1.0) / (2.0 * (m + 1.0) * (2.0 * k + 1.0)) * entry(other, s);
            sum += binomial * (first - second - third);
            of_v += binomial * entry(behind, s);
        }
        self.p.set((n, p, q), sum);
        self.v.set((n, p, q), sum - 2.0 * m / ((m + 1.0) * (2.0 * m + 3.0)) * of_v);
    }

    /// Eqs. (4.8)–(4.11), with which those of a spin across the line agree.
    fn across(&mut self, (n, p, q): (usize, usize, usize)) {
        let (up, down) = ((p + 1).checked_sub(n), p.checked_sub(n + 1));
        let (ahead, behind) = (self.p.along(Some(q), up), self.p.along(Some(q), down));
        let level = self.p.along(Some(q), p.checked_sub(n));
        let other = self.v.along(q.checked_sub(2), up);
        let (turned, turned_level) = (self.q.along(Some(q - 1), up), self.q.along(Some(q - 1), p.checked_sub(n)));
        let (m, mut binomial) = (n as f64, 1.0);
        let (mut sum, mut of_v, mut of_q) = (0.0, 0.0, 0.0);
        for s in 1..=q.div_ceil(2) {
            let k = s as f64;
            binomial *= (m + k) / k;
            let weight = binomial * k / (m + 1.0);
            let first = (2.0 * m + 1.0) * (3.0 * (m + k) - (m * k + 1.0) * (2.0 * m * k - k - m + 2.0))
                / (2.0 * (m + 1.0) * k * (m + k) * (2.0 * k - 1.0))
                * entry(ahead, s);
            let second = m * (2.0 * m - 1.0) / (2.0 * (m + 1.0)) * entry(behind, s);
            let third = m * (4.0 * m * m - 1.0) / (2.0 * (m + 1.0) * (2.0 * k + 1.0)) * entry(other, s);
            let fourth = 2.0 * (4.0 * m * m - 1.0) / (3.0 * (m + 1.0)) * entry(turned, s);
            sum += weight * (first + second + third - fourth);
            of_v += weight * entry(behind, s);
            of_q += weight * (k / (m + 1.0) * entry(turned_level, s) - 1.5 / (m * k * (m + 1.0)) * entry(level, s));
        }
        self.p.set((n, p, q), sum);
        self.v.set((n, p, q), sum + 2.0 * m / ((m + 1.0) * (2.0 * m + 3.0)) * of_v);
        self.q.set((n, p, q), of_q);
    }

    /// Eq. (6.7).
    fn spinning(&mut self, (n, p, q): (usize, usize, usize)) {
        let level = self.q.along(Some(q - 1), p.checked_sub(n));
        let (m, mut binomial, mut sum) = (n as f64, 1.0, 0.0);
        for s in 1..=q.div_ceil(2) {
            let k = s as f64;
            binomial *= (m + k) / k;
            sum += binomial * k / (m + 1.0) * entry(level, s);
        }
        self.q.set((n, p, q), sum);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The coefficients f_k = 2^k Σ P λ^q as printed, eqs. (3.15), (4.14), (5.7), (6.11), (7.10).
    #[test]
    fn coefficients_are_those_in_print() {
        let scaled = |row: &[f64], k: i32| row.iter().map(|p| p * 2.0_f64.powi(k)).collect::<Vec<_>>();
        let all = &*COEFFICIENTS;
        let printed = [
            (scaled(&all.xa[3], 3), vec![0.0, -4.0, 27.0, -4.0]),
            (scaled(&all.xa[6], 6), vec![0.0, 16.0, 108.0, 281.0, 648.0, 144.0, 0.0]),
            (scaled(&all.ya[3], 3), vec![0.0, 2.0, 3.375, 2.0]),
            (scaled(&all.ya[7], 7), vec![0.0, 0.0, 144.0, 131.625, 19083.0 / 128.0, 131.625, 144.0, 0.0]),
            (scaled(&all.yb[5], 6), vec![0.0, -12.0, -20.25, -36.0, 0.0, 0.0]),
            (scaled(&all.xc[3], 3), vec![0.0, 0.0, 8.0, 0.0]),
            (scaled(&all.yc[4], 4), vec![0.0, 12.0, 0.0, 0.0, 0.0]),
            (scaled(&all.yc[6], 6), vec![0.0, 0.0, 27.0, 256.0, 0.0, 0.0, 0.0]),
        ];
        for (found, known) in printed {
            let worst = found.iter().zip(&known).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(found.len() == known.len() && worst < 1e-11, "{found:?} {known:?}");
        }
    }

    /// The force of a spin is the torque of a velocity: the coefficients of both, found apart, agree.
    #[test]
    fn coefficients_are_reciprocal() {
        let turn = Reflections::of(Motion::SpinAcross).p.rows();
        for (k, row) in COEFFICIENTS.yb.iter().enumerate() {
            let size = row.iter().fold(0.0_f64, |largest, q| largest.max(q.abs()));
            for (q, found) in row.iter().enumerate() {
                // Of the sphere itself, or of the other one, where the shares change places.
                let known = if k % 2 == 1 { turn[k][q] } else { turn[k].get(k + 1 - q).copied().unwrap_or(0.0) };
                assert!((2.0 * found - 1.5 * known).abs() <= 1e-13 * size, "{k} {q}: {found} {known}");
            }
        }
    }
}
