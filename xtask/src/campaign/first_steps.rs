//! What `check --steps` shows of the first steps of a scene.

use super::process::Said;
use crate::json::Json;

/// How many steps are looked at.
pub const COUNT: usize = 25;
/// Momentum may change by this part of Σ m |v|: rounding, over so few steps.
const ROUNDING: f64 = 1e-13;
/// Planes found anew push as those remembered, to this part of the largest force.
const PLANES: f64 = 1e-6;

/// What was shown.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Shown {
    /// How many steps were made.
    pub count: f64,
    /// The largest difference of a force by planes found anew, over the largest force.
    pub planes: f64,
    /// The largest changes of momentum and angular momentum over what moves; none where something acts from outside.
    pub changes: Option<[f64; 2]>,
}

impl Shown {
    /// Reads what the program said; what is wrong with it otherwise.
    pub fn read(said: &Said) -> Result<Self, String> {
        let report = Json::parse(&said.stdout).ok_or("what check --steps --json prints is no JSON")?;
        let steps = report.get("steps").ok_or("check --steps tells of no steps")?;
        if let Some(difference) = steps.get("difference").and_then(Json::text) {
            return Err(format!("a resumed run is another one: {difference}"));
        }
        if said.code != Some(0) {
            return Err(format!("check --steps exits with {:?}", said.code));
        }
        let number = |value: &Json, key: &str| value.get(key).and_then(Json::number).ok_or(format!("no {key}"));
        let changes = steps.get("changes").ok_or("no changes")?;
        let changes = match changes.entries() {
            Some(_) => Some([number(changes, "momentum")?, number(changes, "angular_momentum")?]),
            None => None,
        };
        Ok(Self { count: number(steps, "count")?, planes: number(steps, "planes")?, changes })
    }

    /// Itself, if it is what it must be at this tolerance.
    pub fn judged(self, rtol: f64) -> Result<Self, String> {
        if self.planes.is_nan() || self.planes > PLANES {
            return Err(format!("planes found anew push by {:e} of the largest force otherwise", self.planes));
        }
        match self.changes {
            Some([linear, _]) if linear.is_nan() || linear > ROUNDING => {
                Err(format!("the momentum changes by {linear:e} of what moves"))
            }
            Some([_, angular]) if angular.is_nan() || angular > rtol => {
                Err(format!("the angular momentum changes by {angular:e} of what moves, at rtol {rtol:e}"))
            }
            _ => Ok(self),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    fn shown(steps: &str) -> Result<Shown, String> {
        let stdout = format!(r#"{{"steps": {steps}}}"#);
        Shown::read(&Said { code: Some(0), stdout, stderr: String::new(), wall: Duration::ZERO })?.judged(1e-6)
    }

    #[test]
    fn what_is_wrong_with_first_steps_is_told() {
        let changes = |momentum, angular| {
            let changes = format!(r#"{{"momentum": {momentum}, "angular_momentum": {angular}}}"#);
            format!(r#"{{"count": 25, "difference": null, "planes": 1e-9, "changes": {changes}}}"#)
        };
        assert_eq!(shown(&changes(0.0, 1e-8)).unwrap().changes, Some([0.0, 1e-8]));
        assert!(shown(&changes(1e-9, 1e-8)).unwrap_err().contains("the momentum"));
        assert!(shown(&changes(0.0, 1e-3)).unwrap_err().contains("angular"));
        let alone = r#"{"count": 3, "difference": null, "planes": 0.0, "changes": null}"#;
        assert_eq!(shown(alone).unwrap().changes, None);
        assert!(shown(&alone.replace("0.0", "0.1")).unwrap_err().contains("planes"));
        assert!(shown(&alone.replacen("null", "\"a row\"", 1)).unwrap_err().contains("a row"));
        assert!(shown("{}").is_err());
    }
}
