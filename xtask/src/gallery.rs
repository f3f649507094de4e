//! The page of the gallery: every scene with its picture, made by running it.
//!
//! The words come from the scenes themselves: titles as `gyration scenes` lists them, and what to look at as it stands
//! at the head of each file. So the page cannot tell of another scene than the one that runs.

use crate::cargo::cargo;
use crate::root;
use crate::steps::Steps;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

/// A scene as the program lists it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ListedScene {
    name: String,
    title: String,
    /// What to look at.
    text: String,
}

/// The scene that moves in the README.
const MOVING: &str = "climber";

/// The page of the gallery.
fn page_path() -> PathBuf {
    root().join("docs/gallery.md")
}

fn picture_path(name: &str) -> PathBuf {
    root().join(format!("docs/pictures/{name}.svg"))
}

/// Runs the scenes named, or all, draws their strips and writes the page.
pub fn run(names: &[&str]) -> ExitCode {
    let mut steps = Steps::default();
    match list(program()) {
        Err(reason) => steps.complain(reason),
        Ok(entries) => {
            for entry in entries.iter().filter(|entry| names.is_empty() || names.contains(&entry.name.as_str())) {
                draw(&mut steps, &entry.name);
            }
            if let Some(name) = names.iter().find(|name| entries.iter().all(|entry| entry.name != **name)) {
                steps.complain(format!("the gallery has no scene `{name}`"));
            }
            if let Err(error) = std::fs::write(page_path(), page(&entries)) {
                steps.complain(format!("{}: {error}", page_path().display()));
            }
        }
    }
    if steps.is_clean() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// Complains about a page that is not the one that the scenes give, and about pictures that are missing.
pub fn check(steps: &mut Steps, program: &Path) {
    let entries = match list(Command::new(program)) {
        Ok(entries) => entries,
        Err(reason) => return steps.complain(reason),
    };
    let written = std::fs::read_to_string(page_path()).unwrap_or_default();
    if written != page(&entries) {
        steps.complain("docs/gallery.md is out of step with the scenes (run `cargo xtask gallery`)".into());
    }
    for entry in entries.iter().filter(|entry| !picture_path(&entry.name).exists()) {
        steps.complain(format!("`{0}` has no picture (run `cargo xtask gallery {0}`)", entry.name));
    }
}

/// Runs a scene and draws its strip.
fn draw(steps: &mut Steps, name: &str) {
    let folder = crate::target_directory().join("gallery");
    if let Err(error) = std::fs::create_dir_all(&folder) {
        return steps.complain(format!("{}: {error}", folder.display()));
    }
    let recording = folder.join(format!("{name}.gyr"));
    let mut run = program();
    run.args(["run", name, "--quiet", "--force", "-o"]).arg(&recording);
    let mut plot = program();
    plot.arg("plot").arg(&recording).args(["strip", "-o"]).arg(picture_path(name));
    if steps.run(&format!("run {name}"), &mut run) {
        steps.run(&format!("draw {name}"), &mut plot);
        if name == MOVING {
            let mut motion = program();
            motion.arg("plot").arg(&recording).args(["motion", "-o"]).arg(picture_path(&format!("{MOVING}-motion")));
            steps.run(&format!("draw {name} as it moves"), &mut motion);
        }
    }
}

/// The program, built for speed.
fn program() -> Command {
    let mut command = cargo();
    command.args(["run", "--release", "--quiet", "--package", "gyration-cli", "--"]);
    command
}

/// The scenes, as the program lists them, each with what its file tells.
fn list(command: Command) -> Result<Vec<ListedScene>, String> {
    Ok(entries(listed(command)?, scene_file))
}

/// The names and titles that a program lists.
pub fn listed(mut command: Command) -> Result<Vec<(String, String)>, String> {
    let output =
        command.arg("scenes").output().map_err(|error| format!("`gyration scenes` cannot be started: {error}"))?;
    if !output.status.success() {
        return Err(format!("`gyration scenes`: {}", String::from_utf8_lossy(&output.stderr)));
    }
    let titles = titles(&String::from_utf8_lossy(&output.stdout));
    if titles.is_empty() { Err("`gyration scenes` lists nothing".into()) } else { Ok(titles) }
}

/// The names of the scenes that a program lists.
pub fn names(program: Command) -> Result<Vec<String>, String> {
    Ok(listed(program)?.into_iter().map(|(name, _)| name).collect())
}

/// Names and titles from a listing: `name  title`; an empty line ends it. Earlier programs had lines of words below
/// each, indented.
fn titles(listing: &str) -> Vec<(String, String)> {
    let lines = listing.lines().take_while(|line| !line.is_empty()).filter(|line| !line.starts_with(' '));
    let split = |line: &str| {
        let (name, title) = line.split_once(' ').unwrap_or((line, ""));
        (name.to_owned(), title.trim().to_owned())
    };
    lines.map(split).collect()
}

/// The scenes of these names and titles; the file of each tells what to look at.
fn entries(titles: Vec<(String, String)>, file: impl Fn(&str) -> String) -> Vec<ListedScene> {
    let entry = |(name, title): (String, String)| {
        let text = told(&file(&name), &title);
        ListedScene { name, title, text }
    };
    titles.into_iter().map(entry).collect()
}

/// The comment at the beginning of a file; one that begins with the title goes on after it.
fn told(file: &str, title: &str) -> String {
    let comment = file.lines().map_while(|line| line.strip_prefix('#'));
    let head = comment.map(str::trim).collect::<Vec<_>>().join(" ");
    head.strip_prefix(title).map_or(head.as_str(), |rest| rest.trim_start_matches(['.', ' '])).to_owned()
}

/// The file of a scene.
fn scene_file(name: &str) -> String {
    std::fs::read_to_string(root().join(format!("scenes/{name}.toml"))).unwrap_or_default()
}

fn page(entries: &[ListedScene]) -> String {
    let mut page = String::from(
        "# The gallery\n\n\
         Scenes that run by name: `gyration run NAME`. `gyration scenes NAME` prints the file, to copy and change.\n\
         This page and its pictures are made by `cargo xtask gallery`, which runs every scene and draws\n\
         `gyration plot NAME.gyr strip`; the words stand at the head of each scene.\n\n",
    );
    for ListedScene { name, title, text } in entries {
        let _ = write!(page, "## `{name}`\n\n**{title}.** {text}\n\n![{title}](pictures/{name}.svg)\n\n");
    }
    page.truncate(page.trim_end().len());
    page + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_listing_is_read_back() {
        let listing = "dice    A die thrown\n        in earlier words\nrock-2  A block\n\n`gyration run NAME` runs\n";
        let files = |name: &str| match name {
            "dice" => "# A die thrown. Look at it,\n# and again.\n\n# Not this.\ntitle = \"A die thrown\"\n".to_owned(),
            _ => String::new(),
        };
        let entry = |name: &str, title: &str, text: &str| ListedScene {
            name: name.into(),
            title: title.into(),
            text: text.into(),
        };
        assert_eq!(
            entries(titles(listing), files),
            [entry("dice", "A die thrown", "Look at it, and again."), entry("rock-2", "A block", "")]
        );
    }

    #[test]
    fn every_scene_has_its_place_on_the_page() {
        let page = page(&entries(titles("a  First\nb  Second\n"), |name| format!("# {name} is told.\n")));
        assert!(page.contains("## `a`\n\n**First.** a is told.\n\n![First](pictures/a.svg)\n\n## `b`"), "{page}");
        assert!(page.ends_with("![Second](pictures/b.svg)\n"));
    }
}
