//! Whether two versions of the program give the same recordings, to the byte.
//!
//! A change that only moves code must leave every array of the gallery as it is; one that regroups sums must say by how
//! much it moves them.

mod side;

use crate::{parallel, recording};
use side::Side;
use std::path::PathBuf;
use std::process::ExitCode;

/// Compares the recordings of two sides, of the scenes named or of all that both have; fails if anything differs.
pub fn run(old: &str, new: &str, scenes: &[&str]) -> ExitCode {
    match compared(old, new, scenes) {
        Ok(0) => ExitCode::SUCCESS,
        Ok(differing) => {
            println!("{differing} scenes differ");
            ExitCode::FAILURE
        }
        Err(reason) => {
            eprintln!("xtask: {reason}");
            ExitCode::FAILURE
        }
    }
}

/// Compares and tells; how many scenes differ.
fn compared(old: &str, new: &str, wanted: &[&str]) -> Result<usize, String> {
    let sides = [Side::of(old, "old")?, Side::of(new, "new")?];
    if sides[0].recordings == sides[1].recordings {
        return Err("both sides are the same".into());
    }
    let [old, new] = [sides[0].scenes()?, sides[1].scenes()?];
    let missing = wanted.iter().find(|scene| !(old.contains(**scene) && new.contains(**scene)));
    if let Some(scene) = missing {
        return Err(format!("`{scene}` is not on both sides"));
    }
    for scene in old.symmetric_difference(&new) {
        println!("{scene}: only on one side");
    }
    let both = old.intersection(&new).cloned();
    let scenes: Vec<String> = both.filter(|scene| wanted.is_empty() || wanted.contains(&scene.as_str())).collect();
    if scenes.is_empty() {
        return Err("there is no scene to compare".into());
    }
    let recordings = recorded(&sides, &scenes);
    let mut differing = 0;
    for (scene, [old, new]) in scenes.iter().zip(recordings) {
        let told = match (old, new) {
            (Ok(old), Ok(new)) => recording::differences(&old, &new)?,
            (old, new) => [old, new].into_iter().filter_map(Result::err).collect(),
        };
        differing += usize::from(!told.is_empty());
        println!("{scene}: {}", if told.is_empty() { "same".to_owned() } else { told.join("\n    ") });
    }
    Ok(differing)
}

/// Runs the scenes on both sides, as many at once as there are cores.
fn recorded(sides: &[Side; 2], scenes: &[String]) -> Vec<[Result<PathBuf, String>; 2]> {
    let mut recordings: Vec<_> = scenes.iter().map(|_| [Err("not run".into()), Err("not run".into())]).collect();
    let places = recordings.iter_mut().flatten();
    let tasks = scenes.iter().flat_map(|scene| sides.iter().map(move |side| (side, scene))).zip(places);
    parallel::each(tasks, |((side, scene), place)| *place = side.record(scene));
    recordings
}
