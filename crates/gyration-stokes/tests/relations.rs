//! What holds for any body: symmetry, scales, turning, change of centre, threads, edges.

use crate::reference::{self, Mat12};
use gyration_stokes::{ClosedSurface, Faces, StokesOptions};
use nalgebra::{Matrix3, Rotation3, Vector3};

/// A lopsided body: no symmetry to hide behind.
fn pear() -> ClosedSurface {
    ClosedSurface::icosphere(1)
        .unwrap()
        .moved(|[x, y, z]| [x * (1.0 + 0.3 * z) + 0.2, 0.7 * y + 0.1 * x, 1.4 * z])
        .unwrap()
}

fn matrix(surface: &ClosedSurface, centre: [f64; 3]) -> Mat12 {
    reference::matrix(&surface.resistance(&StokesOptions { centre, ..StokesOptions::default() }).unwrap().matrix)
}

/// A box of these sides about the origin, `n` cells along each.
fn cuboid(sides: [f64; 3], n: u32) -> ClosedSurface {
    let (mut points, mut triangles) = (Vec::new(), Vec::new());
    for face in 0..6 {
        let (axis, sign) = (face % 3, if face < 3 { 1.0 } else { -1.0 });
        let (u, v) = if face < 3 { ((axis + 1) % 3, (axis + 2) % 3) } else { ((axis + 2) % 3, (axis + 1) % 3) };
        let mut name = |i: u32, j: u32| {
            let mut p = [0.0; 3];
            p[axis] = 0.5 * sign * sides[axis];
            p[u] = (f64::from(i) / f64::from(n) - 0.5) * sides[u];
            p[v] = (f64::from(j) / f64::from(n) - 0.5) * sides[v];
            points.iter().position(|q| *q == p).unwrap_or_else(|| {
                points.push(p);
                points.len() - 1
            }) as u32
        };
        for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
            let [a, b, c, d] = [name(i, j), name(i + 1, j), name(i + 1, j + 1), name(i, j + 1)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    ClosedSurface::new(&points, &triangles).unwrap()
}

#[test]
fn matrix_is_exactly_symmetric_and_positive_definite() {
    let m = matrix(&pear(), [0.1, -0.2, 0.3]);
    assert_eq!(m, m.transpose());
    assert!(m.cholesky().is_some());
}

/// x′ = x with velocities and gradients turned: U′ = R U, L′ = R L Rᵀ.
fn turning(r: &Matrix3<f64>) -> Mat12 {
    let mut t = Mat12::zeros();
    t.fixed_view_mut::<3, 3>(0, 0).copy_from(r);
    for (i, j, k, l) in (0..81).map(|n| (n / 27, n / 9 % 3, n / 3 % 3, n % 3)) {
        t[(3 + 3 * i + j, 3 + 3 * k + l)] = r[(i, k)] * r[(j, l)];
    }
    t
}

#[test]
fn rotating_the_body_rotates_the_matrix() {
    let r = Rotation3::from_scaled_axis(Vector3::new(0.4, -1.1, 0.7)).into_inner();
    let turned = pear().moved(|p| (r * Vector3::from(p)).into()).unwrap();
    let (there, here) = (matrix(&turned, [0.0; 3]), matrix(&pear(), [0.0; 3]));
    let error = (turning(&r) * here * turning(&r).transpose() - there).amax() / here.amax();
    // Rounding, times the condition of the matrix of the single layer.
    assert!(error < 1e-11, "{error:e}");
}

#[test]
fn moments_about_another_centre_follow_from_those_about_one() {
    let (c, d) = (Vector3::new(0.3, 0.1, -0.2), Vector3::new(-0.4, 0.6, 0.5));
    // U + L (x − c) = (U + L (d − c)) + L (x − d).
    let mut shift = Mat12::identity();
    for (i, j) in (0..9).map(|k| (k / 3, k % 3)) {
        shift[(i, 3 + 3 * i + j)] = d[j] - c[j];
    }
    let (about_c, about_d) = (matrix(&pear(), c.into()), matrix(&pear(), d.into()));
    let error = (shift.transpose() * about_d * shift - about_c).amax() / about_c.amax();
    assert!(error < 1e-11, "{error:e}");
}

#[test]
fn resistances_grow_with_the_powers_of_the_size() {
    let size = 1e-6;
    let small = pear().moved(|p| p.map(|x| size * x)).unwrap();
    let (there, here) =
        (small.resistance(&StokesOptions::default()).unwrap(), pear().resistance(&StokesOptions::default()).unwrap());
    for (i, j) in (0..144).map(|k| (k / 12, k % 12)) {
        let power = 1 + i32::from(i >= 3) + i32::from(j >= 3);
        let (expected, found) = (here.matrix[i][j] * size.powi(power), there.matrix[i][j]);
        assert!((found - expected).abs() < 1e-10 * size.powi(power) * reference::matrix(&here.matrix).amax());
    }
    assert!((there.error / here.error - 1.0).abs() < 1e-6);
}

#[test]
fn resistance_has_the_same_bytes_on_any_number_of_threads() {
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| pear().resistance(&StokesOptions::default()).unwrap())
    };
    let single = on(1);
    assert!([2, 3, 7].iter().all(|&threads| on(threads) == single));
}

