//! Paths of wave vectors: vertices, what they are called, and the points between them.

/// Vertices on which bands are looked at.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BandPath {
    /// The points of the path.
    pub points: Vec<PathPoint>,
}

/// A wave vector of a path.
#[derive(Debug, Clone, PartialEq)]
pub struct PathPoint {
    /// κ: k = Σ κ_a b_a.
    pub kappa: [f64; 3],
    /// The direction of the path there, in κ; zero where it has none.
    pub along: [f64; 3],
    /// What it is called, if it is a vertex with a name.
    pub label: Option<String>,
    /// Whether it is a vertex.
    pub is_vertex: bool,
    /// Whether the path begins anew here.
    pub begins: bool,
}

/// The most wave vectors of a path, or of a mesh.
pub const MOST_POINTS: usize = 1_000_000;

/// What is wrong with a path.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum PathError {
    /// It has no vertices.
    #[error("the path has no vertices: write for instance \"0,0,0 0.5,0,0\"")]
    Empty,
    /// A vertex does not parse.
    #[error(
        "\"{word}\" is no vertex: write three numbers or fractions with commas between, as 0.5,0,1/3, or NAME=0.5,0,0"
    )]
    Vertex {
        /// As it is written.
        word: String,
    },
    /// It has too many wave vectors.
    #[error("the path has {0} wave vectors, more than {MOST_POINTS}: take fewer points a segment")]
    TooMany(usize),
    /// It leaves what is periodic.
    #[error("\"{word}\" leaves what is periodic: along {direction} the lattice has no waves; write 0 there")]
    NotPeriodic {
        /// As it is written.
        word: String,
        /// Which of the cell vectors, from 1.
        direction: usize,
    },
}

/// A vertex as it is written.
struct Vertex {
    kappa: [f64; 3],
    label: Option<String>,
}

impl BandPath {
    /// Reads a path; `points` a segment, both ends included, a shared vertex once.
    ///
    /// # Errors
    /// [`PathError`].
    pub fn parse(text: &str, points: usize, periodic: &[bool]) -> Result<Self, PathError> {
        let mut path = Self::default();
        let parts = text.split('|').map(|part| part.split_whitespace().map(|word| vertex(word, periodic)).collect());
        let parts: Vec<Vec<Vertex>> = parts.collect::<Result<_, _>>()?;
        let points = points.max(2);
        let segments: usize = parts.iter().map(|vertices| vertices.len().saturating_sub(1)).sum();
        let many = segments.saturating_mul(points - 1);
        if many > MOST_POINTS {
            return Err(PathError::TooMany(many));
        }
        parts.iter().for_each(|vertices| path.add(vertices, points));
        if path.points.is_empty() { Err(PathError::Empty) } else { Ok(path) }
    }

    /// The path that is looked at where none is given, in words.
    pub fn usual(periodic: &[bool]) -> String {
        let along: Vec<usize> = (0..periodic.len()).filter(|a| periodic[*a]).collect();
        let mut at = [0.0; 3];
        let mut vertices = vec![at];
        for a in &along {
            at[*a] = 0.5;
            vertices.push(at);
        }
        if along.len() > 1 {
            vertices.push([0.0; 3]);
        }
        let words: Vec<String> = vertices.iter().map(|[x, y, z]| format!("{x},{y},{z}")).collect();
        words.join(" ")
    }

    /// Adds a piece without a break.
    fn add(&mut self, vertices: &[Vertex], points: usize) {
        for (number, vertex) in vertices.iter().enumerate() {
            let next = vertices.get(number + 1);
            let before = number.checked_sub(1).and_then(|before| vertices.get(before));
            let along = match (before, next) {
                (_, Some(next)) => difference(&next.kappa, &vertex.kappa),
                (Some(before), None) => difference(&vertex.kappa, &before.kappa),
                (None, None) => [0.0; 3],
            };
            let (kappa, label) = (vertex.kappa, vertex.label.clone());
            self.points.push(PathPoint { kappa, along, label, is_vertex: true, begins: number == 0 });
            let Some(next) = next else { continue };
            for k in 1..points - 1 {
                let part = k as f64 / (points - 1) as f64;
                let kappa = std::array::from_fn(|a| vertex.kappa[a] + part * along[a]);
                debug_assert!(next.kappa != vertex.kappa || along == [0.0; 3]);
                self.points.push(PathPoint { kappa, along, label: None, is_vertex: false, begins: false });
            }
        }
    }
}

fn difference(to: &[f64; 3], from: &[f64; 3]) -> [f64; 3] {
    std::array::from_fn(|a| to[a] - from[a])
}

fn vertex(word: &str, periodic: &[bool]) -> Result<Vertex, PathError> {
    let wrong = || PathError::Vertex { word: word.to_owned() };
    let (label, numbers) = match word.split_once('=') {
        Some((name, numbers)) if !name.is_empty() => (Some(name.to_owned()), numbers),
        Some(_) => return Err(wrong()),
        None => (None, word),
    };
    let numbers: Option<Vec<f64>> = numbers.split(',').map(number).collect();
    let kappa: [f64; 3] = numbers.ok_or_else(wrong)?.try_into().map_err(|_| wrong())?;
    let leaves = (0..3).find(|a| kappa[*a] != 0.0 && !periodic.get(*a).copied().unwrap_or(false));
    match leaves {
        Some(a) => Err(PathError::NotPeriodic { word: word.to_owned(), direction: a + 1 }),
        None => Ok(Vertex { kappa, label }),
    }
}

/// A number, or a fraction of two.
fn number(text: &str) -> Option<f64> {
    let plain = |text: &str| text.trim().parse::<f64>().ok().filter(|value| value.is_finite());
    match text.split_once('/') {
        None => plain(text),
        Some((above, below)) => Some(plain(above)? / plain(below).filter(|below| *below != 0.0)?),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shared_vertex_stands_once_and_a_bar_breaks_the_path() {
        let path = BandPath::parse("0,0,0 X=1/2,0,0 0.5,0.5,0 | G=0,0,0 0,0.5,0", 5, &[true, true]);
        let points = path.unwrap_or_else(|error| panic!("{error}")).points;
        assert_eq!(points.len(), 5 + 4 + 5);
        assert_eq!(points[4].kappa, [0.5, 0.0, 0.0]);
        assert_eq!((points[4].label.as_deref(), points[4].along), (Some("X"), [0.0, 0.5, 0.0]));
        assert_eq!(points.iter().filter(|point| point.begins).count(), 2);
        assert_eq!(points[1].kappa, [0.125, 0.0, 0.0]);
    }

    #[test]
    fn what_is_no_path_is_refused() {
        for wrong in ["", "0,0", "a,b,c", "0,0,1/0", "=0,0,0", "0,0,0 0.5,0,inf"] {
            assert!(BandPath::parse(wrong, 3, &[true; 3]).is_err(), "{wrong}");
        }
        let beyond = BandPath::parse("0,0,0 0,0.5,0", 3, &[true]);
        assert_eq!(beyond, Err(PathError::NotPeriodic { word: "0,0.5,0".into(), direction: 2 }));
        assert_eq!(BandPath::parse("0,0,0 0.5,0,0", usize::MAX, &[true]), Err(PathError::TooMany(usize::MAX - 1)));
        assert_eq!(BandPath::usual(&[true, true]), "0,0,0 0.5,0,0 0.5,0.5,0 0,0,0");
    }
}
