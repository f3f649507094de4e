//! What acts between two at each sample: sums, powers, each once, across cells; as a table; after an interruption.

use crate::islands::parsed;
use crate::runs::provenance;
use gyration::dynamics::{Exchange, ExchangeKind, Workspace, rates};
use gyration::ledger::Work;
use gyration::load::Party;
use gyration::tensor::{Mat3, Vec3};
use gyration_record::Recording;
use gyration_scene::Scene;
use gyration_sim::{FirstSteps, Job, MemorySink, Simulation, Unwatched, pairs_csv};
use std::collections::BTreeSet;

/// Bodies of all kinds on a table and at a peg, with springs and bonds, some without a reach.
fn heap(end: f64, sample: f64) -> Scene {
    let text = format!(
        r#"
        time = {{ end = {end}, sample = {sample} }}
        record = {{ pairs = true, quantities = ["force_by_kind", "moment_by_kind"] }}
        [[support]]
        name = "table"
        plane = {{ origin = [0, 0, 0], normal = [0, 0, 1] }}
        motion = {{ oscillate = {{ direction = [1, 0, 0], amplitude = "1 mm", frequency = 20 }} }}
        [[support]]
        name = "peg"
        shape = {{ cylinder = {{ radius = 0.02, height = 0.3 }} }}
        position = [-0.0705, 0, 0.2]
        [[body]]
        name = "brick"
        group = "all"
        shape = {{ box = {{ size = [0.1, 0.1, 0.04] }} }}
        density = 2000
        position = [0, 0, 0.0205]
        angular_velocity = [0, 0, 3]
        [[body]]
        name = "rubber"
        group = "all"
        shape = {{ box = {{ size = [0.05, 0.05, 0.05] }} }}
        density = 1000
        affine = {{ material = {{ mooney_rivlin = {{ c1 = 3000, c2 = 1000 }} }}, viscosity = 20 }}
        position = [0.005, 0.01, 0.0665]
        [[body]]
        name = "twins"
        group = "all"
        shape = {{ union = {{ parts = [
            {{ shape = {{ sphere = {{ radius = 0.02 }} }}, offset = [0.02, 0, 0], density = 1000 }},
            {{ shape = {{ sphere = {{ radius = 0.02 }} }}, offset = [-0.02, 0, 0], density = 1000 }} ] }} }}
        position = [0, 0, 0.113]
        velocity = [0.1, 0.2, 0]
        [[contact]]
        between = ["all", "all"]
        reach = 0.002
        repulsion = {{ alpha = 100, nu = 6, d0 = 0.001 }}
        damping = {{ beta = 1, nu = 6, d0 = 0.001 }}
        friction = {{ beta = 10, nu = 6, d0 = 0.001, mu = 0.4 }}
        [[contact]]
        between = ["brick", "rubber"]
        repulsion = {{ alpha = 20, nu = 4, d0 = 0.001 }}
        [[contact]]
        support = "table"
        repulsion = {{ alpha = 100, nu = 6, d0 = 0.001 }}
        damping = {{ beta = 1, nu = 6, d0 = 0.001 }}
        friction = {{ beta = 10, nu = 6, d0 = 0.001 }}
        [[contact]]
        between = ["brick", "peg"]
        repulsion = {{ alpha = 100, nu = 6, d0 = 0.001 }}
        friction = {{ beta = 10, nu = 6, d0 = 0.001 }}
        [[spring]]
        between = ["twins", "brick"]
        points = [[0, 0, 0.01], [0.05, 0, 0]]
        stiffness = 50
        rest_length = 0.05
        damping = 0.2
        [[bond]]
        between = ["rubber", "twins"]
        points = [[0, 0, 0.02], [0, 0.01, 0]]
        law = "0.5*40*(l - 0.03)^2"
        "#
    );
    parsed(&text, &[])
}

/// All samples of a run, and the run behind its end.
fn run(scene: &Scene) -> (MemorySink, Simulation, Vec<String>) {
    let job = Job::of(scene, &provenance());
    let mut simulation = Simulation::new(job.model, job.start, job.plan).unwrap();
    let mut sink = MemorySink::default();
    simulation.begin(&mut sink).unwrap();
    simulation.run(&mut sink, &mut Unwatched).unwrap();
    assert_eq!(sink.rows.len(), sink.exchanges.len());
    let layout = job.layout();
    let names = layout
        .arrays
        .iter()
        .flat_map(|array| (0..array.row_len()).map(|place| format!("{}.{place}", array.name)).collect::<Vec<_>>());
    (sink, simulation, names.collect())
}

