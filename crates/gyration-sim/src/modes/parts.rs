//! What acts on each other, through any chain.

/// Numbers, which ascend, in parts that do not act on each other: those of a part ascend, the parts by their first.
pub(super) fn joined_parts(mut left: Vec<usize>, acts: impl Fn(usize, usize) -> bool) -> Vec<Vec<usize>> {
    let mut parts = Vec::new();
    while let Some(first) = left.first().copied() {
        left.remove(0);
        let mut part = vec![first];
        let mut at = 0;
        while at < part.len() {
            let (joined, apart) = left.iter().partition(|j| acts(part[at], **j) || acts(**j, part[at]));
            left = apart;
            part.extend::<Vec<usize>>(joined);
            at += 1;
        }
        part.sort_unstable();
        parts.push(part);
    }
    parts
}
