//! Scratch of the implicit stepper that many integrators share, one after the other.
//!
//! Its matrices are most of what an integrator of a small system holds, and nothing in them is of use to the next step:
//! what is, the polynomial of the last one, stays with its integrator. Who shares leaves no trace in any number.

use crate::implicit::Implicit;
use crate::integrator::Integrator;

/// Scratch for systems of any sizes, one for each size that was met.
#[derive(Debug, Clone, Default)]
pub struct Scratch {
    rooms: Vec<Implicit>,
}

impl Integrator {
    /// Takes the scratch of its size, if there is one: nothing is then allocated. It drops its own.
    pub fn take_scratch(&mut self, scratch: &mut Scratch) {
        let fits = |room: &Implicit| room.has_the_size_of(&self.implicit, &self.layout);
        let found = scratch.rooms.iter().position(fits).map(|place| scratch.rooms.swap_remove(place));
        self.exchange(found.unwrap_or_else(|| self.implicit.without_room()));
    }

    /// Gives its scratch to others, and takes or makes another before it steps again.
    pub fn give_scratch(&mut self, scratch: &mut Scratch) {
        let own = self.exchange(self.implicit.without_room());
        // Of one that has not been sized nobody has any use.
        if own.has_the_size_of(&self.implicit, &self.layout) {
            scratch.rooms.push(own);
        }
    }

    /// Puts a scratch in the place of its own; the polynomial of the last step stays.
    fn exchange(&mut self, scratch: Implicit) -> Implicit {
        let mut own = std::mem::replace(&mut self.implicit, scratch);
        std::mem::swap(&mut own.stages.collocation, &mut self.implicit.stages.collocation);
        self.fitted = false;
        own
    }
}
