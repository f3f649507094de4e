//! The arguments of `gyration orbit`.

use super::SceneArguments;
use super::number::{finite, positive};
use clap::Args;

/// `gyration orbit`
#[derive(Debug, Args)]
pub struct OrbitArguments {
    /// The scene; the search begins at its start.
    #[command(flatten)]
    pub scene: SceneArguments,
    /// The period [s]; beside --energy or --amplitude one to begin with
    #[arg(long, value_name = "T", value_parser = period, allow_negative_numbers = true)]
    pub period: Option<f64>,
    /// The energy of the orbit [J]
    #[arg(long, value_name = "E", conflicts_with = "amplitude", value_parser = finite, allow_hyphen_values = true)]
    pub energy: Option<f64>,
    /// A column of the start and its value: body.a.x=0.1
    #[arg(long, value_name = "COLUMN=VALUE", value_parser = amplitude)]
    pub amplitude: Option<(String, f64)>,
    /// Cells by which a ring has moved on after the period, N or N1,N2,N3 along its cell vectors: a wave that runs
    /// around it without a change
    #[arg(long, value_name = "N", value_parser = shift, allow_hyphen_values = true)]
    pub shift: Option<[i32; 3]>,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

fn period(text: &str) -> Result<f64, String> {
    positive(text).map_err(|_| format!("`{text}` is no time above zero in seconds"))
}

fn amplitude(text: &str) -> Result<(String, f64), String> {
    let found = text.split_once('=').and_then(|(column, value)| Some((column.trim(), finite(value.trim()).ok()?)));
    let found = found.filter(|(column, _)| !column.is_empty());
    found.map(|(column, value)| (column.to_owned(), value)).ok_or_else(|| format!("`{text}` is not as body.a.x=0.1"))
}

fn shift(text: &str) -> Result<[i32; 3], String> {
    let numbers: Result<Vec<i32>, _> = text.split(',').map(|word| word.trim().parse()).collect();
    match numbers.as_deref() {
        Ok([first]) => Ok([*first, 0, 0]),
        Ok([first, second, third]) => Ok([*first, *second, *third]),
        _ => Err(format!("`{text}` is neither a number of cells nor three as 1,0,0")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn amplitudes_are_a_column_and_a_number() {
        assert_eq!(amplitude("body.a.x = -0.1"), Ok(("body.a.x".to_owned(), -0.1)));
        for wrong in ["", "body.a.x", "=1", "body.a.x=much", "body.a.x=inf"] {
            assert!(amplitude(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn shifts_are_one_number_of_cells_or_three() {
        assert_eq!([shift("1"), shift("-2"), shift("0, 1,-3")], [Ok([1, 0, 0]), Ok([-2, 0, 0]), Ok([0, 1, -3])]);
        for wrong in ["", "1,2", "0.5", "x", "1,2,3,4"] {
            assert!(shift(wrong).is_err(), "{wrong}");
        }
    }
}
