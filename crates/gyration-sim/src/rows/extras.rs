//! Quantities that are recorded on request.

use super::fields::{BodyField, EXTRA_FIELDS, OF_CONTACTS, OF_GUIDES, OF_PLACES};
use gyration::tensor::Vec3;
use gyration_scene::Recorded;

/// How many of the fields are of homogeneous strain.
const OF_STRAIN: usize = EXTRA_FIELDS.len() - OF_CONTACTS - OF_PLACES - OF_GUIDES;

/// A set of quantities recorded on request; the words of the scene stand in the order of the fields.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Extras {
    asked: [bool; EXTRA_FIELDS.len()],
    /// The point about which total affine momentum is taken [m].
    pub origin: Vec3,
}

impl Extras {
    /// The set of some quantities.
    pub fn new(quantities: impl IntoIterator<Item = Recorded>, origin: Vec3) -> Self {
        let mut extras = Self { origin, ..Self::default() };
        for quantity in quantities {
            extras.asked[quantity as usize] = true;
        }
        extras
    }

    /// This set and one quantity more.
    #[must_use]
    pub fn and(mut self, quantity: Recorded) -> Self {
        self.asked[quantity as usize] = true;
        self
    }

    /// Whether what is asked for needs the observation of homogeneous strain.
    pub(super) fn are_homogeneous(&self) -> bool {
        self.asked[..OF_STRAIN].contains(&true)
    }

    /// Whether what is asked for needs the contact force by its parts.
    pub(super) fn are_of_contacts(&self) -> bool {
        self.asked[OF_STRAIN..OF_STRAIN + OF_CONTACTS].contains(&true)
    }

    /// Whether displacements are asked for.
    pub(super) fn are_of_places(&self) -> bool {
        self.asked[OF_STRAIN + OF_CONTACTS..][..OF_PLACES].contains(&true)
    }

    /// Whether the force of guides is asked for.
    pub(super) fn are_of_guides(&self) -> bool {
        self.asked[OF_STRAIN + OF_CONTACTS + OF_PLACES..].contains(&true)
    }

    pub(super) fn fields(&self) -> impl Iterator<Item = &'static BodyField> + use<> {
        EXTRA_FIELDS.iter().zip(self.asked).filter_map(|(field, asked)| asked.then_some(field))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_word_of_the_scene_asks_for_the_array_of_its_name() {
        for field in &EXTRA_FIELDS {
            let word: Recorded = serde_json::from_value(field.name.into()).unwrap();
            let asked: Vec<_> = Extras::new([word], Vec3::zeros()).fields().map(|field| field.name).collect();
            assert_eq!(asked, [field.name]);
        }
    }
}