#[test]
fn box_converges_within_its_estimates_and_between_spheres() {
    use std::f64::consts::PI;
    let resistance = |n| cuboid([1.0; 3], n).resistance(&StokesOptions::default()).unwrap();
    let results = [2, 4, 8].map(resistance);
    let finest = reference::matrix(&results[2].matrix);
    for result in &results {
        let drag = result.matrix[0][0];
        println!("cube: drag {drag:.5}, estimate {:.2e}", result.error);
        // Between the spheres inside and around it (Hill and Power 1956).
        assert!((3.0 * PI..3.0 * PI * 3.0_f64.sqrt()).contains(&drag));
    }
    for coarse in &results[..2] {
        let change = reference::largest_error(&reference::matrix(&coarse.matrix), &finest);
        println!("change to the finest {change:.2e}, estimate {:.2e}", coarse.error);
        assert!(change < coarse.error);
    }
}

#[test]
fn cube_of_twelve_triangles_is_solved() {
    let resistance = cuboid([1.0; 3], 1).resistance(&StokesOptions::default()).unwrap();
    let fine = cuboid([1.0; 3], 6).resistance(&StokesOptions::default()).unwrap();
    let error = resistance.matrix[0][0] / fine.matrix[0][0] - 1.0;
    println!("cube of twelve triangles: drag {error:+.2e} from that of 432");
    assert!(error.abs() < 0.05);
}

#[test]
fn unequal_triangles_do_no_harm() {
    // One triangle of a sphere is cut into needles that meet at a point next to a corner.
    let sphere = ClosedSurface::icosphere(1).unwrap();
    let (mut points, mut triangles) = (sphere.points(), sphere.triangles());
    let [a, b, c] = triangles[7];
    let [pa, pb, pc] = [a, b, c].map(|k| points[k as usize]);
    points.push(std::array::from_fn(|k| 0.998 * pa[k] + 0.001 * (pb[k] + pc[k])));
    let new = (points.len() - 1) as u32;
    triangles[7] = [a, b, new];
    triangles.extend([[b, c, new], [c, a, new]]);
    let uneven = ClosedSurface::new(&points, &triangles).unwrap();
    let options = StokesOptions { faces: Faces::Flat, ..StokesOptions::default() };
    let [plain, cut] = [&sphere, &uneven].map(|s| reference::matrix(&s.resistance(&options).unwrap().matrix));
    let change = reference::largest_error(&cut, &plain);
    println!("needles change the matrix by {change:.1e}");
    // The same polyhedron with a little more freedom of the traction, whose loss is 7e-4.
    assert!(change < 1e-3);
}

/// A solid of revolution about z from its meridian (radius, height), from the lower pole to the upper one.
fn revolution(meridian: &[[f64; 2]], n: u32) -> ClosedSurface {
    let (mut points, mut triangles) = (vec![[0.0, 0.0, meridian[0][1]]], Vec::new());
    let rings = &meridian[1..meridian.len() - 1];
    for [radius, height] in rings {
        let at = |k: u32| std::f64::consts::TAU * f64::from(k) / f64::from(n);
        points.extend((0..n).map(|k| [radius * at(k).cos(), radius * at(k).sin(), *height]));
    }
    points.push([0.0, 0.0, meridian[meridian.len() - 1][1]]);
    let (name, last) = (|ring: usize, k: u32| 1 + ring as u32 * n + k % n, points.len() as u32 - 1);
    for k in 0..n {
        triangles
            .extend([[0, name(0, k + 1), name(0, k)], [last, name(rings.len() - 1, k), name(rings.len() - 1, k + 1)]]);
        for ring in 1..rings.len() {
            let [a, b, c, d] = [name(ring - 1, k), name(ring - 1, k + 1), name(ring, k + 1), name(ring, k)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    ClosedSurface::new(&points, &triangles).unwrap()
}

#[test]
fn cylinder_and_cone_with_edges_and_a_tip_converge_within_their_estimates() {
    // Cells graded towards the edges, as tractions grow there.
    let graded = |n: u32| (0..=n).map(move |k| 0.5 - 0.5 * (std::f64::consts::PI * f64::from(k) / f64::from(n)).cos());
    let line = |from: [f64; 2], to: [f64; 2], n: u32| {
        graded(n).map(move |s| [from[0] + s * (to[0] - from[0]), from[1] + s * (to[1] - from[1])]).collect::<Vec<_>>()
    };
    let cylinder = |n: u32| {
        let mut meridian = line([0.0, -1.0], [1.0, -1.0], n);
        meridian.extend(&line([1.0, -1.0], [1.0, 1.0], 2 * n)[1..]);
        meridian.extend(&line([1.0, 1.0], [0.0, 1.0], n)[1..]);
        revolution(&meridian, 6 * n)
    };
    let cone = |n: u32| {
        let mut meridian = line([0.0, 0.0], [1.0, 0.0], n);
        meridian.extend(&line([1.0, 0.0], [0.0, 2.0], 2 * n)[1..]);
        revolution(&meridian, 6 * n)
    };
    let (inside, around) = (6.0 * std::f64::consts::PI, 6.0 * std::f64::consts::PI * 2.0_f64.sqrt());
    for (name, body) in [("cylinder", &cylinder as &dyn Fn(u32) -> ClosedSurface), ("cone", &cone)] {
        let [coarse, fine] = [2, 4].map(|n| body(n).resistance(&StokesOptions::default()).unwrap());
        let [first, second] = [&coarse, &fine].map(|r| reference::matrix(&r.matrix));
        let change = reference::largest_error(&first, &second);
        println!(
            "{name}: drags {:.4} {:.4}, change {change:.2e}, estimates {:.2e} {:.2e}",
            second[(0, 0)],
            second[(2, 2)],
            coarse.error,
            fine.error
        );
        assert!(change < coarse.error && fine.error < coarse.error, "{name}");
        if name == "cylinder" {
            // Between the spheres inside and around it (Hill and Power 1956).
            assert!([second[(0, 0)], second[(2, 2)]].iter().all(|drag| (inside..around).contains(drag)));
        }
    }
}
