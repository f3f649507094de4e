//! What is told of scenes that run all the same: in the survey, and in the recording of a run.

use crate::runs::provenance;
use gyration_record::Recording;
use gyration_scene::Scene;
use gyration_sim::survey::Survey;
use gyration_sim::{Job, Remarks, Unwatched};
use std::path::Path;

pub const HEAD: &str = "[world]\ngravity = [0, 0, 0]\n[time]\nend = 0.01\nsample = 0.005\n";
pub const REPULSION: &str = "repulsion = { alpha = 100, nu = 6, d0 = 1e-3 }\n";

pub fn ball(name: &str, radius: f64, lines: &str) -> String {
    format!("[[body]]\nname = \"{name}\"\nshape = {{ sphere = {{ radius = {radius} }} }}\nmass = 1\n{lines}\n")
}

pub fn at(x: f64) -> String {
    format!("position = [{x:?}, 0, 0]\n")
}

pub fn between(one: &str, other: &str, lines: &str) -> String {
    format!("[[contact]]\nbetween = [\"{one}\", \"{other}\"]\n{REPULSION}{lines}\n")
}

fn scene(text: &str) -> Scene {
    Scene::parse("scene.toml", text, Path::new(""), &[]).unwrap_or_else(|errors| panic!("{errors}\n{text}"))
}

pub fn remarks(text: &str) -> Remarks {
    Survey::of(&scene(text)).unwrap().remarks
}

/// The warnings that a recording of the scene has at its end.
fn recorded(text: &str) -> Vec<String> {
    let (scene, folder) = (scene(text), tempfile::tempdir().unwrap());
    let path = folder.path().join("run.gyr");
    Job::of(&scene, &provenance()).record(&path, &mut Unwatched).unwrap();
    let warnings = Recording::open(&path).unwrap().attributes().get("warnings").cloned();
    warnings.map(|warnings| serde_json::from_value(warnings).unwrap()).unwrap_or_default()
}

#[test]
fn bodies_that_no_contact_joins_are_told_in_one_line() {
    let [a, b, c] = ["a", "b", "c"].map(|name| ball(name, 0.02, &at(f64::from(name.as_bytes()[0]) - 97.0)));
    let alone = remarks(&format!("{HEAD}{a}"));
    assert_eq!(alone, Remarks::default());
    let two = remarks(&format!("{HEAD}{a}{b}"));
    assert_eq!(two.notes, ["\"a\" and \"b\" do not meet: no contact says so"]);
    assert!(two.warnings.is_empty() && recorded(&format!("{HEAD}{a}{b}")).is_empty());
    let joint = "[[joint]]\nname = \"j\"\nbetween = [\"a\", \"b\"]\nkind = \"distance\"\n";
    assert_eq!(remarks(&format!("{HEAD}{a}{b}{joint}")), Remarks::default());
    let three = remarks(&format!("{HEAD}{a}{b}{c}"));
    assert_eq!(three.notes, ["the 3 bodies do not meet one another: no contact says so"]);
    let one_of_three = remarks(&format!("{HEAD}{a}{b}{c}{}", between("a", "c", "")));
    assert_eq!(
        one_of_three.notes,
        ["2 of 3 pairs of bodies do not meet, \"a\" and \"b\" among them: no contact says so"]
    );
    let all = format!("{HEAD}{a}{b}{c}{}{}{}", between("a", "b", ""), between("a", "c", ""), between("b", "c", ""));
    assert_eq!(remarks(&all), Remarks::default());
}

