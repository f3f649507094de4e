//! The contact laws of a scene: force per area against distance for every law, and the force on each body.
//!
//! Both over logarithmic axes, where a power of the gap is a straight line, as in the slides. Central laws are
//! tractions [Pa], viscous ones resistances per speed [Pa s/m]. Attraction is drawn dashed, with its sign reversed. The
//! distance of a law between bodies is that to the plane between them; the force of two is drawn over the width of the
//! slab.
//!
//! | file      | what                                                       |
//! |-----------|------------------------------------------------------------|
//! | `sources` | the different laws of a model, and the names of who has them |
//! | `forces`  | the force on each body, its weight, and where they balance |

mod forces;
mod sources;

use crate::chart::{Axis, Chart, DASHED, Series, extremes};
use crate::error::PlotError;
use crate::figure::Panel;
use forces::{ForceCurve, force_chart};
use gyration::contact::{Action, ContactLaw, LawKind};
use gyration::model::Model;
use gyration::state::State;
use serde_json::Value;
use sources::LawSource;

const HEIGHT: f64 = 170.0;
/// Points along the curve of a law.
const POINTS: usize = 241;
/// The gaps drawn reach from and to this factor of the gaps of rest.
const AROUND_REST: f64 = 10.0;
/// The values drawn reach so far below and above those at the gaps of rest.
const AROUND_VALUES: (f64, f64) = (1e-5, 1e7);
/// Without a gap of rest, so many decades below the largest value are drawn.
const MOST_DECADES: f64 = 14.0;

/// Charts of the laws and of the forces that they make; the resolved scene names groups of bodies.
///
/// # Errors
/// [`PlotError::Nothing`] without contacts.
pub fn law_panels(model: &Model, start: &State, resolved: &Value) -> Result<Vec<Panel>, PlotError> {
    let (curves, left_out) = ForceCurve::all(model, start, resolved);
    if curves.is_empty() {
        let reason = "no contact acts between a body and a support, or between two bodies";
        return Err(PlotError::Nothing { what: "laws", reason });
    }
    let rests = curves.iter().flat_map(ForceCurve::rests).map(|rest| rest.gap).collect();
    let gaps = GapRange { axis: gap_axis(&curves), rests };
    let sources = LawSource::all(model, resolved);
    let charts = [
        law_chart(&sources, &gaps, &CENTRAL),
        law_chart(&sources, &gaps, &VISCOUS),
        force_chart(&curves, left_out, &gaps),
    ];
    Ok(charts.into_iter().flatten().map(Panel::Chart).collect())
}

/// From well below the nearest gap of rest to well above the farthest; without any, by the sizes of the bodies.
fn gap_axis(curves: &[ForceCurve]) -> Axis {
    let rests = curves.iter().flat_map(ForceCurve::rests).map(|rest| rest.gap);
    let sizes = curves.iter().map(ForceCurve::size).flat_map(|size| [1e-3 * size, size]);
    let (low, high) = extremes(rests)
        .map_or_else(|| extremes(sizes).unwrap_or((1e-3, 1.0)), |(low, high)| (low / AROUND_REST, high * AROUND_REST));
    let axis = Axis::logarithmic("distance", "m", [low, high]);
    Axis { low, high, ..axis }
}

/// The gaps that are drawn, and those of rest.
struct GapRange {
    axis: Axis,
    rests: Vec<f64>,
}

impl GapRange {
    fn sampled(&self) -> impl Iterator<Item = f64> + '_ {
        let Axis { low, high, .. } = self.axis;
        (0..POINTS).map(move |k| low * libm::pow(high / low, k as f64 / (POINTS - 1) as f64))
    }
}

/// One of the two charts of laws.
struct Laws {
    title: &'static str,
    name: &'static str,
    unit: &'static str,
    central: bool,
}

const CENTRAL: Laws = Laws { title: "Tractions of the central laws", name: "traction", unit: "Pa", central: true };
const VISCOUS: Laws =
    Laws { title: "Resistances of the viscous laws", name: "traction per speed", unit: "Pa s/m", central: false };

fn law_chart(sources: &[LawSource], gaps: &GapRange, laws: &Laws) -> Option<Chart> {
    let several = sources.len() > 1;
    let acting =
        |law: &&ContactLaw| law.terms().iter().flatten().any(|term| (term.action == Action::Central) == laws.central);
    let mut series = Vec::new();
    let mut between = false;
    for (index, source) in sources.iter().enumerate() {
        for law in source.laws.iter().filter(acting) {
            let of = if several || source.is_between_bodies { format!(" ({})", source.name) } else { String::new() };
            let hue = hue(law.kind()) + if several { index } else { 0 };
            series.extend(law_series(law, &of, hue, gaps));
            between |= source.is_between_bodies;
        }
    }
    let mut chart = chart([laws.title, laws.name, laws.unit], gaps, series)?;
    if between {
        chart.remarks.extend(["between solids: distance".to_owned(), "to the plane between them".to_owned()]);
    }
    Some(chart)
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
fn law_series(law: &ContactLaw, of: &str, hue: usize, gaps: &GapRange) -> Vec<Series> {
    let kind = law.kind().name();
    let points: Vec<[f64; 2]> = gaps.sampled().map(|gap| [gap, law.factor(gap)]).collect();
    let name = match law {
        ContactLaw::Adhesion(law) => {
            format!("{kind}{of}: {}, {}", law.attractive_exponent, law.repulsive_exponent)
        }
        ContactLaw::Repulsion(_) | ContactLaw::Damping(_) | ContactLaw::Friction(_) => {
            let bound = law.mu().map(|mu| format!(", up to {mu} of the repulsion")).unwrap_or_default();
            let one_sided = if law.release().is_some() { ", one-sided" } else { "" };
            format!("{kind}{of}: ν = {}{bound}{one_sided}", law.leading_exponent())
        }
    };
    let mut series = by_sign(name, points, hue);
    // Friction is often given the numbers of damping: its line must not hide the other.
    if law.kind() == LawKind::Friction {
        series.iter_mut().for_each(|line| line.stroke.dash = DASHED);
    }
    series
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
        let name = if name.is_empty() { String::new() } else { format!("{name}, pulling") };
        series.push(Series::solid(name, pulling, hue).dashed(DASHED));
    }
    if drawn(&pushing) {
        series.insert(0, Series::solid(name, pushing, hue));
    }
    series
}

/// A chart with title, name and unit of its upward axis; none without anything to draw.
fn chart([title, name, unit]: [&str; 3], gaps: &GapRange, series: Vec<Series>) -> Option<Chart> {
    let (low, high) = range(gaps, &series)?;
    let y = Axis::logarithmic(name, unit, [low, high]);
    Some(Chart { title: title.into(), x: gaps.axis.clone(), y, series, remarks: Vec::new(), height: HEIGHT })
}

/// The values that are drawn: some decades around those at the gaps of rest, as far as there are any.
fn range(gaps: &GapRange, series: &[Series]) -> Option<(f64, f64)> {
    let points = || series.iter().flat_map(|series| &series.points).filter(|point| point[1] > 0.0);
    let (least, most) = extremes(points().map(|point| point[1]))?;
    let near = |gap: f64| points().filter(move |point| libm::log(point[0] / gap).abs() < 0.1).map(|point| point[1]);
    let typical = extremes(gaps.rests.iter().flat_map(|gap| near(*gap)));
    Some(match typical {
        Some((low, high)) => (least.max(AROUND_VALUES.0 * low), most.min(AROUND_VALUES.1 * high)),
        None => (least.max(most * libm::pow(10f64, -MOST_DECADES)), most),
    })
}
