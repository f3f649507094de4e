//! Commands that the pages of the book print: each is one that the program understands.
//!
//! Read are lines of code and spans between backticks that begin with `gyration`; a line of code that ends in `\` goes
//! on in the next. What follows two blanks or `#` is an explanation, brackets stand around what may be left out, `|`
//! between alternatives, capitals for names.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::arguments::Arguments;
use clap::Parser;
use clap::error::ErrorKind;
use std::fs;
use std::path::{Path, PathBuf};

fn pages() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let entries = fs::read_dir(root.join("docs")).unwrap().map(|entry| entry.unwrap().path());
    let pages = entries.filter(|path| path.extension().is_some_and(|end| end == "md"));
    pages.chain([root.join("README.md")]).collect()
}

/// The commands of a page.
fn commands(text: &str) -> Vec<String> {
    let (mut commands, mut prose, mut in_code) = (Vec::new(), String::new(), false);
    for line in whole_lines(text).lines() {
        let fence = line.trim_start().starts_with("```");
        in_code ^= fence;
        if in_code || line.starts_with("    ") {
            commands.extend(line.trim_start().starts_with("gyration ").then(|| explained(line.trim()).to_owned()));
        } else if !fence {
            prose.push_str(line);
            prose.push(' ');
        }
    }
    let spans = prose.split('`').skip(1).step_by(2);
    commands.extend(spans.filter(|span| span.starts_with("gyration ")).map(str::to_owned));
    commands
}

/// A text whose lines that go on are one.
fn whole_lines(text: &str) -> String {
    let mut parts = text.split("\\\n");
    let first = parts.next().unwrap_or_default().to_owned();
    parts.fold(first, |whole, part| whole + part.trim_start())
}

/// A line without its explanation.
fn explained(line: &str) -> &str {
    let ends = ["  ", " #"].into_iter().filter_map(|end| line.find(end));
    &line[..ends.min().unwrap_or(line.len())]
}

/// The words of a command; of alternatives the first.
fn words(command: &str) -> Vec<String> {
    let (mut words, mut word, mut quote) = (Vec::new(), String::new(), None);
    for character in command.chars().chain([' ']) {
        match (character, quote) {
            ('\'' | '"', None) => quote = Some(character),
            (end, Some(open)) if end == open => quote = None,
            (' ', None) => words.extend((!word.is_empty()).then(|| std::mem::take(&mut word))),
            ('[' | ']', None) if !word.contains('=') => {}
            (other, _) => word.push(other),
        }
    }
    let end = words.iter().position(|word| matches!(word.as_str(), "|" | ">" | "&&")).unwrap_or(words.len());
    words.truncate(end);
    words.retain(|word| word != "…");
    // A variable at the end of a line may be empty.
    words.pop_if(|word| word.starts_with('$'));
    let first = |word: &String| match word.split_once('|') {
        Some((first, _)) if !first.contains('=') => first.to_owned(),
        // A variable of a shell may be a number.
        _ if word.starts_with('$') => "1".to_owned(),
        _ => word.clone(),
    };
    words.iter().map(first).collect()
}

/// That a command or an option is not there, or cannot have this value; what is left out is no fault.
fn refusal(words: &[String]) -> Option<String> {
    let refusal = Arguments::try_parse_from(words).err()?;
    let said = refusal.to_string();
    let is_short = refusal.kind() == ErrorKind::MissingRequiredArgument || said.contains("a value is required");
    (refusal.use_stderr() && !is_short).then(|| said.lines().next().unwrap_or_default().to_owned())
}

#[test]
fn commands_of_the_pages_are_understood() {
    let (mut count, mut wrong) = (0, Vec::new());
    for page in pages() {
        for command in commands(&fs::read_to_string(&page).unwrap()) {
            count += 1;
            let refusal = refusal(&words(&command));
            wrong.extend(refusal.map(|said| format!("{}: `{command}`: {said}", page.display())));
        }
    }
    assert!(count > 100, "{count} commands were found");
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn an_option_that_is_not_there_is_told() {
    let refused = |command: &str| refusal(&words(command)).is_some();
    assert!(!refused("gyration run") && !refused("gyration run SCENE --resume"));
    assert!(refused("gyration run dice --resumed") && refused("gyration runs dice"));
}

#[test]
fn commands_are_read_as_a_shell_reads_them() {
    let text = "`gyration run\na.toml` `other`\n```\ngyration run dice \\\n    --set a='[1, 0]'  # so\n```\n";
    assert_eq!(commands(text), ["gyration run dice --set a='[1, 0]'", "gyration run a.toml"]);
    assert_eq!(words("gyration run dice --set a='[1, 0]'"), ["gyration", "run", "dice", "--set", "a=[1, 0]"]);
    assert_eq!(
        words("gyration export D --format csv|npz [-o X] | less"),
        ["gyration", "export", "D", "--format", "csv", "-o", "X"]
    );
}