#[test]
fn bodies_without_a_contact_that_overlap_are_warned_of() {
    let (a, b) = (ball("a", 0.02, &at(0.0)), ball("b", 0.02, &at(0.03)));
    let found = remarks(&format!("{HEAD}{a}{b}"));
    let told = "\"a\" and \"b\" do not meet: no contact says so, and they overlap at the start, by 0.01 m";
    assert_eq!((found.notes.len(), &found.warnings[..]), (0, &[told.to_owned()][..]));
    assert_eq!(recorded(&format!("{HEAD}{a}{b}")), found.warnings);
    // A spring joins the links of a chain, which may overlap.
    let spring = "[[spring]]\nbetween = [\"a\", \"b\"]\nstiffness = 1\n";
    assert!(remarks(&format!("{HEAD}{a}{b}{spring}")).warnings.is_empty());
    // In touch they do not overlap.
    let touching = remarks(&format!("{HEAD}{a}{}", ball("b", 0.02, &at(0.04))));
    assert_eq!((touching.notes.len(), touching.warnings.len()), (1, 0));
    // Of many, the line counts.
    let crowd: String = (0..60).map(|k| ball(&format!("b{k}"), 0.02, &at(0.03 * f64::from(k)))).collect();
    let [told] = &remarks(&format!("{HEAD}{crowd}")).warnings[..] else { panic!("one line") };
    assert!(
        told.starts_with("the 60 bodies do not meet one another: no contact says so, and 59 pairs overlap"),
        "{told}"
    );
}

#[test]
fn bodies_that_pins_keep_apart_need_no_contact() {
    let pinned = |name: &str, x: f64| ball(name, 0.02, &format!("{}pin = [0, 0, 0.03]", at(x)));
    assert_eq!(remarks(&format!("{HEAD}{}{}", pinned("a", 0.0), pinned("b", 0.11))), Remarks::default());
    assert_eq!(remarks(&format!("{HEAD}{}{}", pinned("a", 0.0), pinned("b", 0.09))).notes.len(), 1);
}

#[test]
fn a_reach_within_the_gaps_of_turning_is_warned_of() {
    let told = |reach: &str, speed: f64| {
        let moving = |name: &str, x: f64, v: f64| ball(name, 0.02, &format!("{}velocity = [{v:?}, 0, 0]", at(x)));
        let bodies = moving("a", -0.05, speed) + &moving("b", 0.05, -speed);
        remarks(&format!("{HEAD}{bodies}{}", between("a", "b", &format!("reach = {reach}")))).warnings
    };
    let [short] = &told("\"1 um\"", 0.5)[..] else { panic!("one warning") };
    assert!(short.starts_with("the reach of 1.00e-6 m between \"a\" and \"b\" is short: they turn back at"), "{short}");
    assert!(told("0.02", 0.5).is_empty());
    // Nothing brings them together: the reference gap of the law is what there is.
    let [short] = &told("0.005", 0.0)[..] else { panic!("one warning") };
    assert!(short.contains("d0 is 0.001 m"), "{short}");
    assert!(told("0.011", 0.0).is_empty());
    // So slow that they turn back farther out than any gap that is tried, and in the fourteenth contact of a scene.
    for speed in [1e-8, 1e-12] {
        let [short] = &told("0.05", speed)[..] else { panic!("{speed}: {:?}", told("0.05", speed)) };
        assert!(short.contains("they turn back at a gap of about"), "{short}");
    }
    let names: Vec<String> = (0..15).map(|k| format!("b{k}")).collect();
    let bodies: String = names.iter().zip(0..).map(|(name, k)| ball(name, 0.02, &at(f64::from(k)))).collect();
    let reach = |k: usize| if k == 13 { "reach = 1e-6" } else { "reach = 0.5" };
    let contacts: String = (0..14).map(|k| between(&names[k], &names[k + 1], reach(k))).collect();
    let warnings = remarks(&format!("{HEAD}{bodies}{contacts}")).warnings;
    assert!(matches!(&warnings[..], [short] if short.contains("\"b13\" and \"b14\" is short")), "{warnings:?}");
}

