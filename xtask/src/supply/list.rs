//! The list of packages that somebody has looked up: remarks, then a line a package, `REGISTRY NAME VERSION LICENCE`.

use std::collections::BTreeSet;
use std::fmt;

/// A package of a registry.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Package {
    /// `cargo` or `npm`.
    pub registry: String,
    /// Its name.
    pub name: String,
    /// Its version.
    pub version: String,
    /// Its licence, as an expression of SPDX.
    pub licence: String,
}

impl fmt::Display for Package {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { registry, name, version, licence } = self;
        write!(formatter, "{registry} {name} {version} {licence}")
    }
}

/// The list.
#[derive(Debug, PartialEq, Eq)]
pub struct List {
    remarks: Vec<String>,
    packages: BTreeSet<Package>,
}

impl List {
    /// Reads it.
    pub fn parse(text: &str) -> Self {
        let (remarks, lines): (Vec<&str>, Vec<&str>) = text.lines().partition(|line| line.starts_with('#'));
        let package = |line: &&str| {
            let mut words = line.splitn(4, ' ').map(str::to_owned);
            Some(Package {
                registry: words.next()?,
                name: words.next()?,
                version: words.next()?,
                licence: words.next()?,
            })
        };
        let packages = lines.iter().filter_map(package).collect();
        Self { remarks: remarks.into_iter().map(str::to_owned).collect(), packages }
    }

    /// The same remarks over other packages.
    pub fn with(self, packages: BTreeSet<Package>) -> Self {
        Self { packages, ..self }
    }

    /// The list as it is written.
    pub fn text(&self) -> String {
        let lines = self.remarks.iter().cloned().chain(self.packages.iter().map(ToString::to_string));
        lines.map(|line| line + "\n").collect()
    }

    /// What is locked and not on the list, and what is on the list only.
    pub fn differences(&self, locked: &BTreeSet<Package>) -> Vec<String> {
        let new = locked.difference(&self.packages).map(|package| format!("not looked up: {package}"));
        let gone = self.packages.difference(locked).map(|package| format!("no longer locked: {package}"));
        new.chain(gone).collect()
    }

    /// Crates whose licence is not allowed; what npm brings builds and tests the page only.
    pub fn refused(&self, allowed: &BTreeSet<String>) -> Vec<String> {
        let crates = self.packages.iter().filter(|package| package.registry == "cargo");
        let refused = crates.filter(|package| !is_allowed(&package.licence, allowed));
        refused.map(|package| format!("its licence is not allowed: {package}")).collect()
    }
}

/// Whether one of the choices of an expression has allowed licences only.
fn is_allowed(expression: &str, allowed: &BTreeSet<String>) -> bool {
    // Brackets are found around choices only: `(A OR B) AND C`.
    let every = |part: &str| part.split(" OR ").any(|licence| allowed.contains(licence.trim_matches(['(', ')', ' '])));
    if expression.contains('(') {
        expression.split(" AND ").all(every)
    } else {
        expression.split(" OR ").any(|choice| choice.split(" AND ").all(every))
    }
}

/// The licences that `deny.toml` allows.
pub fn allowed(deny: &str) -> BTreeSet<String> {
    let lines = deny.lines().skip_while(|line| !line.starts_with("allow = [")).take_while(|line| *line != "]");
    let quoted = lines.filter_map(|line| line.trim().strip_prefix('"')?.split_once('"'));
    quoted.map(|(licence, _)| licence.to_owned()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "# looked up\ncargo a 1.0 MIT OR Apache-2.0\nnpm b 2.0 MPL-2.0\n";

    #[test]
    fn a_list_is_read_as_it_is_written() {
        assert_eq!(List::parse(TEXT).text(), TEXT);
    }

    #[test]
    fn what_is_new_and_what_is_gone_is_told() {
        let list = List::parse(TEXT);
        let locked = List::parse("cargo a 1.1 MIT OR Apache-2.0\nnpm b 2.0 MPL-2.0\n").packages;
        let told = list.differences(&locked);
        assert_eq!(
            told,
            ["not looked up: cargo a 1.1 MIT OR Apache-2.0", "no longer locked: cargo a 1.0 MIT OR Apache-2.0"]
        );
        assert!(list.differences(&list.packages).is_empty());
    }

    #[test]
    fn licences_are_those_allowed() {
        let allowed = allowed("x\nallow = [\n    \"MIT\",\n    # why\n    \"Zlib\",\n]\nother = [\n    \"GPL\",\n]\n");
        assert_eq!(allowed, ["MIT", "Zlib"].map(String::from).into());
        for (expression, is) in [
            ("MIT OR GPL", true),
            ("GPL", false),
            ("MIT AND Zlib", true),
            ("MIT AND GPL", false),
            ("(MIT OR GPL) AND Zlib", true),
            ("(MIT OR GPL) AND GPL", false),
        ] {
            assert_eq!(is_allowed(expression, &allowed), is, "{expression}");
        }
        assert_eq!(List::parse("cargo a 1.0 GPL\nnpm b 2.0 GPL\n").refused(&allowed).len(), 1);
    }
}
