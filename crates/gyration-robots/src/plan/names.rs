//! Names as a scene has them: letters, digits, `_` and `-`, each once.

use crate::report::Report;
use std::collections::BTreeMap;

/// The name by which joints call the world.
const SPACE: &str = "space";

/// The names that are taken, each with the number that was given last to one more thing of that name.
#[derive(Debug, Default)]
pub(super) struct Names(BTreeMap<String, usize>);

impl Names {
    /// A name for what the file calls so; tells where it is another.
    pub fn take(&mut self, written: &str, line: usize, report: &mut Report) -> String {
        let letter = |c: char| if c.is_ascii_alphanumeric() || c == '_' || c == '-' { c } else { '_' };
        let plain: String = written.chars().map(letter).collect();
        let plain = if plain.is_empty() { "unnamed".to_owned() } else { plain };
        let mut name = plain.clone();
        while name == SPACE || self.0.contains_key(&name) {
            let last = self.0.entry(plain.clone()).or_insert(1);
            *last += 1;
            name = format!("{plain}-{last}");
        }
        if name != written {
            let why = "names of a scene have letters, digits, `_` and `-`, and each is one thing's";
            report.choose(Some(line), format!("\"{written}\" is called \"{name}\""), why);
        }
        self.0.insert(name.clone(), 1);
        name
    }
}
