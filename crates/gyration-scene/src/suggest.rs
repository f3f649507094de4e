//! Did-you-mean: the known word nearest to a misspelt one, or the one of which it is the beginning.

/// More words than a person can have in mind; a file may have thousands of names, and as many that are not known.
const COMPARED: usize = 1000;

/// The nearest of the known words, if it is near enough to be meant; else the only one that begins with the word.
pub(crate) fn nearest<'a>(word: &str, known: impl IntoIterator<Item = &'a str> + Clone) -> Option<&'a str> {
    misspelt(word, known.clone()).or_else(|| begun(word, known))
}

/// The only one of the known words that begins with these letters.
fn begun<'a>(letters: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let mut longer = known.into_iter().take(COMPARED).filter(|candidate| candidate.starts_with(letters));
    longer.next().filter(|_| letters.chars().count() > 2 && longer.next().is_none())
}

/// Distance: optimal string alignment (insert, drop, replace, swap neighbours). A third of the word's letters may
/// differ, and one letter in any word longer than two.
fn misspelt<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let length = word.chars().count();
    // Longer than any key or name that is worth comparing; the cost grows with the square.
    const LONGEST: usize = 64;
    if length > LONGEST {
        return None;
    }
    let allowed = (length / 3).max(usize::from(length > 2));
    known
        .into_iter()
        .take(COMPARED)
        .filter(|candidate| candidate.chars().count() <= LONGEST)
        .map(|candidate| (strsim::osa_distance(word, candidate), candidate))
        .filter(|(distance, _)| *distance <= allowed)
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, candidate)| candidate)
}

/// The fix for a word that is not among the known ones: the nearest, or all of them if they are few.
pub fn fix<'a>(word: &str, known: impl IntoIterator<Item = &'a str> + Clone, what: &str) -> String {
    if let Some(candidate) = nearest(word, known.clone()) {
        return format!("did you mean `{candidate}`?");
    }
    let names = listed(known);
    if names.is_empty() { format!("there are no {what} here") } else { format!("{what}: {names}") }
}

/// Names with commas between them, or the first ones of many: a crowd has thousands.
pub fn listed<'a>(known: impl IntoIterator<Item = &'a str>) -> String {
    // Enough for the keys of the largest table of the format.
    const LISTED: usize = 24;
    let mut names: Vec<&str> = known.into_iter().filter(|name| !name.is_empty()).take(LISTED + 1).collect();
    let more = if names.len() > LISTED { ", …" } else { "" };
    names.truncate(LISTED);
    names.join(", ") + more
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn swapped_and_dropped_letters_are_recognised() {
        let keys = ["velocity", "angular_velocity", "position", "name"];
        assert_eq!(nearest("velcoity", keys), Some("velocity"));
        assert_eq!(nearest("postion", keys), Some("position"));
        assert_eq!(nearest("nmae", keys), Some("name"));
        assert_eq!(nearest("colour", keys), None);
    }

    #[test]
    fn the_beginning_of_a_word_is_recognised_if_it_is_of_one_alone() {
        let keys = ["youngs_modulus", "poissons_ratio", "position", "mu"];
        assert_eq!(nearest("young", keys), Some("youngs_modulus"));
        assert_eq!(nearest("poisson", keys), Some("poissons_ratio"));
        assert_eq!(nearest("po", keys), None);
        assert_eq!(nearest("pos", ["poissons_ratio", "position", "posture"]), None);
    }

    #[test]
    fn a_word_far_from_all_gets_the_list() {
        assert_eq!(fix("colour", ["name", "mass"], "known keys"), "known keys: name, mass");
        let many: Vec<String> = (0..1000).map(|body| format!("body-{body}")).collect();
        let said = fix("colour", many.iter().map(String::as_str), "bodies");
        assert!(said.starts_with("bodies: body-0, ") && said.ends_with(", body-23, …"), "{said}");
    }
}
