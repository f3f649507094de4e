//! Names as a scene has them: letters, digits, `_` and `-`, each once.

use crate::report::Report;
use std::collections::BTreeSet;

/// The names that are taken.
#[derive(Debug, Default)]
pub(super) struct Names(BTreeSet<String>);

impl Names {
    /// A name for what the file calls so; tells where it is another.
    pub fn take(&mut self, written: &str, line: usize, report: &mut Report) -> String {
        let letter = |c: char| if c.is_ascii_alphanumeric() || c == '_' || c == '-' { c } else { '_' };
        let plain: String = written.chars().map(letter).collect();
        let plain = if plain.is_empty() { "unnamed".to_owned() } else { plain };
        let candidates = std::iter::once(plain.clone()).chain((2_usize..).map(|number| format!("{plain}-{number}")));
        // `space` is what joints call the world.
        let free = candidates.filter(|name| name != "space" && !self.0.contains(name)).take(1).last();
        let name = free.unwrap_or(plain);
        if name != written {
            let why = "names of a scene have letters, digits, `_` and `-`, and each is one thing's";
            report.choose((line > 0).then_some(line), format!("\"{written}\" is called \"{name}\""), why);
        }
        self.0.insert(name.clone());
        name
    }
}
