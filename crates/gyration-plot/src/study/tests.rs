//! Which picture suits which columns, and what stands in it.

use super::table::TableColumn;
use super::*;
use crate::chart::{ShapeChart, Shapes};
use crate::draw::{Format, Mark};
use crate::figure::Panel;

fn numbers(name: &str, role: Role, values: Vec<f64>) -> TableColumn {
    TableColumn { name: name.into(), unit: "m".into(), role, values: ColumnValues::Numbers(values) }
}

fn words(name: &str, values: &[&str]) -> TableColumn {
    let words = values.iter().map(|word| (!word.is_empty()).then(|| (*word).to_owned())).collect();
    TableColumn { name: name.into(), unit: String::new(), role: Role::Kept, values: ColumnValues::Words(words) }
}

fn table(columns: Vec<TableColumn>) -> RunTable {
    RunTable { title: "a study".into(), columns }
}

/// Two by two points, two runs each.
fn grid() -> RunTable {
    let axis = |values: [f64; 4]| values.into_iter().flat_map(|value| [value, value]).collect();
    table(vec![
        numbers("height", Role::Axis(0), axis([1.0, 1.0, 2.0, 2.0])),
        numbers("spin", Role::Axis(1), axis([5.0, 6.0, 5.0, 6.0])),
        words("face", &["+z", "+z", "-z", "-z", "+z", "-z", "+x", ""]),
        numbers("last", Role::Kept, vec![1.0, 3.0, 2.0, 2.0, 4.0, 4.0, 5.0, f64::NAN]),
    ])
}

fn field(figure: &Figure) -> &ShapeChart {
    match &figure.panels[0] {
        Panel::ShapeChart(field) => field,
        other => panic!("{other:?}"),
    }
}

#[test]
fn columns_choose_the_picture() {
    let none = PlotRequest::default();
    assert_eq!(kind_of(&grid(), &none), PlotKind::Map);
    let ask = |x: Option<&str>, y: Option<&str>| PlotRequest {
        x: x.map(Into::into),
        y: y.map(Into::into),
        ..PlotRequest::default()
    };
    assert_eq!(kind_of(&grid(), &ask(None, Some("face=+z"))), PlotKind::Curve);
    assert_eq!(kind_of(&grid(), &ask(Some("height"), None)), PlotKind::Curve);
    assert_eq!(kind_of(&grid(), &ask(Some("height"), Some("spin"))), PlotKind::Map);
    assert_eq!(kind_of(&grid(), &ask(Some("last"), Some("height"))), PlotKind::Scatter);
    assert_eq!(kind_of(&grid(), &ask(Some("last"), None)), PlotKind::Histogram);
    let random = table(vec![numbers("angle", Role::Random, vec![1.0, 2.0]), words("face", &["+x", "-x"])]);
    assert_eq!(kind_of(&random, &none), PlotKind::Histogram);
    let mut lists = random;
    let values = ColumnValues::Lists(vec![vec![1.0], vec![]]);
    lists.columns[1] = TableColumn { values, ..lists.columns[1].clone() };
    assert_eq!(kind_of(&lists, &none), PlotKind::Scatter);
}

/// Points that stand a little aside, at their places.
fn about(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    points.iter().map(|[x, y]| [x.round(), *y]).collect()
}

#[test]
fn parameters_that_vary_together_are_one_axis() {
    let table = table(vec![
        numbers("level", Role::Axis(0), vec![0.0, 0.0, 0.0]),
        numbers("downhill", Role::Axis(0), vec![1.0, 2.0, 3.0]),
        numbers("pressing", Role::Axis(0), vec![9.0, 8.0, 7.0]),
        numbers("speed", Role::Kept, vec![1.0, 2.0, 4.0]),
    ]);
    for x in [None, Some("downhill".to_owned()), Some("pressing".to_owned())] {
        let request = PlotRequest { x: x.clone(), ..PlotRequest::default() };
        assert_eq!(kind_of(&table, &request), PlotKind::Curve);
        let figure = figure(&table, &request).unwrap();
        let chart = &field(&figure).chart;
        assert_eq!((chart.series.len(), chart.series[0].points.len()), (1, 3), "{x:?}");
        assert_eq!(chart.x.name, x.unwrap_or("downhill".into()));
    }
}