/// Symptom: of a reach to a support with a shape nothing was said.
#[test]
fn a_reach_to_a_support_with_a_shape_is_warned_of() {
    let told = |reach: &str, nu: f64| {
        let support = "[[support]]\nname = \"rock\"\nshape = { sphere = { radius = 1 } }\n";
        let body = ball("a", 0.1, "position = [0, 0, 1.2]\nvelocity = [0, 0, -1]");
        let contact = format!(
            "[[contact]]\nbetween = [\"a\", \"rock\"]\nreach = {reach}\n\
             repulsion = {{ alpha = 100, nu = {nu:?}, d0 = 1e-3 }}\n"
        );
        remarks(&format!("{HEAD}{support}{body}{contact}")).warnings
    };
    let [short] = &told("2e-5", 6.0)[..] else { panic!("one warning") };
    assert!(short.contains("between \"a\" and \"rock\" is short: they turn back at"), "{short}");
    assert!(told("0.02", 6.0).is_empty());
    let [another] = &told("\"auto\"", 2.5)[..] else { panic!("one warning") };
    assert!(another.contains("was found for \"a\" and \"rock\""), "{another}");
}

#[test]
fn a_feedback_on_the_gap_tells_that_supports_with_a_shape_are_not_felt() {
    let feedback = "feedback = { measure = \"support_gap\", gain = [[0, 0, 0], [0, 0, 0], [0, 0, 10]] }";
    let body = format!(
        "[[body]]\nname = \"c\"\nshape = {{ sphere = {{ radius = 0.1 }} }}\ndensity = 1000\n\
         contractile = {{ material = {{ neo_hookean = {{ shear = 1e4 }} }}, contraction_viscosity = 100, {feedback} }}\n"
    );
    let plane = "[[support]]\nname = \"wall\"\nplane = { origin = [0, 0, -10] }\n";
    let ball = "[[support]]\nname = \"ball\"\nshape = { sphere = { radius = 0.1 } }\nposition = [0, 0, -0.3]\n";
    let told =
        |text: &str| remarks(&format!("{HEAD}{text}")).notes.iter().any(|note| note.contains("feels planes alone"));
    assert!(told(&format!("{plane}{ball}{body}")) && !told(&format!("{plane}{body}")));
}

/// Symptom: a third body at 1 km/s made the reach of two slow ones shorter than the gap at which they turn back, and
/// nobody said so; nor of a repulsion that falls too slowly for 25 gaps.
#[test]
fn a_reach_that_was_found_is_warned_of_where_it_changes_the_law() {
    let moving = |name: &str, x: f64, v: [f64; 3]| ball(name, 0.02, &format!("{}velocity = {v:?}", at(x)));
    let slow = moving("a", -0.05, [5e-4, 0.0, 0.0]) + &moving("b", 0.05, [-5e-4, 0.0, 0.0]);
    let fast = moving("c", 50.0, [0.0, 1000.0, 0.0]);
    let told = |bodies: &str, between: &[[&str; 2]], nu: f64| {
        let contacts = between.iter().map(|[one, other]| {
            format!(
                "[[contact]]\nbetween = [\"{one}\", \"{other}\"]\nreach = \"auto\"\n\
                 repulsion = {{ alpha = 100, nu = {nu}, d0 = 1e-4 }}\n"
            )
        });
        let contacts: String = contacts.collect();
        let warnings = remarks(&format!("{HEAD}{bodies}{contacts}")).warnings;
        warnings.into_iter().filter(|told| told.contains("was found")).collect::<Vec<String>>()
    };
    assert!(told(&slow, &[["a", "b"]], 6.0).is_empty());
    // In no contact with them, c has no part in their reach; nor by a contact of its own, nor a spin.
    assert!(told(&format!("{slow}{fast}"), &[["a", "b"]], 6.0).is_empty());
    let spinning = slow.replacen("velocity", "angular_velocity = [0, 0, 10]\nvelocity", 1);
    assert!(told(&spinning, &[["a", "b"]], 6.0).is_empty());
    // In one contact with it they have.
    let grouped = format!("{slow}{fast}").replace("[[body]]\n", "[[body]]\ngroup = \"g\"\n");
    let [slower] = &told(&grouped, &[["g", "g"]], 6.0)[..] else { panic!("one warning") };
    assert!(slower.contains("for \"a\" and \"b\"") && slower.contains("turn back another"), "{slower}");
    let [weak] = &told(&slow, &[["a", "b"]], 3.0)[..] else { panic!("one warning") };
    assert!(weak.contains("turn back another: ") && weak.contains("exponent 3"), "{weak}");
    // 5·25^(2−ν)/(ν−2) of equal balls.
    let [weak] = &told(&slow, &[["a", "b"]], 3.5)[..] else { panic!("one warning") };
    assert!(weak.contains("smaller by 0.027 of it"), "{weak}");
    assert!(told(&slow, &[["a", "b"]], 12.0).is_empty());
}

