//! What a reader says about a file it refuses: where, what, what would be right.
//!
//! An error holds the line it is about, so it can be shown without the file.

use codespan_reporting::diagnostic::{Diagnostic, Label, Severity};
use codespan_reporting::files::{Error as FilesError, Files};
use codespan_reporting::term::{self, Chars, Config, StylesWriter, termcolor};
use std::fmt;
use std::ops::Range;

/// Longest piece of a line that is shown, in characters.
const SNIPPET_LENGTH: usize = 120;
/// Longest name of a file that is shown in full, in characters.
const FILE_SHOWN: usize = 300;
/// More messages than this are counted, not shown.
const MESSAGES_SHOWN: usize = 12;

/// A place in a file and the line of text around it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Place {
    /// Line, from 1.
    pub line: usize,
    /// Columns in characters, from 1, the end exclusive.
    pub columns: Range<usize>,
    /// The line, or the part of a long one around the columns.
    snippet: String,
    /// Bytes of `snippet` to underline.
    underlined: Range<usize>,
}

impl Place {
    /// The place of a byte span in a text. A span over several lines ends with its first.
    #[must_use]
    pub fn of_span(text: &str, span: Range<usize>) -> Self {
        let start = floor_boundary(text, span.start);
        let before = text.get(..start).unwrap_or_default();
        let line_start = before.rfind('\n').map_or(0, |at| at + 1);
        let line = before.matches('\n').count() + 1;
        let rest = text.get(line_start..).unwrap_or_default();
        let content = rest.split(['\n', '\r']).next().unwrap_or_default();
        Self::in_line(
            line,
            content,
            start - line_start..span.end.saturating_sub(line_start),
        )
    }

    /// The place of a byte span within one line of a file.
    #[must_use]
    pub fn in_line(line: usize, content: &str, span: Range<usize>) -> Self {
        let start = floor_boundary(content, span.start);
        let end = floor_boundary(content, span.end).max(start);
        let column = |at| content.get(..at).unwrap_or_default().chars().count();
        let (first, last) = (column(start), column(end));
        let shown_from = first.saturating_sub(SNIPPET_LENGTH / 2);
        let mut snippet = String::new();
        let mut underlined = 0..0;
        for (index, c) in content
            .chars()
            .enumerate()
            .skip(shown_from)
            .take(SNIPPET_LENGTH)
        {
            if index == first {
                underlined.start = snippet.len();
            }
            // Tabs would shift the underline, other controls could steer a terminal.
            snippet.push(match c {
                '\t' => ' ',
                c if c.is_control() => '\u{fffd}',
                c => c,
            });
            if index < last {
                underlined.end = snippet.len();
            }
        }
        if first >= shown_from + snippet.chars().count() {
            underlined.start = snippet.len();
        }
        underlined.end = underlined.end.max(underlined.start);
        Self {
            line,
            columns: first + 1..last + 1,
            snippet,
            underlined,
        }
    }
}

/// The nearest character boundary at or below a byte index.
fn floor_boundary(text: &str, mut at: usize) -> usize {
    at = at.min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

/// One reason to refuse an input, or one warning about it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct InputError {
    /// The file, as the user named it.
    pub file: String,
    /// Where in the file; `None` where the whole file is meant.
    pub place: Option<Place>,
    /// Full key, such as `bearing.diameter`; empty where no key is meant.
    pub key: String,
    /// The value as written; empty where none is meant.
    pub value: String,
    /// What is wrong.
    pub message: String,
    /// What is allowed.
    pub allowed: Option<String>,
    /// What to do about it.
    pub hint: Option<String>,
}

impl InputError {
    /// An error about a whole file.
    #[must_use]
    pub fn new(file: &str, message: impl Into<String>) -> Self {
        Self {
            file: file.to_owned(),
            message: message.into(),
            ..Self::default()
        }
    }

    /// Adds the place.
    #[must_use]
    pub fn at(mut self, place: Place) -> Self {
        self.place = Some(place);
        self
    }

    /// Adds the key.
    #[must_use]
    pub fn of_key(mut self, key: &str) -> Self {
        key.clone_into(&mut self.key);
        self
    }

    /// Adds the value as written.
    #[must_use]
    pub fn with_value(mut self, value: &str) -> Self {
        value.clone_into(&mut self.value);
        self
    }

    /// Adds what is allowed.
    #[must_use]
    pub fn allowing(mut self, allowed: impl Into<String>) -> Self {
        self.allowed = Some(allowed.into());
        self
    }

