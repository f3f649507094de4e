//! A register of facets and the step from scalar weights to tensors.
//!
//! With the corners in the order of their gaps, d₀ ≤ d₁ ≤ d₂, and X = V₀ + λ₁ E₁ + λ₂ E₂, every moment of X follows
//! from
//!
//!   J_ab = ∫ λ₁^a λ₂^b κ(d) dA,   a + b ≤ 3,
//!
//! over λ₁ + λ₂ ≤ 1 for a triangle and λ₁, λ₂ ≤ 1 for a parallelogram, whose fourth corner has the gap d₃ ≥ d₂.
//! Starting at the corner with the smallest gap keeps the tensors free of cancellation where κ is concentrated there.

use pulp::Simd;

use super::pack::{FacetPack, SplatField, Vector};
use crate::simd::{F64s, Log2, Row, WIDTH, fold};

/// J_ab for (a, b) = 00, 10, 01, 20, 11, 02, 30, 21, 12, 03; those above the wanted order have no meaning.
pub(super) type Weights<S> = [F64s<S>; 10];

/// How many components the moments up to an order have, symmetric ones counted once.
pub(super) const COMPONENTS: [usize; 4] = [1, 4, 10, 20];

/// Facets with their corners in the order of their gaps: triangles, or with `WHOLE` parallelograms.
#[derive(Clone, Copy)]
pub(super) struct Facet<S: Simd, const WHOLE: bool> {
    /// d₀ ≤ d₁ ≤ d₂ [m].
    pub gaps: [F64s<S>; 3],
    /// 1/d [1/m].
    pub inverses: [F64s<S>; 3],
    /// d₃ and 1/d₃ of parallelograms.
    pub farthest: (F64s<S>, F64s<S>),
    /// |E₁×E₂| [m²], deformed or not.
    pub spanned: F64s<S>,
    /// V₀.
    origin: Vector<S>,
    /// E₁ = V₁ − V₀, E₂ = V₂ − V₀.
    edges: [Vector<S>; 2],
}

/// What the split of a facet at the levels of its middle corners needs besides.
#[derive(Clone, Copy)]
pub(super) struct LevelSplit<S: Simd> {
    /// τ = (d₁ − d₀)/(d₂ − d₀) and 1 − τ.
    pub shares: [F64s<S>; 2],
    /// Logarithms of the gaps, that of d₃ the last.
    pub logs: [Log2<S>; 4],
}

impl<S: Simd, const WHOLE: bool> Facet<S, WHOLE> {
    /// Sorts the corners of the facets in one register of a pack; their integrals count with this area.
    #[inline(always)]
    pub fn new(pack: &FacetPack, register: usize, field: &SplatField<S>, spanned: F64s<S>) -> Self {
        if WHOLE {
            Self::parallelograms(pack, register, field, spanned)
        } else {
            Self::triangles(pack, register, field, spanned)
        }
    }

    #[inline(always)]
    fn triangles(pack: &FacetPack, register: usize, field: &SplatField<S>, spanned: F64s<S>) -> Self {
        let simd = spanned.simd;
        let [mut a, mut b, mut c] = pack.corners(simd, register);
        let [mut low, mut middle, mut high] = field.gaps(&[a, b, c]);
        sort(&mut low, &mut a, &mut middle, &mut b);
        sort(&mut middle, &mut b, &mut high, &mut c);
        sort(&mut low, &mut a, &mut middle, &mut b);
        let inverses = [1.0 / low, 1.0 / middle, 1.0 / high];
        Self {
            gaps: [low, middle, high],
            inverses,
            farthest: (high, inverses[2]),
            spanned,
            origin: a,
            edges: [difference(&b, &a), difference(&c, &a)],
        }
    }