#[test]
fn the_mean_of_lists_is_over_runs() {
    let lists = vec![vec![1.0; 50], vec![3.0; 50]];
    let column = TableColumn { values: ColumnValues::Lists(lists), ..numbers("peaks", Role::Kept, Vec::new()) };
    let request = PlotRequest { kind: Some(PlotKind::Histogram), ..PlotRequest::default() };
    let figure = figure(&table(vec![column]), &request).unwrap();
    // Two values, 1 and 3: t = 12.7 with one degree of freedom.
    let remarks = &field(&figure).chart.remarks;
    assert_eq!(remarks[..], ["100 values", "mean 2 ± 13 m"], "{remarks:?}");
}

#[test]
fn share_of_a_face_is_that_of_the_runs_which_have_one() {
    let request = PlotRequest { x: Some("height".into()), y: Some("face=+z,-z".into()), ..PlotRequest::default() };
    let figure = figure(&grid(), &PlotRequest { colour: Some("spin".into()), ..request }).unwrap();
    let chart = &field(&figure).chart;
    // At (2, 6) one of two runs failed and the other one ended on +x.
    assert_eq!(about(&chart.series[0].points), [[1.0, 1.0], [2.0, 1.0]]);
    assert_eq!(about(&chart.series[1].points), [[1.0, 1.0], [2.0, 0.0]]);
    assert_eq!(chart.series[1].name, "spin = 6 m");
    // A dot stands where its interval does, and those of two curves beside each other.
    let Shapes::Intervals { ends, .. } = &field(&figure).shapes[0] else { panic!() };
    assert_eq!(ends[0][0][0], chart.series[0].points[0][0]);
    assert!(chart.series[0].points[0][0] < chart.series[1].points[0][0]);
}

#[test]
fn two_columns_may_be_asked_to_agree() {
    let mut table = grid();
    table
        .columns
        .push(TableColumn { name: "first".into(), ..words("", &["+z", "-z", "-z", "-z", "+z", "+z", "+y", "+x"]) });
    let request = PlotRequest { x: Some("height".into()), y: Some("face=first".into()), ..PlotRequest::default() };
    let figure = figure(&table, &request).unwrap();
    assert_eq!(about(&field(&figure).chart.series[0].points), [[1.0, 0.5], [2.0, 0.5]]);
    assert_eq!(about(&field(&figure).chart.series[1].points), [[1.0, 1.0], [2.0, 0.0]]);
}

#[test]
fn cells_of_a_row_with_one_colour_are_one_area() {
    let request = PlotRequest { colour: Some("last".into()), ..PlotRequest::default() };
    let table = table(vec![
        numbers("a", Role::Axis(0), vec![1.0, 2.0, 4.0, 1.0, 2.0, 4.0]),
        numbers("b", Role::Axis(1), vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0]),
        words("last", &["up", "up", "down", "up", "down", "down"]),
    ]);
    let figure = figure(&table, &request).unwrap();
    let count = |shapes: &Shapes| match shapes {
        Shapes::Areas { corners, .. } => corners.len(),
        other => panic!("{other:?}"),
    };
    let areas: Vec<usize> = field(&figure).shapes.iter().map(count).collect();
    assert_eq!(areas, [2, 2]);
    // The cells of 1, 2, 4 reach to the geometric means.
    let Shapes::Areas { corners, .. } = &field(&figure).shapes[1] else { panic!() };
    assert!((corners[0][0][0] - 0.5_f64.sqrt()).abs() < 1e-12 && (corners[0][1][0] - 8f64.sqrt()).abs() < 1e-12);
}

