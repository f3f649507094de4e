//! Requests of moments, planned once for each contact.

use super::facets::{BATCH, FacetPlan};
use super::line::LineKernel;
use super::moments::{Kernel, MomentRequest};

/// The moments that a contact needs, with all that does not depend on the gaps worked out once.
#[derive(Debug, Clone, PartialEq)]
pub struct MomentPlan {
    requests: Vec<MomentRequest>,
    /// How facets meet them, a batch each.
    pub(super) facets: Vec<FacetPlan>,
    /// How spheres and zones of them meet each, along their axis.
    lines: Vec<LineKernel>,
}

impl MomentPlan {
    /// Prepares these requests for any surface.
    pub fn new(requests: Vec<MomentRequest>) -> Self {
        let facets = requests.chunks(BATCH).map(FacetPlan::new).collect();
        let lines = requests.iter().map(|request| LineKernel::up_to(request.kernel, request.order)).collect();
        Self { requests, facets, lines }
    }

    /// The requests, in the order of the results.
    pub fn requests(&self) -> &[MomentRequest] {
        &self.requests
    }

    /// Their kernels along a segment, in the same order.
    pub(super) fn lines(&self) -> &[LineKernel] {
        &self.lines
    }
}

/// The index of the request for d^−ν among those wanted, made or raised to the order.
pub(crate) fn request(requests: &mut Vec<MomentRequest>, exponent: f64, order: usize) -> usize {
    let kernel = Kernel::Power(exponent);
    if let Some(index) = requests.iter().position(|request| request.kernel == kernel) {
        requests[index].order = requests[index].order.max(order);
        return index;
    }
    requests.push(MomentRequest { kernel, order });
    requests.len() - 1
}
