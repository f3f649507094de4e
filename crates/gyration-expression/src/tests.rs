//! Relations: derivatives agree with differences, texts with the trees that they are printed from, faults with columns.

use proptest::prelude::*;

use crate::{Expression, ParseError, Reason, Scratch, Want};

const VARIABLES: [&str; 3] = ["x", "y", "t"];

fn parsed(text: &str) -> Expression {
    Expression::parse(text, &VARIABLES, &[("k".to_owned(), 40.0)]).unwrap()
}

fn value(text: &str) -> f64 {
    parsed(text).value(&[2.0, 3.0, 0.5], &mut Scratch::default()).unwrap()
}

fn fault(text: &str) -> (usize, Reason) {
    match Expression::parse(text, &VARIABLES, &[("k".to_owned(), 40.0)]).unwrap_err() {
        ParseError::Text { column, reason } => (column, reason),
        other => panic!("{other}"),
    }
}

#[test]
fn powers_bind_tighter_than_signs_and_group_to_the_right() {
    assert_eq!(value("-x^2"), -4.0);
    assert_eq!(value("(-x)^2"), 4.0);
    assert_eq!(value("2^x^3"), 256.0);
    assert_eq!(value("2^-x"), 0.25);
    assert_eq!(value("-2^-x^2"), -0.0625);
    assert_eq!(value("x - y - t"), -1.5);
    assert_eq!(value("x / y / t"), 2.0 / 3.0 / 0.5);
    assert_eq!(value("x*-y"), -6.0);
    assert_eq!(value("x - -y"), 5.0);
    assert_eq!(value("6 - 2*3^2/9 + 1"), 5.0);
}

#[test]
fn constants_take_the_place_of_their_names_and_the_first_of_a_name_counts() {
    let constants = [("k".to_owned(), 3.0), ("k".to_owned(), 4.0), ("a_1".to_owned(), 0.5)];
    let expression = Expression::parse("k*a_1 + pi", &[], &constants).unwrap();
    assert_eq!(expression.constant(), Some(1.5 + std::f64::consts::PI));
    assert_eq!(value("0.5*k*x^2"), 80.0);
}

#[test]
fn numbers_have_points_and_exponents() {
    assert_eq!(value(".5 + 5. + 1e-3*1E3 + 2.5e+1"), 0.5 + 5.0 + 1.0 + 25.0);
}

#[test]
fn functions_are_those_of_libm() {
    assert_eq!(value("tanh(x) + ln(y) + sqrt(t)"), libm::tanh(2.0) + libm::log(3.0) + libm::sqrt(0.5));
    assert_eq!(value("min(x, y) + max(x, y)*abs(-t)"), 3.5);
}

#[test]
fn whole_powers_are_products() {
    assert_eq!(value("0.1^3"), 0.1 * 0.1 * 0.1);
    assert_eq!(value("(x/10)^3"), 0.2 * (0.2 * 0.2));
    assert_eq!(value("(-x)^-3"), -0.125);
    assert_eq!(value("x^0"), 1.0);
}

#[test]
fn faults_have_columns() {
    let cases = [
        ("2x", 2, Reason::Operator("`x`".to_owned())),
        ("x y", 3, Reason::Operator("`y`".to_owned())),
        ("2(x)", 2, Reason::Operator("`(`".to_owned())),
        ("(x)(y)", 4, Reason::Operator("`(`".to_owned())),
        ("", 1, Reason::Empty),
        ("  ", 3, Reason::Empty),
        ("x +", 4, Reason::Operand("the end".to_owned())),
        ("x + * y", 5, Reason::Operand("`*`".to_owned())),
        ("x**2", 2, Reason::Stars),
        ("x % 2", 3, Reason::Character('%')),
        ("ä + x", 1, Reason::Character('ä')),
        ("1.2.3", 1, Reason::Number("1.2.3".to_owned())),
        ("x + 1e999", 5, Reason::Number("1e999".to_owned())),
        ("(x + 1", 1, Reason::Unclosed),
        ("x + 1)", 6, Reason::Unopened),
        ("x, y", 2, Reason::Comma),
        ("(x, y)", 3, Reason::Comma),
        ("sin x", 1, Reason::Function("sin".to_owned())),
        ("k(x)", 1, Reason::NoFunction("k".to_owned())),
        ("x(y)", 1, Reason::NoFunction("x".to_owned())),
        ("1 + min(x)", 5, Reason::Arguments { name: "min", takes: "two arguments", given: 1 }),
        ("max(x, y, t)", 9, Reason::Arguments { name: "max", takes: "two arguments", given: 3 }),
        ("sin(x, y)", 6, Reason::Arguments { name: "sin", takes: "one argument", given: 2 }),
    ];
    for (text, column, reason) in cases {
        assert_eq!(fault(text), (column, reason), "{text}");
    }
}