#[test]
fn a_pair_too_far_from_the_origin_for_its_gap_is_warned_of() {
    let told = |x: f64, apart: f64| {
        let moving = |name: &str, x: f64, v: f64| ball(name, 0.05, &format!("{}velocity = [{v:?}, 0, 0]", at(x)));
        let bodies = moving("a", x - 0.5 * apart, 1.0) + &moving("b", x + 0.5 * apart, -1.0);
        remarks(&format!("{HEAD}{bodies}{}", between("a", "b", ""))).warnings
    };
    let [warning] = &told(1e6, 0.101)[..] else { panic!("one warning") };
    assert!(warning.contains("\"a\" and \"b\" are 1.00e6 m from the origin"), "{warning}");
    // What starts far apart meets with all its digits.
    assert!(told(1.0, 0.101).is_empty() && told(1e6, 1.0).is_empty());
}

/// `docs/theory-meetings.md`: a ball of 2.5 mm 32 mm off the middle of a plate of 128 mm is pushed by 9.7e-6 of the
/// normal force at a gap of 0.2 mm, and by 1.8e-6 at 50 µm.
#[test]
fn bodies_beside_the_middle_of_a_large_face_are_told_what_pushes_them() {
    let (radius, weight): (f64, f64) = (2.5e-3, 1e-3 * 9.81);
    let on = |plate: &str, gap: f64, x: f64| {
        // F = 2πRα d₀ (d₀/g)^(ν−1)/(ν−1) of a ball at a plane, at d₀ = g.
        let alpha = 5.0 * weight / (2.0 * std::f64::consts::PI * radius * gap);
        format!(
            "time = {{ end = 1, sample = 1 }}\n{plate}[[contact]]\nbetween = [\"plate\", \"ball\"]\n\
             repulsion = {{ alpha = {alpha:?}, nu = 6, d0 = {gap:?} }}\n[[body]]\nname = \"ball\"\n\
             shape = {{ sphere = {{ radius = {radius:?} }} }}\nmass = 1e-3\nposition = [{x:?}, 0, {:?}]\n",
            0.01 + radius + gap
        )
    };
    let shape = "shape = { box = { size = [0.128, 0.128, 0.02] } }\n";
    let (support, body) =
        (format!("[[support]]\nname = \"plate\"\n{shape}"), format!("[[body]]\nname = \"plate\"\nmass = 1\n{shape}"));
    for (gap, push) in [(2e-4, 9.7e-6), (5e-5, 1.8e-6)] {
        for plate in [&support, &body] {
            let [note] = &remarks(&on(plate, gap, 0.032)).notes[..] else { panic!("one note") };
            let told: f64 =
                note.split("there, ").nth(1).and_then(|rest| rest.split(' ').next()).unwrap().parse().unwrap();
            // The ball stands off by some per cent more of the whole gap.
            assert!(note.contains("\"ball\" is beside the middle") && (told / push - 1.0).abs() < 0.15, "{note}");
        }
    }
    for beside in
        [on(&support, 2e-4, 0.0), on("[[support]]\nname = \"plate\"\nplane = { origin = [0, 0, 0.01] }\n", 2e-4, 0.03)]
    {
        assert!(remarks(&beside).notes.is_empty(), "{:?}", remarks(&beside).notes);
    }
}

