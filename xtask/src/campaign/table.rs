//! The rows of a recording, as `gyration export --format csv` writes them, and what must hold in each.

use super::toml::{Matrix, determinant};
use std::cmp::Ordering;

/// det P of a body that keeps its volume may be off by this, times the size of what is summed.
const VOLUME: f64 = 1e-9;
/// The ledger is summed in another order here: this part of the largest term is rounding.
const ROUNDING: f64 = 1e-12;

/// Columns by name, and rows.
#[derive(Debug)]
pub struct Table {
    names: Vec<String>,
    rows: Vec<Vec<f64>>,
}

impl Table {
    /// Reads the text; what is wrong with it otherwise.
    pub fn parse(text: &str) -> Result<Self, String> {
        let mut lines = text.lines();
        let names: Vec<String> = lines.next().unwrap_or_default().split(',').map(str::to_owned).collect();
        let row = |line: &str| line.split(',').map(|cell| cell.parse().ok()).collect::<Option<Vec<f64>>>();
        let rows: Option<Vec<_>> = lines.map(row).collect();
        let rows = rows.ok_or("the export has a cell that is no number")?;
        if rows.is_empty() || rows.iter().any(|row| row.len() != names.len()) {
            return Err("the export has no rows, or rows of another width".into());
        }
        Ok(Self { names, rows })
    }

    /// What does not hold in these rows.
    pub fn audit(&self) -> Result<(), String> {
        self.times()?;
        self.numbers()?;
        self.volumes()?;
        self.ledger()
    }

    /// The last time [s].
    pub fn end(&self) -> f64 {
        self.rows.last().map_or(f64::NAN, |row| row[0])
    }

    /// The largest |energy.residual| [J].
    pub fn largest_residual(&self) -> f64 {
        let Some(column) = self.column("energy.residual") else { return f64::NAN };
        self.rows.iter().map(|row| row[column].abs()).fold(0.0, f64::max)
    }

    /// The largest kinetic energy, or sum of |works| [J]: the least that is in play.
    pub fn in_play(&self) -> f64 {
        let kinetic = self.column("energy.kinetic");
        let works = self.columns("work.");
        let in_row = |row: &Vec<f64>| {
            let exchanged: f64 = works.iter().map(|work| row[*work].abs()).sum();
            kinetic.map_or(0.0, |column| row[column]).max(exchanged)
        };
        self.rows.iter().map(in_row).fold(0.0, f64::max)
    }

    /// How far bodies are at most from where another table has them at the same time, in which their names have a word
    /// before them [m].
    pub fn farthest(&self, other: &Self, before: &str) -> Result<f64, String> {
        if self.rows.len() != other.rows.len() {
            return Err(format!("{} rows as written, {} with bodies exchanged", self.rows.len(), other.rows.len()));
        }
        let mut farthest = 0.0_f64;
        for body in self.names.iter().filter_map(|name| name.strip_suffix(".x")) {
            for axis in ["x", "y", "z"] {
                let one = self.column(&format!("{body}.{axis}"));
                let (Some(one), Some(another)) = (one, other.column(&format!("{before}{body}.{axis}"))) else {
                    return Err(format!("{body} has no place"));
                };
                let off = self.rows.iter().zip(&other.rows).map(|(a, b)| (a[one] - b[another]).abs());
                farthest = off.fold(farthest, f64::max);
            }
        }
        Ok(farthest)
    }

