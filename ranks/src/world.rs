//! All processes of the run, as MPI knows them.

use gyration_sim::Communicator;
use mpi::datatype::PartitionMut;
use mpi::topology::SimpleCommunicator;
use mpi::traits::{Communicator as _, CommunicatorCollectives as _};
use std::io;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;

/// The processes that mpiexec has begun.
#[derive(Debug)]
pub struct World {
    pub rank: usize,
    size: usize,
    /// Messages, bytes of this rank, and nanoseconds that it has waited for the others and for their bytes.
    traffic: [AtomicU64; 4],
}

impl World {
    pub fn of(world: &SimpleCommunicator) -> Self {
        let number = |number: i32| usize::try_from(number).unwrap_or(0);
        Self { rank: number(world.rank()), size: number(world.size()).max(1), traffic: Default::default() }
    }

    /// The first rank of which something holds.
    pub fn first_that(&self, holds: bool) -> Option<usize> {
        let mut all = vec![0_u8; self.size];
        SimpleCommunicator::world().all_gather_into(&u8::from(holds), &mut all[..]);
        all.iter().position(|holds| *holds != 0)
    }

    /// What this rank has told, in words.
    pub fn traffic(&self) -> String {
        let [messages, bytes, waiting, transfer] = self.traffic.each_ref().map(|count| count.load(Ordering::Relaxed));
        let seconds = |nanoseconds: u64| nanoseconds as f64 * 1e-9;
        format!(
            "rank 0 of {} told {bytes} bytes in {messages} messages, waited {:.2} s for others, {:.2} s for bytes",
            self.size,
            seconds(waiting),
            seconds(transfer)
        )
    }

    fn count(&self, what: usize, by: u64) {
        self.traffic[what].fetch_add(by, Ordering::Relaxed);
    }
}

impl Communicator for World {
    fn rank(&self) -> usize {
        self.rank
    }

    fn size(&self) -> usize {
        self.size
    }

    fn all_gather(&self, own: Vec<u8>) -> io::Result<Vec<Vec<u8>>> {
        let world = SimpleCommunicator::world();
        let began = Instant::now();
        let mut lengths = vec![0_u64; self.size];
        world.all_gather_into(&(own.len() as u64), &mut lengths[..]);
        let met = Instant::now();
        // MPI counts in numbers of 31 bits.
        let too_many = |_| io::Error::other("more than 2 GiB at once");
        let all = i32::try_from(lengths.iter().sum::<u64>()).map_err(too_many)?;
        let lengths = lengths.into_iter().map(i32::try_from).collect::<Result<Vec<_>, _>>().map_err(too_many)?;
        let places: Vec<i32> =
            lengths.iter().scan(0, |end, length| Some(std::mem::replace(end, *end + length))).collect();
        let mut bytes = vec![0_u8; usize::try_from(all).map_err(too_many)?];
        world.all_gather_varcount_into(&own[..], &mut PartitionMut::new(&mut bytes[..], &lengths[..], &places[..]));
        self.count(0, 1);
        self.count(1, own.len() as u64);
        self.count(2, (met - began).as_nanos() as u64);
        self.count(3, met.elapsed().as_nanos() as u64);
        let mut rest = &bytes[..];
        let split = |length: &i32| {
            let (own, others) = rest.split_at(usize::try_from(*length).unwrap_or(0));
            rest = others;
            own.to_vec()
        };
        Ok(lengths.iter().map(split).collect())
    }
}
