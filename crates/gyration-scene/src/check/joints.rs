//! Joints, well formed or not, that name what is not there, or nothing that moves.

use super::Reporter;
use super::ends::check_ends;
use super::named::Named;
use crate::suggest;

/// The word of `between` for space.
pub(crate) const SPACE: &str = "space";

/// Notes what the ends of joints are called that they cannot be.
pub(super) fn ends(supports: &Named, bodies: &Named, reporter: &mut Reporter<'_>) {
    let is_prescribed = |name: &str| name == SPACE || (supports.has(name) && !bodies.has(name));
    check_ends("joint", reporter, |end| {
        let name = end.name;
        if name == SPACE && (bodies.has(SPACE) || supports.has(SPACE)) {
            let message = "\"space\" is space itself, and a body or support is called so too".to_owned();
            Some((message, "give the body or support another name".to_owned()))
        } else if is_prescribed(name) {
            let other = end.before.iter().flatten().find(|other| is_prescribed(other))?;
            let message = format!("neither \"{other}\" nor \"{name}\" is a body: the joint closes nothing");
            Some((message, "name a body".to_owned()))
        } else if bodies.lacks(name) {
            let known = bodies.iter().chain(supports.iter()).chain([SPACE]);
            Some((format!("there is no body or support \"{name}\""), suggest::fix(name, known, "one of")))
        } else if let Some(fault) = bodies.many(name) {
            Some(fault)
        } else if end.is_twice() {
            let help = "name two different bodies, or a body and \"space\"";
            Some((format!("both ends are at the body \"{name}\": the joint closes nothing"), help.to_owned()))
        } else {
            None
        }
    });
}
