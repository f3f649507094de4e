//! Where a formula of the model goes over to another along a run: `abs`, `min` and `max` of what moves.
//!
//!   h(y(t_s), t_s; p) = 0,   τ = dt_s/dp = −(∂h/∂y S⁻ + ∂h/∂p)/ḣ⁻,   ḣ⁻ = ∂h/∂y f⁻ + ∂h/∂t
//!   S⁺ = S⁻ + (f⁻ − f⁺) τ,   W⁺ = W⁻ + (g⁻ − g⁺) τ
//!
//! Every step of the run is searched for t_s, and a step of S ends there, so that its nodes see one formula only. Near
//! by, ∂f/∂p is taken on one side of it and continued by a parabola, since neighbours with another p go over earlier or
//! later. Source: Aizerman, Gantmakher, *On the stability of periodic motions*, J. Appl. Math. Mech. 22 (1958);
//! Hiskens, Pai, *Trajectory sensitivity analysis of hybrid systems*, IEEE Trans. Circuits Syst. I 47 (2000).

use super::Meaningless;
use super::kinks::parabola;
use super::probe::{along, fill_scales, meaningless, reason};
use super::switches::{Switch, Switching};
use super::tangent::{Followed, Tangent};
use gyration::Inadmissible;
use gyration::state::State;
use gyration_ode::{Extended, System as _};

/// A switching function that is no larger than this part of what it has been is rounding, and keeps its sign.
const ROUNDING: f64 = 64.0 * f64::EPSILON;
/// Rates that differ on both sides by less than this part of them go on.
const SAME: f64 = 1e-9;
/// So do those that differ by less than so many times what they change by within a part of a step of the run.
const MORE: f64 = 10.0;
const EARLIER: f64 = 1e-6;
/// Two functions that change sign at once move alike if their τ differ by no more than this part.
const ALIKE: f64 = 1e-6;
/// How many times as far as the neighbours' t_s ∂f/∂p stays from it.
const DISTANCE: f64 = 8.0;
/// The neighbours' t_s are no farther than this part of a step of the run, if they can be as near.
const NEAR: f64 = 3e-3;
/// Where in a step of the run the functions are looked at: they turn round between no two of them but where they hardly
/// change their sign.
const LOOKS: [f64; 4] = [0.25, 0.5, 0.75, 1.0];
/// How far before a step whose start stands at a switch but for rounding the run is looked at, as a part of it, and how
/// often that is made four times as far: about a jump steps are short.
const FIRST_BACK: f64 = 1e-12;
const BACK: i32 = 24;
/// How often a bracket of t_s is halved, at most.
const HALVINGS: usize = 200;

/// f and g in a state.
struct Rates {
    bodies: Vec<f64>,
    powers: Vec<f64>,
}

/// The sign of a number; zero of zero.
fn sign(value: f64) -> f64 {
    if value == 0.0 { 0.0 } else { value.signum() }
}

impl Rates {
    /// f⁻ − f⁺ and g⁻ − g⁺; none where both go on: where no number differs by more than it changes, or is rounded, on
    /// the way from a little earlier.
    fn jump_to(&self, behind: &Self, earlier: &Self) -> Option<Self> {
        let apart = |one: &[f64], other: &[f64]| one.iter().zip(other).map(|(one, other)| one - other).collect();
        let jump = Self { bodies: apart(&self.bodies, &behind.bodies), powers: apart(&self.powers, &behind.powers) };
        let jumps = |jump: &[f64], here: &[f64], behind: &[f64], earlier: &[f64]| {
            jump.iter().zip(here).zip(behind).zip(earlier).any(|(((jump, here), behind), earlier)| {
                jump.abs() > MORE * (here - earlier).abs() + SAME * here.abs().max(behind.abs())
            })
        };
        let do_bodies = jumps(&jump.bodies, &self.bodies, &behind.bodies, &earlier.bodies);
        let do_powers = jumps(&jump.powers, &self.powers, &behind.powers, &earlier.powers);
        (do_bodies || do_powers).then_some(jump)
    }
}

