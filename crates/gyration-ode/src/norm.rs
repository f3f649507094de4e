//! The size of an error: one number from many components.
//!
//!   ‖e‖ = max over the groups G of √( (1/|G|) Σ_{i∈G} (e_i/s_i)² )
//!
//! The groups are the blocks of the system and, as one more, its quadratures. The maximum keeps a body at rest from
//! hiding the error of one that bounces, so that the accuracy of a body does not depend on the company it is in. s_i is
//! the smaller of the errors allowed at the two ends of the step: a state that approaches a boundary, where little is
//! allowed, is judged by what is allowed where it arrives and not by what was allowed where it came from.

use crate::layout::SystemLayout;
use crate::report::Cause;

/// The size of an error and the component that is worst.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Norm {
    pub value: f64,
    pub component: usize,
}

impl Norm {
    /// Refuses an error larger than allowed, or not a number.
    ///
    /// # Errors
    /// `Cause::Error`.
    pub fn allow<I>(self) -> Result<Self, Cause<I>> {
        let Self { value: norm, component } = self;
        if norm <= 1.0 { Ok(self) } else { Err(Cause::Error { component, norm }) }
    }
}

/// The norm of a vector over the groups, by the smaller of two scales; a NaN is the largest of all.
pub(crate) fn norm(layout: &SystemLayout, error: &[f64], start: &[f64], end: &[f64]) -> Norm {
    let mut result = Norm { value: 0.0, component: 0 };
    for group in layout.groups.iter().filter(|group| !group.is_empty()) {
        let (mut squares, mut component, mut largest) = (0.0, group.start, 0.0);
        for i in group.clone() {
            let relative = (error[i] / start[i].min(end[i])).abs();
            squares += relative * relative;
            // Written so that a NaN is taken, and kept.
            if relative > largest || relative.is_nan() {
                (component, largest) = (i, relative);
            }
        }
        let value = (squares / group.len() as f64).sqrt();
        if value > result.value || value.is_nan() {
            result = Norm { value, component };
        }
        if value.is_nan() {
            break;
        }
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;
    use gyration_blocks::Components;

    fn layout() -> SystemLayout {
        SystemLayout::new(&[0..2, 2..3], &Components::apart(), 1)
    }

    #[test]
    fn the_worst_group_counts_by_the_smaller_scale() {
        let ones = [1.0; 4];
        assert_eq!(norm(&layout(), &[3.0, 4.0, 0.1, 0.2], &ones, &ones), Norm { value: 12.5_f64.sqrt(), component: 1 });
        // Little is allowed to the third component at one end, to the quadrature at the other.
        let (start, end) = ([1.0, 1.0, 0.01, 1.0], [1.0, 1.0, 1.0, 0.001]);
        assert_eq!(norm(&layout(), &[3.0, 4.0, 0.1, 0.0], &start, &end), Norm { value: 10.0, component: 2 });
        assert_eq!(norm(&layout(), &[3.0, 4.0, 0.1, 0.25], &start, &end), Norm { value: 250.0, component: 3 });
    }

    #[test]
    fn what_is_not_a_number_is_never_allowed() {
        let ones = [1.0; 4];
        for error in [[f64::NAN, 0.0, 0.0, 9.0], [0.0, 9.0, 0.0, f64::NAN]] {
            let size = norm(&layout(), &error, &ones, &ones);
            assert!(size.value.is_nan() && error[size.component].is_nan());
            assert!(size.allow::<()>().is_err());
        }
        // A freed component is never wrong; nothing at all is no error.
        assert_eq!(norm(&layout(), &[1e9, 0.0, 0.0, 0.0], &[f64::INFINITY; 4], &[f64::INFINITY; 4]).value, 0.0);
        assert_eq!(norm(&layout(), &[0.0; 4], &ones, &ones).value, 0.0);
    }
}
