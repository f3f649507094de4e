//! What can be wrong with a surface or with its resistance: one enum, each variant with the triangle and the fix.

/// Why there is no surface or no resistance matrix. Triangles and points are counted from 0.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StokesError {
    /// Fewer triangles than a tetrahedron has.
    #[error("a closed surface has four triangles at least, not {count}")]
    TooFew {
        /// Triangles given.
        count: usize,
    },
    /// A corner that is no point of the list.
    #[error("triangle {triangle} names the point {point}, but there are {count} points, counted from 0")]
    NoSuchPoint {
        /// The triangle.
        triangle: usize,
        /// The point that it names.
        point: usize,
        /// Points given.
        count: usize,
    },
    /// A coordinate is infinite or not a number.
    #[error("point {point} is not finite: mend its coordinates")]
    NotFinite {
        /// The point.
        point: usize,
    },
    /// A number of the options is out of its range.
    #[error("{what} must be {must_be}, not {value}")]
    BadOption {
        /// Its name.
        what: &'static str,
        /// Its range.
        must_be: &'static str,
        /// What was given.
        value: f64,
    },
    /// A triangle without area, or so thin that its integrals lose their digits.
    #[error(
        "triangle {triangle} is degenerate: its height is {ratio:.1e} of its longest side, at least {limit:.0e} is needed; \
         merge its points or mesh the surface anew"
    )]
    Degenerate {
        /// The triangle.
        triangle: usize,
        /// Smallest height over longest side.
        ratio: f64,
        /// The smallest ratio that is taken.
        limit: f64,
    },
    /// A side without a neighbour that runs along it the other way.
    #[error(
        "the surface is not closed: the side of triangle {triangle} from point {from} to point {to} has {neighbours} \
         neighbours that run the other way, not one; close the hole, remove the doubled triangle or turn the one that is flipped"
    )]
    NotClosed {
        /// The triangle.
        triangle: usize,
        /// First point of the side.
        from: usize,
        /// Second point.
        to: usize,
        /// How many there are.
        neighbours: usize,
    },
    /// The triangles are those of several bodies, or of a body with a cavity.
    #[error(
        "triangle {triangle} is not connected with triangle 0: give each closed surface by itself, without cavities"
    )]
    NotConnected {
        /// A triangle of another part.
        triangle: usize,
    },
    /// The normals point into the body.
    #[error("the triangles are turned inward (volume {volume:.3e}): swap two corners of each, triangle 0 first")]
    Inward {
        /// Signed volume [length³].
        volume: f64,
    },
    /// The matrices would not fit the memory granted.
    #[error(
        "{unknowns} unknowns from {triangles} triangles need {bytes} bytes, {limit} are allowed: \
         take a coarser mesh or raise max_bytes"
    )]
    TooLarge {
        /// Triangles.
        triangles: usize,
        /// Components of traction.
        unknowns: usize,
        /// What the matrices take.
        bytes: u64,
        /// What is allowed.
        limit: u64,
    },
    /// The surface touches or crosses the wall.
    #[error("triangle {triangle} touches or crosses the wall (gap {gap:.3e}): move the body away from it")]
    WallCrossed {
        /// The triangle.
        triangle: usize,
        /// Its least distance from the wall, negative behind it [length].
        gap: f64,
    },
    /// The gap to the wall is too narrow for the triangles that face it.
    #[error(
        "triangle {triangle} has the size {size:.3e}, too much for a gap of {gap:.3e} to the wall: \
         refine the mesh there to {needed:.3e} at most"
    )]
    WallTooNear {
        /// The triangle.
        triangle: usize,
        /// Its longest side [length].
        size: f64,
        /// Its least distance from the wall [length].
        gap: f64,
        /// The longest side allowed [length].
        needed: f64,
    },
    /// The matrix of the single layer has a pivot that is not positive.
    #[error(
        "the matrix of the single layer is not positive definite (unknown {unknown}, triangle {triangle}): \
         the surface crosses itself, triangles lie on each other, or they are far larger than the body is thick there; \
         mend or refine the surface"
    )]
    NotDefinite {
        /// The pivot.
        unknown: usize,
        /// A triangle at whose corner it stands.
        triangle: usize,
    },
    /// Whoever wants the matrix waits for it no longer (`gyration_threads::Interruption`).
    #[error("it was given up before it was known")]
    Interrupted,
    /// The resistance matrix has a motion that is not resisted.
    #[error("the mesh is too coarse: motion {motion} of the resistance matrix is not resisted; refine the surface")]
    TooCoarse {
        /// Row of the matrix.
        motion: usize,
    },
}
