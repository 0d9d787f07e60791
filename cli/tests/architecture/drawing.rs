//! Reads the drawing of the house: the fenced blocks of ARCHITECTURE.md that open with
//! ```` ```crates ```` or ```` ```modules <crate> ````.
//!
//! One crate or module a line, first word its name, the rest a remark; what stands further up may
//! be used by what stands further down. A remark that opens with `(planned)` marks a module that
//! is not built yet.

/// A crate or module as drawn.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Room {
    pub name: String,
    pub planned: bool,
    /// Line of ARCHITECTURE.md, from 1.
    pub line: usize,
}

/// One fenced block: rooms from the bottom of the house up.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Floor {
    pub rooms: Vec<Room>,
    /// Line of the opening fence.
    pub line: usize,
}

impl Floor {
    /// Place in the order, 0 for the lowest room.
    pub fn place(&self, name: &str) -> Option<usize> {
        self.rooms.iter().position(|room| room.name == name)
    }
}

/// The fenced blocks with this info string, for example `crates` or `modules film`.
pub fn floor(drawing: &str, info: &str) -> Option<Floor> {
    let fence = format!("```{info}");
    let mut lines = drawing.lines().zip(1..);
    let (_, line) = lines.find(|(text, _)| text.trim_end() == fence)?;
    let rooms = lines
        .take_while(|(text, _)| !text.starts_with("```"))
        .filter_map(|(text, line)| {
            let mut words = text.split_whitespace();
            Some(Room {
                name: words.next()?.to_owned(),
                planned: words.next() == Some("(planned)"),
                line,
            })
        })
        .collect();
    Some(Floor { rooms, line })
}