#[test]
fn unknown_names_tell_what_is_known() {
    let (column, reason) = fault("2*z + x");
    assert_eq!(column, 3);
    let words = reason.to_string();
    assert!(words.starts_with("`z` is not known; variables: x, y, t; constants: k; functions: sqrt, exp"), "{words}");
}

#[test]
fn constants_may_not_be_named_like_what_has_a_meaning() {
    let named = |name: &str| Expression::parse("x", &VARIABLES, &[(name.to_owned(), 1.0)]).unwrap_err();
    assert_eq!(named("x"), ParseError::ConstantTaken { name: "x".to_owned(), taken_by: "a variable" });
    assert_eq!(named("min"), ParseError::ConstantTaken { name: "min".to_owned(), taken_by: "a function" });
    assert_eq!(named("pi"), ParseError::ConstantTaken { name: "pi".to_owned(), taken_by: "the number pi" });
    assert_eq!(named("2k"), ParseError::ConstantName { name: "2k".to_owned() });
    assert_eq!(named("").column(), None);
}

#[test]
fn parts_without_variables_are_computed_at_once_and_must_be_finite() {
    assert_eq!(fault("x + 1/(2 - 2)").0, 6);
    assert_eq!(fault("x*ln(0)").1.to_string(), "`ln` has no finite value at 0");
    assert_eq!(parsed("sqrt(0) + abs(0)").constant(), Some(0.0));
}

#[test]
fn depth_is_bounded_and_length_is_not() {
    for nested in ["(".repeat(100_000), "-".repeat(100_000), "sin(".repeat(100_000), "2^".repeat(100_000)] {
        assert!(matches!(fault(&nested).1, Reason::Depth(100)));
    }
    let long = vec!["x"; 100_000].join(" + ");
    assert_eq!(value(&long), 200_000.0);
}

#[test]
fn places_without_a_derivative_are_told() {
    let scratch = &mut Scratch::default();
    let (gradient, hessian) = (&mut [0.0; 3], &mut [0.0; 9]);
    for (text, at, want) in [
        ("abs(x)", 0.0, Want::Derivative),
        ("sqrt(x)", 0.0, Want::Derivative),
        ("x^0.5", 0.0, Want::Derivative),
        ("x^1.5", 0.0, Want::SecondDerivative),
        ("x^y", 0.0, Want::Derivative),
        ("ln(x)", 0.0, Want::Value),
        ("1/x", 0.0, Want::Value),
        ("x^-2", 0.0, Want::Value),
        ("sqrt(x)", -1.0, Want::Value),
        ("x^y", -1.0, Want::Value),
        ("exp(x)", 1e3, Want::Value),
        ("1e300*x*1e300", 1.0, Want::Value),
    ] {
        let expression = parsed(text);
        let point = [at, 2.0, 0.0];
        let undefined = expression.hessian(&point, scratch, gradient, hessian).unwrap_err();
        assert_eq!(undefined.want, want, "{text}: {undefined}");
        assert_eq!(expression.value(&point, scratch).is_err(), want == Want::Value, "{text}");
        assert_eq!(expression.gradient(&point, scratch, gradient).is_err(), want != Want::SecondDerivative, "{text}");
    }
    let undefined = parsed("1 + abs(x)").gradient(&[0.0; 3], scratch, gradient).unwrap_err();
    assert_eq!(undefined.to_string(), "`abs` has no derivative at 0 (column 5)");
}

#[test]
fn no_derivative_is_asked_of_what_does_not_enter() {
    let scratch = &mut Scratch::default();
    let (gradient, hessian) = (&mut [0.0; 3], &mut [0.0; 9]);
    // The operand that is not taken, and a function of what is held.
    let expression = parsed("max(abs(x), 1) + y*abs(t) + y^(1 + sqrt(t))").holding(&[2]);
    expression.hessian(&[0.0, 2.0, 0.0], scratch, gradient, hessian).unwrap();
    assert_eq!(gradient, &[0.0, 1.0, 0.0]);
    assert_eq!(expression.free().collect::<Vec<_>>(), [0, 1]);
    assert!(expression.uses(2));
}

#[test]
fn equal_operands_of_min_and_max_have_the_derivative_of_the_first() {
    let scratch = &mut Scratch::default();
    let gradient = &mut [0.0; 3];
    for text in ["max(x, 2*y)", "min(x, 2*y)"] {
        parsed(text).gradient(&[2.0, 1.0, 0.0], scratch, gradient).unwrap();
        assert_eq!(gradient, &[1.0, 0.0, 0.0], "{text}");
    }
}

