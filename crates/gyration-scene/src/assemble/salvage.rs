//! What can be said of a body that is not well formed as a whole: the values of its well-formed keys.
//!
//! All errors of a file are to come at once, so that a wrong type in one key must not hide a wrong value in another.
//! The body is built without the keys that something was found against; of what that finds, only that counts which no
//! missing key can have caused.

use super::body::PreparedBody;
use super::context::SceneContext;
use super::solids::Solids;
use crate::check::{Placed, Reporter};
use crate::document::{Diagnostics, Document};
use crate::file::Body;
use crate::key::Key;
use crate::tree::Node;
use std::collections::BTreeSet;

/// Keys whose values are checked by themselves.
const ALONE: [&str; 3] = ["orientation", "mass_properties", "spring"];
/// Expressions, and what they need: constants, and where the body starts.
const OWN: [&str; 5] = ["constants", "potential", "body_force", "force", "linear_friction"];
const PLACE: [&str; 8] =
    ["constants", "shape", "mass_properties", "position", "orientation", "gradient", "contractile", "pin"];
/// What a body is made of needs to know whether it has a volume, which these say.
const VOLUME: [&str; 2] = ["shape", "mass_properties"];
/// The shape is checked together with these: parts of a union may take the body's density.
const WEIGHTS: [&str; 3] = ["density", "mass", "mass_properties"];

/// Notes what is wrong in the well-formed keys of bodies that are not well formed.
pub(crate) fn salvage(document: &Document, context: &SceneContext, diagnostics: &mut Diagnostics) {
    let section = Key::root().key("body");
    let dirty: BTreeSet<Key> = diagnostics.iter().map(|diagnostic| diagnostic.key.clone()).collect();
    for (index, node) in document.root.get("body").map(Node::items).unwrap_or_default().iter().enumerate() {
        let key = section.index(index);
        // What lies inside of a key follows it in the order of keys.
        let is_dirty = |name: &str| {
            let place = key.key(name);
            dirty.range(&place..).next().is_some_and(|found| place.holds(found))
        };
        let mut json = node.to_json();
        let Some(written) = json.as_object_mut() else { continue };
        let before = written.len();
        written.retain(|name, _| !is_dirty(name));
        if written.len() == before {
            continue;
        }
        let mut checked: Vec<&str> = ALONE.into_iter().filter(|name| written.contains_key(*name)).collect();
        if written.contains_key("shape") && !WEIGHTS.iter().any(|name| is_dirty(name)) {
            checked.push("shape");
        }
        if !PLACE.iter().any(|name| is_dirty(name)) {
            checked.extend(OWN.into_iter().filter(|name| written.contains_key(*name)));
        }
        if !VOLUME.iter().any(|name| is_dirty(name)) {
            checked.extend(["affine", "contractile"].into_iter().filter(|name| written.contains_key(*name)));
        }
        let Ok(value) = serde_json::from_value::<Body>(json) else { continue };
        let mut found = Diagnostics::default();
        let (placed, solids) = (Placed { key: key.clone(), number: index, value }, &mut Solids::default());
        let reporter = &mut Reporter::new(document, &mut found);
        if let Some(prepared) = PreparedBody::new(&placed, context, solids, reporter) {
            prepared.alone(index, solids, reporter);
        }
        let counts = |place: &Key| checked.iter().any(|name| key.key(name).holds(place));
        diagnostics.extend(found.into_iter().filter(|f| counts(&f.key) && !dirty.contains(&f.key)));
    }
}
