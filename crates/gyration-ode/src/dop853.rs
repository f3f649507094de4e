//! The numbers of DOP853, the explicit pair 8(5,3) of Dormand and Prince.
//!
//!   Y_s = u₀ + h Σ_j a_sj k_j,   k_s = f(t₀ + c_s h, Y_s),   u₁ = u₀ + h Σ_j b_j k_j
//!
//! Twelve stages; the thirteenth "stage" is the rate at the new state, three more serve dense output alone.
//! Rows are sparse: pairs (stage, coefficient), stages from 0. Every number is the nearest f64 to the published one.
//! Source: E. Hairer, S. P. Nørsett, G. Wanner, *Solving Ordinary Differential Equations I*, 2nd ed., §II.5, II.6 and
//! the authors' code dop853.f. The order conditions are checked for every
//! rooted tree in `tableau_tests`.

/// One row of a tableau: (stage, coefficient).
pub(crate) type Row = &'static [(usize, f64)];

/// The nodes c of the twelve stages, of the rate at the end, and of the three stages of the dense output.
pub(crate) const NODES: [f64; 16] = [
    0.0,
    0.05260015195876773,
    0.0789002279381516,
    0.1183503419072274,
    0.2816496580927726,
    0.3333333333333333,
    0.25,
    0.3076923076923077,
    0.6512820512820513,
    0.6,
    0.8571428571428571,
    1.0,
    1.0,
    0.1,
    0.2,
    0.7777777777777778,
];

/// The rows a_s of stages 1 to 11 (stage 0 is the rate at the start).
pub(crate) const STAGES: [Row; 11] = [
    &[(0, 0.05260015195876773)],
    &[(0, 0.0197250569845379), (1, 0.0591751709536137)],
    &[(0, 0.02958758547680685), (2, 0.08876275643042054)],
    &[(0, 0.2413651341592667), (2, -0.8845494793282861), (3, 0.924834003261792)],
    &[(0, 0.037037037037037035), (3, 0.17082860872947386), (4, 0.12546768756682242)],
    &[(0, 0.037109375), (3, 0.17025221101954405), (4, 0.06021653898045596), (5, -0.017578125)],
    &[
        (0, 0.03709200011850479),
        (3, 0.17038392571223998),
        (4, 0.10726203044637328),
        (5, -0.015319437748624402),
        (6, 0.008273789163814023),
    ],
    &[
        (0, 0.6241109587160757),
        (3, -3.3608926294469414),
        (4, -0.868219346841726),
        (5, 27.59209969944671),
        (6, 20.154067550477894),
        (7, -43.48988418106996),
    ],
    &[
        (0, 0.47766253643826434),
        (3, -2.4881146199716677),
        (4, -0.590290826836843),
        (5, 21.230051448181193),
        (6, 15.279233632882423),
        (7, -33.28821096898486),
        (8, -0.020331201708508627),
    ],
    &[
        (0, -0.9371424300859873),
        (3, 5.186372428844064),
        (4, 1.0914373489967295),
        (5, -8.149787010746927),
        (6, -18.52006565999696),
        (7, 22.739487099350505),
        (8, 2.4936055526796523),
        (9, -3.0467644718982196),
    ],
    &[
        (0, 2.273310147516538),
        (3, -10.53449546673725),
        (4, -2.0008720582248625),
        (5, -17.9589318631188),
        (6, 27.94888452941996),
        (7, -2.8589982771350235),
        (8, -8.87285693353063),
        (9, 12.360567175794303),
        (10, 0.6433927460157636),
    ],
];

/// The weights b of the solution of order 8.
pub(crate) const WEIGHTS: Row = &[
    (0, 0.054293734116568765),
    (5, 4.450312892752409),
    (6, 1.8915178993145003),
    (7, -5.801203960010585),
    (8, 0.3111643669578199),
    (9, -0.1521609496625161),
    (10, 0.20136540080403034),
    (11, 0.04471061572777259),
];

/// b − b̂ of the embedded solution of order 5.
pub(crate) const ERROR_FIFTH: Row = &[
    (0, 0.01312004499419488),
    (5, -1.2251564463762044),
    (6, -0.4957589496572502),
    (7, 1.6643771824549864),
    (8, -0.35032884874997366),
    (9, 0.3341791187130175),
    (10, 0.08192320648511571),
    (11, -0.022355307863886294),
];

/// b − b̂ of the embedded solution of order 3.
pub(crate) const ERROR_THIRD: Row = &[
    (0, -0.18980075407240762),
    (5, 4.450312892752409),
    (6, 1.8915178993145003),
    (7, -5.801203960010585),
    (8, -0.4226823213237919),
    (9, -0.1521609496625161),
    (10, 0.20136540080403034),
    (11, 0.02265179219836082),
];

/// The rows of stages 13 to 15, for dense output only; stage 12 is the rate at the new state.
pub(crate) const DENSE_STAGES: [Row; 3] = [
    &[
        (0, 0.056167502283047954),
        (6, 0.25350021021662483),
        (7, -0.2462390374708025),
        (8, -0.12419142326381637),
        (9, 0.15329179827876568),
        (10, 0.00820105229563469),
        (11, 0.007567897660545699),
        (12, -0.008298),
    ],
    &[
        (0, 0.03183464816350214),
        (5, 0.028300909672366776),
        (6, 0.053541988307438566),
        (7, -0.05492374857139099),
        (10, -0.00010834732869724932),
        (11, 0.0003825710908356584),
        (12, -0.00034046500868740456),
        (13, 0.1413124436746325),
    ],
    &[
        (0, -0.42889630158379194),
        (5, -4.697621415361164),
        (6, 7.683421196062599),
        (7, 4.06898981839711),
        (8, 0.3567271874552811),
        (12, -0.0013990241651590145),
        (13, 2.9475147891527724),
        (14, -9.15095847217987),
    ],
];

