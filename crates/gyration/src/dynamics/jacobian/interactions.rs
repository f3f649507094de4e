//! Blocks off the diagonal: what a spring between two bodies, or their meeting, does to one when the other moves.
//!
//! Of a spring these are
//!
//!   ∂Q_i/∂q_j = −(∂F/∂d) X̃_i⊗X̃_j,   ∂Q_i/∂q̇_j = −(∂F/∂ḋ) X̃_i⊗X̃_j

use super::super::loads::sloped;
use super::{Coupling, Lift, Lower};
use crate::acting::Load;
use crate::instant::BodyAt;
use crate::lattice::{Cell, HERE};
use crate::load::{Mat12, SpringEnd, SpringLoads, add_blocks};
use crate::tensor::Vec3;
use std::convert::Infallible;

/// Hands to `each`, for every spring and pair of a body with another, and for each that it feels through the fluid,
/// this other body and its cell, ∂Q by its coordinates, B of the one and A of the other.
pub(in super::super) fn add_interactions(at: &BodyAt, mut each: impl FnMut((usize, Cell), &Coupling, &Lower, &Lift)) {
    let (mut lower, mut felt) = (None, None);
    let Ok(()) = at.try_each_load(|load| {
        let (other, coupling) = match load {
            Load::Spring(end) => match end.other().body() {
                Some(other) => ((other, end.cell()), Coupling::of_spring(&end, at.spring(&end))),
                None => return Ok(()),
            },
            Load::Bond(end) => {
                let (slopes, own) = (at.bond_slopes(&end), end.end);
                let by_rate = slopes.by_rate.as_ref().map(|by_rate| by_rate[own][1 - own]);
                let coupling = Coupling { by_place: slopes.by_place[own][1 - own], by_rate };
                ((end.other_body(), end.cell()), coupling)
            }
            Load::Pair(pair) => {
                let Some(other) = pair.other_body() else { return Ok(()) };
                let (slopes, own) = (sloped(&pair), pair.end.end);
                let by_place = slopes.by_place[own][1 - own];
                let by_rate = slopes.by_rate.as_ref().map(|by_rate| by_rate[own][1 - own]);
                ((other, pair.end.cell()), Coupling { by_place, by_rate })
            }
            Load::Joint(end) => match end.other().body() {
                Some(other) => {
                    let own = end.end;
                    let mut by_place = end.interaction.slope(at.joint(&end), [own, 1 - own]);
                    let motor = at.motor_slopes(&end);
                    if let Some(motor) = motor {
                        by_place += motor.by_place[own][1 - own];
                    }
                    let by_rate = motor.map(|motor| motor.by_rate[own][1 - own]);
                    ((other, end.cell()), Coupling { by_place, by_rate })
                }
                None => return Ok(()),
            },
            Load::Neighbours(place) => {
                felt = Some(place);
                return Ok(());
            }
            // What acts on one body alone.
            Load::Contact(_)
            | Load::Couple(_)
            | Load::Applied(_)
            | Load::Resistance(_)
            | Load::Potential(_)
            | Load::BodyForce(_)
            | Load::PointForce(_)
            | Load::OwnFriction(_)
            | Load::MassFriction(_)
            | Load::SelfGravity(_)
            | Load::Fluid(..)
            | Load::Walls(_) => {
                return Ok(());
            }
        };
        let lower = lower.get_or_insert_with(|| Lower::of(at));
        each(other, &coupling, lower, &Lift::of_state(&at.beside(other.0)));
        Ok::<(), Infallible>(())
    });
    let (Some(own), Some(spheres)) = (felt, at.model.spheres()) else { return };
    let lower = lower.unwrap_or_else(|| Lower::of(at));
    for (place, other) in spheres.bodies().iter().enumerate().filter(|(place, _)| *place != own) {
        let beside = at.beside(*other);
        let moving = (&beside.inverse(), &beside.motion.velocity.gradient_rate);
        let [by_place, by_rate] = at.spheres().coupling([own, place], &at.motion.placement.gradient, moving);
        each((*other, HERE), &Coupling { by_place, by_rate: Some(by_rate) }, &lower, &Lift::of_state(&beside));
    }
}

impl Coupling {
    /// Of a spring between two bodies.
    fn of_spring(end: &SpringEnd, loads: &SpringLoads) -> Self {
        let (here, there) = (end.point(), end.other_point());
        let point = |point: &Vec3, place: usize| if place == 0 { 1.0 } else { point[place - 1] };
        let weight = |a: usize, b: usize| -point(&here, a) * point(&there, b);
        let (mut by_place, mut by_rate) = (Mat12::zeros(), Mat12::zeros());
        add_blocks(&mut by_place, &loads.by_place, weight);
        if end.interaction.law.damping == 0.0 {
            return Self { by_place, by_rate: None };
        }
        add_blocks(&mut by_rate, &loads.by_velocity, weight);
        Self { by_place, by_rate: Some(by_rate) }
    }
}