/// Reads entries of a row by array.
struct Row<'a> {
    names: &'a [String],
    row: &'a [f64],
}

impl Row<'_> {
    fn at(&self, array: &str, place: usize) -> f64 {
        let name = format!("{array}.{place}");
        self.row[self.names.iter().position(|known| *known == name).unwrap()]
    }

    fn vector(&self, array: &str, body: usize) -> Vec3 {
        Vec3::from_fn(|i, _| self.at(array, 3 * body + i))
    }

    fn matrix(&self, array: &str, body: usize) -> Mat3 {
        Mat3::from_fn(|i, j| self.at(array, 9 * body + 3 * i + j))
    }
}

/// The force on a body and its N in a sum of exchanges of some kinds, and the sum of their sizes.
fn sums(exchanges: &[Exchange], body: usize, kinds: &[ExchangeKind]) -> (Vec3, Mat3, [f64; 2]) {
    let (mut force, mut moment, mut sizes) = (Vec3::zeros(), Mat3::zeros(), [0.0; 2]);
    for exchange in exchanges.iter().filter(|exchange| kinds.contains(&exchange.kind)) {
        for (end, sign) in [(0, 1.0), (1, -1.0)] {
            if exchange.parties[end] == Party::Body(body) {
                let own = exchange.moments[end].unwrap();
                force += sign * exchange.force;
                moment += own;
                sizes = [sizes[0] + exchange.force.norm(), sizes[1] + own.norm()];
            }
        }
    }
    (force, moment, sizes)
}

#[test]
fn forces_and_moments_of_pairs_sum_to_those_of_each_body() {
    let (sink, _, names) = run(&heap(0.03, 0.001));
    let mut kinds = BTreeSet::new();
    for ((_, row), exchanges) in sink.rows.iter().zip(&sink.exchanges) {
        let row = Row { names: &names, row };
        let keys: BTreeSet<_> = exchanges.iter().map(|it| (it.parties, it.kind)).collect();
        assert_eq!(keys.len(), exchanges.len(), "each once");
        kinds.extend(keys);
        for body in 0..3 {
            let contacts = [ExchangeKind::Contact];
            let (force, moment, sizes) = sums(exchanges, body, &contacts);
            let gradient = row.matrix("placement_gradient", body);
            let told = |kinds: [&str; 2]| kinds.map(|kind| row.matrix(&format!("moment_{kind}"), body));
            let [contact, pair] = told(["contact", "pair"]);
            let off = (force - row.vector("contact_force", body)).norm();
            assert!(off <= 1e-14 * sizes[0], "{off:e} of {}", sizes[0]);
            let off = (moment - gradient * (contact + pair).transpose()).norm();
            assert!(off <= 1e-13 * sizes[1], "{off:e} of {}", sizes[1]);
            let (force, moment, sizes) = sums(exchanges, body, &[ExchangeKind::Spring, ExchangeKind::Bond]);
            let off = (force - row.vector("force_spring", body)).norm();
            assert!(off <= 1e-14 * sizes[0], "{off:e} of {}", sizes[0]);
            let off = (moment - gradient * row.matrix("moment_spring", body).transpose()).norm();
            assert!(off <= 1e-13 * sizes[1], "{off:e} of {}", sizes[1]);
        }
    }
    // Three on the table, the brick at the peg, two pairs of bodies (the third is out of reach), a spring and a bond.
    assert_eq!(kinds.len(), 8, "{kinds:?}");
}

