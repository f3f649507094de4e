//! Numbers, vectors and matrices as a scene file has them, and the little algebra that a random start needs.

/// A vector.
pub type Vector = [f64; 3];
/// A matrix, rows.
pub type Matrix<T = f64> = [[T; 3]; 3];

/// The unit matrix.
pub const UNIT: Matrix = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// A list of numbers: `[1.0, 2e-7]`. Each reads back to the same f64.
pub fn list(numbers: &[f64]) -> String {
    format!("{numbers:?}")
}

/// A matrix, by rows.
pub fn rows(matrix: &Matrix) -> String {
    format!("{matrix:?}")
}

/// A square matrix that has these numbers on its diagonal, by rows.
pub fn diagonal_rows(numbers: &[f64]) -> String {
    let entry = |i: usize, j: usize| if i == j { numbers[i] } else { 0.0 };
    let row = |i| (0..numbers.len()).map(|j| entry(i, j)).collect();
    format!("{:?}", (0..numbers.len()).map(row).collect::<Vec<Vec<f64>>>())
}

/// A vector times a number.
pub fn scaled(vector: Vector, factor: f64) -> Vector {
    vector.map(|x| x * factor)
}

/// A matrix times a number.
pub fn scaled_rows(matrix: &Matrix, factor: f64) -> Matrix {
    matrix.map(|row| scaled(row, factor))
}

/// The product of two matrices.
pub fn product(a: &Matrix, b: &Matrix) -> Matrix {
    a.map(|row| [0, 1, 2].map(|j| (0..3).map(|k| row[k] * b[k][j]).sum()))
}

/// A matrix without its trace.
pub fn deviator(matrix: &Matrix) -> Matrix {
    let mean = (matrix[0][0] + matrix[1][1] + matrix[2][2]) / 3.0;
    let mut rest = *matrix;
    for (i, row) in rest.iter_mut().enumerate() {
        row[i] -= mean;
    }
    rest
}

/// The determinant.
pub fn determinant([a, b, c]: &Matrix) -> f64 {
    a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])
}

/// The vector that a matrix takes to another, by Cramer's rule.
pub fn solved(matrix: &Matrix, right: Vector) -> Vector {
    let replaced = |column: usize| {
        let mut rows = *matrix;
        rows.iter_mut().zip(right).for_each(|(row, entry)| row[column] = entry);
        determinant(&rows) / determinant(matrix)
    };
    [0, 1, 2].map(replaced)
}

/// The rotation of a unit quaternion.
pub fn rotation([w, x, y, z]: [f64; 4]) -> Matrix {
    [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
        [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)],
        [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)],
    ]
}

#[cfg(test)]
mod tests {
    use super::super::stream::Stream;
    use super::*;

    #[test]
    fn numbers_are_written_so_that_they_read_back() {
        assert_eq!(list(&[1.0, 2.5e-7, -3e20]), "[1.0, 2.5e-7, -3e20]");
        assert_eq!(rows(&UNIT), "[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]");
        assert_eq!(diagonal_rows(&[1.0, 2.0]), "[[1.0, 0.0], [0.0, 2.0]]");
    }

    #[test]
    fn a_rotation_keeps_volumes_and_a_deviator_has_no_trace() {
        let mut stream = Stream::of(1, 1);
        let turn = rotation(stream.turn());
        assert!((determinant(&turn) - 1.0).abs() < 1e-14);
        let rest = deviator(&stream.matrix());
        assert!((rest[0][0] + rest[1][1] + rest[2][2]).abs() < 1e-15);
        assert_eq!(product(&UNIT, &turn), turn);
        let solution = solved(&turn, [0.3, -0.2, 0.5]);
        for (row, right) in turn.iter().zip([0.3, -0.2, 0.5]) {
            assert!((row.iter().zip(solution).map(|(a, x)| a * x).sum::<f64>() - right).abs() < 1e-15);
        }
    }
}
