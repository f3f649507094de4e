//! A contact of a body with a support.

use super::law_set::LawSet;
use super::negligible::Negligible;
use crate::load::{Interaction, Party};
use std::sync::Arc;

/// The laws between a body and a support.
#[derive(Debug, Clone, PartialEq)]
pub struct Contact {
    /// The index of the body.
    pub body: usize,
    /// The index of the support.
    pub support: usize,
    /// What acts between them.
    pub law_set: Arc<LawSet>,
    /// From where on that is negligible.
    pub negligible: Negligible,
}

impl Contact {
    /// A contact of a body with a support, however far it is.
    pub fn new(body: usize, support: usize, law_set: impl Into<Arc<LawSet>>) -> Self {
        Self { body, support, law_set: law_set.into(), negligible: Negligible::NOWHERE }
    }

    /// The same laws between a body and the support, renumbered.
    pub(crate) fn of_parties(&self, [body, _]: [Party; 2]) -> Self {
        Self { body: body.body().unwrap_or(self.body), ..self.clone() }
    }
}

impl Interaction for Contact {
    fn parties(&self) -> [Party; 2] {
        [Party::Body(self.body), Party::Support(self.support)]
    }
}