/// The rate of what a ledger says is damped and rubbed away is the power of the pairs: at an instant to rounding, and
/// over a time by Simpson's rule.
#[test]
fn powers_of_pairs_are_the_rates_of_the_works() {
    let scene = heap(0.004, 2e-6);
    let (sink, simulation, names) = run(&scene);
    let powers = |exchanges: &[Exchange]| {
        let all = exchanges.iter().filter_map(|it| it.powers);
        all.fold([0.0; 2], |sum, powers| [sum[0] + powers[0], sum[1] + powers[1]])
    };
    let (model, state) = (simulation.model(), simulation.state());
    let (mut slopes, mut rate) = (vec![0.0; model.dimension()], vec![0.0; model.works().len()]);
    let mut workspace = Workspace::default();
    rates(model, &mut workspace, state.time, state.numbers(), &mut slopes, &mut rate).unwrap();
    let last = powers(sink.exchanges.last().unwrap());
    for (k, (work, array)) in [(Work::Damping, "work_damping"), (Work::Friction, "work_friction")].iter().enumerate() {
        let place = model.works().iter().position(|other| other == work).unwrap();
        // The rates of rigid bodies come from their own ten numbers: other roundings.
        assert!((last[k] - rate[place]).abs() <= 1e-9 * rate[place].abs(), "{array}: {} {}", last[k], rate[place]);
        let count = sink.rows.len() - 1;
        assert!(count.is_multiple_of(2));
        let weight = |n: usize| if n == 0 || n == count { 1.0 } else { 2.0 + 2.0 * (n % 2) as f64 };
        let integral: f64 = sink.exchanges.iter().enumerate().map(|(n, it)| weight(n) * powers(it)[k]).sum();
        let integral = integral * 2e-6 / 3.0;
        let work = |row: &[f64]| Row { names: &names, row }.at(array, 0);
        let done = work(&sink.rows[count].1) - work(&sink.rows[0].1);
        assert!(done < 0.0 && (integral - done).abs() <= 1e-6 * done.abs(), "{array}: {integral} {done}");
    }
}

#[test]
fn normals_gaps_and_feet_of_a_box_on_a_ball_and_a_plane_are_those_of_its_geometry() {
    let text = r#"
        world = { gravity = [0, 0, 0] }
        time = { end = 0.001, sample = 0.001 }
        record = { pairs = true }
        [[support]]
        name = "wall"
        plane = { origin = [0.0515, 0, 0], normal = [-1, 0, 0] }
        [[body]]
        name = "ball"
        shape = { sphere = { radius = 0.03 } }
        density = 1000
        position = [-0.082, 0, 0]
        [[body]]
        name = "cube"
        shape = { box = { size = [0.1, 0.1, 0.1] } }
        density = 1000
        [[contact]]
        between = ["cube", "ball"]
        repulsion = { alpha = 100, nu = 6, d0 = 0.001 }
        [[contact]]
        support = "wall"
        body = "cube"
        repulsion = { alpha = 100, nu = 6, d0 = 0.001 }
    "#;
    let (sink, ..) = run(&parsed(text, &[]));
    let [pair, wall] = sink.exchanges[0][..] else { panic!("two contacts: {:?}", sink.exchanges[0]) };
    assert_eq!(pair.parties, [Party::Body(0), Party::Body(1)]);
    assert_eq!(wall.parties, [Party::Body(1), Party::Support(0)]);
    // Towards the first: the ball lies where x is smaller, the cube where it is smaller than the wall.
    for (contact, gap, normal) in [(&pair, 0.002, -1.0), (&wall, 0.0015, -1.0)] {
        assert!((contact.gap.unwrap() - gap).abs() < 1e-12, "{contact:?}");
        assert!((contact.normal.unwrap() - Vec3::new(normal, 0.0, 0.0)).norm() < 1e-9, "{contact:?}");
        assert!(contact.force.x < 0.0 && contact.powers == Some([0.0; 2]), "{contact:?}");
    }
    let (between, on_wall) = (pair.point.unwrap(), wall.point.unwrap());
    assert!(between.x > -0.052 && between.x < -0.05 && between.yz().norm() < 1e-9, "{between}");
    assert!((on_wall - Vec3::new(0.0515, 0.0, 0.0)).norm() < 1e-9, "{on_wall}");
    assert!(wall.moments[1].is_none() && pair.moments[1].is_some());
}

