//! Ticks at round numbers, and the words beside them.
//!
//! A linear axis has steps of 1, 2 or 5 times a power of ten; a logarithmic one has decades, and its words are powers
//! of ten.

/// A tick of an axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Tick {
    /// Where it stands.
    pub value: f64,
    /// The words beside it (as `Label::new` reads them); none for a minor tick.
    pub label: Option<String>,
}

/// The step of 1, 2 or 5 times a power of ten by which `span` is divided into at most `count` parts.
pub fn round_step(span: f64, count: usize) -> f64 {
    let least = span / count.max(1) as f64;
    let power = libm::pow(10f64, libm::log10(least).floor());
    // A step that is round but for rounding is taken.
    let fits = |factor: &f64| factor * power >= least * (1.0 - 1e-9);
    [1.0, 2.0, 5.0].into_iter().find(fits).unwrap_or(10.0) * power
}

/// Ticks of a linear axis from `low` to `high`, at most about `count`.
pub fn linear(low: f64, high: f64, count: usize) -> Vec<Tick> {
    let step = round_step(high - low, count);
    let decimals = decimals(step);
    // A dozen zeros are no words; what has a unit was given a prefix before.
    let many = !(1e-4..1e7).contains(&low.abs().max(high.abs()));
    let tolerance = 1e-9 * (high - low);
    let (first, last) = (((low - tolerance) / step).ceil(), ((high + tolerance) / step).floor());
    (0..=(last - first).max(0.0) as usize)
        .map(|k| {
            // Multiplied, not accumulated; adding zero turns −0 into 0.
            let value = (first + k as f64) * step + 0.0;
            let label = if many { short(value) } else { format!("{value:.decimals$}") };
            Tick { value, label: Some(label) }
        })
        .collect()
}

/// Decimals that tell multiples of a step apart.
pub fn decimals(step: f64) -> usize {
    (-libm::log10(step * (1.0 + 1e-9)).floor()).clamp(0.0, 12.0) as usize
}

/// Ticks of a logarithmic axis from `low` > 0 to `high`: at most about `count` with words, minor ones between.
pub fn logarithmic(low: f64, high: f64, count: usize) -> Vec<Tick> {
    let tolerance = 1e-9;
    let (first, last) = ((libm::log10(low) - tolerance).ceil(), (libm::log10(high) + tolerance).floor());
    let decades = (last - first).max(0.0) as usize + 1;
    if decades < 2 {
        return within_a_decade(low, high);
    }
    let every = decades.div_ceil(count.max(1));
    let mut ticks = Vec::new();
    for k in -1..=(decades as i64) {
        let power = first as i64 + k;
        let value = 10f64.powi(power as i32);
        let wanted = power.rem_euclid(every as i64) == 0;
        ticks.push(Tick { value, label: wanted.then(|| format!("10^{{{power}}}")) });
        if decades <= 8 {
            ticks.extend((2..10).map(|digit| Tick { value: f64::from(digit) * value, label: None }));
        }
    }
    let inside = |value: f64| value >= low * (1.0 - tolerance) && value <= high * (1.0 + tolerance);
    ticks.retain(|tick| inside(tick.value));
    ticks
}

/// Words at 1, 2 and 5, for an axis on which at most one power of ten stands.
fn within_a_decade(low: f64, high: f64) -> Vec<Tick> {
    let power = libm::log10(low).floor() as i32;
    let mut ticks = Vec::new();
    for power in power..=power + 1 {
        for digit in 1..10 {
            let value = f64::from(digit) * 10f64.powi(power);
            let label = [1, 2, 5].contains(&digit).then(|| short(value));
            ticks.push(Tick { value, label });
        }
    }
    ticks.retain(|tick| tick.value >= low * (1.0 - 1e-9) && tick.value <= high * (1.0 + 1e-9));
    ticks
}

