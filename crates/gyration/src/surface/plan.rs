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
    /// Their kernels along a segment: the axis of a sphere, a ruling of a cylinder, a meridian of a hemisphere.
    lines: Vec<LineKernel>,
    /// The same to one degree more: along a ruling of a cone, which widens.
    widening_lines: Vec<LineKernel>,
}

impl MomentPlan {
    /// Prepares these requests for any surface.
    pub fn new(requests: Vec<MomentRequest>) -> Self {
        let facets = requests.chunks(BATCH).map(FacetPlan::new).collect();
        // Degree 1 is the least that a kernel is prepared for.
        let line = |request: &MomentRequest, beyond| LineKernel::up_to(request.kernel, request.order.max(1) + beyond);
        let lines = requests.iter().map(|request| line(request, 0)).collect();
        let widening_lines = requests.iter().map(|request| line(request, 1)).collect();
        Self { requests, facets, lines, widening_lines }
    }

    /// The requests, in the order of the results.
    pub fn requests(&self) -> &[MomentRequest] {
        &self.requests
    }

    /// Their kernels along a segment, in the same order.
    pub(super) fn lines(&self) -> &[LineKernel] {
        &self.lines
    }

    /// The same to one degree more.
    pub(super) fn widening_lines(&self) -> &[LineKernel] {
        &self.widening_lines
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
