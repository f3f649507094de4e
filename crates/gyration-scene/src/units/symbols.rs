//! The table of unit symbols and SI prefixes.
//!
//! An exact symbol wins over a prefixed one, so that `min` is the minute and `cd` nothing at all. Only units that take
//! prefixes in practice do (`mbar`, `kN`, but no `kmin`).

use super::{Unit, UnitDimension};
use std::f64::consts::PI;

/// A symbol, its size in SI units, its dimension (m, kg, s, rad), whether prefixes apply.
type Row = (&'static str, f64, [i32; 4], bool);

const SYMBOLS: &[Row] = &[
    ("m", 1.0, [1, 0, 0, 0], true),
    ("g", 1e-3, [0, 1, 0, 0], true),
    ("t", 1e3, [0, 1, 0, 0], false),
    ("s", 1.0, [0, 0, 1, 0], true),
    ("min", 60.0, [0, 0, 1, 0], false),
    ("h", 3600.0, [0, 0, 1, 0], false),
    ("rad", 1.0, [0, 0, 0, 1], true),
    ("deg", PI / 180.0, [0, 0, 0, 1], false),
    ("°", PI / 180.0, [0, 0, 0, 1], false),
    ("rev", 2.0 * PI, [0, 0, 0, 1], false),
    ("rpm", 2.0 * PI / 60.0, [0, 0, -1, 1], false),
    ("Hz", 1.0, [0, 0, -1, 0], true),
    ("N", 1.0, [1, 1, -2, 0], true),
    ("Pa", 1.0, [-1, 1, -2, 0], true),
    ("bar", 1e5, [-1, 1, -2, 0], true),
    ("J", 1.0, [2, 1, -2, 0], true),
    ("W", 1.0, [2, 1, -3, 0], true),
    ("L", 1e-3, [3, 0, 0, 0], true),
    ("l", 1e-3, [3, 0, 0, 0], true),
];

const PREFIXES: &[(&str, f64)] = &[
    ("p", 1e-12),
    ("n", 1e-9),
    ("u", 1e-6),
    ("µ", 1e-6),
    ("μ", 1e-6),
    ("m", 1e-3),
    ("c", 1e-2),
    ("d", 1e-1),
    ("h", 1e2),
    ("k", 1e3),
    ("M", 1e6),
    ("G", 1e9),
    ("T", 1e12),
];

/// The unit of a symbol, with or without a prefix.
pub(super) fn lookup(symbol: &str) -> Option<Unit> {
    if let Some(row) = SYMBOLS.iter().find(|row| row.0 == symbol) {
        return Some(unit(row, 1.0));
    }
    PREFIXES.iter().find_map(|(prefix, factor)| {
        let rest = symbol.strip_prefix(prefix)?;
        SYMBOLS.iter().find(|row| row.3 && row.0 == rest).map(|row| unit(row, *factor))
    })
}

/// The symbol that a misspelt one was most likely meant to be: letters in another case first.
pub(super) fn nearest(symbol: &str) -> Option<String> {
    let common = ["mm", "cm", "km", "kg", "mg", "ms", "kPa", "MPa", "kN", "mN", "kJ", "kHz", "mL", "mbar", "mrad"];
    let known = || SYMBOLS.iter().map(|row| row.0).chain(common);
    if let Some(same) = known().find(|known| known.eq_ignore_ascii_case(symbol)) {
        return Some(same.to_owned());
    }
    let long_names = [("meter", "m"), ("metre", "m"), ("gram", "g"), ("second", "s"), ("sec", "s"), ("minute", "min")];
    let more_names = [("hour", "h"), ("degree", "deg"), ("radian", "rad"), ("newton", "N"), ("pascal", "Pa")];
    let lower = symbol.to_ascii_lowercase();
    let singular = lower.strip_suffix('s').unwrap_or(&lower);
    let spelled = long_names.iter().chain(&more_names).find(|(name, _)| *name == singular || *name == lower);
    if let Some((_, short)) = spelled {
        return Some((*short).to_owned());
    }
    crate::suggest::nearest(symbol, known()).map(str::to_owned)
}

fn unit(row: &Row, factor: f64) -> Unit {
    let [length, mass, time, angle] = row.2;
    Unit { size: row.1 * factor, dimension: UnitDimension::new(length, mass, time, angle) }
}
