//! The table of a study in words: outcomes counted, what is kept by mean and deviation or counted, throughput.

use crate::error::code;
use crate::output;
use gyration_sim::format::{duration, significant};
use gyration_study::{Column, ColumnKind, Digest, FAILED, Spread, Study};
use serde_json::{Map, Value, json};

/// The most different texts that are listed.
const MOST_LISTED: usize = 12;

/// What it took.
pub struct StudyCost {
    /// Runs made now.
    pub runs: u64,
    /// Wall time [s].
    pub seconds: f64,
    /// Threads.
    pub threads: usize,
}

/// The summary, a line a thing.
pub fn in_words(study: &Study, digest: &Digest, effort: &StudyCost) -> String {
    let mut lines = Vec::new();
    if let Some(title) = study.title() {
        lines.push(title.to_owned());
    }
    let points = study.points();
    let grid =
        if points > 1 { format!(": {points} points, {}", repetitions(study.repetitions())) } else { String::new() };
    lines.push(format!("runs       {}{grid}", digest.rows));
    if let Some((_, spread)) = digest.column("outcome") {
        lines.push(format!("outcomes   {}", counted(spread)));
    }
    let width = study.keeps().iter().map(|(name, _)| name.chars().count()).max().unwrap_or(0).max(10);
    for (name, _) in study.keeps() {
        if let Some((column, spread)) = digest.column(name) {
            lines.push(format!("{name:<width$} {}", told(column, spread)));
        }
    }
    if effort.runs > 0 {
        lines.push(format!("time       {}", throughput(effort)));
    }
    lines.join("\n")
}

/// The same for programs: how many runs, and of each column counts of texts, or mean, deviation and range of numbers.
pub fn in_json(study: &Study, digest: &Digest) -> Value {
    let told = |name: &str| {
        let (column, spread) = digest.column(name)?;
        let number = |value: f64| if value.is_finite() { json!(value) } else { Value::Null };
        let spread = match column.kind {
            ColumnKind::Text => json!(spread.texts),
            _ => json!({
                "count": spread.count,
                "mean": number(spread.mean),
                "deviation": number(spread.deviation()),
                "least": number(spread.least),
                "greatest": number(spread.greatest),
            }),
        };
        Some((name.to_owned(), spread))
    };
    let kept: Map<String, Value> = study.keeps().iter().filter_map(|(name, _)| told(name)).collect();
    let outcomes = digest.column("outcome").map(|(_, spread)| &spread.texts);
    json!({
        "title": study.title(),
        "runs": digest.rows,
        "points": study.points(),
        "repetitions": study.repetitions(),
        "outcomes": outcomes,
        "open_ledgers": digest.open.count,
        "columns": kept,
    })
}

fn repetitions(count: u64) -> String {
    if count == 1 { "1 repetition".to_owned() } else { format!("{count} repetitions") }
}

/// Tells what must not go unseen of a finished table, also if all else is kept quiet, and gives its exit code: a study
/// none of whose runs could be made is no success, nor is one with an open ledger.
pub fn verdict(digest: &Digest) -> u8 {
    if let Some(warning) = digest.open.warning() {
        output::say(&format!("gyration: warning: {warning} The column `ledger` tells which they are."));
    }
    let failed = digest.column("outcome").and_then(|(_, spread)| spread.texts.get(FAILED)).copied().unwrap_or(0);
    if failed == 0 || failed < digest.rows {
        return if digest.open.count > 0 { code::OPEN } else { code::DONE };
    }
    let reasons = digest.column("reason").map(|(_, spread)| spread.texts.keys().next().cloned()).unwrap_or_default();
    output::say(&format!("gyration: no run could be made: {}", reasons.unwrap_or_default()));
    code::ENDED_EARLY
}

fn throughput(effort: &StudyCost) -> String {
    let rate = effort.runs as f64 / effort.seconds;
    let threads = match effort.threads {
        1 => "on one thread".to_owned(),
        count => format!("on {count} threads, {} each", significant(rate / count as f64, 3)),
    };
    let time = match effort.seconds {
        seconds if seconds < 10.0 => format!("{} s", significant(seconds, 2)),
        seconds => duration(seconds),
    };
    format!("{time}: {} runs/s {threads}", significant(rate, 3))
}

/// A kept column in a few words: counts, or mean ± standard deviation and the range.
fn told(column: &Column, spread: &Spread) -> String {
    if column.kind == ColumnKind::Text {
        return counted(spread);
    }
    if spread.count == 0 {
        return "none".to_owned();
    }
    let unit = column.unit.as_deref().filter(|unit| *unit != "1").map_or(String::new(), |unit| format!(" {unit}"));
    let lists = if column.kind == ColumnKind::List { ", in lists" } else { "" };
    let range = format!("{} to {}", significant(spread.least, 4), significant(spread.greatest, 4));
    format!("{} ± {}{unit} ({range}){lists}", significant(spread.mean, 5), significant(spread.deviation(), 3))
}

/// How often each text occurs, the most frequent first.
fn counted(spread: &Spread) -> String {
    let mut counts: Vec<(&String, &u64)> = spread.texts.iter().collect();
    counts.sort_by_key(|(text, count)| (std::cmp::Reverse(**count), *text));
    let more =
        if counts.len() > MOST_LISTED { format!(", and {} more", counts.len() - MOST_LISTED) } else { String::new() };
    let listed = counts.iter().take(MOST_LISTED).map(|(text, count)| format!("{count} {text}"));
    listed.collect::<Vec<_>>().join(", ") + &more
}
