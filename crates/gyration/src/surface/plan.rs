//! Requests of moments, planned once for each contact.

use super::facets::{BATCH, FacetPlan};
use super::moments::MomentRequest;

/// The moments that a contact needs, with all that does not depend on the gaps worked out once.
#[derive(Debug, Clone, PartialEq)]
pub struct MomentPlan {
    requests: Vec<MomentRequest>,
    /// How facets meet them, a batch each.
    pub(super) facets: Vec<FacetPlan>,
}

impl MomentPlan {
    /// Prepares these requests for any surface.
    pub fn new(requests: Vec<MomentRequest>) -> Self {
        let facets = requests.chunks(BATCH).map(FacetPlan::new).collect();
        Self { requests, facets }
    }

    /// The requests, in the order of the results.
    pub fn requests(&self) -> &[MomentRequest] {
        &self.requests
    }
}
