//! The contact laws of a scene: force per area against distance for every law, and the force on each body.
//!
//! Both over logarithmic axes, where a power of the gap is a straight line, as in the slides. Central laws are
//! tractions [Pa], viscous ones resistances per speed [Pa s/m]. Attraction is drawn dashed, with its sign reversed.

use super::{MOST_LINES, MOST_NAMES};
use crate::check::Approach;
use crate::plot::PlotError;
use crate::plot::chart::ticks::length_in_words;
use crate::plot::chart::{Axis, Chart, DASHED, DOTTED, Panel, Series, extremes};
use crate::plot::draw::color;
use gyration::contact::{Action, Contact, ContactLaw, LawKind};
use gyration::model::Model;
use gyration::state::State;

const HEIGHT: f64 = 170.0;
/// Points along the curve of a law.
const POINTS: usize = 241;
/// The gaps drawn reach from and to this factor of the gaps of rest.
const AROUND_REST: f64 = 30.0;
/// Decades of force that are drawn below the largest one.
const MOST_DECADES: f64 = 14.0;

/// Charts of the laws and of the forces that they make.
///
/// # Errors
/// [`PlotError::Nothing`] without contacts.
pub fn law_panels(model: &Model, start: &State) -> Result<Vec<Panel>, PlotError> {
    let approaches = approaches(model, start);
    if approaches.is_empty() {
        return Err(PlotError::Nothing { what: "laws", reason: "no contact is given between a body and a support" });
    }
    let gaps = gap_axis(&approaches);
    let charts = [
        law_chart(model, &gaps, "Tractions of the central laws", "traction", "Pa", |action| action == Action::Central),
        law_chart(model, &gaps, "Resistances of the viscous laws", "traction per speed", "Pa s/m", |action| {
            action != Action::Central
        }),
        force_chart(model, &approaches, &gaps),
    ];
    Ok(charts.into_iter().flatten().map(Panel::Chart).collect())
}

/// Each pair of a body and a support that act on each other.
fn approaches<'a>(model: &'a Model, start: &State) -> Vec<(usize, usize, Approach<'a>)> {
    let mut approaches = Vec::new();
    for body in 0..model.bodies.len().min(MOST_LINES) {
        for support in 0..model.supports.len() {
            let approach = Approach::new(model, start, body, support).filter(Approach::acts);
            approaches.extend(approach.map(|approach| (body, support, approach)));
        }
    }
    approaches
}

/// From well below the nearest gap of rest to well above the farthest; without any, by the sizes of the bodies.
fn gap_axis(approaches: &[(usize, usize, Approach)]) -> Axis {
    let rests = approaches.iter().flat_map(|(_, _, approach)| approach.rests()).map(|rest| rest.gap);
    let sizes = approaches.iter().flat_map(|(_, _, approach)| [1e-3 * approach.size(), approach.size()]);
    let (low, high) = extremes(rests)
        .map_or_else(|| extremes(sizes).unwrap_or((1e-3, 1.0)), |(low, high)| (low / AROUND_REST, high * AROUND_REST));
    let axis = Axis::logarithmic("distance", "m", [low, high]);
    Axis { low, high, ..axis }
}

fn sampled(axis: &Axis) -> impl Iterator<Item = f64> + '_ {
    let ratio = axis.high / axis.low;
    (0..POINTS).map(move |k| axis.low * ratio.powf(k as f64 / (POINTS - 1) as f64))
}

/// The different contacts of the model with the name of their support.
fn contacts(model: &Model) -> Vec<&Contact> {
    let mut contacts: Vec<&Contact> = Vec::new();
    for contact in model.bodies.iter().flat_map(|body| &body.contacts) {
        if !contacts.contains(&contact) {
            contacts.push(contact);
        }
    }
    contacts
}

fn law_chart(
    model: &Model,
    gaps: &Axis,
    title: &str,
    name: &str,
    unit: &str,
    wanted: impl Fn(Action) -> bool,
) -> Option<Chart> {
    let contacts = contacts(model);
    let several = contacts.len() > 1;
    let mut series = Vec::new();
    for (index, contact) in contacts.iter().enumerate() {
        let acting = |law: &&ContactLaw| law.terms().iter().flatten().any(|term| wanted(term.action));
        for law in contact.laws().iter().filter(acting) {
            let of = if several { format!(" ({})", model.supports[contact.support].name) } else { String::new() };
            let hue = hue(law.kind()) + if several { index } else { 0 };
            series.extend(law_series(law, &of, hue, gaps));
        }
    }
    chart(title, name, unit, gaps, series)
}

