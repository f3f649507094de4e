//! Did-you-mean: the known word nearest to a misspelt one.

/// The nearest of the known words, if it is near enough to be meant.
///
/// Distance: optimal string alignment (insert, drop, replace, swap neighbours). A third of the word's letters may
/// differ, and one letter in any word longer than two.
pub(crate) fn nearest<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let length = word.chars().count();
    // Longer than any key or name that is worth comparing; the cost grows with the square.
    const LONGEST: usize = 64;
    // More than a person can have in mind; a file may have thousands of names, and as many that are not known.
    const COMPARED: usize = 1000;
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
    // Enough for the keys of the largest table of the format.
    const LISTED: usize = 24;
    let mut names: Vec<&str> = known.into_iter().take(LISTED + 1).collect();
    if names.is_empty() {
        return format!("there are no {what} here");
    }
    let more = if names.len() > LISTED { ", …" } else { "" };
    names.truncate(LISTED);
    format!("{what}: {}{more}", names.join(", "))
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
    fn a_word_far_from_all_gets_the_list() {
        assert_eq!(fix("colour", ["name", "mass"], "known keys"), "known keys: name, mass");
    }
}