    /// Turned over along each edge until V₀ is the corner next to the plane, and E₁ is the edge that rises less.
    #[inline(always)]
    fn parallelograms(pack: &FacetPack, register: usize, field: &SplatField<S>, spanned: F64s<S>) -> Self {
        let simd = spanned.simd;
        let [a, b, c] = pack.corners(simd, register);
        let [mut low, mut middle, mut high] = field.gaps(&[a, b, c]);
        let mut far = field.gap(&pack.opposite(simd, register));
        let (mut one, mut other) = (difference(&b, &a), difference(&c, &a));
        let over = middle.less_than(low);
        over.exchange(&mut low, &mut middle);
        over.exchange(&mut high, &mut far);
        let across = high.less_than(low);
        across.exchange(&mut low, &mut high);
        across.exchange(&mut middle, &mut far);
        let swapped = high.less_than(middle);
        swapped.exchange(&mut middle, &mut high);
        let mut origin = a;
        for axis in 0..3 {
            one[axis] = over.select(-one[axis], one[axis]);
            other[axis] = across.select(-other[axis], other[axis]);
            // From the middle, ½ (b + c).
            origin[axis] = ((b[axis] + c[axis]) - (one[axis] + other[axis])) * 0.5;
            swapped.exchange(&mut one[axis], &mut other[axis]);
        }
        // Rounding must not put gaps that are equal out of order.
        middle = middle.less_than(low).select(low, middle);
        high = high.less_than(middle).select(middle, high);
        far = far.less_than(high).select(high, far);
        Self {
            gaps: [low, middle, high],
            inverses: [1.0 / low, 1.0 / middle, 1.0 / high],
            farthest: (far, 1.0 / far),
            spanned,
            origin,
            edges: [one, other],
        }
    }

    /// Shares and, if they are read, logarithms of the gaps.
    #[inline(always)]
    pub fn levels(&self, needs_logs: bool) -> LevelSplit<S> {
        let [low, middle, high] = self.gaps;
        let simd = low.simd;
        let range = high - low;
        let (flat, half) = (F64s::splat(simd, 0.0), F64s::splat(simd, 0.5));
        let proper = flat.less_than(range);
        LevelSplit {
            shares: [proper.select((middle - low) / range, half), proper.select((high - middle) / range, half)],
            logs: if needs_logs {
                let far = if WHOLE { Log2::new(self.farthest.0) } else { Log2::unread(simd) };
                [Log2::new(low), Log2::new(middle), Log2::new(high), far]
            } else {
                [Log2::unread(simd); 4]
            },
        }
    }
}

/// The gaps that a pass has met.
#[derive(Clone, Copy)]
pub(super) struct GapsSeen<S: Simd> {
    lowest: F64s<S>,
    total: F64s<S>,
}

impl<S: Simd> GapsSeen<S> {
    #[inline(always)]
    pub fn new(simd: S) -> Self {
        Self { lowest: F64s::splat(simd, f64::INFINITY), total: F64s::splat(simd, 0.0) }
    }

    #[inline(always)]
    pub fn add<const WHOLE: bool>(&mut self, facet: &Facet<S, WHOLE>) {
        let [low, middle, high] = facet.gaps;
        self.lowest = low.less_than(self.lowest).select(low, self.lowest);
        self.total += (low + middle) + (high + facet.farthest.0);
    }

    /// Whether all of them are positive and finite.
    #[inline(always)]
    pub fn are_open(&self) -> bool {
        // A sum of gaps is finite if all of them are; what is smaller than a normal number has no reciprocal.
        let mut sums = [0.0; WIDTH];
        self.total.add_to(&mut sums, 0);
        self.lowest.smallest() >= f64::MIN_POSITIVE && fold(&sums).is_finite()
    }
}

/// Puts the lower of two gaps first, with its point.
#[inline(always)]
fn sort<S: Simd>(low: &mut F64s<S>, a: &mut Vector<S>, high: &mut F64s<S>, b: &mut Vector<S>) {
    let wrong = high.less_than(*low);
    wrong.exchange(low, high);
    for axis in 0..3 {
        wrong.exchange(&mut a[axis], &mut b[axis]);
    }
}