    /// Adds what to do about it.
    #[must_use]
    pub fn hinting(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into());
        self
    }

    /// The file as messages name it: of a path that fills the page, its end.
    fn file_shown(&self) -> String {
        let length = self.file.chars().count();
        if length <= FILE_SHOWN {
            return self.file.clone();
        }
        let end: String = self.file.chars().skip(length - FILE_SHOWN).collect();
        format!("...{end}")
    }

    /// The message with the offending text underlined, as an error or a warning.
    #[must_use]
    pub fn render(&self, kind: MessageKind, colours: bool) -> String {
        let severity = match kind {
            MessageKind::Error => Severity::Error,
            MessageKind::Warning => Severity::Warning,
        };
        let mut diagnostic = Diagnostic::new(severity).with_message(&self.message);
        if let Some(place) = &self.place {
            diagnostic.labels = vec![Label::primary((), place.underlined.clone())];
        }
        let allowed = self.allowed.iter().map(|text| format!("allowed: {text}"));
        let hint = self.hint.iter().map(|text| format!("hint: {text}"));
        diagnostic.notes = allowed.chain(hint).collect();
        match self.emit(&diagnostic, colours) {
            Ok(text) if self.place.is_some() => text.trim_end().to_owned() + "\n",
            // Without a place the renderer does not name the file.
            Ok(text) => {
                let (head, notes) = text.split_once('\n').unwrap_or((&text, ""));
                format!(
                    "{head}\n --> {}\n{}",
                    self.file_shown(),
                    notes.trim_end_matches('\n')
                )
                .trim_end()
                .to_owned()
                    + "\n"
            }
            Err(_) => format!("error: {}: {}\n", self.file_shown(), self.message),
        }
    }

    fn emit(&self, diagnostic: &Diagnostic<()>, colours: bool) -> Result<String, FilesError> {
        let config = Config {
            chars: Chars::ascii(),
            ..Config::default()
        };
        if !colours {
            return term::emit_into_string(&config, self, diagnostic);
        }
        let mut buffer = termcolor::Buffer::ansi();
        let styles = term::Styles::default();
        let mut writer = StylesWriter::new(&mut buffer, &styles);
        term::emit_to_write_style(&mut writer, &config, self, diagnostic)?;
        Ok(String::from_utf8_lossy(buffer.as_slice()).into_owned())
    }
}

impl fmt::Display for InputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.render(MessageKind::Error, false))
    }
}

impl std::error::Error for InputError {}

/// How a message is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MessageKind {
    /// The input is refused.
    Error,
    /// The input is taken; the user should know.
    Warning,
}

/// The renderer sees a file of one line with the number it has in the real one.
impl<'a> Files<'a> for InputError {
    type FileId = ();
    type Name = String;
    type Source = &'a str;

    fn name(&'a self, (): ()) -> Result<String, FilesError> {
        Ok(self.file_shown())
    }

    fn source(&'a self, (): ()) -> Result<&'a str, FilesError> {
        Ok(self.place.as_ref().map_or("", |place| &place.snippet))
    }

    fn line_index(&'a self, (): (), _byte_index: usize) -> Result<usize, FilesError> {
        Ok(0)
    }

    fn line_number(&'a self, (): (), _line_index: usize) -> Result<usize, FilesError> {
        Ok(self.place.as_ref().map_or(1, |place| place.line))
    }

    fn column_number(
        &'a self,
        (): (),
        _line_index: usize,
        _byte_index: usize,
    ) -> Result<usize, FilesError> {
        Ok(self.place.as_ref().map_or(1, |place| place.columns.start))
    }

    fn line_range(&'a self, (): (), line_index: usize) -> Result<Range<usize>, FilesError> {
        let length = self.place.as_ref().map_or(0, |place| place.snippet.len());
        if line_index == 0 {
            Ok(0..length)
        } else {
            Err(FilesError::LineTooLarge {
                given: line_index,
                max: 0,
            })
        }
    }
}

/// All reasons to refuse an input, in the order of the file.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct InputErrors(pub Vec<InputError>);

impl InputErrors {
    /// All messages, one after the other.
    #[must_use]
    pub fn render(&self, colours: bool) -> String {
        render_all(&self.0, MessageKind::Error, colours)
    }
}

/// Messages one after the other, a blank line between them.
#[must_use]
pub fn render_all(messages: &[InputError], kind: MessageKind, colours: bool) -> String {
    let mut shown = Vec::new();
    let mut before: Option<&String> = None;
    for message in messages.iter().take(MESSAGES_SHOWN) {
        let allowed = message.allowed.as_ref();
        // What was just said is not said again.
        if allowed.is_some() && allowed == before {
            let brief = InputError {
                allowed: None,
                ..message.clone()
            };
            shown.push(brief.render(kind, colours));
        } else {
            shown.push(message.render(kind, colours));
        }
        before = allowed;
    }
    if messages.len() > MESSAGES_SHOWN {
        let more = messages.len() - MESSAGES_SHOWN;
        shown.push(format!("... and at least {more} more\n"));
    }
    shown.join("\n")
}

impl fmt::Display for InputErrors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.render(false))
    }
}

impl std::error::Error for InputErrors {}

impl From<InputError> for InputErrors {
    fn from(error: InputError) -> Self {
        Self(vec![error])
    }
}

impl From<Box<InputError>> for InputErrors {
    fn from(error: Box<InputError>) -> Self {
        Self(vec![*error])
    }
}