/// Round a ring each ball meets the next one once, with the cell that it is in; all forces of a ball balance.
#[test]
fn pairs_across_cells_are_told_once_with_their_cell() {
    let text = r#"
        world = { gravity = [0, 0, 0] }
        time = { end = 0.01, sample = 0.01 }
        record = { pairs = true }
        lattice = { cell = [[0.0403, 0, 0]], repeat = [4, 1, 1] }
        [[body]]
        name = "a"
        density = 1000
        shape = { sphere = { radius = 0.02 } }
        velocity = [1, 0, 0]
        [[contact]]
        between = ["a", "a"]
        reach = 0.002
        repulsion = { alpha = 100, nu = 6, d0 = 1e-4 }
        [[spring]]
        between = ["a", "a"]
        cell = [1, 0, 0]
        points = [[0.01, 0, 0], [-0.01, 0, 0]]
        stiffness = 10
    "#;
    let (sink, simulation, _) = run(&parsed(text, &[]));
    let model = simulation.model();
    for (exchanges, (time, _)) in sink.exchanges.iter().zip(&sink.rows) {
        for kind in [ExchangeKind::Contact, ExchangeKind::Spring] {
            let of_kind: Vec<_> = exchanges.iter().filter(|it| it.kind == kind).collect();
            let keys: BTreeSet<_> = of_kind.iter().map(|it| it.parties).collect();
            assert_eq!([of_kind.len(), keys.len()], [4, 4], "{exchanges:?}");
            for it in of_kind {
                let [first, second] = it.parties.map(|party| party.body().unwrap());
                // In a cell of its own each, one beside the other.
                let step = if (first + 1) % 4 == second { 1 } else { -1 };
                assert_eq!(it.cell, [step, 0, 0], "{it:?}");
                assert!(it.force.x != 0.0);
                let along = if kind == ExchangeKind::Contact { 0.5 * 0.0403 * f64::from(step) } else { 0.01 };
                let place = time + 0.0403 * first as f64 + along;
                assert!((it.point.unwrap() - Vec3::new(place, 0.0, 0.0)).norm() < 1e-9, "{it:?} {place}");
            }
        }
        for body in 0..model.bodies.len() {
            let (force, _, sizes) = sums(exchanges, body, &[ExchangeKind::Contact, ExchangeKind::Spring]);
            assert!(force.norm() < 1e-9 * sizes[0], "{force}");
        }
    }
}

#[test]
fn the_table_has_a_row_a_pair_with_the_header_of_the_contract() {
    let scene = heap(0.01, 0.002);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("heap.gyr");
    let job = Job::of(&scene, &provenance());
    job.record(&path, &mut Unwatched).unwrap();
    let recording = Recording::open(&path).unwrap();
    let (sink, ..) = run(&scene);
    let mut text = Vec::new();
    pairs_csv(&recording, &mut text).unwrap();
    let text = String::from_utf8(text).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(
        lines[0],
        "t,first,second,cell_1,cell_2,cell_3,kind,gap,nx,ny,nz,x,y,z,fx,fy,fz,N1_xx,N1_xy,N1_xz,N1_yx,N1_yy,N1_yz,\
         N1_zx,N1_zy,N1_zz,N2_xx,N2_xy,N2_xz,N2_yx,N2_yy,N2_yz,N2_zx,N2_zy,N2_zz,power.damping,power.friction"
    );
    let all: Vec<(f64, &Exchange)> = sink
        .rows
        .iter()
        .zip(&sink.exchanges)
        .flat_map(|((time, _), exchanges)| exchanges.iter().map(|exchange| (*time, exchange)))
        .collect();
    assert_eq!(lines.len(), 1 + all.len());
    let mut named = BTreeSet::new();
    for (line, (time, exchange)) in lines[1..].iter().zip(all) {
        let fields: Vec<&str> = line.split(',').collect();
        assert_eq!(fields.len(), 37);
        let number = |place: usize| fields[place].parse::<f64>().unwrap();
        assert_eq!([number(0), number(14)], [time, exchange.force.x]);
        assert!(number(3).is_nan(), "no lattice, no cell");
        assert_eq!(fields[6], ExchangeKind::NAMES[exchange.kind as usize]);
        let is_contact = exchange.kind == ExchangeKind::Contact;
        assert_eq!([7, 8, 35, 36].map(|place| number(place).is_nan()), [!is_contact; 4], "{line}");
        assert_eq!(number(26).is_nan(), exchange.moments[1].is_none());
        assert_eq!(number(18), exchange.moments[0].unwrap()[(0, 1)], "row by row");
        named.insert((fields[1], fields[2]));
    }
    assert!(named.contains(&("brick", "table")) && named.contains(&("brick", "peg")), "{named:?}");
    assert!(named.contains(&("twins", "brick")), "a spring keeps its order: {named:?}");
    let start = recording.read("pairs/start").unwrap().data;
    assert_eq!(start.len(), recording.rows() + 1);
}

#[test]
fn a_heap_with_its_pairs_resumes_after_every_window() {
    let steps = FirstSteps::of(&Job::of(&heap(0.02, 1e-4), &provenance()), 200).unwrap();
    assert!(steps.windows > 50 && steps.difference.is_none(), "{steps:?}");
}
