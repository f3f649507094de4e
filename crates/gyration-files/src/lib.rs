//! Files that others made, and texts that stand in them.
//!
//! [`open`] opens a regular file and nothing else: to open a pipe waits for whoever writes into it, for ever if nobody
//! does. [`printable`] takes from a text what a terminal would obey. [`in_words`] says why the system refuses
//! something, [`line_of_row`] where a row of a table stands. [`check`] has the checksums by which damage is told,
//! [`Files`] finds what a scene names.

#![forbid(unsafe_code)]

mod beside;
pub mod check;
mod words;

pub use beside::{Files, GivenFiles};
pub use words::in_words;

use std::borrow::Cow;
use std::fmt::Write as _;
use std::fs::{self, File, FileType};
use std::io::{self, ErrorKind, Read};
use std::path::Path;

/// Opens a file for reading, or refuses at once what is none: a folder, a pipe, a device, a socket.
///
/// # Errors
/// Those of the system; `InvalidInput` in words that go on from the path, with a fix.
pub fn open(path: &Path) -> io::Result<File> {
    let found = fs::metadata(path)?.file_type();
    match not_a_file(found) {
        Some(what) => Err(io::Error::new(ErrorKind::InvalidInput, format!("it is {what}"))),
        None => File::open(path),
    }
}

/// Reads a whole file, which [`open`] opens.
///
/// # Errors
/// Those of [`open`], and of reading.
pub fn read(path: &Path) -> io::Result<Vec<u8>> {
    let mut file = open(path)?;
    let mut bytes = Vec::with_capacity(file.metadata().map_or(0, |found| usize::try_from(found.len()).unwrap_or(0)));
    file.read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Opens a file of ours to write at its end, or makes it. A link is refused too: who laid it could have us write
/// anywhere.
///
/// # Errors
/// As of [`open`].
pub fn open_to_append(path: &Path) -> io::Result<File> {
    match path.symlink_metadata().ok().and_then(|found| not_a_file(found.file_type())) {
        Some(what) => Err(io::Error::new(ErrorKind::InvalidInput, format!("it is {what}"))),
        None => File::options().append(true).create(true).open(path),
    }
}

/// What is there instead of a file, and what to do about it; none of a file.
pub fn not_a_file(found: FileType) -> Option<&'static str> {
    if found.is_file() {
        None
    } else if found.is_dir() {
        Some("a folder, not a file: name a file in it")
    } else if found.is_symlink() {
        Some("a link, not a file: put in its place what it points to")
    } else {
        Some("a pipe, a device or a socket, not a file: save what it gives in a file and name that")
    }
}

/// Begins a line of a table that is passed over.
pub const REMARK: u8 = b'#';

/// The line, from 1, of the first row of a table behind a byte: blank lines and remarks are passed over.
pub fn line_of_row(content: &[u8], start: usize) -> u64 {
    let (before, behind) = content.split_at(start.min(content.len()));
    let skipped = |line: &&[u8]| line.trim_ascii().is_empty() || line.first() == Some(&REMARK);
    let blank = behind.split(|byte| *byte == b'\n').take_while(skipped).count();
    (1 + before.iter().filter(|byte| **byte == b'\n').count() + blank) as u64
}

/// A text as it may go to a terminal: control characters are written as their codes, `\u001b`, which say the same in a
/// text of JSON or TOML. Ends of lines and tabs stay.
pub fn printable(text: &str) -> Cow<'_, str> {
    if !text.contains(is_obeyed) {
        return Cow::Borrowed(text);
    }
    let mut shown = String::with_capacity(text.len() + 16);
    for letter in text.chars() {
        if is_obeyed(letter) {
            // A string takes whatever it is given.
            let _ = write!(shown, "\\u{:04x}", u32::from(letter));
        } else {
            shown.push(letter);
        }
    }
    Cow::Owned(shown)
}

/// Whether a terminal obeys a character where it should show it.
fn is_obeyed(letter: char) -> bool {
    letter.is_control() && !matches!(letter, '\n' | '\t')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_terminal_is_told_nothing_but_letters() {
        assert_eq!(printable("käse\n\t½"), "käse\n\t½");
        assert_eq!(printable("a\u{1b}]0;b\u{7}\rc\u{9b}d"), r"a\u001b]0;b\u0007\u000dc\u009bd");
    }

    #[test]
    fn a_row_stands_behind_remarks_and_blank_lines() {
        let table = b"t,x\n# a\n\n0,1\n1,2";
        assert_eq!([0, 4, 9, 13].map(|start| line_of_row(table, start)), [1, 4, 4, 5]);
    }

    #[test]
    fn only_a_file_is_opened() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("file");
        fs::write(&path, "content").unwrap();
        assert_eq!(read(&path).unwrap(), b"content");
        let refused = open(folder.path()).unwrap_err().to_string();
        assert!(refused.contains("a folder") && refused.contains("name a file in it"), "{refused}");
        assert_eq!(open(&folder.path().join("none")).unwrap_err().kind(), ErrorKind::NotFound);
    }

    #[cfg(unix)]
    #[test]
    fn a_pipe_and_a_device_are_refused_before_they_are_opened() {
        let folder = tempfile::tempdir().unwrap();
        let pipe = folder.path().join("pipe");
        assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        // A link to a file is as good as the file; a link to a pipe is not.
        let link = folder.path().join("link");
        std::os::unix::fs::symlink(&pipe, &link).unwrap();
        for path in [&pipe, &link] {
            assert!(open_to_append(path).unwrap_err().to_string().starts_with("it is a "));
        }
        for path in [&pipe, &link, Path::new("/dev/zero")] {
            let refused = read(path).unwrap_err().to_string();
            assert!(refused.contains("a pipe, a device or a socket") && refused.contains("save what"), "{refused}");
        }
    }
}
