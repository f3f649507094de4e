//! What is found while a file is read: faults, what is left out, and what a scene needs and the file does not say.
//!
//! Each has its line. An attribute or element that nobody reads is left out by [`Report::rest`]: a reader names what it
//! has read of an element, and all else is listed.

use crate::error::{Fault, Faults};
use gyration_files::printable;
use roxmltree::Node;
use std::fmt;

/// Letters of a value that are told.
const TOLD: usize = 60;

/// Something of the file that is not in the scene, or of the scene that is not in the file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Finding {
    /// The file as it was named.
    pub file: String,
    /// Line of the file, from one; none of what holds for all of it.
    pub line: Option<usize>,
    /// What it is.
    pub what: String,
    /// Why it is left out or chosen so.
    pub why: String,
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.file)?;
        if let Some(line) = self.line {
            write!(f, ":{line}")?;
        }
        write!(f, ": {}: {}", self.what, self.why)
    }
}

/// Findings and faults of a file, with the places of its lines.
#[derive(Debug)]
pub(crate) struct Report {
    file: String,
    /// Where each line begins \[bytes\].
    starts: Vec<usize>,
    faults: Vec<Fault>,
    left_out: Vec<Finding>,
    chosen: Vec<Finding>,
}

impl Report {
    /// Of a text without findings.
    pub fn of(file: &str, text: &str) -> Self {
        let behind = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n').map(|(at, _)| at + 1);
        let starts = std::iter::once(0).chain(behind).collect();
        Self { file: file.to_owned(), starts, faults: Vec::new(), left_out: Vec::new(), chosen: Vec::new() }
    }

    /// The line of a byte, from one.
    fn line_at(&self, byte: usize) -> usize {
        self.starts.partition_point(|start| *start <= byte)
    }

    /// The line in which an element begins.
    pub fn line(&self, node: Node<'_, '_>) -> usize {
        self.line_at(node.range().start)
    }

    /// Notes what is wrong at an element.
    pub fn fault(&mut self, node: Node<'_, '_>, message: impl Into<String>, fix: impl Into<String>) {
        let line = self.line(node);
        self.fault_at(line, message, fix);
    }

    /// Notes what is wrong at a line.
    pub fn fault_at(&mut self, line: usize, message: impl Into<String>, fix: impl Into<String>) {
        self.faults.push(Fault {
            file: self.file.clone(),
            line,
            message: one_line(&message.into()),
            fix: one_line(&fix.into()),
        });
    }

    /// Lists something of an element that the scene does not have.
    pub fn leave_out(&mut self, node: Node<'_, '_>, what: impl Into<String>, why: impl Into<String>) {
        let line = self.line(node);
        self.leave_out_at(line, what, why);
    }

    /// The same of a line.
    pub fn leave_out_at(&mut self, line: usize, what: impl Into<String>, why: impl Into<String>) {
        let finding = self.finding(Some(line), what.into(), why.into());
        self.left_out.push(finding);
    }

    /// Lists something of the scene that the file does not have.
    pub fn choose(&mut self, line: Option<usize>, what: impl Into<String>, why: impl Into<String>) {
        let finding = self.finding(line, what.into(), why.into());
        self.chosen.push(finding);
    }

    fn finding(&self, line: Option<usize>, what: String, why: String) -> Finding {
        Finding { file: self.file.clone(), line, what: one_line(&what), why: one_line(&why) }
    }

    /// Lists every attribute and every element within an element that is not among those read.
    pub fn rest(&mut self, node: Node<'_, '_>, read: Read<'_>) {
        let named = named(node);
        for attribute in node.attributes().filter(|attribute| !read.attributes.contains(&attribute.name())) {
            let what = format!("{named}: {} = \"{}\"", attribute.name(), cut(attribute.value()));
            let line = self.line_at(attribute.range().start);
            self.leave_out_at(line, what, (read.why)(attribute.name()));
        }
        for child in elements(node).filter(|child| !read.elements.contains(&child.tag_name().name())) {
            let name = child.tag_name().name();
            self.leave_out(child, format!("{named}: <{name}>{}", told_attributes(child)), (read.why)(name));
        }
    }

    /// Lists elements that an element has once and that are written again: the first of each is read.
    pub fn again(&mut self, node: Node<'_, '_>, names: &[&str]) {
        for name in names {
            for child in elements(node).filter(|child| child.tag_name().name() == *name).skip(1) {
                let what = format!("{}: a second <{name}>{}", named(node), told_attributes(child));
                self.leave_out(child, what, "it has one, and the first is read");
            }
        }
    }

    /// Whether nothing is wrong so far.
    pub fn is_sound(&self) -> bool {
        self.faults.is_empty()
    }

    /// What is wrong, which is something.
    pub fn into_faults(self) -> Faults {
        Faults::of(self.faults)
    }

    /// What was left out and what was chosen, by line.
    ///
    /// # Errors
    /// All faults, by line.
    pub fn finish(mut self) -> Result<(Vec<Finding>, Vec<Finding>), Faults> {
        if !self.is_sound() {
            return Err(self.into_faults());
        }
        self.left_out.sort_by_key(|finding| finding.line);
        self.chosen.sort_by_key(|finding| finding.line);
        Ok((self.left_out, self.chosen))
    }
}

/// What a reader has read of an element, and why it reads no more.
#[derive(Clone, Copy)]
pub(crate) struct Read<'a> {
    pub attributes: &'a [&'a str],
    pub elements: &'a [&'a str],
    /// Why an attribute or element of this name has no place in a scene.
    pub why: fn(&str) -> &'static str,
}

/// The elements directly within another.
pub(crate) fn elements<'a, 'i>(node: Node<'a, 'i>) -> impl Iterator<Item = Node<'a, 'i>> {
    node.children().filter(Node::is_element)
}

/// The first element of this name directly within another.
pub(crate) fn element<'a, 'i>(node: Node<'a, 'i>, name: &str) -> Option<Node<'a, 'i>> {
    elements(node).find(|child| child.tag_name().name() == name)
}

/// An element in words: its tag, and its name or that of what it stands in.
pub(crate) fn named(node: Node<'_, '_>) -> String {
    let tag = node.tag_name().name();
    let name = |node: Node<'_, '_>| node.attribute("name").or_else(|| node.attribute("class")).map(cut);
    if let Some(name) = name(node) {
        return format!("{tag} \"{name}\"");
    }
    let owner = node.ancestors().skip(1).find_map(|outer| Some((outer, name(outer)?)));
    match owner {
        Some((outer, name)) => format!("{tag} of {} \"{name}\"", outer.tag_name().name()),
        None => tag.to_owned(),
    }
}

fn told_attributes(node: Node<'_, '_>) -> String {
    let told = node.attributes().map(|attribute| format!(" {}=\"{}\"", attribute.name(), attribute.value()));
    cut(&told.collect::<String>())
}

/// The beginning of a text.
fn cut(text: &str) -> String {
    match text.char_indices().nth(TOLD) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}

/// A text as one line of a comment.
fn one_line(text: &str) -> String {
    printable(text).split_whitespace().collect::<Vec<_>>().join(" ")
}
