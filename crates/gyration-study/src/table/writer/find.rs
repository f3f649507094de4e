//! What an interrupted writer has left: chunks that are finished, and journals to go on with.

use super::{Input, ROWS, StudyError, Table, journal};
use std::fs;

impl Table {
    /// Finds the rows that an interrupted writer has left.
    pub(super) fn find_rows(&mut self) -> Result<(), StudyError> {
        let folder = self.folder.join(ROWS);
        fs::create_dir_all(&folder).map_err(StudyError::io("make", &folder))?;
        let mut journals = Vec::new();
        for entry in fs::read_dir(&folder).map_err(StudyError::io("read", &folder))? {
            let path = entry.map_err(StudyError::io("read", &folder))?.path();
            let number = path.file_stem().and_then(|stem| stem.to_str()?.trim_start_matches('_').parse::<u64>().ok());
            match (path.extension().and_then(|ending| ending.to_str()), number) {
                (Some("tmp"), _) => fs::remove_file(&path).map_err(StudyError::io("remove", &path))?,
                (Some("parquet"), Some(number)) => {
                    let rows = Input::open(&path)?.rows();
                    if rows != self.chunk.min(self.runs.saturating_sub(number * self.chunk)) {
                        return Err(StudyError::damaged(&path, "it has not the rows of its chunk"));
                    }
                    self.finished.insert(number);
                    self.rows += rows;
                }
                (Some("jsonl"), Some(number)) => journals.push((number, path)),
                _ => {}
            }
        }
        for (number, path) in journals {
            if self.finished.contains(&number) {
                // Its chunk was sealed just before the writer stopped.
                fs::remove_file(&path).map_err(StudyError::io("remove", &path))?;
                continue;
            }
            let rows = journal::mend(&path, &self.columns)?;
            for row in rows {
                let place = row.run().and_then(|run| self.shard.place(run));
                let Some(place) = place.filter(|place| *place < self.runs && place / self.chunk == number) else {
                    return Err(StudyError::damaged(&path, "it holds a row of another chunk"));
                };
                let within = (place % self.chunk) as usize;
                let open = self.open(number)?;
                if !std::mem::replace(&mut open.there[within], true) {
                    open.count += 1;
                    self.rows += 1;
                }
            }
            self.seal_if_full(number)?;
        }
        Ok(())
    }
}
