use super::*;
use std::f64::consts::PI;

const LENGTH: UnitDimension = UnitDimension::new(1, 0, 0, 0);
const PRESSURE: UnitDimension = UnitDimension::new(-1, 1, -2, 0);

/// Text, value in SI, dimension. Products of two or three decimal factors round: 4 units in the last place.
const TABLE: &[(&str, f64, UnitDimension)] = &[
    ("2 cm", 0.02, LENGTH),
    ("2cm", 0.02, LENGTH),
    ("-3.5e2 um", -3.5e-4, LENGTH),
    ("1 µm", 1e-6, LENGTH),
    ("30 kPa", 3e4, PRESSURE),
    ("1 N/m^2", 1.0, PRESSURE),
    ("2 mbar", 200.0, PRESSURE),
    ("15 deg", PI / 12.0, UnitDimension::new(0, 0, 0, 1)),
    ("15°", PI / 12.0, UnitDimension::new(0, 0, 0, 1)),
    ("3 rpm", PI / 10.0, UnitDimension::new(0, 0, -1, 1)),
    ("2 rev/s", 4.0 * PI, UnitDimension::new(0, 0, -1, 1)),
    ("10 min", 600.0, UnitDimension::new(0, 0, 1, 0)),
    ("2 h", 7200.0, UnitDimension::new(0, 0, 1, 0)),
    ("5 m/s", 5.0, UnitDimension::new(1, 0, -1, 0)),
    ("36 km/h", 10.0, UnitDimension::new(1, 0, -1, 0)),
    ("9.81 m/s^2", 9.81, UnitDimension::new(1, 0, -2, 0)),
    ("9.81 m s^-2", 9.81, UnitDimension::new(1, 0, -2, 0)),
    ("9.81 m·s⁻²", 9.81, UnitDimension::new(1, 0, -2, 0)),
    ("1200 kg/m^3", 1200.0, UnitDimension::new(-3, 1, 0, 0)),
    ("2 g/cm3", 2000.0, UnitDimension::new(-3, 1, 0, 0)),
    ("1 kg/L", 1000.0, UnitDimension::new(-3, 1, 0, 0)),
    ("0.1 N s/m", 0.1, UnitDimension::new(0, 1, -1, 0)),
    ("3 Pa s/m", 3.0, UnitDimension::new(-2, 1, -1, 0)),
    ("20 mPa s", 0.02, UnitDimension::new(-1, 1, -1, 0)),
    ("3 mN m", 3e-3, UnitDimension::new(2, 1, -2, 0)),
    ("3 kN·cm", 30.0, UnitDimension::new(2, 1, -2, 0)),
    ("10 N/m", 10.0, UnitDimension::new(0, 1, -2, 0)),
    ("4 g cm^2", 4e-7, UnitDimension::new(2, 1, 0, 0)),
    ("1 J/(kg m)", 1.0, UnitDimension::new(1, 0, -2, 0)),
    ("50 mHz", 0.05, UnitDimension::new(0, 0, -1, 0)),
    ("5 s^-1", 5.0, UnitDimension::new(0, 0, -1, 0)),
    ("7 1/s", 7.0, UnitDimension::new(0, 0, -1, 0)),
    ("4", 4.0, UnitDimension::new(0, 0, 0, 0)),
];

#[test]
fn quantities_have_the_size_and_dimension_of_their_units() {
    for (text, value, dimension) in TABLE {
        let (number, unit) = parse_quantity(text).unwrap_or_else(|error| panic!("{text}: {error}"));
        assert_eq!(unit.dimension, *dimension, "{text}");
        let error = (number * unit.size - value).abs();
        assert!(error <= 4.0 * f64::EPSILON * value.abs(), "{text}: {} is not {value}", number * unit.size);
    }
}

#[test]
fn numbers_are_shown_without_the_rounding_that_they_carry() {
    let sums = [1249.9999999999998, 0.1 + 0.2, 3.0 * 1.1, 1e-3 * 0.7, -1e-14, 0.0, 250.0, 123456789.125, 1.0 / 3.0];
    let words = ["1250", "0.3", "3.3", "0.0007", "-1e-14", "0", "250", "123456789.125", "0.3333333333333333"];
    assert_eq!(sums.map(shown), words);
    // Further off than rounding is another number.
    assert_eq!(shown(1249.999999999), "1249.999999999");
    assert_eq!(shown(1250.000000000002), "1250.000000000002");
}

#[test]
fn what_is_no_quantity_is_refused_with_its_reason() {
    let unknown = |text: &str| match parse_quantity(text) {
        Err(UnitError::UnknownUnit { symbol, nearest }) => (symbol, nearest),
        other => panic!("{text}: {other:?}"),
    };
    assert_eq!(unknown("2 CM"), ("CM".to_owned(), Some("cm".to_owned())));
    assert_eq!(unknown("2 kpa"), ("kpa".to_owned(), Some("kPa".to_owned())));
    assert_eq!(unknown("2 metres"), ("metres".to_owned(), Some("m".to_owned())));
    assert_eq!(unknown("2 parsec"), ("parsec".to_owned(), None));
    assert!(matches!(parse_quantity("cm"), Err(UnitError::NoNumber { .. })));
    assert!(matches!(parse_quantity(""), Err(UnitError::NoNumber { .. })));
    assert!(matches!(parse_quantity("inf m"), Err(UnitError::NoNumber { .. })));
    assert!(matches!(parse_quantity("1e999 m"), Err(UnitError::NotFinite { .. })));
    assert!(matches!(parse_quantity("1e300 km^12"), Err(UnitError::NotFinite { .. })));
    for text in ["1 m^", "1 m^99", "1 (m", "1 m/", "1 m)", "1 m^9999999999", "1 kg//m", "1 m % s"] {
        assert!(matches!(parse_quantity(text), Err(UnitError::Malformed { .. })), "{text}");
    }
    assert!(parse_quantity(&format!("1 {}m", "(".repeat(100_000))).is_err());
}

#[test]
fn dimensions_print_their_base_units() {
    assert_eq!(PRESSURE.to_string(), "kg m^-1 s^-2");
    assert_eq!(UnitDimension::default().to_string(), "1");
}
