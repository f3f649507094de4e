//! The gap at which two faces that adhere hold each other.

use super::laws::PairLaws;

/// The gaps, from d₀ on, between which faces that pull are looked for: a factor from one to the next, and how many.
const LOOKED_AT: (f64, usize) = (1.25, 60);
/// Halvings of the last of them: to the last digit.
const HALVINGS: usize = 60;

impl PairLaws {
    /// The gap at which two faces hold each other, neither pushing nor pulling [m]; none where they push at any gap.
    ///
    ///   α (g/d₀)^−ν = β ((g/d₀)^−ν_a − (g/d₀)^−ν_r)
    pub fn held_gap(&self) -> Option<f64> {
        let term = self.pull.as_ref()?.terms[0]?;
        let central = |gap: f64| -> f64 {
            self.laws().iter().filter(|law| law.kind().is_central()).map(|law| law.factor(gap)).sum()
        };
        let (step, most) = LOOKED_AT;
        let mut pushes = term.reference_gap;
        if central(pushes) <= 0.0 {
            return Some(pushes);
        }
        let mut pulls = (1..=most).map(|k| term.reference_gap * step.powi(k as i32)).find(|gap| {
            let found = central(*gap) <= 0.0;
            if !found {
                pushes = *gap;
            }
            found
        })?;
        for _ in 0..HALVINGS {
            let middle = 0.5 * (pushes + pulls);
            if central(middle) > 0.0 { pushes = middle } else { pulls = middle }
        }
        Some(pulls)
    }
}
