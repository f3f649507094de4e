//! What is asked for on the command line.

use gyration_threads::Threads;
use std::num::NonZeroUsize;
use std::path::PathBuf;

const USAGE: &str =
    "usage: mpiexec -n RANKS gyration-ranks SCENE -o RECORDING [--set KEY=VALUE]... [--threads N] [--resume]";

/// A scene, where it goes, and how.
pub struct Arguments {
    pub scene: String,
    pub recording: PathBuf,
    pub overrides: Vec<String>,
    /// Threads of each rank; one if that is not said.
    pub threads: Option<NonZeroUsize>,
    pub resumes: bool,
}

impl Arguments {
    /// Reads the arguments behind the name of the program.
    ///
    /// # Errors
    /// A sentence on what is missing or unknown.
    pub fn read(mut words: impl Iterator<Item = String>) -> Result<Self, String> {
        let (mut scene, mut recording, mut threads) = (None, None, None);
        let (mut overrides, mut resumes) = (Vec::new(), false);
        while let Some(word) = words.next() {
            let mut value = || words.next().ok_or(format!("{word} needs a value\n{USAGE}"));
            match word.as_str() {
                "-o" => recording = Some(PathBuf::from(value()?)),
                "--set" => overrides.push(value()?),
                "--threads" => {
                    let count = value()?.parse::<NonZeroUsize>().map_err(|error| format!("--threads: {error}"))?;
                    let asked = Threads::asked(Some(count.get()));
                    threads = Some(asked.map_err(|error| error.to_string())?);
                }
                "--resume" => resumes = true,
                _ if word.starts_with('-') || scene.is_some() => return Err(format!("unknown {word}\n{USAGE}")),
                _ => scene = Some(word),
            }
        }
        let (Some(scene), Some(recording)) = (scene, recording) else { return Err(USAGE.to_owned()) };
        Ok(Self { scene, recording, overrides, threads, resumes })
    }
}