#[inline(always)]
fn difference<S: Simd>(a: &Vector<S>, b: &Vector<S>) -> Vector<S> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// Adds the components of the moments of X = V₀ + λ₁ E₁ + λ₂ E₂ up to an order to rows of sums: 1, then x y z, xx xy xz
/// yy yz zz, xxx xxy xxz xyy xyz xzz yyy yyz yzz zzz.
///
/// Each order is built from the one below with the weights multiplied by λ₁ and λ₂: A_n = V₀ ⊗ A_(n−1)[J] + E₁ ⊗
/// A_(n−1)[λ₁ J] + E₂ ⊗ A_(n−1)[λ₂ J], every factor being symmetric as a whole.
#[inline(always)]
pub(super) fn add_tensors<S: Simd, const ORDER: usize, const WHOLE: bool>(
    sums: &mut [Row],
    j: &Weights<S>,
    facet: &Facet<S, WHOLE>,
    register: usize,
) {
    let Facet { origin: v, edges: [e1, e2], .. } = facet;
    let Some(sums) = sums.get_mut(..COMPONENTS[ORDER]) else { return };
    j[0].add_to(&mut sums[0], register);
    if ORDER == 0 {
        return;
    }
    let first = combine(v, j[0], e1, j[1], e2, j[2]);
    add_all(&mut sums[1..], &first, register);
    if ORDER == 1 {
        return;
    }
    let (first1, first2) = (combine(v, j[1], e1, j[3], e2, j[4]), combine(v, j[2], e1, j[4], e2, j[5]));
    let second = symmetric(v, &first, e1, &first1, e2, &first2);
    add_all(&mut sums[4..], &second, register);
    if ORDER == 2 {
        return;
    }
    let first11 = combine(v, j[3], e1, j[6], e2, j[7]);
    let first12 = combine(v, j[4], e1, j[7], e2, j[8]);
    let first22 = combine(v, j[5], e1, j[8], e2, j[9]);
    let second1 = symmetric(v, &first1, e1, &first11, e2, &first12);
    let second2 = symmetric(v, &first2, e1, &first12, e2, &first22);
    // The ten components ijk as the product of component i of a vector and component jk of a matrix.
    const PRODUCTS: [(usize, usize); 10] =
        [(0, 0), (0, 1), (0, 2), (0, 3), (0, 4), (0, 5), (1, 3), (1, 4), (1, 5), (2, 5)];
    for (sum, (i, jk)) in sums[10..].iter_mut().zip(PRODUCTS) {
        dot([v[i], e1[i], e2[i]], [second[jk], second1[jk], second2[jk]]).add_to(sum, register);
    }
}

#[inline(always)]
fn add_all<S: Simd>(sums: &mut [Row], terms: &[F64s<S>], register: usize) {
    for (sum, term) in sums.iter_mut().zip(terms) {
        term.add_to(sum, register);
    }
}

/// a p + b q + c r.
#[inline(always)]
fn combine<S: Simd>(a: &Vector<S>, p: F64s<S>, b: &Vector<S>, q: F64s<S>, c: &Vector<S>, r: F64s<S>) -> Vector<S> {
    [dot([a[0], b[0], c[0]], [p, q, r]), dot([a[1], b[1], c[1]], [p, q, r]), dot([a[2], b[2], c[2]], [p, q, r])]
}

/// The components xx, xy, xz, yy, yz, zz of a⊗b + c⊗d + e⊗f, known to be symmetric.
#[inline(always)]
fn symmetric<S: Simd>(
    a: &Vector<S>,
    b: &Vector<S>,
    c: &Vector<S>,
    d: &Vector<S>,
    e: &Vector<S>,
    f: &Vector<S>,
) -> [F64s<S>; 6] {
    let (x, y, z) = ([a[0], c[0], e[0]], [a[1], c[1], e[1]], [a[2], c[2], e[2]]);
    let (u, v, w) = ([b[0], d[0], f[0]], [b[1], d[1], f[1]], [b[2], d[2], f[2]]);
    [dot(x, u), dot(x, v), dot(x, w), dot(y, v), dot(y, w), dot(z, w)]
}

#[inline(always)]
fn dot<S: Simd>(a: Vector<S>, b: Vector<S>) -> F64s<S> {
    (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]
}
