//! Joints, well formed or not, that name a body that is not there, a support, or nothing that moves.

use super::Reporter;
use super::named::Named;
use crate::key::Key;
use crate::suggest;
use crate::tree::Node;

/// The word of `between` for space.
pub(crate) const SPACE: &str = "space";

/// Notes what the ends of joints are called that they cannot be.
pub(super) fn ends(supports: &Named, bodies: &Named, reporter: &mut Reporter<'_>) {
    let joints = Key::root().key("joint");
    let document = reporter.document;
    let items = document.root.get("joint").map(Node::items).unwrap_or_default();
    for (index, item) in items.iter().enumerate() {
        let key = joints.index(index).key("between");
        let ends = item.get("between").map(Node::items).unwrap_or_default();
        let names: Vec<Option<&str>> = ends.iter().map(Node::text).collect();
        for (end, (node, name)) in ends.iter().zip(&names).enumerate() {
            if reporter.diagnostics.is_full() {
                return;
            }
            let Some(name) = name else { continue };
            let is_twice = names[..end].contains(&Some(name));
            let (message, help) = if *name == SPACE && !bodies.has(SPACE) {
                if !is_twice {
                    continue;
                }
                ("both ends are \"space\": the joint closes nothing".to_owned(), "name a body".to_owned())
            } else if supports.has(name) && !bodies.has(name) {
                let message = format!("\"{name}\" is a support: this version has no joints to supports");
                (message, "write \"space\" and a place, if the support does not move".to_owned())
            } else if bodies.lacks(name) {
                let known = bodies.iter().chain([SPACE]);
                (format!("there is no body \"{name}\""), suggest::fix(name, known, "one of"))
            } else if is_twice {
                let help = "name two different bodies, or a body and \"space\"";
                (format!("both ends are at the body \"{name}\": the joint closes nothing"), help.to_owned())
            } else {
                continue;
            };
            reporter.diagnostics.at(node.span, &key.index(end), message, help);
        }
    }
}