/// The memory of a sphere that deforms is that of small strains: of a larger one the start and the rows tell.
#[test]
fn a_sphere_that_is_stretched_too_far_for_the_memory_of_the_fluid_is_told() {
    let ball = |stretch: f64, rate: f64| {
        format!(
            "world = {{ gravity = [0, 0, 0] }}\ntime = {{ end = 0.02, sample = 1e-3 }}\n\
             fluid = {{ viscosity = 1, density = 1000 }}\n[[body]]\nname = \"ball\"\ndensity = 1000\n\
             shape = {{ sphere = {{ radius = 0.01 }} }}\ninclusion = {{ history = true, history_error = 1e-3 }}\n\
             affine = {{ material = {{ neo_hookean = {{ shear = 20 }} }} }}\n\
             gradient = [[{stretch:?}, 0, 0], [0, {:?}, 0], [0, 0, 1]]\n\
             gradient_rate = [[0, {rate:?}, 0], [{rate:?}, 0, 0], [0, 0, 0]]\n",
            1.0 / stretch
        )
    };
    let [told] = &remarks(&ball(1.25, 0.0)).warnings[..] else { panic!("one warning") };
    assert!(told.contains("remembers \"ball\" as a sphere"), "{told}");
    assert!(told.contains("at the start") && told.contains("about 22 %"), "{told}");
    assert!(remarks(&ball(1.05, 0.0)).warnings.is_empty() && remarks(&ball(1.0, 60.0)).warnings.is_empty());
    let [told] = &recorded(&ball(1.0, 60.0))[..] else { panic!("one warning") };
    assert!(told.contains("remembers \"ball\" as a sphere") && told.contains("at t = "), "{told}");
    assert!(recorded(&ball(1.05, 0.0)).is_empty());
}

