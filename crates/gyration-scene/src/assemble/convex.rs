//! What to write in the place of a shape that is not convex.

use gyration::shape::NotConvex;

/// How to make convex parts of what has none.
pub(super) fn convex_help(why: NotConvex) -> &'static str {
    match why {
        NotConvex::Ring => "make it a union of capsules around the ring: a plane stands between convex bodies",
        NotConvex::Dent { .. } | NotConvex::Pieces => {
            "make it a union of convex meshes, each in a file of its own, as CoACD or V-HACD cut it: a plane stands \
             between convex bodies"
        }
    }
}
