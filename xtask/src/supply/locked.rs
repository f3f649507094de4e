//! What is locked: the crates of `Cargo.lock` with their licences, the packages of `viewer/package-lock.json`.

use super::list::Package;
use crate::cargo::cargo;
use crate::json::Json;
use crate::root;
use std::collections::{BTreeMap, BTreeSet};

const REGISTRY: &str = "registry+https://github.com/rust-lang/crates.io-index";

/// Everything that is locked; what comes from elsewhere than the registries is an error.
pub fn locked() -> Result<BTreeSet<Package>, String> {
    let read = |path: &str| std::fs::read_to_string(root().join(path)).map_err(|error| format!("{path}: {error}"));
    let mut packages = crates(&read("Cargo.lock")?, &licences()?)?;
    packages.extend(npm_packages(&read("viewer/package-lock.json")?)?);
    Ok(packages)
}

/// The licence of each crate, as it says itself.
fn licences() -> Result<BTreeMap<(String, String), String>, String> {
    let output = cargo().args(["metadata", "--format-version", "1", "--locked"]).output();
    let output = output.map_err(|error| format!("cargo metadata: {error}"))?;
    let told = Json::parse(&String::from_utf8_lossy(&output.stdout)).ok_or("cargo metadata gives no JSON")?;
    let Some(Json::List(packages)) = told.get("packages") else { return Err("cargo metadata has no packages".into()) };
    let text = |package: &Json, key: &str| package.get(key).and_then(Json::text).unwrap_or("unknown").to_owned();
    let entry = |package: &Json| ((text(package, "name"), text(package, "version")), text(package, "license"));
    Ok(packages.iter().map(entry).collect())
}

/// The crates of a lock file that are not of this workspace.
fn crates(lock: &str, licences: &BTreeMap<(String, String), String>) -> Result<BTreeSet<Package>, String> {
    let mut packages = BTreeSet::new();
    for table in lock.split("[[package]]").skip(1) {
        let value = |key: &str| {
            let line = table.lines().find_map(|line| line.strip_prefix(key)?.strip_prefix(" = "))?;
            Some(line.trim_matches('"').to_owned())
        };
        let (Some(name), Some(version)) = (value("name"), value("version")) else {
            return Err("Cargo.lock: a package without name or version".into());
        };
        match value("source") {
            None => continue,
            Some(source) if source == REGISTRY && value("checksum").is_some() => {}
            Some(source) => return Err(format!("{name} {version} comes from {source}, or has no check sum")),
        }
        let licence = licences.get(&(name.clone(), version.clone())).map_or("unknown", String::as_str);
        packages.insert(Package { registry: "cargo".into(), name, version, licence: licence.replace('/', " OR ") });
    }
    Ok(packages)
}

/// The packages of npm, each with a check sum.
fn npm_packages(lock: &str) -> Result<BTreeSet<Package>, String> {
    let lock = Json::parse(lock).ok_or("viewer/package-lock.json: no JSON")?;
    let entries = lock.get("packages").and_then(Json::entries).ok_or("viewer/package-lock.json: no packages")?;
    let mut packages = BTreeSet::new();
    for (place, entry) in entries {
        // The first is the viewer itself.
        let Some((_, name)) = place.rsplit_once("node_modules/") else { continue };
        let text = |key: &str| entry.get(key).and_then(Json::text).map(str::to_owned);
        if text("integrity").is_none() {
            return Err(format!("viewer/package-lock.json: {name} has no check sum"));
        }
        let [version, licence] = ["version", "license"].map(|key| text(key).unwrap_or_else(|| "unknown".into()));
        packages.insert(Package { registry: "npm".into(), name: name.to_owned(), version, licence });
    }
    Ok(packages)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn crates_of_the_registry_are_read_and_others_refused() {
        let own = "[[package]]\nname = \"own\"\nversion = \"0.1.0\"\n";
        let crate_of = |source: &str, sum: &str| {
            format!("version = 4\n\n{own}[[package]]\nname = \"a\"\nversion = \"1.0\"\nsource = \"{source}\"\n{sum}")
        };
        let licences = BTreeMap::from([(("a".to_owned(), "1.0".to_owned()), "MIT/Apache-2.0".to_owned())]);
        let found = crates(&crate_of(REGISTRY, "checksum = \"0\"\n"), &licences).unwrap();
        let words: Vec<String> = found.iter().map(ToString::to_string).collect();
        assert_eq!(words, ["cargo a 1.0 MIT OR Apache-2.0"]);
        assert!(crates(&crate_of(REGISTRY, ""), &licences).is_err());
        assert!(crates(&crate_of("git+https://example.org/a", "checksum = \"0\"\n"), &licences).is_err());
    }

    #[test]
    fn packages_of_npm_need_a_check_sum() {
        let lock = |sum: &str| {
            format!(
                r#"{{"packages": {{"": {{}}, "node_modules/@x/y": {{"version": "1.2.3", "license": "MIT"{sum}}}}}}}"#
            )
        };
        let found = npm_packages(&lock(r#", "integrity": "sha512-0""#)).unwrap();
        assert_eq!(found.first().map(ToString::to_string).as_deref(), Some("npm @x/y 1.2.3 MIT"));
        assert!(npm_packages(&lock("")).is_err());
    }
}