/// Of two equal spheres and of one above a plane the exact ratios are known: 1.54 (Stimson, Jeffery), 134 (Brenner).
#[test]
fn what_the_fluid_between_bodies_would_do_is_told_with_its_size() {
    let fluid = "[time]\nend = 0.01\nsample = 0.005\n[fluid]\nviscosity = 1.0\ndensity = 1000\n";
    let sphere = |name: &str, z: f64| {
        format!(
            "[[body]]\nname = \"{name}\"\nshape = {{ sphere = {{ radius = 0.005 }} }}\ndensity = 2500\n\
             position = [0, 0, {z:?}]\ninclusion = {{ inertia = false }}\n"
        )
    };
    let two = |distance: f64| format!("{fluid}{}{}", sphere("a", 1.0), sphere("b", 1.0 + distance));
    let [near] = &remarks(&two(0.0105)).warnings[..] else { panic!("one warning") };
    assert!(near.contains("the fluid between \"a\" and \"b\" is left out: 0.0105 m apart at the start"), "{near}");
    assert!(near.ends_with("1.54 times as fast"), "{near}");
    assert!(remarks(&two(0.06)).warnings.is_empty());
    let floor = format!(
        "[[support]]\nname = \"floor\"\nplane = {{}}\n[[contact]]\nsupport = \"floor\"\n{}",
        "repulsion = { alpha = 1000.0, nu = 6, d0 = 1e-5 }\n"
    );
    let above = |height: f64| format!("{fluid}{floor}{}", sphere("a", height));
    let [near] = &remarks(&above(0.005 * 1.0076)).warnings[..] else { panic!("one warning") };
    assert!(near.contains("the fluid between \"a\" and the support \"floor\" is left out"), "{near}");
    assert!(near.contains("134 times as large"), "{near}");
    assert!(remarks(&above(0.06)).warnings.is_empty());
    // A soft sphere nearly is one. Symptom: 16 times, however near it was.
    let soft = "affine = { material = { neo_hookean = { shear = 1e5 } } }\ninclusion";
    let [near] = &remarks(&above(0.005 * 1.0076).replace("inclusion", soft)).warnings[..] else {
        panic!("one warning")
    };
    assert!(near.contains("about 134 times as large"), "{near}");
    let box_of = "box = { size = [0.01, 0.01, 0.01] }";
    let near = remarks(&above(0.005 * 1.0076).replace("sphere = { radius = 0.005 }", box_of)).warnings;
    assert!(near.iter().any(|told| told.contains("more than 16 times as large")), "{near:?}");
    // Symptom: "they" would move 1.35 times as fast, which is nothing that the small one does.
    let unlike =
        two(0.0425).replacen("radius = 0.005", "radius = 0.01", 1).replace("radius = 0.005", "radius = 0.0005");
    let [near] = &remarks(&unlike).warnings[..] else { panic!("one warning") };
    assert!(
        near.contains("where \"a\" moves along their line, it would take \"b\" along with about 0.35 times"),
        "{near}"
    );
    // Nothing is left out between those that say so.
    let feels = |text: &str, key: &str| text.replace("inertia = false", &format!("inertia = false, {key} = true"));
    let said = remarks(&feels(&two(0.0105), "neighbours"));
    assert!(said.warnings.is_empty() && said.notes.is_empty(), "{said:?}");
    let said = remarks(&feels(&above(0.005 * 1.0076), "walls"));
    assert!(said.warnings.is_empty() && said.notes.is_empty(), "{said:?}");
    let three = format!("{}{}", two(0.0105), sphere("c", 1.03));
    let [note] = &remarks(&feels(&three, "neighbours")).notes[..] else { panic!("one note") };
    assert!(note.starts_with("3 spheres feel one another through the fluid by their far field"), "{note}");
    let sheared = feels(&two(0.0105), "neighbours")
        .replace("viscosity = 1.0", "viscosity = 1.0\nvelocity_gradient = [[0, 0, 1], [0, 0, 0], [0, 0, 0]]");
    let [warning] = &remarks(&sheared).warnings[..] else { panic!("one warning") };
    assert!(warning.starts_with("the undisturbed flow strains, and the 2 spheres"), "{warning}");
    let [note] = &remarks(&feels(&format!("{fluid}{}", sphere("a", 1.0)), "neighbours")).notes[..] else {
        panic!("one note")
    };
    assert!(note.ends_with("\"a\" feels nobody through the fluid"), "{note}");
    let both = feels(&format!("{floor}{}{}", two(0.03), ""), "walls = true, neighbours");
    let notes = remarks(&both).notes;
    assert!(notes.iter().any(|note| note.contains("feels walls and other spheres")), "{notes:?}");
    // The recording tells of the row in which they are nearest: the sphere sinks.
    let [sunk] = &recorded(&above(0.02))[..] else { panic!("one warning") };
    assert!(sunk.contains("at t = 0.01 s"), "{sunk}");
    assert!(recorded(&above(0.06)).is_empty());
}

#[test]
fn a_support_that_is_carried_round_the_origin_is_told() {
    let notes = |motion: &str| {
        let support = format!(
            "[[support]]\nname = \"drum\"\nshape = {{ cylinder = {{ radius = 0.2, height = 0.1 }} }}\n\
             position = [2, 0, 0]\nmotion = {{ rotate = {{ rate = 3, {motion} }} }}\n"
        );
        remarks(&format!("{HEAD}{support}{}", ball("a", 0.02, &at(0.0)))).notes
    };
    let told = notes("axis = [0, 0, 1]");
    assert!(told.iter().any(|note| note.contains("\"drum\" is carried round the origin, 2 m")), "{told:?}");
    // About a line through its centre, and one that was given.
    for motion in ["axis = [1, 0, 0]", "axis = [0, 0, 1], point = [2, 0, 0]", "axis = [0, 0, 1], point = [1, 0, 0]"] {
        let told = notes(motion);
        assert!(!told.iter().any(|note| note.contains("carried round")), "{motion}: {told:?}");
    }
}

