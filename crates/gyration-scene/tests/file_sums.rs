//! Every file that a scene names has a checksum of its numbers at the key that names it.

use gyration_scene::{FileSum, Scene};
use std::fs;
use std::path::Path;

const TEXT: &str = r#"
time = { end = 0.2, sample = 0.01 }
fluid = { viscosity = 1, velocity = { table = { file = "u.csv" } } }
[[support]]
name = "rock"
shape = { mesh = { file = "rock.obj" } }
[[body]]
name = "rod"
shape = { box = { size = [0.02, 0.02, 0.1] } }
density = 1000
position = [0, 0, 2]
affine = { couple = { table = "n.csv" } }
[[body]]
name = "crawler"
shape = { sphere = { radius = 0.05 } }
density = 1000
position = [0, 0, 3]
contractile = { contraction_viscosity = 10, drive = { sum = [{ table = { file = "n.csv" } }] } }
[[body]]
name = "grain"
shape = { sphere = { radius = 0.01 } }
density = 1000
copies = { places = "places.csv" }
[[body]]
name = "arm"
shape = { box = { size = [0.02, 0.02, 0.1] } }
density = 1000
position = [0, 0, 5]
[[joint]]
name = "motor"
between = ["arm", "space"]
kind = "hinge"
axis = [0, 1, 0]
points = [[0, 0, 0], [0, 0, 5]]
drive = { torque = { table = { file = "torque.csv" } } }
"#;

/// The files, and the same with a remark and with another number.
const FILES: [(&str, &str, &str, &str); 5] = [
    ("u.csv", "0,0,0,0\n0.2,0.1,0,0\n", "t,x,y,z\n0,0,0,0\n# a remark\n0.2,0.10,0,0\n", "0,0,0,0\n0.2,0.2,0,0\n"),
    (
        "n.csv",
        "0,0,0,0,0,0,0,0,0,0\n0.2,1e-3,0,0,0,0,0,0,0,0\n",
        "0, 0,0,0, 0,0,0, 0,0,0\r\n\r\n0.2, 0.001,0,0, 0,0,0, 0,0,0\r\n",
        "0,0,0,0,0,0,0,0,0,0\n0.2,0,1e-3,0,0,0,0,0,0,0\n",
    ),
    ("torque.csv", "0,0\n0.2,1e-3\n", "t,torque\n0,0\n0.2,1e-3\n", "0,0\n0.3,1e-3\n"),
    ("places.csv", "x,y,z\n0,0,0\n1,0,0\n", "z,y,x\n0,0,0\n0,0,1\n", "x,y,z\n0,0,0\n1,0,0\n2,0,0\n"),
    (
        "rock.obj",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n",
        "# a remark\nv 0 0 0\nv 1.0 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 2\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n",
    ),
];

fn sums(folder: &Path) -> Vec<FileSum> {
    let scene = Scene::parse("all.toml", TEXT, folder, &[]).unwrap_or_else(|errors| panic!("{errors}"));
    // The resolved form names the same files.
    let again = Scene::parse("all.json", &scene.resolved().to_string(), folder, &[]);
    assert_eq!(again.unwrap_or_else(|errors| panic!("{errors}")).file_sums(), scene.file_sums());
    scene.file_sums().to_vec()
}

#[test]
fn files_are_told_by_their_keys_with_sums_of_their_numbers() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, content: &str| fs::write(folder.path().join(name), content).unwrap();
    FILES.iter().for_each(|(name, content, ..)| write(name, content));
    let before = sums(folder.path());
    let told: Vec<(&str, &str)> = before.iter().map(|found| (&*found.key, &*found.file)).collect();
    let expected = [
        ("body.crawler.contractile.drive.sum.0.table.file", "n.csv"),
        ("body.grain.copies.places", "places.csv"),
        ("body.rod.affine.couple.table", "n.csv"),
        ("fluid.velocity.table.file", "u.csv"),
        ("joint.motor.drive.torque.table.file", "torque.csv"),
        ("support.rock.shape.mesh.file", "rock.obj"),
    ];
    assert_eq!(told, expected);
    for (name, content, same, other) in FILES {
        write(name, same);
        assert_eq!(sums(folder.path()), before, "{name}");
        write(name, other);
        let changed = sums(folder.path());
        assert_eq!(changed.len(), before.len());
        for (now, then) in changed.iter().zip(&before) {
            assert_eq!(now.sum != then.sum, now.file == name, "{} after {name} has changed", now.file);
        }
        write(name, content);
    }
    let without = Scene::open("dice", &[]).unwrap();
    assert!(without.file_sums().is_empty());
}