#[test]
fn degree_is_that_of_the_polynomial_as_written() {
    let degree = |text: &str| parsed(text).degree(&[0, 1]);
    assert_eq!(degree("3"), Some(0));
    assert_eq!(degree("2*sin(3*t)*x + y/t"), Some(1));
    assert_eq!(degree("(x + y)^3*x - -x"), Some(4));
    assert_eq!(degree("x^2/2 + 2^t + min(t, 1)"), Some(2));
    for text in ["1/x", "sin(x)", "x^0.5", "x^y", "max(x, 1)", "x^-1", "x/y", "abs(x)"] {
        assert_eq!(degree(text), None, "{text}");
    }
}

#[test]
fn hessian_of_many_variables_touches_those_that_occur() {
    let names: Vec<String> = (0..31).map(|i| format!("v{i}")).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let expression = Expression::parse("v3*v17^2 + v3", &names, &[]).unwrap();
    assert_eq!(expression.free().collect::<Vec<_>>(), [3, 17]);
    let (gradient, hessian) = (&mut [1.0; 31], &mut [1.0; 961]);
    let point: Vec<f64> = (0..31).map(f64::from).collect();
    expression.hessian(&point, &mut Scratch::default(), gradient, hessian).unwrap();
    let not_zero: Vec<(usize, f64)> = hessian.iter().copied().enumerate().filter(|(_, entry)| *entry != 0.0).collect();
    assert_eq!(not_zero, [(3 * 31 + 17, 34.0), (17 * 31 + 3, 34.0), (17 * 31 + 17, 6.0)]);
    assert_eq!((gradient[3], gradient[17]), (290.0, 102.0));
}

/// A tree of which text and value are known without the parser.
#[derive(Clone, Debug)]
enum Tree {
    Number(f64),
    Variable(usize),
    Negative(Box<Tree>),
    Call(&'static str, Box<Tree>),
    Whole(Box<Tree>, i32),
    Between(char, Box<Tree>, Box<Tree>),
}

impl Tree {
    /// Text with as few parentheses as the grammar allows around an operand that must bind at least as `rank`.
    fn text(&self, rank: u8) -> String {
        let (own, text) = match self {
            Tree::Number(value) => (4, value.to_string()),
            Tree::Variable(index) => (4, VARIABLES[*index].to_owned()),
            Tree::Negative(a) => (2, format!("-{}", a.text(2))),
            Tree::Call(name, a) => (4, format!("{name}({})", a.text(0))),
            Tree::Whole(a, n) => (3, format!("{}^{n}", a.text(4))),
            Tree::Between(sign @ ('+' | '-'), a, b) => (0, format!("{} {sign} {}", a.text(0), b.text(1))),
            Tree::Between(sign, a, b) => (1, format!("{}{sign}{}", a.text(1), b.text(2))),
        };
        if own < rank { format!("({text})") } else { text }
    }

