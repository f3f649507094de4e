//! Files that a scene names: those of a folder, or some that were handed over, where there are no folders.

use std::collections::BTreeMap;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Where the files are that a scene names.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Files {
    /// Below a folder, to which names are relative.
    Folder(PathBuf),
    /// Handed over.
    Given(GivenFiles),
}

/// The contents of files by name, without folders: a name in a scene is met by what stands behind its last slash.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct GivenFiles(Arc<BTreeMap<String, Arc<[u8]>>>);

impl GivenFiles {
    /// Takes a file in the place of the one of this name.
    pub fn give(&mut self, name: &str, content: Vec<u8>) {
        Arc::make_mut(&mut self.0).insert(last_part(name).to_owned(), content.into());
    }

    fn get(&self, name: &str) -> io::Result<&[u8]> {
        let found = self.0.get(last_part(name)).map(|content| &**content);
        found.ok_or_else(|| io::Error::new(ErrorKind::NotFound, "there is no such file in this page yet"))
    }
}

impl Files {
    /// The folder; empty where files are handed over.
    pub fn folder(&self) -> &Path {
        match self {
            Self::Folder(folder) => folder,
            Self::Given(_) => Path::new(""),
        }
    }

    /// What messages call a file, and where it is in a folder.
    pub fn path(&self, name: &str) -> PathBuf {
        self.folder().join(name)
    }

    /// The content of a file that was handed over; none of a folder, whose files are read by their path.
    ///
    /// # Errors
    /// `NotFound` in words.
    pub fn given(&self, name: &str) -> Option<io::Result<&[u8]>> {
        match self {
            Self::Folder(_) => None,
            Self::Given(files) => Some(files.get(name)),
        }
    }

    /// What to do about a file that cannot be read.
    pub fn help(&self) -> &'static str {
        match self {
            Self::Folder(_) => "the path is relative to the folder of the scene",
            Self::Given(_) => "drop the file on the page, or choose it there",
        }
    }
}

impl From<&Path> for Files {
    fn from(folder: &Path) -> Self {
        Self::Folder(folder.to_owned())
    }
}

impl From<GivenFiles> for Files {
    fn from(files: GivenFiles) -> Self {
        Self::Given(files)
    }
}

/// What stands behind the last slash, of either kind.
fn last_part(name: &str) -> &str {
    name.rsplit(['/', '\\']).next().unwrap_or(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_given_is_found_whatever_folder_a_scene_names() {
        let mut given = GivenFiles::default();
        given.give("rock.stl", vec![1]);
        let kept = Files::from(given.clone());
        given.give("rock.stl", vec![2]);
        let files = Files::from(given);
        let content = |files: &Files, name: &str| files.given(name).unwrap().map(<[u8]>::to_vec);
        assert_eq!(content(&files, "meshes/rock.stl").unwrap(), [2]);
        assert_eq!(content(&kept, r"..\rock.stl").unwrap(), [1]);
        let missing = content(&files, "meshes/other.stl").unwrap_err();
        assert_eq!(missing.kind(), ErrorKind::NotFound);
        assert!(crate::in_words(&missing).contains("in this page") && files.help().contains("drop"));
    }

    #[test]
    fn files_of_a_folder_are_not_given() {
        let files = Files::from(Path::new("folder"));
        assert!(files.given("rock.stl").is_none());
        assert_eq!(files.path("rock.stl"), Path::new("folder/rock.stl"));
    }
}
