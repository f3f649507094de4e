//! Who pushes whom: the same of a run that is watched, of its recording and of its report.

use crate::common::{FALL, Served, record, singles};
use crate::live::{Page, running};
use crate::report::{blob, header, html};
use gyration_view::{PageSource, Stored};

/// Two balls on a floor, one on the other, that swing for a while.
const STACK: &str = r#"
time = { end = 0.02, sample = 0.001 }
[[support]]
name = "floor"
plane = { origin = [0, 0, 0], normal = [0, 0, 1] }
[[contact]]
support = "floor"
repulsion = { alpha = 1e4, nu = 6, d0 = "1 mm" }
[[contact]]
between = ["balls", "balls"]
repulsion = { alpha = 1e4, nu = 6, d0 = "1 mm" }
[[body]]
name = "ball"
group = "balls"
shape = { sphere = { radius = 0.05 } }
mass = 0.1
position = [0, 0, 0.051]
copies = { grid = { count = [1, 1, 2], spacing = [1, 1, 0.101] } }
"#;

/// The contacts of each sample: first, second, force.
fn samples(mut numbers: &[f32]) -> Vec<Vec<[f32; 3]>> {
    let mut samples = Vec::new();
    while let [count, rest @ ..] = numbers {
        let (contacts, behind) = rest.split_at(6 * *count as usize);
        samples.push(contacts.chunks(6).map(|contact| [contact[0], contact[1], contact[2]]).collect());
        numbers = behind;
    }
    samples
}

#[test]
fn forces_between_bodies_are_those_of_the_recording_wherever_they_are_looked_at() {
    let folder = tempfile::tempdir().unwrap();
    let watched = Page::open(&Served::new(running(&folder, STACK))).read_all();
    let path = record(folder.path(), "stack", STACK);
    let stored = Stored::open(&path).unwrap();
    let served = Served::new(PageSource::Recording(Box::new(stored)));
    assert_eq!(served.json("/api/header")["network"], true);
    let all = singles(&served.get("/api/blob/network").1);
    let found = samples(&all);
    assert_eq!(found.len(), 21);
    assert!(found.iter().any(|sample| sample.len() == 2), "{found:?}");
    for contact in found.iter().flatten() {
        assert!([[0.0, -1.0], [0.0, 1.0]].contains(&[contact[0], contact[1]]) && contact[2] > 0.0, "{contact:?}");
    }
    assert_eq!(samples(&singles(&served.get("/api/blob/network?from=3&to=5").1)), found[3..5]);
    let live = samples(&watched.network);
    assert_eq!(live.len(), found.len());
    for (live, found) in live.iter().flatten().zip(found.iter().flatten()) {
        assert_eq!(live[..2], found[..2]);
        // A recording has all digits; of a force twelve bits are told.
        assert!((live[2] - found[2]).abs() <= 1e-3 * found[2], "{live:?} {found:?}");
    }
    let Some(html) = html(&path) else { return };
    assert_eq!(header(&html)["network"], true);
    assert_eq!(samples(&singles(&blob(&html, "network"))), found);
}

#[test]
fn bodies_that_do_not_meet_have_no_network() {
    let folder = tempfile::tempdir().unwrap();
    let stored = Stored::open(&record(folder.path(), "fall", FALL)).unwrap();
    let served = Served::new(PageSource::Recording(Box::new(stored)));
    assert_eq!(served.json("/api/header")["network"], false);
    assert_eq!(served.get("/api/blob/network").0, 404);
    assert!(Page::open(&Served::new(running(&folder, FALL))).read_all().network.is_empty());
}