    fn value(&self, at: &[f64]) -> f64 {
        match self {
            Tree::Number(value) => *value,
            Tree::Variable(index) => at[*index],
            Tree::Negative(a) => -a.value(at),
            Tree::Call(name, a) => {
                let a = a.value(at);
                match *name {
                    "sin" => libm::sin(a),
                    "cos" => libm::cos(a),
                    "tanh" => libm::tanh(a),
                    "exp" => libm::exp(a),
                    "sqrt" => libm::sqrt(a),
                    "ln" => libm::log(a),
                    "tan" => libm::tan(a),
                    _ => a.abs(),
                }
            }
            Tree::Whole(a, n) => crate::operation::whole_power(a.value(at), *n),
            Tree::Between('+', a, b) => a.value(at) + b.value(at),
            Tree::Between('-', a, b) => a.value(at) - b.value(at),
            Tree::Between('*', a, b) => a.value(at) * b.value(at),
            Tree::Between(_, a, b) => a.value(at) / b.value(at),
        }
    }
}

fn trees() -> impl Strategy<Value = Tree> {
    let leaf = prop_oneof![
        (1..40_u32).prop_map(|tenths| Tree::Number(f64::from(tenths) / 10.0)),
        (0..3_usize).prop_map(Tree::Variable),
        (0..3_usize).prop_map(Tree::Variable),
    ];
    leaf.prop_recursive(5, 24, 2, |inner| {
        let function = prop_oneof![
            Just("sin"),
            Just("cos"),
            Just("tanh"),
            Just("exp"),
            Just("sqrt"),
            Just("ln"),
            Just("tan"),
            Just("abs")
        ];
        let sign = prop_oneof![Just('+'), Just('-'), Just('*'), Just('/')];
        prop_oneof![
            inner.clone().prop_map(|a| Tree::Negative(Box::new(a))),
            (function, inner.clone()).prop_map(|(name, a)| Tree::Call(name, Box::new(a))),
            (inner.clone(), -3..5_i32).prop_map(|(a, n)| Tree::Whole(Box::new(a), n)),
            (sign, inner.clone(), inner).prop_map(|(sign, a, b)| Tree::Between(sign, Box::new(a), Box::new(b))),
        ]
    })
}

/// Derivative of `of` at zero from central differences with steps h and h/2, extrapolated, and what the two differ by.
fn difference(of: impl Fn(f64) -> Option<f64>) -> Option<(f64, f64)> {
    let h = 1e-3;
    let central = |h: f64| Some((of(h)? - of(-h)?) / (2.0 * h));
    let (coarse, fine) = (central(h)?, central(h / 2.0)?);
    Some((fine + (fine - coarse) / 3.0, (fine - coarse).abs()))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    /// The same bytes as the tree, whose operations are rounded in the same order.
    #[test]
    fn text_means_the_tree_that_it_was_printed_from(tree in trees(), x in 0.1..3.0, y in -2.0..2.0, t in 0.0..1.0) {
        let at = [x, y, t];
        let text = tree.text(0);
        let Ok(expression) = Expression::parse(&text, &VARIABLES, &[]) else { return Ok(()) };
        match expression.value(&at, &mut Scratch::default()) {
            Ok(value) => prop_assert_eq!(value.to_bits(), tree.value(&at).to_bits(), "{}", text),
            // Some part of it is not finite, even if dividing by it is.
            Err(undefined) => prop_assert_eq!(undefined.want, Want::Value),
        }
    }

    /// Steps of 1e-3 extrapolated twice: errors of order 1e-12 times the fifth derivative; where the two steps disagree
    /// by more than a thousandth the function bends too sharply for differences.
    #[test]
    fn derivatives_agree_with_differences(tree in trees(), x in 0.1..3.0, y in -2.0..2.0, t in 0.0..1.0) {
        let at = [x, y, t];
        let text = tree.text(0);
        let Ok(expression) = Expression::parse(&text, &VARIABLES, &[]) else { return Ok(()) };
        let (gradient, hessian, scratch) = (&mut [0.0; 3], &mut [0.0; 9], &mut Scratch::default());
        let Ok(value) = expression.hessian(&at, scratch, gradient, hessian) else { return Ok(()) };
        let moved = |i: usize, h: f64| { let mut moved = at; moved[i] += h; moved };
        for i in 0..3 {
            let values = |h: f64| expression.value(&moved(i, h), &mut Scratch::default()).ok();
            if let Some((slope, doubt)) = difference(values) {
                let tolerance = 1e-9 * (1.0 + value.abs() + slope.abs()) + doubt;
                if doubt < 1e-3 * (1.0 + slope.abs()) {
                    prop_assert!((slope - gradient[i]).abs() <= tolerance, "{}: {} {}", text, slope, gradient[i]);
                }
            }
            for j in 0..3 {
                prop_assert_eq!(hessian[3 * i + j].to_bits(), hessian[3 * j + i].to_bits());
                let slopes = |h: f64| {
                    let gradient = &mut [0.0; 3];
                    expression.gradient(&moved(i, h), &mut Scratch::default(), gradient).ok().map(|_| gradient[j])
                };
                if let Some((bend, doubt)) = difference(slopes) {
                    let tolerance = 1e-9 * (1.0 + gradient[j].abs() + bend.abs()) + doubt;
                    if doubt < 1e-3 * (1.0 + bend.abs()) {
                        let entry = hessian[3 * i + j];
                        prop_assert!((bend - entry).abs() <= tolerance, "{}: {} {}", text, bend, entry);
                    }
                }
            }
        }
    }

    /// Whatever the text: an expression or a fault at a column of it.
    #[test]
    fn any_text_ends_soundly(text in "[-+*/^(),.0-9a-z _é]{0,40}") {
        match Expression::parse(&text, &VARIABLES, &[]) {
            Ok(expression) => {
                let _ = expression.hessian(&[1.0, 2.0, 3.0], &mut Scratch::default(), &mut [0.0; 3], &mut [0.0; 9]);
            }
            Err(error) => prop_assert!(error.column().unwrap() <= text.chars().count() + 1),
        }
    }
}
