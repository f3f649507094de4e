//! What the pairs of a body do to parts of its surface.

use crate::inadmissible::Inadmissible;
use crate::instant::{BodyAt, outside, with_sides};
use crate::neighbours::Pair;
use crate::pair::{PairFault, PairScratch, PairTractions};

/// A pair of a body that acts, its plane found again.
pub struct PairTractionsAt<'a, 'b> {
    /// The pair.
    pub pair: &'a Pair,
    /// Which of its two the body is.
    pub side: usize,
    /// Its tractions.
    pub tractions: &'a PairTractions<'b>,
    /// Room for moments.
    pub room: &'a mut PairScratch,
}

/// Hands the pairs of a body that act to `each`.
///
/// # Errors
/// [`Inadmissible`] where no plane separates the two, or `each` says so.
pub fn each_pair_traction(
    at: &BodyAt,
    mut each: impl FnMut(PairTractionsAt) -> Result<(), PairFault>,
) -> Result<(), Inadmissible> {
    let mut room = PairScratch::default();
    for seen in at.pairs().filter(|pair| pair.acts()) {
        let (pair, side) = (seen.end.interaction, seen.end.end);
        with_sides(pair, &at.parties_of(pair), |sides| {
            let tractions = PairTractions::new(&pair.form, sides, &mut room)?;
            each(PairTractionsAt { pair, side, tractions: &tractions, room: &mut room })
        })
        .map_err(|fault| outside(pair, fault))?;
    }
    Ok(())
}
