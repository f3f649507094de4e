//! Scenes from the files of robots: URDF, of ROS, and MJCF, of MuJoCo.
//!
//! ```text
//! text → XML with lines → robot (urdf | mjcf) → plan (bodies, joints, supports) → text of a scene
//! ```
//!
//! What has a counterpart in a scene is mapped; everything else is listed with its line ([`Import::left_out`]), and so
//! is what a scene needs and the file does not tell ([`Import::chosen`]). Nothing of a file is passed over: each reader
//! names what it has read of an element, and `report` lists the rest. The table of what maps is in `docs/robots.md`.
//!
//! This crate opens no scene and runs nothing.

#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

mod error;
mod mesh;
mod mjcf;
mod plan;
mod pose;
mod report;
mod robot;
mod tag;
mod urdf;
mod weight;
mod write;

pub use error::{Fault, Faults, ImportError};
pub use report::Finding;

use error::LARGEST;
use report::Report;
use roxmltree::Document;
use std::io::Read as _;
use std::path::Path;

/// A scene from the file of a robot.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Import {
    /// The text of the scene, in TOML; both lists stand at its head.
    pub scene: String,
    /// What the file says and the scene does not, by line.
    pub left_out: Vec<Finding>,
    /// What the scene says and the file does not, by line.
    pub chosen: Vec<Finding>,
}

/// How a file is read.
#[derive(Debug, Clone, Copy)]
pub struct Options<'a> {
    /// The folder in which the scene is to stand: paths of meshes are told from there.
    pub folder: &'a Path,
    /// Whether the root of a URDF stands still.
    pub is_base_fixed: bool,
}

/// Reads the file of a robot, URDF or MJCF by its first element.
///
/// # Errors
/// [`ImportError`]: a file that cannot be read, or everything that is wrong in it, each with its line and its fix.
pub fn import(path: &Path, options: Options<'_>) -> Result<Import, ImportError> {
    let read = || -> std::io::Result<Vec<u8>> {
        let mut bytes = Vec::new();
        gyration_files::open(path)?.take(LARGEST + 1).read_to_end(&mut bytes)?;
        Ok(bytes)
    };
    let bytes = read().map_err(|source| ImportError::Unreadable { path: path.to_owned(), source })?;
    if bytes.len() as u64 > LARGEST {
        return Err(ImportError::TooLarge { path: path.to_owned() });
    }
    let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
    let text = String::from_utf8_lossy(&bytes);
    Ok(import_text(&name, &text, path.parent().unwrap_or(Path::new("")), options)?)
}

/// Reads the text of a robot; `name` is what messages call it, meshes are looked for as seen from `base`.
///
/// # Errors
/// Everything that is wrong in it.
pub fn import_text(name: &str, text: &str, base: &Path, options: Options<'_>) -> Result<Import, Faults> {
    let mut report = Report::of(name, text);
    let document = match Document::parse(text) {
        Ok(document) => document,
        Err(error) => {
            let line = error.pos().row as usize;
            report.fault_at(line, format!("it is no XML: {error}"), "mend the file there, or before it");
            return Err(report.into_faults());
        }
    };
    let root = document.root_element();
    let robot = match root.tag_name().name() {
        "robot" => urdf::read(root, base, &mut report),
        "mujoco" => mjcf::read(root, base, &mut report),
        other => {
            let message = format!("the first element is <{other}>, of neither URDF (<robot>) nor MJCF (<mujoco>)");
            report.fault(root, message, "give a file of URDF or MJCF");
            return Err(report.into_faults());
        }
    };
    if !report.is_sound() {
        return Err(report.into_faults());
    }
    let plan = plan::plan(robot, options.is_base_fixed, &mut report);
    if plan.bodies.is_empty() && report.is_sound() {
        report.fault(root, "nothing of it moves", "give links that move a mass");
    }
    report.choose(None, "[time]", "end and sample are one second and a hundredth of one: write others");
    let why = "bodies pass through one another until contacts say by which law they meet";
    report.choose(None, "no [[contact]]", why);
    let (left_out, chosen) = report.finish()?;
    let head = write::Head { file: name, left_out: &left_out, chosen: &chosen };
    let scene = write::text(&plan, head, options.folder);
    Ok(Import { scene, left_out, chosen })
}
