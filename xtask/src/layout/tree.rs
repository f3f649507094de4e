//! The modules of a crate, and which of them import which.
//!
//! Modules are compared where they stand side by side: of the children of one module, A imports B if a file in or under
//! A names a path that leads into B, straight or by a name that their parent hands on. What a parent takes from its
//! children is no import: it is made of them.

use super::paths::{handed_on, paths, stripped};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// A module by its parts; empty for the root of the crate.
pub type Module = Vec<String>;

/// The sources of a crate without its tests, by module.
#[derive(Debug, Default)]
pub struct ModuleTree {
    sources: BTreeMap<Module, String>,
}

/// Of each module that has children: which child imports which.
pub type Imports = BTreeMap<Module, BTreeMap<String, BTreeSet<String>>>;

impl ModuleTree {
    /// Reads a crate: `source` is its folder `src`.
    pub fn read(source: &Path) -> Self {
        let mut tree = Self::default();
        for root in ["lib.rs", "main.rs"] {
            if let Ok(text) = fs::read_to_string(source.join(root)) {
                tree.take(source, Vec::new(), &text);
            }
        }
        tree
    }

    /// Takes in a module and, from the files beside it, those that it declares.
    fn take(&mut self, folder: &Path, module: Module, source: &str) {
        let text = stripped(source);
        for line in text.lines() {
            let declared = line.trim().strip_suffix(';').and_then(|line| line.rsplit_once("mod "));
            let Some((before, name)) = declared.filter(|(before, _)| before.is_empty() || before.starts_with("pub"))
            else {
                continue;
            };
            debug_assert!(before.len() < 20, "{line}");
            let name = name.trim_start_matches("r#");
            let child: Module = module.iter().cloned().chain([name.to_owned()]).collect();
            let places = [folder.join(format!("{name}.rs")), folder.join(name).join("mod.rs")];
            if let Some(text) = places.iter().find_map(|place| fs::read_to_string(place).ok()) {
                self.take(&folder.join(name), child, &text);
            }
        }
        self.sources.entry(module).or_default().push_str(&text);
    }

    /// Which modules import which, wherever modules stand side by side.
    pub fn imports(&self) -> Imports {
        let handed: BTreeMap<(&Module, String), Module> = self
            .sources
            .iter()
            .flat_map(|(module, text)| {
                handed_on(text).into_iter().map(move |(name, path)| ((module, name), self.absolute(module, &path)))
            })
            .collect();
        let mut imports = Imports::new();
        for (module, text) in &self.sources {
            for path in paths(text) {
                let target = self.followed(self.absolute(module, &path), &handed);
                let common = module.iter().zip(&target).take_while(|(a, b)| a == b).count();
                // One of them is the other's parent, or they are the same.
                let (Some(importer), Some(imported)) = (module.get(common), target.get(common)) else { continue };
                if self.sources.contains_key(&target[..=common]) {
                    let children = imports.entry(target[..common].to_vec()).or_default();
                    children.entry(importer.clone()).or_default().insert(imported.clone());
                }
            }
        }
        imports
    }

    /// A path from the root of the crate on.
    fn absolute(&self, module: &Module, path: &[String]) -> Module {
        let mut absolute = module.clone();
        for (place, part) in path.iter().enumerate() {
            match part.as_str() {
                "crate" if place == 0 => absolute.clear(),
                "self" if place == 0 => {}
                "super" => drop(absolute.pop()),
                _ => absolute.push(part.split(" as ").next().unwrap_or_default().to_owned()),
            }
        }
        absolute
    }

    /// Where a path leads if a module on its way hands the next name on.
    fn followed(&self, mut path: Module, handed: &BTreeMap<(&Module, String), Module>) -> Module {
        for _ in 0..8 {
            let known = (0..path.len()).rev().find(|length| self.sources.contains_key(&path[..*length]));
            let Some(length) = known.filter(|_| !self.sources.contains_key(&path)) else { break };
            let module = path[..length].to_vec();
            let Some(target) = handed.get(&(&module, path[length].clone())) else { break };
            path = target.iter().chain(&path[length + 1..]).cloned().collect();
        }
        path
    }
}

/// The circles among modules side by side: groups in which each leads to each.
pub fn circles(imports: &BTreeMap<String, BTreeSet<String>>) -> BTreeSet<BTreeSet<String>> {
    let reached = |from: &String| {
        let (mut seen, mut next) = (BTreeSet::new(), vec![from]);
        while let Some(module) = next.pop() {
            next.extend(imports.get(module).into_iter().flatten().filter(|to| seen.insert((*to).clone())));
        }
        seen
    };
    let all: BTreeMap<&String, BTreeSet<String>> = imports.keys().map(|module| (module, reached(module))).collect();
    let mutual = |module: &String, to: &String| all.get(to).is_some_and(|back| back.contains(module));
    let mut circles = BTreeSet::new();
    for (module, reached) in &all {
        let circle: BTreeSet<String> = reached.iter().filter(|to| mutual(module, to)).cloned().collect();
        if circle.len() > 1 {
            circles.insert(circle);
        }
    }
    circles
}

#[cfg(test)]
mod tests {
    use super::*;

    fn crate_of(files: &[(&str, &str)]) -> Imports {
        let mut tree = ModuleTree::default();
        for (module, text) in files {
            let module = module.split("::").filter(|part| !part.is_empty()).map(String::from).collect();
            tree.sources.insert(module, (*text).to_owned());
        }
        tree.imports()
    }

    fn set(names: &[&str]) -> BTreeSet<String> {
        names.iter().map(ToString::to_string).collect()
    }

    #[test]
    fn a_circle_by_a_name_that_is_handed_on_is_found() {
        let imports =
            crate_of(&[("", "mod a;\nmod b;\npub use a::A;\n"), ("a", "use crate::b::B;\n"), ("b", "use crate::A;\n")]);
        assert_eq!(circles(&imports[&Vec::new()]), [set(&["a", "b"])].into());
    }

    #[test]
    fn parents_and_children_are_no_circle_but_siblings_are_compared() {
        let imports = crate_of(&[
            ("", "mod a;"),
            ("a", "mod x;\nmod y;\nuse x::X;\n"),
            ("a::x", "use super::A;\nuse super::y::Y;\n"),
            ("a::y", "use super::A;\n"),
        ]);
        assert_eq!(imports.len(), 1);
        let children = &imports[&vec!["a".to_owned()]];
        assert_eq!(children, &BTreeMap::from([("x".to_owned(), set(&["y"]))]));
        assert!(circles(children).is_empty());
    }
}