#[test]
fn histogram_of_faces_counts_the_face_that_never_came() {
    let random = table(vec![words("face", &["+x", "-x", "+x", ""])]);
    let figure = figure(&random, &PlotRequest::default()).unwrap();
    let chart = &field(&figure).chart;
    assert_eq!(chart.x.words.len(), 6);
    assert_eq!(chart.series[0].points[0][1], 0.5);
    assert!(chart.remarks.iter().any(|words| words.contains("5 degrees")), "{:?}", chart.remarks);
}

#[test]
fn what_does_not_suit_is_told_with_what_there_is() {
    let ask = |x: &str, y: &str, kind| PlotRequest {
        kind: Some(kind),
        x: Some(x.into()),
        y: Some(y.into()),
        ..PlotRequest::default()
    };
    let problem = figure(&grid(), &ask("heigth", "face", PlotKind::Curve)).unwrap_err().to_string();
    assert!(problem.contains("`heigth`") && problem.contains("height, spin"), "{problem}");
    let problem = figure(&grid(), &ask("face", "height", PlotKind::Map)).unwrap_err().to_string();
    assert!(problem.contains("two axes of numbers"), "{problem}");
    assert!(figure(&table(vec![words("face", &["", ""])]), &ask("face", "face", PlotKind::Scatter)).is_err());
}

#[test]
fn a_logarithmic_scale_says_what_it_leaves_out() {
    let request = |x: &str, kind| PlotRequest {
        kind: Some(kind),
        x: Some(x.into()),
        y: Some("spin".into()),
        colour: Some("last".into()),
        logarithmic: vec!["x".into(), "colour".into()],
        ..PlotRequest::default()
    };
    let mut table = grid();
    table.columns[3] = numbers("last", Role::Kept, vec![0.0, 0.0, 2.0, 2.0, 4.0, 4.0, 5.0, f64::NAN]);
    let remarks = |figure: &Figure| field(figure).chart.remarks.clone();
    assert_eq!(remarks(&figure(&table, &request("height", PlotKind::Map)).unwrap()), ["1 left out: not above zero"]);
    let change = vec![-1.0, 0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
    table.columns.push(numbers("change", Role::Kept, change));
    assert_eq!(
        remarks(&figure(&table, &request("change", PlotKind::Scatter)).unwrap()),
        ["2 left out: not above zero"]
    );
    table.columns[3] = numbers("last", Role::Kept, vec![-1.0; 8]);
    for kind in [PlotKind::Map, PlotKind::Scatter] {
        let problem = figure(&table, &request("height", kind)).unwrap_err().to_string();
        assert!(problem.contains("`last` is above zero") && problem.contains("logarithmic"), "{problem}");
    }
}

#[test]
fn runs_that_ended_early_are_counted() {
    let mut table = grid();
    table.columns.push(TableColumn {
        name: "outcome".into(),
        ..words("", &["completed", "failed", "gap_closed", "step_limit", "at_rest", "completed", "completed", "failed"])
    });
    assert_eq!(
        figure(&table, &PlotRequest::default()).unwrap().subtitle,
        "8 runs, 2 of them failed, 2 of them ended early"
    );
}

#[test]
fn every_kind_draws_in_every_format() {
    for kind in [PlotKind::Histogram, PlotKind::Curve, PlotKind::Map, PlotKind::Scatter] {
        let y = if kind == PlotKind::Map { "spin" } else { "last" };
        let request =
            PlotRequest { kind: Some(kind), x: Some("height".into()), y: Some(y.into()), ..PlotRequest::default() };
        let drawing = figure(&grid(), &request).unwrap().draw();
        assert!(drawing.marks.iter().any(|mark| matches!(mark, Mark::Path(path) if path.fill.is_some())), "{kind:?}");
        for format in [Format::Svg, Format::Png, Format::Pdf] {
            assert!(drawing.render(format).len() > 1000);
        }
    }
}