/// The colour of a kind of law.
fn hue(kind: LawKind) -> usize {
    match kind {
        LawKind::Repulsion => 0,
        LawKind::Damping => 1,
        LawKind::Friction => 2,
        LawKind::Adhesion => 3,
    }
}

/// A law's factor over the gap; where it is negative, its magnitude in a dashed line.
fn law_series(law: &ContactLaw, of: &str, hue: usize, gaps: &Axis) -> Vec<Series> {
    let kind = law.kind().name();
    let points: Vec<[f64; 2]> = sampled(gaps).map(|gap| [gap, law.factor(gap)]).collect();
    let name = match law {
        ContactLaw::Adhesion(law) => {
            format!("{kind}{of}: {}, {}", law.attractive_exponent, law.repulsive_exponent)
        }
        _ => format!("{kind}{of}: ν = {}", law.leading_exponent()),
    };
    by_sign(name, points, hue)
}

/// The positive part in a solid line, the negative one with its sign reversed in a dashed line.
fn by_sign(name: String, points: Vec<[f64; 2]>, hue: usize) -> Vec<Series> {
    let part = |sign: f64| -> Vec<[f64; 2]> {
        points.iter().map(|[x, y]| [*x, if sign * y > 0.0 { sign * y } else { f64::NAN }]).collect()
    };
    let (pushing, pulling) = (part(1.0), part(-1.0));
    let drawn = |points: &[[f64; 2]]| points.iter().any(|point| point[1].is_finite());
    let mut series = Vec::new();
    if drawn(&pulling) {
        series.push(Series::solid(format!("{name}, pulling"), pulling, hue).dashed(DASHED));
    }
    if drawn(&pushing) {
        series.insert(0, Series::solid(name, pushing, hue));
    }
    series
}

/// The force of the central laws on each body, its weight, and the gaps at which they balance.
fn force_chart(model: &Model, approaches: &[(usize, usize, Approach)], gaps: &Axis) -> Option<Chart> {
    let several_supports = model.supports.len() > 1;
    let mut series = Vec::new();
    let mut marks = Vec::new();
    for (body, support, approach) in approaches {
        let force = |gap: f64| [gap, approach.force(gap).unwrap_or(f64::NAN)];
        let of = if several_supports { format!(" on {}", model.supports[*support].name) } else { String::new() };
        let name = format!("{}{of}", model.bodies[*body].name);
        let points: Vec<[f64; 2]> = sampled(gaps).map(force).collect();
        let named = series.len() < MOST_NAMES;
        series.extend(by_sign(name, points, *body).into_iter().map(|line| match named {
            true => line,
            false => Series { name: String::new(), ..line },
        }));
        if approaches.len() <= MOST_NAMES {
            marks.extend(balance_marks(approach, &model.bodies[*body].name, *body, gaps));
        }
    }
    let mut chart = chart("Force of the central laws on a body at its first orientation", "force", "N", gaps, series)?;
    // Marks do not decide the range; weights outside of it are not drawn.
    let (low, high) = (chart.y.low, chart.y.high);
    chart.series.extend(marks.into_iter().filter(|mark| (low..=high).contains(&mark.points[1][1])));
    Some(chart)
}

/// The weight as a level line and each gap of rest as an upright one below it.
fn balance_marks(approach: &Approach, name: &str, body: usize, gaps: &Axis) -> Vec<Series> {
    let weight = approach.weight;
    let mut marks = Vec::new();
    if weight > 0.0 {
        marks.push(Series::level(format!("weight of {name}"), weight, gaps));
    }
    for rest in approach.rests() {
        let mut mark = Series::solid(format!("rest gap {}", length_in_words(rest.gap)), Vec::new(), body);
        mark.stroke.width = 0.9;
        mark.points = vec![[rest.gap, f64::MIN_POSITIVE], [rest.gap, weight.abs()]];
        if !rest.stable {
            mark.stroke.color = color::GREY;
            mark.name += " (unstable)";
        }
        marks.push(mark.dashed(DOTTED));
    }
    marks
}

fn chart(title: &str, name: &str, unit: &str, gaps: &Axis, series: Vec<Series>) -> Option<Chart> {
    let values = || series.iter().flat_map(|series| &series.points).map(|point| point[1]);
    let (low, high) = extremes(values().filter(|y| *y > 0.0))?;
    let low = low.max(high * 10f64.powf(-MOST_DECADES));
    let y = Axis::logarithmic(name, unit, [low, high]);
    Some(Chart { title: title.into(), x: gaps.clone(), y, series, remarks: Vec::new(), height: HEIGHT })
}
