//! The same bodies written otherwise: in another order they move alike, under other names to the same numbers.

use super::meeting::Meeting;
use super::scene::RandomScene;
use super::table::Table;
use super::trial::{SCENE, Trial};

/// Bodies in another order are summed in another order: what differs is rounding, and what grows out of it. Two runs
/// may be apart by so many times what the tolerance leaves open, as a run with a tenth of it shows.
const TIMES: f64 = 30.0;
/// Apart by less than so many times rtol, two runs agree whatever the tolerance leaves open.
const TOLERANCES: f64 = 1000.0;
/// The file of the scene written otherwise.
const TWIN: &str = "twin.toml";

/// What does not hold of the same scene under other names.
pub fn renamed(trial: &Trial, meeting: &Meeting, rows: &str) -> Result<(), String> {
    let again = trial.rows_of(TWIN, &meeting.renamed(), &[])?;
    let numbers = |text: &str| text.split_once('\n').map(|(_, numbers)| numbers.to_owned());
    match numbers(rows) == numbers(&again) {
        true => Ok(()),
        false => Err("other names of bodies and groups give other numbers".into()),
    }
}

/// What does not hold of the same scene in another order.
pub fn exchanged(trial: &Trial, meeting: &Meeting, table: &Table, scene: &RandomScene) -> Result<(), String> {
    let RandomScene { size, rtol, .. } = *scene;
    let again = Table::parse(&trial.rows_of(TWIN, &meeting.exchanged(), &[])?)?;
    let apart = table.apart(&again, size)?;
    if apart <= TOLERANCES * rtol {
        return Ok(());
    }
    let finer = format!("solver.rtol={:?}", 0.1 * rtol);
    let finer = Table::parse(&trial.rows_of(SCENE, &scene.text, &["--set", &finer])?)?;
    let open = table.apart(&finer, size)?;
    match apart <= TIMES * open {
        true => Ok(()),
        false => Err(format!("in another order bodies are apart by {apart:.1e}, a tenth of rtol makes {open:.1e}")),
    }
}
