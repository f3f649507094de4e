//! Energy that contacts store at the start: which of it is warned of.

use crate::remarks::{HEAD, REPULSION, at, ball, between, remarks};

#[test]
fn energy_stored_at_the_start_that_dwarfs_all_other_is_warned_of() {
    let told = |gap: f64, gravity: &str| {
        let bodies = ball("a", 0.05, &at(0.0)) + &ball("b", 0.05, &at(0.1 + gap));
        remarks(&format!("{gravity}[time]\nend = 0.01\nsample = 0.01\n{bodies}{}", between("a", "b", ""))).warnings
    };
    for gravity in ["", "[world]\ngravity = [0, 0, 0]\n"] {
        let [warning] = &told(1e-10, gravity)[..] else { panic!("one warning") };
        assert!(warning.contains("\"a\" and \"b\" begin 1.00") && warning.contains("they are shot apart"), "{warning}");
        assert!(told(1e-3, gravity).is_empty());
    }
    let above = |height: f64| {
        let table = "[[support]]\nname = \"table\"\nplane = {}\n[[contact]]\nsupport = \"table\"\n";
        let body = ball("a", 0.05, &format!("position = [0, 0, {height:?}]"));
        remarks(&format!("[time]\nend = 0.01\nsample = 0.01\n{table}{REPULSION}{body}")).warnings
    };
    assert!(above(0.05 + 1e-9).iter().any(|told| told.contains("\"a\" and the support \"table\" begin 1.00")));
    assert!(above(0.051).is_empty());
    // Symptom: farther from one another than they are large nothing was said, and a die of 2 cm was shot 361 m high.
    let of_a_metre = "repulsion = { alpha = 1000, nu = 6 }\n";
    let high = "[[support]]\nname = \"table\"\nplane = {}\n[[contact]]\nsupport = \"table\"\n";
    let body = ball("a", 0.01, "position = [0, 0, 0.1]");
    let warnings = remarks(&format!("[time]\nend = 0.01\nsample = 0.01\n{high}{of_a_metre}{body}")).warnings;
    assert!(warnings.iter().any(|told| told.contains("\"table\" begin 0.09 m apart")), "{warnings:?}");
    let bodies = ball("a", 0.01, &at(0.0)) + &ball("b", 0.01, &at(0.1));
    let far = format!("[time]\nend = 0.01\nsample = 0.01\n{bodies}[[contact]]\nbetween = [\"a\", \"b\"]\n{of_a_metre}");
    assert!(remarks(&far).warnings.iter().any(|told| told.contains("\"b\" begin 0.08 m apart")), "{far}");
    // What is pinned, held between walls, or carried by a fluid stays where it is.
    let pinned = |name: &str, x: f64| {
        ball(name, 0.05, &format!("position = [{x:?}, 0, 0]\npin = [0, 0, 0]\nangular_velocity = [0, 0, 0.01]"))
    };
    let strong = "repulsion = { alpha = 1e9, nu = 2, d0 = 0.01 }\n";
    let two = pinned("a", 0.0) + &pinned("b", 0.3);
    let held = format!("[time]\nend = 0.01\nsample = 0.01\n{two}[[contact]]\nbetween = [\"a\", \"b\"]\n{strong}");
    assert!(remarks(&held).warnings.is_empty(), "{:?}", remarks(&held).warnings);
    let wall = |name: &str, x: f64| {
        let law = "repulsion = { alpha = 1e6, nu = 4, d0 = 0.1 }\n";
        let plane = format!("plane = {{ origin = [{x:?}, 0, 0], normal = [{:?}, 0, 0] }}", -x.signum());
        format!("[[support]]\nname = \"{name}\"\n{plane}\n[[contact]]\nsupport = \"{name}\"\n{law}")
    };
    let between_walls = format!(
        "[world]\ngravity = [0, 0, 0]\n[time]\nend = 0.01\nsample = 0.01\n{}{}{}",
        wall("l", -0.2),
        wall("r", 0.2),
        ball("a", 0.05, "position = [0.001, 0, 0]\nvelocity = [0.01, 0, 0]")
    );
    assert!(remarks(&between_walls).warnings.is_empty(), "{:?}", remarks(&between_walls).warnings);
    // Adhesion alone pushes with its repulsive part.
    let adhering = |height: f64| {
        let table = "[[support]]\nname = \"table\"\nplane = {}\n[[contact]]\nsupport = \"table\"\n";
        let law = "adhesion = { beta = 100, nu_attractive = 3, nu_repulsive = 9, d0 = 1e-3 }\n";
        let body = ball("a", 0.05, &format!("position = [0, 0, {height:?}]"));
        remarks(&format!("[time]\nend = 0.01\nsample = 0.01\n{table}{law}{body}")).warnings
    };
    assert!(adhering(0.05 + 1e-5).iter().any(|told| told.contains("they are shot apart")));
    assert!(!adhering(0.052).iter().any(|told| told.contains("they are shot apart")));
}

#[test]
fn a_compressed_chain_is_held_by_its_neighbours() {
    let chain = |lattice: &str| {
        let contact = between("a", "a", "reach = 2e-2\n");
        let body = ball("a", 0.05, "velocity = [1e-4, 0, 0]");
        remarks(&format!("{HEAD}[lattice]\ncell = [[0.1003, 0, 0]]\n{lattice}\n{body}{contact}")).warnings
    };
    let wave = "repeat = [40, 1, 1]\nwave = { kappa = [0.25, 0, 0], branch = 5, amplitude = 1e-7 }";
    assert_eq!(chain(wave), Vec::<String>::new());
    // Those at a free end are not.
    let [warning] = &chain("repeat = [8, 1, 1]\nperiodic = false")[..] else { panic!("one warning") };
    let end = warning.contains("\"a-0\" and \"a-1\"") || warning.contains("\"a-6\" and \"a-7\"");
    assert!(end && warning.contains("they are shot apart"), "{warning}");
}
