//! Coulomb's bound on the friction of a contact.
//!
//!   σ = 1/√(1 + s),   s = 2R B/(μN)²
//!
//! All frictional tractions are multiplied by σ: 2R [W] is what viscous friction alone would take, B = ∫β (d/d₀)^−ν dA
//! its resistance to a translation [N s/m], N the resultant of the repulsion, never of an attraction. Sliding at w
//! meets B w/√(1 + (B w/μN)²), which tends to μN; slow motion meets viscous friction, a creep. A spin and a slip weaken
//! one another, since the friction is −∂Ψ/∂v of the convex potential Ψ = ((μN)²/B) (√(1 + s) − 1). So it dissipates σ
//! 2R, and its derivative by the motion is of rank one beside that of viscous friction:
//!
//!   δσ = −½ σ (g δ(2R) + τ (δB/B − 2 δN/N)),   g = B/((μN)² + 2R B),   τ = s/(1 + s)
//!   δ(2R) = −2 Q·δv,   Q the viscous friction
//!
//! Source: `docs/theory-rigid.md`.

/// What a bound is made of, or the change of it: 2R, B and N.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Sliding {
    /// 2R [W].
    pub lost: f64,
    /// B [N s/m].
    pub resistance: f64,
    /// N [N].
    pub push: f64,
}

/// The bound of a contact that slides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Bound {
    at: Sliding,
    /// σ.
    factor: f64,
    /// g [1/W].
    by_loss: f64,
    /// τ.
    saturation: f64,
}

impl Bound {
    /// Of a coefficient μ. A push that vanishes leaves no friction.
    pub fn new(mu: f64, at: Sliding) -> Self {
        let most = mu * at.push;
        let resistance = at.resistance / most;
        // Of what does not slide 2R is rounding, of either sign.
        let at = Sliding { lost: at.lost.max(0.0), ..at };
        let strength = at.lost / most * resistance;
        if !strength.is_finite() {
            return Self { at, factor: 0.0, by_loss: 0.0, saturation: 0.0 };
        }
        let part = 1.0 / (1.0 + strength);
        Self { at, factor: part.sqrt(), by_loss: part * resistance / most, saturation: part * strength }
    }

    /// σ.
    pub fn factor(&self) -> f64 {
        self.factor
    }

    /// δσ with changes of 2R, B and N.
    pub fn change(&self, change: &Sliding) -> f64 {
        let mut relative = self.by_loss * change.lost;
        if self.saturation > 0.0 {
            let growth = change.resistance / self.at.resistance - 2.0 * change.push / self.at.push;
            relative += self.saturation * growth;
        }
        -0.5 * self.factor * relative
    }

    /// σ g: with the motion alone δσ = σ g Q·δv.
    pub fn by_motion(&self) -> f64 {
        self.factor * self.by_loss
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const AT: Sliding = Sliding { lost: 3.0, resistance: 2.0, push: 1.5 };

    #[test]
    fn sliding_friction_tends_to_coulombs() {
        let (mu, resistance, push) = (0.4, 2.0, 1.5);
        let friction = |speed: f64| {
            let at = Sliding { lost: resistance * speed * speed, resistance, push };
            Bound::new(mu, at).factor() * resistance * speed
        };
        assert!((friction(1e-9) / (resistance * 1e-9) - 1.0).abs() < 1e-15);
        assert!((friction(1e9) / (mu * push) - 1.0).abs() < 1e-15);
        let middle = mu * push / resistance;
        assert!((friction(middle) / (mu * push * 0.5_f64.sqrt()) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn change_agrees_with_differences() {
        let change = Sliding { lost: 0.7, resistance: -0.4, push: 0.9 };
        let moved = |by: f64| Sliding {
            lost: AT.lost + by * change.lost,
            resistance: AT.resistance + by * change.resistance,
            push: AT.push + by * change.push,
        };
        let factor = |by: f64| Bound::new(0.6, moved(by)).factor();
        let difference = (factor(1e-5) - factor(-1e-5)) / 2e-5;
        // Step² × third derivative.
        assert!((Bound::new(0.6, AT).change(&change) - difference).abs() < 1e-9);
    }

    /// Where laws fade with the distance, N goes to zero before the numbers end.
    #[test]
    fn no_push_leaves_no_friction() {
        for push in [0.0, 1e-320] {
            let bound = Bound::new(0.6, Sliding { push, ..AT });
            let change = bound.change(&Sliding { lost: 1.0, resistance: 1.0, push: 1.0 });
            assert_eq!((bound.factor(), change, bound.by_motion()), (0.0, 0.0, 0.0));
        }
        let turning = Bound::new(0.6, Sliding { lost: -1e-20, resistance: 1e-9, push: 1e-25 });
        assert_eq!((turning.factor(), turning.saturation), (1.0, 0.0));
        let still = Bound::new(0.6, Sliding { lost: 0.0, resistance: 0.0, push: 1.0 });
        assert_eq!((still.factor(), still.change(&Sliding { lost: 0.0, ..AT })), (1.0, 0.0));
    }
}