/// A number of few digits in words: plain where that is short, else with a power of ten.
pub fn short(value: f64) -> String {
    let magnitude = value.abs();
    if value == 0.0 || (1e-3..1e5).contains(&magnitude) {
        return trimmed(value, 6);
    }
    let power = libm::log10(magnitude).floor() as i32;
    let digits = trimmed(value / 10f64.powi(power), 4);
    match digits.as_str() {
        "1" => format!("10^{{{power}}}"),
        "-1" => format!("-10^{{{power}}}"),
        _ => format!("{digits}×10^{{{power}}}"),
    }
}

fn trimmed(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// A length in the unit in which it reads best.
pub fn length_in_words(length: f64) -> String {
    let (factor, unit) = match length {
        // Just below a unit is as good as the unit: 0.9999 m are 1 m.
        l if l >= 0.9995 => (1.0, "m"),
        l if l >= 0.9995e-2 => (1e2, "cm"),
        l if l >= 0.9995e-3 => (1e3, "mm"),
        l if l >= 0.9995e-6 => (1e6, "µm"),
        _ => (1e9, "nm"),
    };
    let value = factor * length;
    let decimals = (2.0 - libm::log10(value).floor()).clamp(0.0, 3.0) as i32;
    let rounded = (value * 10f64.powi(decimals)).round() / 10f64.powi(decimals);
    format!("{} {unit}", short(rounded))
}

/// A prefix of a unit: the factor by which values are multiplied, and the prefix.
///
/// The largest magnitude then reads between 1 and 1000; without unit-breaking prefixes beyond peta and femto.
pub fn prefix(largest: f64) -> (f64, &'static str) {
    const PREFIXES: [&str; 11] = ["f", "p", "n", "µ", "m", "", "k", "M", "G", "T", "P"];
    if !(largest > 0.0 && largest.is_finite()) {
        return (1.0, "");
    }
    let thousands = (libm::log10(largest) / 3.0 + 1e-9).floor().clamp(-5.0, 5.0) as i32;
    (10f64.powi(-3 * thousands), PREFIXES[(thousands + 5) as usize])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(ticks: &[Tick]) -> Vec<&str> {
        ticks.iter().filter_map(|tick| tick.label.as_deref()).collect()
    }

    #[test]
    fn linear_ticks_are_round_and_stay_inside() {
        assert_eq!(labels(&linear(0.0, 1.0, 5)), ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
        assert_eq!(labels(&linear(-0.13, 0.27, 4)), ["-0.1", "0.0", "0.1", "0.2"]);
        assert_eq!(labels(&linear(3.0, 47.0, 6)), ["10", "20", "30", "40"]);
        assert_eq!(labels(&linear(0.0, 0.3, 3)), ["0.0", "0.1", "0.2", "0.3"]);
        assert_eq!(labels(&linear(-1e-17, 1.1e-17, 3)), ["-10^{-17}", "0", "10^{-17}"]);
        assert_eq!(labels(&linear(0.0, 1.3e13, 3)), ["0", "5×10^{12}", "10^{13}"]);
    }

    #[test]
    fn logarithmic_ticks_are_decades() {
        assert_eq!(labels(&logarithmic(1e-3, 10.0, 6)), ["10^{-3}", "10^{-2}", "10^{-1}", "10^{0}", "10^{1}"]);
        assert_eq!(labels(&logarithmic(1e-12, 1e12, 5)).len(), 5);
        assert_eq!(labels(&logarithmic(0.11, 0.6, 5)), ["0.2", "0.5"]);
    }

    #[test]
    fn prefixes_leave_one_to_three_digits() {
        assert_eq!(prefix(0.012), (1e3, "m"));
        assert_eq!(prefix(1.0), (1.0, ""));
        assert_eq!(prefix(999.0).1, "");
        assert_eq!(prefix(1000.0).1, "k");
        assert_eq!(prefix(0.0), (1.0, ""));
        assert_eq!(prefix(f64::NAN), (1.0, ""));
    }

    #[test]
    fn short_numbers_have_no_idle_digits() {
        assert_eq!([0.0, 0.5, 20.0, 1e-6, 2.5e-7].map(short), ["0", "0.5", "20", "10^{-6}", "2.5×10^{-7}"]);
    }
}
