//! Numbers of the command line. `nan` and `inf`, which Rust reads as numbers, are none here: they would compare with no
//! time, and select all or nothing without a word.

/// Reads a finite number.
pub fn finite(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|number: &f64| number.is_finite());
    number.ok_or_else(|| format!("`{text}` is no finite number"))
}

/// Reads a finite number above zero.
pub fn positive(text: &str) -> Result<f64, String> {
    finite(text).ok().filter(|number| *number > 0.0).ok_or_else(|| format!("`{text}` is no finite number above zero"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_finite() {
        assert_eq!([finite("2.5"), finite("-1e-3"), finite("0")], [Ok(2.5), Ok(-1e-3), Ok(0.0)]);
        for wrong in ["", "x", "nan", "-NaN", "inf", "-inf", "infinity", "1e400"] {
            assert!(finite(wrong).is_err() && positive(wrong).is_err(), "{wrong}");
        }
        assert_eq!(positive("2.5"), Ok(2.5));
        assert!(positive("0").is_err() && positive("-1").is_err());
    }
}
