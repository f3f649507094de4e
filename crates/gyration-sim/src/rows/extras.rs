//! Quantities that are recorded on request.

use super::extra_fields::{Source, extra_fields};
use super::fields::BodyField;
use gyration::tensor::Vec3;
use gyration_scene::Recorded;

/// A set of quantities recorded on request.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Extras {
    /// A bit for each word of the scene.
    asked: u64,
    /// The point about which total affine momentum and moment are taken [m].
    pub origin: Vec3,
}

impl Extras {
    /// The set of some quantities.
    pub fn new(quantities: impl IntoIterator<Item = Recorded>, origin: Vec3) -> Self {
        quantities.into_iter().fold(Self { asked: 0, origin }, Self::and)
    }

    /// This set and one quantity more.
    #[must_use]
    pub fn and(mut self, quantity: Recorded) -> Self {
        self.asked |= bit(quantity);
        self
    }

    fn asks_for(&self, quantity: Recorded) -> bool {
        self.asked & bit(quantity) != 0
    }

    /// Whether impulses are asked for, which a run integrates.
    pub(crate) fn impulses(&self) -> bool {
        self.asks_for(Recorded::Impulse)
    }

    /// Whether the largest contact forces are asked for, which a run looks for in each step.
    pub(crate) fn peak_forces(&self) -> bool {
        self.asks_for(Recorded::PeakForce)
    }

    /// Whether quantities are asked for that belong to the interval since the last sample.
    pub fn have_intervals(&self) -> bool {
        self.need(Source::Interval)
    }

    /// Whether something is asked for that is made of this.
    pub(super) fn need(&self, source: Source) -> bool {
        extra_fields().any(|extra| extra.source == source && self.asks_for(extra.word))
    }

    pub(super) fn fields(self) -> impl Iterator<Item = &'static BodyField> {
        extra_fields().filter(move |extra| self.asks_for(extra.word)).map(|extra| &extra.field)
    }
}

fn bit(quantity: Recorded) -> u64 {
    1 << quantity as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_word_of_the_scene_asks_for_the_arrays_of_its_name() {
        for extra in extra_fields() {
            let name = extra.field.name;
            let apart = |stem: &str| name.starts_with(stem) && !name.ends_with("_total");
            let word = match name {
                _ if name.starts_with("kinetic_energy") => "kinetic_energy",
                _ if apart("force_") => "force_by_kind",
                _ if apart("moment_") && !["moment_power"].contains(&name) => "moment_by_kind",
                _ => name,
            };
            let word: Recorded = serde_json::from_value(word.into()).unwrap();
            assert_eq!(word, extra.word, "{name}");
            assert!(Extras::new([word], Vec3::zeros()).fields().any(|field| field.name == name));
        }
    }
}