#[test]
fn a_contraction_that_begins_at_a_rate_and_turns_its_body_is_told() {
    let cat = |lines: &str| {
        format!(
            r#"{HEAD}[[body]]
            name = "cat"
            shape = {{ capsule = {{ radius = 0.08, height = 0.3 }} }}
            density = 1000
            {lines}
            [body.contractile]
            material = {{ mooney_rivlin = {{ c1 = 3e3, c2 = 1e3 }} }}
            viscosity = 20
            prescribed = {{ sum = [
              {{ constant = {{ value = [[1, 0, 0], [0, 1, 0], [0, 0, 1]] }} }},
              {{ sine = {{ amplitude = [[0.3, 0, 0], [0, 0, 0], [0, 0, -0.3]], frequency = 1, phase = "90 deg" }} }},
              {{ sine = {{ amplitude = [[0, 0, 0.3], [0, 0, 0], [0.3, 0, 0]], frequency = 1 }} }}] }}"#
        )
    };
    let told = remarks(&cat("")).notes;
    assert!(told[0].starts_with("\"cat\" starts with the angular momentum (0, 0.122"), "{told:?}");
    assert!(told[0].contains("with (0, -1.5739, 0) rad/s added to its `angular_velocity`"), "{told:?}");
    assert_eq!(remarks(&cat("angular_velocity = [0, -1.5738718943690573, 0]")).notes, Vec::<String>::new());
}

#[test]
fn a_support_that_nothing_names_is_told() {
    let block = "[[support]]\nname = \"floor\"\nshape = { box = { size = [1, 1, 1] } }\nposition = [0, 0, -0.6]\n";
    let joint = "[[joint]]\nname = \"rod\"\nbetween = [\"floor\", \"a\"]\nkind = \"distance\"\n\
                 points = [[0, 0, 0], [0, 0, 0]]\n";
    let above = |support: &str, lines: &str| {
        remarks(&format!("{HEAD}{support}{}{lines}", ball("a", 0.02, "position = [0, 0, 1]\n"))).notes
    };
    assert!(above(block, "")[0].starts_with("nothing touches the support \"floor\""), "{:?}", above(block, ""));
    assert_eq!(above(block, joint), Vec::<String>::new());
    let plane = "[[support]]\nname = \"floor\"\nplane = {}\n";
    assert_eq!(above(plane, joint), Vec::<String>::new());
    let fallen = format!("{HEAD}{plane}{}", ball("a", 0.02, "position = [0, 0, 1]\n"));
    let expected = "nothing touches the support \"floor\": no contact names it, and bodies go through it";
    assert_eq!(remarks(&fallen).notes, [expected]);
    let touched = format!("{fallen}[[contact]]\nsupport = \"floor\"\n{REPULSION}");
    assert_eq!(remarks(&touched), Remarks::default());
}

#[test]
fn a_contact_of_many_bodies_without_a_reach_is_told() {
    let heap = |count: usize, lines: &str| {
        let balls: String = (0..count).map(|k| ball(&format!("b{k}"), 0.02, &at(k as f64))).collect();
        let contact = between("b0", "b1", lines).replace("\"b0\", \"b1\"", "\"pile\", \"pile\"");
        format!("{HEAD}{}{contact}", balls.replace("mass = 1", "mass = 1\ngroup = \"pile\""))
    };
    let told = remarks(&heap(8, "")).notes;
    assert!(
        told.len() == 1 && told[0].contains("has no reach") && told[0].contains("a `reach` of some 25"),
        "{told:?}"
    );
    assert_eq!(remarks(&heap(3, "")).notes, Vec::<String>::new());
    assert_eq!(remarks(&heap(8, "reach = \"5 mm\"")).notes, Vec::<String>::new());
}

