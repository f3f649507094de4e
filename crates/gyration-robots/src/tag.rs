//! An element of a file, and behind it what holds where it is silent: numbers of its attributes.

use crate::pose::unit;
use crate::report::{Report, named};
use gyration::tensor::Vec3;
use roxmltree::Node;

/// An element, then its defaults, the nearest first.
#[derive(Debug, Clone)]
pub(crate) struct Tag<'a, 'i>(Vec<Node<'a, 'i>>);

impl<'a, 'i> Tag<'a, 'i> {
    /// An element without defaults.
    pub fn alone(node: Node<'a, 'i>) -> Self {
        Self(vec![node])
    }

    /// An element with its defaults, the nearest first.
    pub fn with(node: Node<'a, 'i>, defaults: impl IntoIterator<Item = Node<'a, 'i>>) -> Self {
        Self(std::iter::once(node).chain(defaults).collect())
    }

    /// The element.
    pub fn node(&self) -> Node<'a, 'i> {
        self.0[0]
    }

    /// The element and its defaults, each as one without.
    pub fn layers(&self) -> impl Iterator<Item = Self> + '_ {
        self.0.iter().map(|node| Self::alone(*node))
    }

    /// Where an attribute is written, and its text.
    fn written(&self, name: &str) -> Option<(Node<'a, 'i>, &'a str)> {
        self.0.iter().find_map(|node| Some((*node, node.attribute(name)?)))
    }

    /// The text of an attribute, without blanks around it.
    pub fn text(&self, name: &str) -> Option<&'a str> {
        self.written(name).map(|(_, text)| text.trim())
    }

    /// Whether an attribute is written.
    pub fn has(&self, name: &str) -> bool {
        self.written(name).is_some()
    }

    /// All numbers of an attribute; none if it is missing, or wrong, which is noted.
    pub fn list(&self, name: &str, report: &mut Report) -> Option<Vec<f64>> {
        let (node, text) = self.written(name)?;
        let number = |word: &str| word.parse::<f64>().ok().filter(|number| number.is_finite());
        let mut numbers = Vec::new();
        for word in text.split_whitespace() {
            let Some(number) = number(word) else {
                let message = format!("{}: {name} = \"{text}\": \"{word}\" is no number", named(node));
                let fix = if text.contains("${") {
                    "expand the macros first: `xacro FILE > robot.urdf`"
                } else {
                    "write finite decimal numbers with blanks between them"
                };
                report.fault(node, message, fix);
                return None;
            };
            numbers.push(number);
        }
        Some(numbers)
    }

    /// So many numbers of an attribute; none if it is missing, or wrong, which is noted.
    pub fn numbers<const N: usize>(&self, name: &str, report: &mut Report) -> Option<[f64; N]> {
        let (node, text) = self.written(name)?;
        let numbers = self.list(name, report)?;
        let count = numbers.len();
        let read = <[f64; N]>::try_from(numbers).ok();
        if read.is_none() {
            let message = format!("{}: {name} = \"{text}\" has {count} numbers, not {N}", named(node));
            report.fault(node, message, "write as many as the format asks for");
        }
        read
    }

    /// One number of an attribute.
    pub fn number(&self, name: &str, report: &mut Report) -> Option<f64> {
        self.numbers::<1>(name, report).map(|[number]| number)
    }

    /// Three numbers of an attribute.
    pub fn vector(&self, name: &str, report: &mut Report) -> Option<Vec3> {
        self.numbers::<3>(name, report).map(Vec3::from)
    }

    /// A direction of length one; none if it is missing, or zero, which is noted.
    pub fn direction(&self, name: &str, report: &mut Report) -> Option<Vec3> {
        let written = self.vector(name, report)?;
        let found = unit(&written);
        if found.is_none() {
            self.note_zero(name, report);
        }
        found
    }

    /// Notes that an attribute is zero where it is to be a direction.
    pub fn note_zero(&self, name: &str, report: &mut Report) {
        report.fault(self.node(), format!("{}: {name} is zero", named(self.node())), "write a direction, \"0 0 1\"");
    }

    /// The word of an attribute that has one of some; none if it is missing, or another, which is noted.
    pub fn keyword<'w>(&self, name: &str, words: &[&'w str], report: &mut Report) -> Option<&'w str> {
        let (node, text) = self.written(name)?;
        let found = words.iter().copied().find(|word| *word == text.trim());
        if found.is_none() {
            let message = format!("{}: {name} = \"{text}\" is no keyword", named(node));
            report.fault(node, message, format!("write one of {}", words.join(", ")));
        }
        found
    }

    /// Whether an attribute that is required is written; notes it otherwise.
    pub fn is_given(&self, name: &str, report: &mut Report) -> bool {
        if !self.has(name) {
            let message = format!("{}: the attribute \"{name}\" is missing", named(self.node()));
            report.fault(self.node(), message, format!("write {name}=\"…\""));
        }
        self.has(name)
    }

    /// A number that is required; none if it is missing, or wrong, which is noted.
    pub fn required(&self, name: &str, report: &mut Report) -> Option<f64> {
        if self.is_given(name, report) { self.number(name, report) } else { None }
    }

    /// Whether lengths are > 0; notes it otherwise.
    pub fn are_positive(&self, lengths: &[f64], report: &mut Report) -> bool {
        let wrong = lengths.iter().find(|length| **length <= 0.0);
        if let Some(length) = wrong {
            let message = format!("{}: a length is {length:?} m", named(self.node()));
            report.fault(self.node(), message, "write lengths > 0");
        }
        wrong.is_none()
    }
}
