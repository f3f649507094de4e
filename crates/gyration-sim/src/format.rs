//! Numbers as texts show them: significant digits, vectors, durations.

/// So many digits, without an exponent where that is short; what has none, in words.
pub fn significant(value: f64, digits: i32) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    if value.is_nan() {
        return "no number".to_owned();
    }
    if value.is_infinite() {
        return if value > 0.0 { "infinite" } else { "minus infinite" }.to_owned();
    }
    let power = libm::log10(value.abs()).floor();
    if !(-4.0..6.0).contains(&power) {
        let digits = (digits - 1) as usize;
        return format!("{value:.digits$e}");
    }
    let decimals = (f64::from(digits) - 1.0 - power).max(0.0) as usize;
    let text = format!("{value:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

/// Five digits of each component; what is rounding beside the largest reads as zero.
pub fn vector(v: &[f64; 3]) -> String {
    let largest = v.iter().filter(|c| c.is_finite()).fold(0.0, |largest: f64, c| largest.max(c.abs()));
    let [x, y, z] = v.map(|c| if c.abs() <= 1e-14 * largest { "0".to_owned() } else { significant(c, 5) });
    format!("({x}, {y}, {z})")
}

/// A duration in two units at most; a question mark where it cannot be told.
pub fn duration(seconds: f64) -> String {
    if !seconds.is_finite() {
        return "?".to_owned();
    }
    let whole = seconds.round() as u64;
    match whole {
        0..60 => format!("{whole} s"),
        60..3600 => format!("{} min {} s", whole / 60, whole % 60),
        _ => format!("{} h {} min", whole / 3600, whole / 60 % 60),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_the_digits_asked_for() {
        let words = [0.0, 1.5, -0.000123456, 123456.7, 1e-9, 4.0].map(|value| significant(value, 5));
        assert_eq!(words, ["0", "1.5", "-0.00012346", "123457", "1.0000e-9", "4"]);
        assert_eq!(significant(0.75649, 3), "0.756");
    }

    #[test]
    fn rounding_beside_large_components_reads_as_zero() {
        assert_eq!(vector(&[0.5, -2.7e-18, 0.25]), "(0.5, 0, 0.25)");
        assert_eq!(vector(&[0.0, 1e-15, 0.0]), "(0, 1.0000e-15, 0)");
    }

    #[test]
    fn what_is_no_number_is_told_and_does_not_read_as_zero() {
        assert_eq!(vector(&[f64::NAN, 1.0, 1e-20]), "(no number, 1, 0)");
        assert_eq!(vector(&[2.0, f64::INFINITY, f64::NEG_INFINITY]), "(2, infinite, minus infinite)");
    }

    #[test]
    fn durations_have_two_units() {
        assert_eq!([3.2, 75.0, 7300.0, f64::INFINITY].map(duration), ["3 s", "1 min 15 s", "2 h 1 min", "?"]);
    }
}
