//! What may be asked for of a recording, by name.

use crate::error::PlotError;

/// A quantity that may be asked for of a recording.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PlotQuantity {
    /// All that the recording has.
    Overview,
    /// Outlines at successive times.
    Strip,
    /// Outlines that move.
    Motion,
    /// Height of the centres over time.
    Height,
    /// Smallest distance to what is met over time.
    Gap,
    /// Principal stretches of bodies that deform.
    Stretch,
    /// Forces of contact.
    Forces,
    /// Energies, works, residual of the ledger.
    Energy,
    /// Two measures of bodies that contract against each other.
    Stroke,
    /// Level distance of the centres from their starts over time.
    Distance,
    /// Work of the drive by weight and distance.
    Cost,
    /// Where the work of the drive goes, and its power.
    Drive,
    /// What many bodies do together.
    Crowd,
    /// Tractions and resistances of the contact laws against distance.
    Laws,
}

impl PlotQuantity {
    /// All of them.
    pub const ALL: [Self; 14] = [
        Self::Overview,
        Self::Strip,
        Self::Motion,
        Self::Height,
        Self::Gap,
        Self::Stretch,
        Self::Forces,
        Self::Energy,
        Self::Stroke,
        Self::Distance,
        Self::Cost,
        Self::Drive,
        Self::Crowd,
        Self::Laws,
    ];

    /// Its name.
    pub fn name(self) -> &'static str {
        self.described().0
    }

    /// What is drawn, in words.
    pub fn description(self) -> &'static str {
        self.described().1
    }

    fn described(self) -> (&'static str, &'static str) {
        match self {
            Self::Overview => ("overview", "All that the recording has"),
            Self::Strip => {
                ("strip", "Outlines at successive times, from the side; bodies that spin on the spot from above")
            }
            Self::Motion => {
                ("motion", "The same as they move, in SVG: a picture that browsers and readers of Markdown play")
            }
            Self::Height => ("height", "Heights of the centres of mass"),
            Self::Gap => ("gap", "Smallest distances to a support or another body"),
            Self::Stretch => ("stretch", "Principal stretches of bodies that deform"),
            Self::Forces => ("forces", "Forces of contact"),
            Self::Energy => ("energy", "Energies, works and the residual of their balance"),
            Self::Stroke => (
                "stroke",
                "Two measures of bodies that contract against each other, and the area that the last cycle encloses",
            ),
            Self::Distance => {
                ("distance", "Level distances of the centres of mass from their starts, and lengths of their paths")
            }
            Self::Cost => {
                ("cost", "Cost of transport of bodies that contract: work of the drive by weight and distance")
            }
            Self::Drive => ("drive", "Where the work of the drive goes, and its power"),
            Self::Crowd => {
                ("crowd", "What many bodies do together: energies, temperature, contacts, and the forces at the end")
            }
            Self::Laws => ("laws", "Tractions and resistances against distance, forces on bodies, gaps of rest"),
        }
    }

    /// The quantity of this name.
    ///
    /// # Errors
    /// [`PlotError::Arguments`] if there is none.
    pub fn of_name(name: &str) -> Result<Self, PlotError> {
        Self::ALL.into_iter().find(|quantity| quantity.name() == name).ok_or_else(|| {
            let names = Self::ALL.map(Self::name).join(", ");
            PlotError::arguments(format!("there is no plot `{name}`"), format!("choose one of {names}"))
        })
    }
}
