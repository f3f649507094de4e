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
    /// Whether the second may be left out.
    pub may_be_incompressible: bool,
    /// Whether λ may be negative.
    pub may_be_auxetic: bool,
    /// E \[Pa\].
    pub youngs_modulus: Option<f64>,
    /// ν.
    pub poissons_ratio: Option<f64>,
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
                let is_above = if self.may_be_auxetic { poissons_ratio > -1.0 } else { poissons_ratio >= 0.0 };
                let is_incompressible = poissons_ratio == 0.5 && self.may_be_incompressible;
                if !(is_above && (poissons_ratio < 0.5 || is_incompressible)) {
                    let least = if self.may_be_auxetic { "above -1" } else { "from 0" };
                    let most = if self.may_be_incompressible { "at most" } else { "below" };
                    let help = format!("write a number {least} and {most} 0.5");
                    let message = format!("Poisson's ratio is {poissons_ratio:?}");
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
            [(_, Some(first)), (_, None)] if self.may_be_incompressible => Some(Moduli::Own(first, None)),
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
