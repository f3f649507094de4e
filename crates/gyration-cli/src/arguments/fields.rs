//! The arguments of `gyration fields`.

use super::number::finite;
use clap::{Args, ValueHint};
use gyration::tensor::Vec3;
use std::num::NonZeroUsize;
use std::path::PathBuf;

/// `gyration fields`
#[derive(Debug, Args)]
pub struct FieldArguments {
    /// Directory of the recording
    #[arg(value_name = "DIR", value_hint = ValueHint::DirPath)]
    pub recording: PathBuf,
    /// Standard deviation of the Gaussian with which bodies are seen from a point [m]
    #[arg(long, value_name = "W", value_parser = finite, allow_negative_numbers = true)]
    pub width: f64,
    /// Points [m], x,y,z, with spaces between them
    #[arg(long, value_name = "POINTS", value_parser = points, allow_hyphen_values = true, conflicts_with = "grid")]
    pub at: Option<Points>,
    /// Points along x, y and z of a grid over all centres and two widths beyond [default: 16 along the longest side]
    #[arg(long, value_name = "NX,NY,NZ", value_parser = counts)]
    pub grid: Option<[usize; 3]>,
    /// Each N-th sample and the last
    #[arg(long, value_name = "N", default_value = "1")]
    pub every: NonZeroUsize,
    /// Print JSON
    #[arg(long, conflicts_with = "output")]
    pub json: bool,
    /// Write the grid for ParaView, FILE.vti; of several samples FILE.pvd lists all
    #[arg(short, long, value_name = "FILE.vti", value_hint = ValueHint::FilePath, conflicts_with = "at")]
    pub output: Option<PathBuf>,
    /// Draw the last sample on the grid: density, speed, pressure, shear stress, power of pairs (.svg, .png, .pdf)
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath, conflicts_with = "at")]
    pub plot: Option<PathBuf>,
}

/// Points [m].
#[derive(Debug, Clone, PartialEq)]
pub struct Points(pub Vec<Vec3>);

fn points(text: &str) -> Result<Points, String> {
    let point = |word: &str| {
        let numbers: Result<Vec<f64>, _> = word.split(',').map(finite).collect();
        let numbers = numbers.ok().and_then(|numbers| <[f64; 3]>::try_from(numbers).ok());
        numbers.map(Vec3::from).ok_or_else(|| format!("`{word}` is no point x,y,z in metres"))
    };
    let points: Vec<Vec3> = text.split_whitespace().map(point).collect::<Result<_, _>>()?;
    if points.is_empty() { Err("there is no point x,y,z".to_owned()) } else { Ok(Points(points)) }
}

fn counts(text: &str) -> Result<[usize; 3], String> {
    let counts: Result<Vec<usize>, _> = text.split(',').map(|word| word.trim().parse()).collect();
    let counts = counts.ok().and_then(|counts| <[usize; 3]>::try_from(counts).ok());
    counts.filter(|counts| !counts.contains(&0)).ok_or_else(|| format!("`{text}` is not three counts as 64,64,1"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_read_with_their_signs() {
        let found = points("0,1,-2.5  1e-3,0,0").unwrap();
        assert_eq!(found.0, [Vec3::new(0.0, 1.0, -2.5), Vec3::new(1e-3, 0.0, 0.0)]);
        for wrong in ["", "1,2", "1,2,3,4", "a,b,c", "0,0,inf"] {
            assert!(points(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn a_grid_has_points_along_each_axis() {
        assert_eq!(counts("64, 64,1"), Ok([64, 64, 1]));
        for wrong in ["64", "64,64,0", "64,-1,1", "x,y,z"] {
            assert!(counts(wrong).is_err(), "{wrong}");
        }
    }
}