    fn column(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|column| column == name)
    }

    fn columns(&self, prefix: &str) -> Vec<usize> {
        (0..self.names.len()).filter(|index| self.names[*index].starts_with(prefix)).collect()
    }

    fn times(&self) -> Result<(), String> {
        let first = self.rows[0][0];
        let step = self.rows.windows(2).find(|pair| pair[0][0].partial_cmp(&pair[1][0]) != Some(Ordering::Less));
        match step {
            Some(pair) => Err(format!("time {:?} comes behind {:?}", pair[1][0], pair[0][0])),
            None if first != 0.0 => Err(format!("the first time is {first:?}")),
            None => Ok(()),
        }
    }

    /// Numbers are finite, but for the gap of what can touch nothing; gaps are positive.
    fn numbers(&self) -> Result<(), String> {
        for row in &self.rows {
            for (name, number) in self.names.iter().zip(row) {
                let is_gap = name.ends_with(".gap");
                if !(number.is_finite() || is_gap && *number == f64::INFINITY) {
                    return Err(format!("{name} is {number} at t = {:?}", row[0]));
                }
                if is_gap && *number <= 0.0 {
                    return Err(format!("{name} is {number:e} m at t = {:?}", row[0]));
                }
            }
        }
        Ok(())
    }

    /// det P = 1, or det P = det G, of bodies that have a pressure.
    fn volumes(&self) -> Result<(), String> {
        for body in self.names.iter().filter_map(|name| name.strip_suffix(".pressure")) {
            let placement = self.matrix(body, "P").ok_or("a body without P")?;
            let contraction = self.matrix(body, "G");
            for row in &self.rows {
                let at = |places: Matrix<usize>| places.map(|row_of| row_of.map(|column| row[column]));
                let gradient = at(placement);
                let volume = contraction.map_or(1.0, |columns| determinant(&at(columns)));
                let largest = gradient.iter().flatten().fold(1.0_f64, |most, entry| most.max(entry.abs()));
                let off = determinant(&gradient) / volume - 1.0;
                if off.is_nan() || off.abs() > VOLUME * largest.powi(3) {
                    return Err(format!("the volume of {body} is off by {off:e} at t = {:?}", row[0]));
                }
            }
        }
        Ok(())
    }

    /// The columns of a matrix of a body.
    fn matrix(&self, body: &str, symbol: &str) -> Option<Matrix<usize>> {
        let mut columns = [[0; 3]; 3];
        for (i, row) in ["x", "y", "z"].iter().enumerate() {
            for (j, col) in ["x", "y", "z"].iter().enumerate() {
                columns[i][j] = self.column(&format!("{body}.{symbol}_{row}{col}"))?;
            }
        }
        Some(columns)
    }

    /// The residual is Σ energies − Σ energies at 0 − Σ works.
    fn ledger(&self) -> Result<(), String> {
        let residual = self.column("energy.residual").ok_or("no energy.residual")?;
        let energies: Vec<usize> = self.columns("energy.").into_iter().filter(|column| *column != residual).collect();
        let works = self.columns("work.");
        let sum = |row: &[f64], columns: &[usize]| columns.iter().map(|column| row[*column]).sum::<f64>();
        let start = sum(&self.rows[0], &energies);
        for row in &self.rows {
            let found = sum(row, &energies) - start - sum(row, &works);
            let both = [&self.rows[0], row];
            let terms = both.iter().flat_map(|row| energies.iter().chain(&works).map(|column| row[*column].abs()));
            let off = (found - row[residual]).abs();
            if off > ROUNDING * terms.fold(0.0, f64::max) {
                return Err(format!("energy.residual is {off:e} J off its definition at t = {:?}", row[0]));
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEAD: &str = "t,b.gap,energy.kinetic,energy.load,work.damping,energy.residual";

    fn audited(rows: &str) -> Result<(), String> {
        Table::parse(&format!("{HEAD}\n{rows}"))?.audit()
    }

    #[test]
    fn rows_that_hold_pass() {
        assert_eq!(audited("0,inf,1,0,0,0\n0.5,1e-9,0.5,0.25,-0.25,0\n1,1,0.5,0,-0.75,0.25\n"), Ok(()));
        let table = Table::parse(&format!("{HEAD}\n0,1,1,0,0,0\n1,1,0.5,0,-3,-0.25\n")).unwrap();
        assert_eq!((table.end(), table.largest_residual(), table.in_play()), (1.0, 0.25, 3.0));
    }

    #[test]
    fn the_farthest_body_of_two_tables_is_found() {
        let table = |name: &str, z: f64| Table::parse(&format!("t,{name}.x,{name}.y,{name}.z\n0,1,2,3\n1,2,3,{z}\n"));
        let one = table("b", 4.0).unwrap();
        assert_eq!(one.farthest(&table("x-b", 4.5).unwrap(), "x-"), Ok(0.5));
        assert!(one.farthest(&table("b", 4.5).unwrap(), "x-").is_err());
    }

    #[test]
    fn what_does_not_hold_is_told() {
        for (rows, told) in [
            ("0,1,1,0,0,0\n0,1,1,0,0,0\n", "comes behind"),
            ("0.5,1,1,0,0,0\n", "first time"),
            ("0,0,1,0,0,0\n", "b.gap is 0e0 m"),
            ("0,1,NaN,0,0,0\n", "energy.kinetic is NaN"),
            ("0,1,1,0,0,0\n1,1,1,0,-1,0\n", "off its definition"),
            ("0,1,1,0,0\n", "another width"),
            ("", "no rows"),
        ] {
            let wrong = audited(rows).unwrap_err();
            assert!(wrong.contains(told), "{rows}: {wrong}");
        }
    }

    #[test]
    fn a_volume_that_is_not_kept_is_told() {
        let head: String = ["xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"].map(|c| format!("b.P_{c},")).concat();
        let table = |xx: f64| {
            let text = format!("t,{head}b.pressure,energy.residual\n0,{xx},0,0,0,1,0,0,0,1,0,0\n");
            Table::parse(&text).unwrap().audit()
        };
        assert_eq!(table(1.0), Ok(()));
        assert!(table(1.0 + 1e-6).unwrap_err().contains("the volume of b is off"));
    }
}