/// The four highest coefficients of the interpolant of order 7, as combinations of the sixteen rates.
pub(crate) const DENSE: [Row; 4] = [
    &[
        (0, -8.428938276109013),
        (5, 0.5667149535193777),
        (6, -3.0689499459498917),
        (7, 2.38466765651207),
        (8, 2.117034582445028),
        (9, -0.871391583777973),
        (10, 2.2404374302607883),
        (11, 0.6315787787694688),
        (12, -0.08899033645133331),
        (13, 18.148505520854727),
        (14, -9.194632392478356),
        (15, -4.436036387594894),
    ],
    &[
        (0, 10.427508642579134),
        (5, 242.28349177525817),
        (6, 165.20045171727028),
        (7, -374.5467547226902),
        (8, -22.113666853125306),
        (9, 7.733432668472264),
        (10, -30.674084731089398),
        (11, -9.332130526430229),
        (12, 15.697238121770845),
        (13, -31.139403219565178),
        (14, -9.35292435884448),
        (15, 35.81684148639408),
    ],
    &[
        (0, 19.985053242002433),
        (5, -387.0373087493518),
        (6, -189.17813819516758),
        (7, 527.8081592054236),
        (8, -11.57390253995963),
        (9, 6.8812326946963),
        (10, -1.0006050966910838),
        (11, 0.7777137798053443),
        (12, -2.778205752353508),
        (13, -60.19669523126412),
        (14, 84.32040550667716),
        (15, 11.99229113618279),
    ],
    &[
        (0, -25.69393346270375),
        (5, -154.18974869023643),
        (6, -231.5293791760455),
        (7, 357.6391179106141),
        (8, 93.40532418362432),
        (9, -37.45832313645163),
        (10, 104.0996495089623),
        (11, 29.8402934266605),
        (12, -43.53345659001114),
        (13, 96.32455395918828),
        (14, -39.17726167561544),
        (15, -149.72683625798564),
    ],
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trees::{Tree, residual};

    fn dense_row(row: Row, len: usize) -> Vec<f64> {
        let mut full = vec![0.0; len];
        for &(stage, coefficient) in row {
            full[stage] = coefficient;
        }
        full
    }

    /// All sixteen rows: the stages, the new state, the stages of dense output.
    fn tableau() -> Vec<Vec<f64>> {
        let mut rows = vec![vec![0.0; 16]];
        rows.extend(STAGES.iter().chain([&WEIGHTS]).chain(&DENSE_STAGES).map(|row| dense_row(row, 16)));
        rows
    }

    fn worst(order: usize, weights: &[f64], theta: f64) -> f64 {
        let rows = tableau();
        Tree::of_order(order).iter().map(|tree| residual(tree, &rows, weights, theta).abs()).fold(0.0, f64::max)
    }

    #[test]
    fn rows_sum_to_their_nodes() {
        for (row, node) in tableau().iter().zip(NODES) {
            // Coefficients reach 43, so that roundings of 1e-14 remain.
            assert!((row.iter().sum::<f64>() - node).abs() < 2e-14, "{node}");
        }
    }

    /// Residuals of products of a few coefficients of size 40: 1e-13 leaves room for cancellation.
    #[test]
    fn solution_has_order_eight_and_no_more() {
        let weights = dense_row(WEIGHTS, 16);
        for order in 1..=8 {
            let residual = worst(order, &weights, 1.0);
            assert!(residual < 1e-13, "order {order}: {residual:e}");
        }
        assert!(worst(9, &weights, 1.0) > 1e-8);
    }

    #[test]
    fn embedded_solutions_have_orders_five_and_three() {
        let weights = dense_row(WEIGHTS, 16);
        for (row, order) in [(ERROR_FIFTH, 5), (ERROR_THIRD, 3)] {
            let embedded: Vec<f64> = weights.iter().zip(dense_row(row, 16)).map(|(b, e)| b - e).collect();
            assert!((1..=order).all(|p| worst(p, &embedded, 1.0) < 1e-13), "order {order}");
            assert!(worst(order + 1, &embedded, 1.0) > 1e-5, "order {order} is exceeded");
        }
    }

    /// The interpolant of `dense`, written as weights b(θ) of the sixteen rates.
    #[test]
    fn interpolant_has_order_seven_at_every_point() {
        let change = dense_row(WEIGHTS, 16);
        for theta in [0.1, 0.35, 0.5, 0.77, 0.95] {
            let rest = 1.0 - theta;
            let d = DENSE.map(|row| dense_row(row, 16));
            let weights: Vec<f64> = (0..16)
                .map(|j| {
                    let bend = f64::from(u8::from(j == 0)) - change[j];
                    let twist = change[j] - f64::from(u8::from(j == 12)) - bend;
                    let high = d[0][j] + theta * (d[1][j] + rest * (d[2][j] + theta * d[3][j]));
                    theta * (change[j] + rest * (bend + theta * (twist + rest * high)))
                })
                .collect();
            for order in 1..=7 {
                let residual = worst(order, &weights, theta);
                // Coefficients D reach 500.
                assert!(residual < 1e-12, "θ = {theta}, order {order}: {residual:e}");
            }
        }
    }
}
