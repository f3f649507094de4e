//! Rates and Jacobian of bodies that deform: free, of each material, contracting or not, and near a table.
//!
//! `cargo bench -p gyration-bench --bench affine`

use divan::Bencher;
use gyration::dynamics::jacobian;
use gyration::dynamics::{Workspace, rates};
use gyration::model::Model;
use gyration::state::State;
use gyration_benchmark::soft::{MATERIALS, contracting_cube, cube_over_table, free_cube, material};
use nalgebra::DMatrix;

fn main() {
    divan::main();
}

fn bench_rates(bencher: Bencher, (model, state): (Model, State)) {
    let mut workspace = Workspace::default();
    let (mut slopes, mut powers) = (vec![0.0; model.dimension()], vec![0.0; model.works().len()]);
    bencher.bench_local(|| {
        let bodies = divan::black_box(&state.bodies);
        rates(&model, &mut workspace, 0.0, bodies.into(), &mut slopes, &mut powers)
    });
}

fn bench_jacobian(bencher: Bencher, (model, state): (Model, State)) {
    let mut workspace = Workspace::default();
    let mut blocks = [DMatrix::zeros(model.dimension(), model.dimension())];
    bencher.bench_local(|| {
        let bodies = divan::black_box(&state.bodies);
        jacobian(&model, &mut workspace, 0.0, bodies.into(), &mut blocks[..])
    });
}

#[divan::bench(args = MATERIALS)]
fn free_rates(bencher: Bencher, name: &str) {
    bench_rates(bencher, free_cube(material(name)));
}

#[divan::bench(args = MATERIALS)]
fn free_jacobian(bencher: Bencher, name: &str) {
    bench_jacobian(bencher, free_cube(material(name)));
}

#[divan::bench(args = MATERIALS)]
fn contracting_rates(bencher: Bencher, name: &str) {
    bench_rates(bencher, contracting_cube(material(name)));
}

#[divan::bench(args = MATERIALS)]
fn contracting_jacobian(bencher: Bencher, name: &str) {
    bench_jacobian(bencher, contracting_cube(material(name)));
}

#[divan::bench(args = ["neo_hookean_log"])]
fn rates_near_table(bencher: Bencher, name: &str) {
    bench_rates(bencher, cube_over_table(material(name), 0.86));
}

#[divan::bench(args = ["neo_hookean_log"])]
fn jacobian_near_table(bencher: Bencher, name: &str) {
    bench_jacobian(bencher, cube_over_table(material(name), 0.86));
}
