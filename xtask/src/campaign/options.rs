//! What a campaign is asked for.

use std::ops::RangeInclusive;
use std::path::PathBuf;
use std::str::FromStr;

/// The words behind `cargo xtask campaign`.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// How many scenes.
    pub scenes: u64,
    /// What they depend on, beside their number.
    pub seed: u64,
    /// The one scene to try, which keeps its folder.
    pub only: Option<u64>,
    /// The program; built for speed if none is named.
    pub program: Option<PathBuf>,
    /// `solver.max_wall_time` of each run [s].
    pub wall_time: f64,
}

impl Default for Options {
    fn default() -> Self {
        Self { scenes: 100, seed: 1, only: None, program: None, wall_time: 10.0 }
    }
}

impl Options {
    /// Reads them; what is wrong with them otherwise.
    pub fn parse(words: &[&str]) -> Result<Self, String> {
        let mut options = Self::default();
        let (pairs, rest) = words.as_chunks::<2>();
        for [name, value] in pairs {
            match *name {
                "--scenes" => options.scenes = number(name, value)?,
                "--seed" => options.seed = number(name, value)?,
                "--only" => options.only = Some(number(name, value)?),
                "--program" => options.program = Some(value.into()),
                "--wall-time" => options.wall_time = number(name, value)?,
                _ => return Err(format!("a campaign has no option `{name}`")),
            }
        }
        if let [name] = rest {
            return Err(format!("`{name}` has no value"));
        }
        if !(options.wall_time > 0.0 && options.wall_time < 1e6) {
            return Err("--wall-time is a number of seconds".into());
        }
        Ok(options)
    }

    /// The numbers of the scenes.
    pub fn cases(&self) -> RangeInclusive<u64> {
        match self.only {
            Some(case) => case..=case,
            None => 1..=self.scenes,
        }
    }
}

fn number<T: FromStr>(name: &str, value: &str) -> Result<T, String> {
    value.parse().map_err(|_| format!("{name}: `{value}` is no number"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_are_read_and_others_refused() {
        let options = Options::parse(&["--scenes", "7", "--seed", "3", "--wall-time", "2.5"]).unwrap();
        assert_eq!(options, Options { scenes: 7, seed: 3, wall_time: 2.5, ..Options::default() });
        assert_eq!(options.cases(), 1..=7);
        assert_eq!(Options::parse(&["--only", "5"]).unwrap().cases(), 5..=5);
        for words in [&["--scene", "7"][..], &["--seed", "x"], &["--seed"], &["--wall-time", "0"]] {
            assert!(Options::parse(words).is_err(), "{words:?}");
        }
    }
}