impl Tangent<'_> {
    /// Looks at the switching functions of the start.
    ///
    /// # Errors
    /// [`Inadmissible`] where it is outside the model.
    pub(super) fn begin_switching(&mut self) -> Result<(), Inadmissible> {
        let y = Extended { high: &self.at.bodies, low: &self.at.low };
        let values = self.system.switching(self.time, y)?;
        if values.is_empty() {
            return Ok(());
        }
        self.switching.start = self.time;
        self.switching.sides = values.iter().map(|value| sign(*value)).collect();
        self.switching.sizes = values.into_iter().map(f64::abs).collect();
        Ok(())
    }

    /// Looks for formulas that change within the last step of the run.
    ///
    /// # Errors
    /// [`Inadmissible`] where a state is outside the model.
    pub(super) fn watch(&mut self, from: f64, to: f64) -> Result<(), Inadmissible> {
        if self.switching.sides.is_empty() {
            return Ok(());
        }
        let mut before = 0.0;
        for part in LOOKS {
            let later = part * (to - from);
            loop {
                let changed = self.changed(from, later)?;
                if changed.is_empty() {
                    break;
                }
                let had_signs = changed.iter().any(|place| self.switching.sides[*place] != 0.0);
                match self.bracket(from, [before, later], &changed)? {
                    Some(bracket) => {
                        self.see(from, bracket, changed)?;
                        before = bracket[1];
                    }
                    None if had_signs => {
                        self.lose_all("a formula goes over to another, and when cannot be found".into());
                        return Ok(());
                    }
                    None => self.take_sides(from, later, &changed)?,
                }
            }
            before = later;
        }
        Ok(())
    }

    /// The last state before a formula changes next, if that is by a time.
    pub(super) fn switch_by(&self, time: f64) -> Option<&State> {
        self.switching.ahead.front().map(|switch| &switch.states[0]).filter(|state| state.time <= time)
    }

    /// Goes over to the other formula.
    pub(super) fn switch_over(&mut self) {
        let Some(switch) = self.switching.ahead.pop_front() else { return };
        if let Err(left) = self.pass(&switch) {
            self.lose_all(reason(self.model, self.time, &left));
        }
        self.time = self.time.max(switch.states[1].time);
        self.switching.passed = Some(switch);
    }

    /// The states to look at in the place of the present one, with their weights, where neighbours of a number have
    /// another formula there.
    pub(super) fn beside_switches(&mut self, column: usize) -> Option<[(State, f64); 3]> {
        let time = self.at.time;
        let near = |switch: &&Switch| {
            let [before, behind] = switch.times();
            let away = if time <= before { before - time } else { time - behind };
            away < switch.margins[column]
        };
        let Switching { passed, ahead, .. } = &self.switching;
        let switch = passed.iter().chain(ahead).find(near)?;
        let [before, behind] = switch.times();
        let (place, side) = if time <= before { (before, -1.0) } else { (behind, 1.0) };
        let margin = switch.margins[column];
        let here = self.at.clone();
        let places = parabola(place, side, margin, time).map(|(time, weight)| {
            self.look_at(time, 0.0);
            (self.at.clone(), weight)
        });
        self.at = here;
        Some(places)
    }

    /// The numbers of the run so long after a time.
    pub(super) fn look_at(&mut self, from: f64, later: f64) {
        self.at.time = from + later;
        self.at.low.resize(self.at.bodies.len(), 0.0);
        self.history.at(from, later, &mut self.at.bodies, &mut self.at.low);
        self.project();
    }

    /// The switching functions so long after a time.
    fn switching_at(&mut self, from: f64, later: f64) -> Result<Vec<f64>, Inadmissible> {
        self.look_at(from, later);
        self.system.switching(self.at.time, Extended { high: &self.at.bodies, low: &self.at.low })
    }

    /// On which sides of the switching functions a state is, the last one before a switch among them; zero where a
    /// function is rounding.
    pub(super) fn sides(&mut self, state: &State) -> Result<Vec<f64>, Inadmissible> {
        let values = self.switching_of(state.time, &state.bodies)?;
        let Switching { sizes, ahead, .. } = &self.switching;
        let last = ahead.front().filter(|switch| switch.states[0].time <= state.time);
        let changes = |place: usize| last.is_some_and(|switch| switch.which.contains(&place));
        let side = |(place, value): (usize, &f64)| {
            if value.abs() > ROUNDING * sizes[place] || changes(place) { sign(*value) } else { 0.0 }
        };
        Ok(values.iter().enumerate().map(side).collect())
    }

    /// Whether some numbers of the bodies are on another side than these of a switching function.
    pub(super) fn are_beyond(&mut self, sides: &[f64], time: f64, bodies: &[f64]) -> Result<bool, Inadmissible> {
        let values = self.switching_of(time, bodies)?;
        Ok(sides.iter().zip(values).any(|(side, value)| side * value < 0.0))
    }

    /// The switching functions of some numbers of the bodies.
    fn switching_of(&mut self, time: f64, bodies: &[f64]) -> Result<Vec<f64>, Inadmissible> {
        if self.switching.sides.is_empty() {
            return Ok(Vec::new());
        }
        let low = vec![0.0; bodies.len()];
        self.system.switching(time, Extended { high: bodies, low: &low })
    }

    /// Those that have changed their signs so long after a time, by more than rounding.
    fn changed(&mut self, from: f64, later: f64) -> Result<Vec<usize>, Inadmissible> {
        let values = self.switching_at(from, later)?;
        let Switching { sides, sizes, .. } = &mut self.switching;
        sizes.iter_mut().zip(&values).for_each(|(size, value)| *size = size.max(value.abs()));
        let has_changed =
            |place: &usize| sign(values[*place]) != sides[*place] && values[*place].abs() > ROUNDING * sizes[*place];
        Ok((0..values.len()).filter(has_changed).collect())
    }

    /// The last time with the old signs of some of them, and the first at which one has another: in between they may be
    /// zero. The start may be there: before it stands what the run comes from. None if they have never had a sign.
    fn bracket(
        &mut self,
        from: f64,
        [before, later]: [f64; 2],
        which: &[usize],
    ) -> Result<Option<[f64; 2]>, Inadmissible> {
        let values = self.switching_at(from, later)?;
        for place in which {
            self.switching.sides[*place] = -sign(values[*place]);
        }
        let mut backwards =
            [before, 0.0].into_iter().chain((0..BACK).map(|k| -FIRST_BACK * later * libm::ldexp(1.0, 2 * k)));
        let first = loop {
            let Some(at) = backwards.next() else { return Ok(None) };
            if self.have_old_signs(from, at, which)? {
                break at;
            }
        };
        let [before, mut behind] =
            self.halve(from, [first, later], |this, at| Ok(!this.have_old_signs(from, at, which)?))?;
        if !self.has_new_sign(from, behind, which)? {
            [_, behind] = self.halve(from, [behind, later], |this, at| this.has_new_sign(from, at, which))?;
        }
        Ok(Some([before, behind]))
    }

    fn have_old_signs(&mut self, from: f64, at: f64, which: &[usize]) -> Result<bool, Inadmissible> {
        let values = self.switching_at(from, at)?;
        Ok(which.iter().all(|place| values[*place] * self.switching.sides[*place] > 0.0))
    }

    fn has_new_sign(&mut self, from: f64, at: f64, which: &[usize]) -> Result<bool, Inadmissible> {
        let values = self.switching_at(from, at)?;
        Ok(which.iter().any(|place| values[*place] * self.switching.sides[*place] < 0.0))
    }

    /// Halves a bracket, at whose end something holds and at whose beginning not, while there are times in it.
    fn halve(
        &mut self,
        from: f64,
        [mut before, mut behind]: [f64; 2],
        mut holds: impl FnMut(&mut Self, f64) -> Result<bool, Inadmissible>,
    ) -> Result<[f64; 2], Inadmissible> {
        for _ in 0..HALVINGS {
            let middle = 0.5 * (before + behind);
            if from + middle <= from + before || from + middle >= from + behind {
                break;
            }
            match holds(self, middle)? {
                true => behind = middle,
                false => before = middle,
            }
        }
        Ok([before, behind])
    }

    /// Takes the signs that they have so long after a time for those that they always had.
    fn take_sides(&mut self, from: f64, later: f64, which: &[usize]) -> Result<(), Inadmissible> {
        let values = self.switching_at(from, later)?;
        which.iter().for_each(|place| self.switching.sides[*place] = sign(values[*place]));
        Ok(())
    }

    /// The derivatives of the switching functions along a direction of the present state, in which t goes on at a rate.
    fn switching_along(&mut self, direction: &[f64], rate: f64) -> Result<Vec<f64>, Inadmissible> {
        let (State { time, bodies, low, .. }, scales) = (self.at.clone(), self.scales.clone());
        along(direction, &scales[..bodies.len()], |part| {
            let moved: Vec<f64> = bodies.iter().zip(direction).map(|(y, s)| y + part * s).collect();
            self.system.switching(time + part * rate, Extended { high: &moved, low: &low })
        })
    }

    /// Takes down where formulas change, and how near to it each number may look at ∂f/∂p.
    fn see(&mut self, from: f64, bracket: [f64; 2], mut which: Vec<usize>) -> Result<(), Inadmissible> {
        let values = self.switching_at(from, bracket[1])?;
        which.retain(|place| values[*place] * self.switching.sides[*place] < 0.0);
        let behind = self.at.clone();
        self.look_at(from, bracket[0]);
        let before = self.at.clone();
        let time = before.time;
        let rates = self.rates_here()?;
        let speeds = self.switching_along(&rates.bodies, 1.0)?;
        let (length, model) = (self.run_step, self.model);
        let (mut by_number, mut margins) = (Vec::new(), Vec::new());
        for followed in &mut self.columns {
            let mut found = None;
            let mut margin = 0.0;
            if let Ok(Followed::Number(number)) = followed {
                let variation = &mut number.0;
                let moves = loop {
                    let moves = variation.switching(time, self.at.numbers());
                    let Ok(Some(slopes)) = &moves else { break moves };
                    let farthest =
                        which.iter().map(|place| (slopes[*place] / speeds[*place]).abs()).fold(0.0, f64::max);
                    margin = DISTANCE * farthest * variation.step();
                    if margin <= NEAR * length || variation.finer().is_err() {
                        break moves;
                    }
                };
                match moves {
                    Ok(slopes) => found = slopes,
                    Err(fault) => *followed = Err(meaningless(model, time, &fault)),
                }
                if margin > length {
                    let reason = "with it a formula of the model changes too far from where it does now".to_owned();
                    *followed = Err(Meaningless { from: time, reason });
                }
            }
            by_number.push(found);
            margins.push(margin);
        }
        which.iter().for_each(|place| self.switching.sides[*place] *= -1.0);
        self.switching.ahead.push_back(Switch { states: [before, behind], by_number, margins, which, length });
        Ok(())
    }

    /// The rates of the present state, and the powers of its works.
    fn rates_here(&mut self) -> Result<Rates, Inadmissible> {
        let State { time, bodies, low, works } = &self.at;
        let mut found = Rates { bodies: vec![0.0; bodies.len()], powers: vec![0.0; works.len()] };
        let y = Extended { high: bodies, low };
        self.system.extended_rates(*time, y, &mut found.bodies, &mut found.powers)?;
        Ok(found)
    }

    /// Takes S from one formula to the other.
    fn pass(&mut self, switch: &Switch) -> Result<(), Inadmissible> {
        self.at.clone_from(&switch.states[1]);
        let behind = self.rates_here()?;
        self.at.clone_from(&switch.states[0]);
        fill_scales(&mut self.system, &self.at, &mut self.scales);
        let before = self.rates_here()?;
        self.look_at(switch.states[0].time, -EARLIER * switch.length);
        let earlier = self.rates_here()?;
        self.at.clone_from(&switch.states[0]);
        let Some(jump) = before.jump_to(&behind, &earlier) else { return Ok(()) };
        let speeds = self.switching_along(&before.bodies, 1.0)?;
        let later = self.switching_along(&behind.bodies, 1.0)?;
        if switch.which.iter().any(|place| speeds[*place] * later[*place] <= 0.0) {
            self.lose_all("the motion does not go through a jump of a force, but stays there or turns back".into());
            return Ok(());
        }
        for column in 0..self.state.ncols() {
            if self.columns.get(column).is_some_and(Result::is_err) {
                continue;
            }
            match self.moves(switch, &speeds, column)? {
                Ok(moves) => {
                    let (rates, powers) = (jump.bodies.iter().enumerate(), jump.powers.iter().enumerate());
                    rates.for_each(|(row, jump)| self.state[(row, column)] += jump * moves);
                    powers.for_each(|(row, jump)| self.works[(row, column)] += jump * moves);
                }
                Err(reason) => match self.columns.get_mut(column) {
                    Some(followed) => {
                        *followed = Err(Meaningless { from: self.time, reason: reason.to_owned() });
                        self.state.column_mut(column).fill(0.0);
                    }
                    None => self.lose_all(reason.to_owned()),
                },
            }
        }
        Ok(())
    }

    /// τ of a column, given ḣ⁻; none, with the reason, where there is no single one.
    fn moves(
        &mut self,
        switch: &Switch,
        speeds: &[f64],
        column: usize,
    ) -> Result<Result<f64, &'static str>, Inadmissible> {
        let direction: Vec<f64> = self.state.column(column).iter().copied().collect();
        let mut slopes = self.switching_along(&direction, 0.0)?;
        if let Some(Some(by_number)) = switch.by_number.get(column) {
            slopes.iter_mut().zip(by_number).for_each(|(sum, slope)| *sum += slope);
        }
        let moves = switch.which.iter().map(|place| -slopes[*place] / speeds[*place]);
        let ends = |(least, most): (f64, f64), moves: f64| (least.min(moves), most.max(moves));
        let (least, most) = moves.fold((f64::INFINITY, f64::NEG_INFINITY), ends);
        Ok(if most - least > ALIKE * most.abs().max(least.abs()) {
            Err("two forces jump at the same time, and their instants move apart")
        } else if self.at.time <= self.switching.start && most != 0.0 {
            Err("a force jumps where the motion starts")
        } else {
            Ok(most)
        })
    }
}
