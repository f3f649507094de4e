//! The moduli of a material from what the file gives: its own two, or Young's modulus and Poisson's ratio.
//!
//!   μ = E/(2(1 + ν)),   λ = Eν/((1 + ν)(1 − 2ν)),   K = E/(3(1 − 2ν))

use crate::check::Reporter;
use crate::key::Key;

/// Two moduli as they may be written.
pub(super) struct WrittenModuli<'a> {
    /// The table of the material.
    pub key: &'a Key,
    /// The words for its own two moduli, and their values \[Pa\].
    pub own: [(&'static str, Option<f64>); 2],
    /// Which ν the material may have.
    pub ratios: Ratios,
    /// E \[Pa\].
    pub youngs_modulus: Option<f64>,
    /// ν.
    pub poissons_ratio: Option<f64>,
}

/// Which Poisson's ratios a material may have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Ratios {
    /// −1 < ν ≤ ½: without the second of its moduli it is incompressible.
    ToIncompressible,
    /// −1 < ν < ½.
    Compressible,
    /// 0 ≤ ν < ½: λ is not negative.
    NotNegative,
}

impl Ratios {
    fn allow(self, ratio: f64) -> bool {
        match self {
            Self::ToIncompressible => ratio > -1.0 && ratio <= 0.5,
            Self::Compressible => ratio > -1.0 && ratio < 0.5,
            Self::NotNegative => (0.0..0.5).contains(&ratio),
        }
    }

    fn in_words(self) -> &'static str {
        match self {
            Self::ToIncompressible => "above -1 and at most 0.5",
            Self::Compressible => "above -1 and below 0.5",
            Self::NotNegative => "from 0 and below 0.5",
        }
    }
}

/// Two moduli of a material \[Pa\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Moduli {
    /// Its own; the second may be none.
    Own(f64, Option<f64>),
    /// E and ν.
    Engineering { youngs_modulus: f64, poissons_ratio: f64 },
}

impl Moduli {
    /// μ.
    pub fn shear(self) -> f64 {
        match self {
            Self::Own(first, _) => first,
            Self::Engineering { youngs_modulus, poissons_ratio } => youngs_modulus / (2.0 * (1.0 + poissons_ratio)),
        }
    }

    /// λ; the second of its own.
    pub fn lambda(self) -> f64 {
        match self {
            Self::Own(_, second) => second.unwrap_or(0.0),
            Self::Engineering { youngs_modulus, poissons_ratio } => {
                youngs_modulus * poissons_ratio / ((1.0 + poissons_ratio) * (1.0 - 2.0 * poissons_ratio))
            }
        }
    }

    /// K; none of an incompressible material.
    pub fn bulk(self) -> Option<f64> {
        match self {
            Self::Own(_, second) => second,
            Self::Engineering { poissons_ratio: 0.5, .. } => None,
            Self::Engineering { youngs_modulus, poissons_ratio } => {
                Some(youngs_modulus / (3.0 * (1.0 - 2.0 * poissons_ratio)))
            }
        }
    }
}

impl WrittenModuli<'_> {
    /// The moduli; notes what is missing, given twice or impossible.
    pub fn read(&self, reporter: &mut Reporter<'_>) -> Option<Moduli> {
        let [(first, one), (second, other)] = self.own;
        match (self.youngs_modulus, self.poissons_ratio) {
            (None, None) => self.own_two(reporter),
            (Some(youngs_modulus), Some(poissons_ratio)) => {
                let twice = [(first, one), (second, other)].into_iter().find(|(_, value)| value.is_some());
                if let Some((word, _)) = twice {
                    let message = format!("`{word}` is given beside `youngs_modulus` and `poissons_ratio`");
                    reporter.note(&self.key.key(word), message, "keep one of the two ways");
                    return None;
                }
                if !self.ratios.allow(poissons_ratio) {
                    let message = format!("Poisson's ratio is {poissons_ratio:?}");
                    let help = format!("write a number {}", self.ratios.in_words());
                    reporter.note(&self.key.key("poissons_ratio"), message, help);
                    return None;
                }
                Some(Moduli::Engineering { youngs_modulus, poissons_ratio })
            }
            (Some(_), None) => self.missing("poissons_ratio", "youngs_modulus", reporter),
            (None, Some(_)) => self.missing("youngs_modulus", "poissons_ratio", reporter),
        }
    }

    fn own_two(&self, reporter: &mut Reporter<'_>) -> Option<Moduli> {
        match self.own {
            [(_, Some(first)), (_, Some(second))] => Some(Moduli::Own(first, Some(second))),
            [(_, Some(first)), (_, None)] if self.ratios == Ratios::ToIncompressible => Some(Moduli::Own(first, None)),
            [(word, None), _] | [_, (word, None)] => {
                let message = format!("the key \"{word}\" is missing");
                let help = format!("add `{word}`, or give `youngs_modulus` and `poissons_ratio` instead");
                reporter.note(&self.key.key(word), message, help);
                None
            }
        }
    }

    fn missing(&self, word: &str, beside: &str, reporter: &mut Reporter<'_>) -> Option<Moduli> {
        let message = format!("`{beside}` is given without `{word}`");
        reporter.note(&self.key.key(beside), message, format!("add `{word}`"));
        None
    }
}
