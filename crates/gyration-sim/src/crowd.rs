//! What many bodies do at an instant, in a few numbers.
//!
//!   V = Σ m v/M,   drift ½ M V²,   agitation ½ Σ m |v − V|²,   turning and straining ½ Σ tr(Ṗ J Ṗᵀ)
//!   T = Σ m |v − V|²/(3 M)                                          granular temperature [m²/s²]
//!   Z = (2 n_b + n_s)/N                                             coordination: contacts of a body in the mean
//!
//! n_b and n_s are contacts between bodies and with supports that count. Laws that are powers of distance have no other
//! end than that a force is small: a contact counts whose force is above [`COUNTED`] of the mean force of those that
//! count, and above as much of the mean of m (|g| + |v − V|²/size), which is what it takes to carry a body or to turn
//! it round within its own size. Bodies without inertia, which have no momentum, count for contacts alone.

use gyration::balance::kinetic_energy;
use gyration::dynamics::{Exchange, ExchangeKind, Scratch, exchanges};
use gyration::instant::Instant;
use gyration::{Inadmissible, Party};

use gyration::tensor::Vec3;
use serde::Serialize;

/// The part of the mean force above which a contact counts.
const COUNTED: f64 = 0.01;

/// What many bodies do at an instant.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct CrowdState {
    /// ½ M V², of all bodies with their common centre \[J\].
    pub drift: f64,
    /// ½ Σ m |v − V|² \[J\].
    pub agitation: f64,
    /// ½ Σ tr(Ṗ J Ṗᵀ), of rotation and strain \[J\].
    pub turning: f64,
    /// T \[m²/s²\]; none where nothing has inertia.
    pub temperature: Option<f64>,
    /// Contacts that count, between bodies and with supports.
    pub contacts: [usize; 2],
    /// Z.
    pub coordination: f64,
    /// The mean force of the contacts that count \[N\]; none without contacts.
    pub mean_force: Option<f64>,
    /// The largest force of a contact \[N\]; none without contacts.
    pub largest_force: Option<f64>,
}

impl CrowdState {
    /// Of the bodies of an instant.
    ///
    /// # Errors
    /// [`Inadmissible`] where the state is outside the model.
    pub fn of(instant: &Instant, scratch: &mut Scratch) -> Result<Self, Inadmissible> {
        Ok(Self::with_contacts(instant, scratch)?.0)
    }

    /// The same, with the contacts that count.
    pub(crate) fn with_contacts(
        instant: &Instant,
        scratch: &mut Scratch,
    ) -> Result<(Self, Vec<Exchange>), Inadmissible> {
        let model = instant.model();
        let count = model.bodies.len().max(1) as f64;
        let with_inertia = || (0..model.bodies.len()).map(|index| instant.at(index)).filter(|at| at.body.has_inertia());
        let mass: f64 = with_inertia().map(|at| at.body.solid.mass.mass).sum();
        let momentum: Vec3 = with_inertia().map(|at| at.body.solid.mass.mass * at.motion.velocity.velocity).sum();
        let mean = if mass > 0.0 { momentum / mass } else { Vec3::zeros() };
        let (mut agitation, mut turning, mut needed) = (0.0, 0.0, 0.0);
        for at in with_inertia() {
            let (own, velocity) = (at.body.solid.mass.mass, at.motion.velocity.velocity);
            let square = (velocity - mean).norm_squared();
            agitation += 0.5 * own * square;
            turning += kinetic_energy(at.body, at.motion) - 0.5 * own * velocity.norm_squared();
            needed += own * (model.gravity.norm() + square / at.body.size) / count;
        }
        let mut contacts = Vec::new();
        exchanges(instant, scratch, &mut contacts)?;
        keep_counted(&mut contacts, needed);
        let between = contacts.iter().filter(|contact| matches!(contact.parties[1], Party::Body(_))).count();
        let touches = [between, contacts.len() - between];
        let forces = || contacts.iter().map(|contact| contact.force.norm());
        let state = Self {
            drift: 0.5 * mass * mean.norm_squared(),
            agitation,
            turning,
            temperature: (mass > 0.0).then_some(2.0 * agitation / (3.0 * mass)),
            contacts: touches,
            coordination: (2 * touches[0] + touches[1]) as f64 / count,
            mean_force: (!contacts.is_empty()).then(|| forces().sum::<f64>() / contacts.len() as f64),
            largest_force: forces().reduce(f64::max),
        };
        Ok((state, contacts))
    }
}

/// Drops what is no contact, and contacts that do not count, until all that are left do.
pub(crate) fn keep_counted(contacts: &mut Vec<Exchange>, needed: f64) {
    contacts.retain(|exchange| exchange.kind == ExchangeKind::Contact && exchange.force != Vec3::zeros());
    loop {
        let before = contacts.len();
        let mean = contacts.iter().map(|contact| contact.force.norm()).sum::<f64>() / before.max(1) as f64;
        contacts.retain(|contact| contact.force.norm() > COUNTED * mean.max(needed));
        if contacts.len() == before {
            return;
        }
    }
}
