//! A part of a study: every n-th run.

use crate::error::StudyError;

/// Shard k of n: the runs k − 1, k − 1 + n, k − 1 + 2n, …
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    number: u64,
    count: u64,
}

impl Shard {
    /// The whole study.
    pub const WHOLE: Self = Self { number: 1, count: 1 };

    /// Shard `number` of `count`, from one.
    ///
    /// # Errors
    /// [`StudyError::NoShard`] unless 1 ≤ number ≤ count.
    pub fn new(number: u64, count: u64) -> Result<Self, StudyError> {
        if number == 0 || number > count {
            return Err(StudyError::NoShard { number, count });
        }
        Ok(Self { number, count })
    }

    /// k.
    pub fn number(self) -> u64 {
        self.number
    }

    /// n.
    pub fn count(self) -> u64 {
        self.count
    }

    /// Whether it is a part only.
    pub fn is_part(self) -> bool {
        self.count > 1
    }

    /// The name of its folder in the folder of the table; none of the whole.
    pub fn folder(self) -> Option<String> {
        self.is_part().then(|| format!("shard-{}-of-{}", self.number, self.count))
    }

    /// The shard of a folder's name.
    pub fn of_folder(name: &str) -> Option<Self> {
        let (number, count) = name.strip_prefix("shard-")?.split_once("-of-")?;
        Self::new(number.parse().ok()?, count.parse().ok()?)
            .ok()
            .filter(|shard| shard.folder().as_deref() == Some(name))
    }

    /// How many of the runs of a study are its own.
    pub fn runs(self, total: u64) -> u64 {
        total.saturating_sub(self.number - 1).div_ceil(self.count)
    }

    /// Its run at a place.
    pub fn run(self, place: u64) -> u64 {
        self.number - 1 + self.count * place
    }

    /// The place of a run in it, if it is its own.
    pub fn place(self, run: u64) -> Option<u64> {
        let ahead = run.checked_sub(self.number - 1)?;
        (ahead % self.count == 0).then_some(ahead / self.count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_share_the_runs() {
        for (total, count) in [(10, 3), (1, 4), (12, 4), (0, 2)] {
            let shards: Vec<Shard> = (1..=count).map(|k| Shard::new(k, count).unwrap()).collect();
            let mut runs: Vec<u64> =
                shards.iter().flat_map(|shard| (0..shard.runs(total)).map(|place| shard.run(place))).collect();
            runs.sort_unstable();
            assert!(runs.into_iter().eq(0..total));
            for shard in shards {
                assert!((0..shard.runs(total)).all(|place| shard.place(shard.run(place)) == Some(place)));
                assert_eq!(shard.folder().map(|name| Shard::of_folder(&name)), Some(Some(shard)));
            }
        }
        assert!(Shard::new(0, 3).is_err() && Shard::new(4, 3).is_err());
        assert_eq!(Shard::of_folder("shard-03-of-8"), None);
    }
}
