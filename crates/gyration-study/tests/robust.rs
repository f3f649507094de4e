//! No text makes the reader of studies panic, and no journal the reader of rows.

use crate::common::{STUDY, sandbox, study};
use gyration_study::{Row, Study};
use proptest::prelude::*;

/// A text with some pieces cut out, doubled, or replaced by others that mean something.
fn damaged(text: &str, changes: &[(usize, usize, usize)]) -> String {
    const PIECES: [&str; 12] =
        ["", "0", "-1", "1e400", "nan", "\"", "{", "[", "]", "3 kg", "body.ball", "\n[parameter.x]\n"];
    let mut text: Vec<char> = text.chars().collect();
    for (start, length, piece) in changes {
        let start = start % (text.len() + 1);
        let end = (start + length).min(text.len());
        text.splice(start..end, PIECES[piece % PIECES.len()].chars());
    }
    text.into_iter().collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn damaged_studies_are_studies_or_are_refused(
        changes in prop::collection::vec((0_usize..2000, 0_usize..30, 0_usize..12), 1..5),
    ) {
        let sandbox = sandbox();
        if let Ok(study) = Study::parse("s.toml", &damaged(STUDY, &changes), sandbox.path(), &[]) {
            // Whatever it says, each run has its scene, or reasons against it.
            for run in [0, study.runs() / 2, study.runs() - 1] {
                let _ = study.scene_of(run);
            }
        }
    }

    #[test]
    fn damaged_lines_are_rows_or_are_not(
        changes in prop::collection::vec((0_usize..2000, 0_usize..30, 0_usize..12), 1..5),
    ) {
        let sandbox = sandbox();
        let study = study(sandbox.path());
        let line = study.row(0).to_line();
        if let Some(row) = Row::from_line(&damaged(&line, &changes), study.columns()) {
            prop_assert_eq!(row.values.len(), study.columns().len());
        }
    }
}