/// The reach that is proposed changes the gap of rest as `check` says, and by little, whatever the exponent is.
#[test]
fn a_crowd_without_a_reach_is_told_what_it_costs_and_which_changes_little() {
    let crowd = |shape: &str, nu: f64, reach: &str| {
        scene(&format!(
            "[time]\nend = 0.01\nsample = 0.005\n[[body]]\nname = \"b\"\nshape = {{ {shape} }}\nmass = 0.1\n\
             copies = {{ grid = {{ count = [15, 15, 1], spacing = [0.1, 0.1, 0.1] }} }}\n[[contact]]\n\
             between = [\"b\", \"b\"]\nrepulsion = {{ alpha = 100, nu = {nu}, d0 = 1e-3 }}\n{reach}"
        ))
    };
    for shape in ["sphere = { radius = 0.02 }", "box = { size = [0.03, 0.04, 0.05] }"] {
        for nu in [2.5, 6.0, 12.0] {
            let told = Survey::of(&crowd(shape, nu, "")).unwrap().remarks.notes;
            let note = told.iter().find(|note| note.contains("has no reach")).unwrap();
            assert!(
                note.contains("each of its 25200 pairs") && note.contains("a step of all its bodies takes"),
                "{note}"
            );
            let (_, from) = note.split_once('`').unwrap();
            let (reach, rest) = from.split_once('`').unwrap();
            let (_, change) = rest.split_once("smaller by ").unwrap();
            let change: f64 = change.split_once(" of it").unwrap().0.parse().unwrap();
            println!("{shape}, exponent {nu}: {reach}, {change:e}");
            let survey = Survey::of(&crowd(shape, nu, reach)).unwrap();
            let found = survey.meetings[0].reach_change.unwrap();
            // One digit is told of the change, and two of a length.
            let digit = 10.0_f64.powf(change.log10().floor());
            assert!(change <= 1e-2 && (found - change).abs() < digit, "{reach}: {change:e} {found:e}");
            assert_eq!(survey.remarks.warnings, Vec::<String>::new());
        }
    }
}

#[test]
fn rest_before_what_drives_is_told() {
    let scene = |rest: &str, force: &str| {
        format!(
            "world = {{ gravity = [0, 0, 0] }}\n[time]\nend = 3\nsample = 1\n{rest}\n[[body]]\nname = \"a\"\ndensity = \
             1000\nshape = {{ sphere = {{ radius = 0.1 }} }}\nbody_force = [\"{force}\", \"0\", \"0\"]\n"
        )
    };
    let rest = "stop_at_rest = { speed = 1e-6, hold = 0.2 }";
    let notes = |text: String| remarks(&text).notes;
    let [told] = &notes(scene(rest, "max(0, t - 1)"))[..] else { panic!("one note") };
    assert!(told.contains("slower than 0.000001 m/s for 0.2 s, the run ends"), "{told}");
    assert!(notes(scene("", "max(0, t - 1)")).is_empty());
    assert!(notes(scene(rest, "x")).is_empty());
    let plane = |motion: &str| format!("{}[[support]]\nname = \"p\"\nplane = {{}}\n{motion}", scene(rest, "x"));
    let told = |motion: &str| notes(plane(motion)).iter().any(|note| note.contains("slower than"));
    assert!(told("motion = { velocity = [0, 0, 0.1] }\n") && !told(""));
}

#[test]
fn many_rigid_bodies_beside_one_that_deforms_are_told() {
    let notes = |kind: &str, count: usize| {
        let soft = "affine = { material = { neo_hookean = { shear = 1e4 } } }\n";
        let first = ball("soft", 0.01, &format!("group = \"all\"\n{}", if kind == "soft" { soft } else { "" }));
        let others: String = (1..=count)
            .map(|k| ball(&format!("b{k}"), 0.01, &format!("group = \"all\"\n{}", at(k as f64 * 0.1))))
            .collect();
        remarks(&format!("{HEAD}{first}{others}{}", between("all", "all", "reach = 0.01"))).notes
    };
    let [told] = &notes("soft", 25)[..] else { panic!("{:?}", notes("soft", 25)) };
    assert!(told.starts_with("\"soft\" deforms") && told.contains("25 rigid bodies share their steps"), "{told}");
    assert!(notes("rigid", 25).is_empty() && notes("soft", 5).is_empty());
}
