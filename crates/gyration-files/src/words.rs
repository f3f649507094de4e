//! Why the system refuses something, in words of our own.
//!
//! What the library says ends with a number of the system, `(os error 28)`, and is in the words of a manual for
//! programmers.

use std::io::{self, ErrorKind};

/// Why the system refuses, in words that go on from "cannot write PATH: ".
///
/// What was said in words already, as by [`open`](crate::open), is said in these.
pub fn in_words(error: &io::Error) -> String {
    if error.get_ref().is_some() {
        return error.to_string();
    }
    let known = of_kind(error.kind()).or_else(|| error.raw_os_error().and_then(of_number));
    match (known, error.raw_os_error()) {
        (Some(words), _) => words.to_owned(),
        // The library has a kind of its own for what it does not know.
        (None, Some(number)) if error.kind().to_string().contains("uncategorized") => {
            format!("the system refuses it, for reason number {number}")
        }
        (None, _) => error.kind().to_string(),
    }
}

fn of_kind(kind: ErrorKind) -> Option<&'static str> {
    Some(match kind {
        ErrorKind::NotFound => "there is no such file or folder",
        ErrorKind::PermissionDenied => "you have not the permission",
        ErrorKind::StorageFull => "the disk is full",
        ErrorKind::QuotaExceeded => "your share of the disk is full",
        ErrorKind::FileTooLarge => "the file would be larger than the system allows",
        ErrorKind::ReadOnlyFilesystem => "the disk can only be read",
        ErrorKind::AlreadyExists => "something of that name is there already",
        ErrorKind::IsADirectory => "it is a folder, not a file",
        ErrorKind::NotADirectory => "what should be a folder on the way to it is none",
        ErrorKind::DirectoryNotEmpty => "the folder is not empty",
        ErrorKind::InvalidFilename => "the name is too long, or has characters that it must not have",
        ErrorKind::ResourceBusy | ErrorKind::ExecutableFileBusy => "another program is using it",
        ErrorKind::CrossesDevices => "it is on another disk",
        ErrorKind::OutOfMemory => "there is not enough memory",
        ErrorKind::BrokenPipe => "nobody reads it any more",
        ErrorKind::UnexpectedEof => "it ends too early",
        ErrorKind::AddrInUse => "another program is using it",
        ErrorKind::AddrNotAvailable => "this machine has no such address",
        ErrorKind::TimedOut => "it took too long",
        ErrorKind::Interrupted => "it was interrupted",
        ErrorKind::Unsupported => "the system cannot do that",
        ErrorKind::StaleNetworkFileHandle => "the disk on the network has lost it",
        _ => return None,
    })
}

/// Reasons without a kind, by their numbers on Unix; those up to 34 have been the same since Version 7.
#[cfg(unix)]
fn of_number(number: i32) -> Option<&'static str> {
    match number {
        5 => Some("the disk or device failed"),
        6 | 19 => Some("there is no such device"),
        23 | 24 => Some("too many files are open"),
        _ => None,
    }
}

#[cfg(not(unix))]
fn of_number(_: i32) -> Option<&'static str> {
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_usual_reasons_have_words_of_our_own() {
        let said = |kind: ErrorKind| in_words(&kind.into());
        assert_eq!(said(ErrorKind::NotFound), "there is no such file or folder");
        assert_eq!(said(ErrorKind::StorageFull), "the disk is full");
        assert_eq!(said(ErrorKind::IsADirectory), "it is a folder, not a file");
        // A kind without words of ours is told by its name.
        assert_eq!(said(ErrorKind::HostUnreachable), ErrorKind::HostUnreachable.to_string());
        assert_eq!(in_words(&io::Error::other("it is a link")), "it is a link");
    }

    #[cfg(unix)]
    #[test]
    fn no_number_of_the_system_and_none_of_its_words_come_through() {
        for number in 1..=140 {
            let error = io::Error::from_raw_os_error(number);
            let said = in_words(&error);
            assert!(!said.contains("os error") && !said.contains("uncategorized"), "{number}: {said}");
            assert!(!error.to_string().starts_with(&said), "{number}: {said}");
        }
        assert_eq!(in_words(&io::Error::from_raw_os_error(24)), "too many files are open");
        assert_eq!(in_words(&io::Error::from_raw_os_error(28)), "the disk is full");
        assert_eq!(in_words(&io::Error::from_raw_os_error(36)), in_words(&ErrorKind::InvalidFilename.into()));
    }
}
