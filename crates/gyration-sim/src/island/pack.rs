//! What an island has become, in bytes: who did not step it goes on from them as the one who did.
//!
//! These are its memory, as in a checkpoint, the last step to interpolate in, the memory before it, and what was found
//! on the way and waits to be handed on: events, path bounds, a stop. Everything else follows from these.

use crate::events::{EVENT_KINDS, Event, FoundEvent};
use crate::island::Island;
use crate::island::effort::Effort;
use crate::peaks::Peaks;
use crate::plan::RunPlan;
use crate::run_state::{IslandMemory, list, put_list};
use gyration_ode::StepReport;

impl Island {
    /// Adds what it has become to some bytes.
    pub fn pack(&self, bytes: &mut Vec<u8>) {
        let mut list = |numbers: &mut dyn ExactSizeIterator<Item = u64>| put_list(bytes, numbers);
        self.memory_now().write(&mut list);
        list(&mut self.integrator.last_step_numbers().into_iter().map(f64::to_bits));
        let (start, end) = self.last_step.unwrap_or((f64::NAN, f64::NAN));
        let Effort { made, kept } = self.effort;
        let unseen = self.paths.as_ref().map_or(0, |paths| paths.unseen() as u64);
        list(&mut [start.to_bits(), end.to_bits(), made, kept, unseen].into_iter());
        list(&mut self.peaks_before.bits().collect::<Vec<_>>().into_iter());
        let events = self.events.iter().map(|FoundEvent { event: Event { time, kind, body }, gap }| {
            [time.to_bits(), *kind as u64, *body as u64, gap.to_bits()]
        });
        list(&mut events.collect::<Vec<_>>().as_flattened().iter().copied());
        let bounds = self.paths.as_ref().map(|paths| paths.numbers()).unwrap_or_default();
        list(&mut bounds.into_iter().map(f64::to_bits));
        list(&mut self.report.iter().flat_map(StepReport::numbers).collect::<Vec<_>>().into_iter());
        let stop = self.stop.as_ref().and_then(|stop| serde_json::to_string(stop).ok()).unwrap_or_default();
        list(&mut stop.bytes().map(u64::from));
        let latest = self.restart_point.as_ref().and_then(|restart_point| restart_point.latest());
        list(&mut [u64::from(latest.is_some())].into_iter());
        if let Some(latest) = latest {
            latest.write(&mut list);
        }
    }

    /// Becomes what [`Island::pack`] has told of it, but for the bodies at the end of the step, which are yet to be
    /// read; none where the bytes are not that.
    pub fn unpack(&mut self, rest: &mut &[u8], plan: &RunPlan) -> Option<()> {
        let now = IslandMemory::read(rest)?;
        let last_step: Vec<f64> = list(rest)?.into_iter().map(f64::from_bits).collect();
        if now.members != self.members {
            return None;
        }
        self.integrator = self.integrator_of(&now, &last_step, plan).ok()?;
        self.state = now.state;
        let [start, end, made, kept, unseen] = list(rest)?.try_into().ok()?;
        let (start, end) = (f64::from_bits(start), f64::from_bits(end));
        self.last_step = (!start.is_nan()).then_some((start, end));
        self.effort = Effort { made, kept };
        self.peaks_before = Peaks::of_bits(&list(rest)?);
        self.events = events(&list(rest)?)?;
        let bounds: Vec<f64> = list(rest)?.into_iter().map(f64::from_bits).collect();
        if let Some(paths) = &mut self.paths {
            paths.become_those_of(&bounds, usize::try_from(unseen).ok()?)?;
        }
        let report = list(rest)?;
        self.report = if report.is_empty() { None } else { Some(StepReport::of_numbers(report.try_into().ok()?)?) };
        let stop = list(rest)?.into_iter().map(u8::try_from).collect::<Result<Vec<_>, _>>().ok()?;
        self.stop = if stop.is_empty() { None } else { Some(serde_json::from_slice(&stop).ok()?) };
        if list(rest)? == [1] {
            self.restart_point.as_mut()?.put_latest(IslandMemory::read(rest)?);
        }
        Some(())
    }
}

fn events(numbers: &[u64]) -> Option<Vec<FoundEvent>> {
    let (events, []) = numbers.as_chunks::<4>() else { return None };
    let event = |[time, kind, body, gap]: &[u64; 4]| {
        let (kind, body) = (usize::try_from(*kind).ok()?, usize::try_from(*body).ok()?);
        let event = Event { time: f64::from_bits(*time), kind, body };
        (kind < EVENT_KINDS.len()).then_some(FoundEvent { event, gap: f64::from_bits(*gap) })
    };
    events.iter().map(event).collect()
}
