//! A straight stretch of a crankshaft: one main journal or one crankpin.

use crate::ShaftError;
use sommerfeld_flex::{Frame, Section};

/// Places closer than this, m, are one.
pub(crate) const SAME: f64 = 1e-9;

/// One journal or pin between the mid-planes of its webs.
pub(crate) struct Station {
    /// As in messages.
    pub(crate) name: String,
    /// Axial position of its middle, m.
    pub(crate) centre: f64,
    /// Half its length between the webs, m.
    pub(crate) half_length: f64,
    /// Off the axis of the shaft, m.
    pub(crate) offset: [f64; 2],
    /// Whether it is a pin.
    pub(crate) is_pin: bool,
    /// Its cross-section.
    pub(crate) section: Section,
    /// Mid-planes of its webs, or its free ends, m.
    pub(crate) ends: [f64; 2],
    /// Its nodes, ascending along the axis.
    pub(crate) nodes: Vec<usize>,
    marks: Vec<f64>,
    positions: Vec<f64>,
}

impl Station {
    /// A journal on the axis of the shaft without webs.
    pub(crate) fn new(name: String, centre: f64, length: f64, section: Section) -> Self {
        Self {
            name,
            centre,
            half_length: 0.5 * length,
            offset: [0.0; 2],
            is_pin: false,
            section,
            ends: [centre - 0.5 * length, centre + 0.5 * length],
            nodes: Vec::new(),
            marks: vec![centre],
            positions: Vec::new(),
        }
    }

    /// Its ends at the faces of the webs, m.
    pub(crate) fn faces(&self) -> [f64; 2] {
        [
            self.centre - self.half_length,
            self.centre + self.half_length,
        ]
    }

    /// Whether its axis is that of `other`.
    pub(crate) fn is_in_line(&self, other: &Self) -> bool {
        let [a, b] = [self.offset, other.offset];
        (a[0] - b[0]).hypot(a[1] - b[1]) < SAME
    }

    /// Asks for a node at `axial` (m), beyond its ends as well.
    pub(crate) fn mark(&mut self, axial: f64) {
        self.marks.push(axial);
    }

    /// Adds nodes at its ends and marks, and beams between them; its first node is `start` if given.
    pub(crate) fn build(
        &mut self,
        frame: &mut Frame,
        start: Option<usize>,
    ) -> Result<(), ShaftError> {
        let mut places = self.marks.clone();
        places.extend(self.ends);
        places.sort_by(f64::total_cmp);
        places.dedup_by(|later, earlier| *later - *earlier < SAME);
        let [x, y] = self.offset;
        let fresh = places.iter().skip(usize::from(start.is_some()));
        self.nodes = start.into_iter().collect();
        for place in fresh {
            self.nodes.push(frame.add_node([x, y, *place]));
        }
        for ends in self.nodes.windows(2) {
            frame.add_beam([ends[0], ends[1]], self.section, [1.0, 0.0, 0.0])?;
        }
        self.positions = places;
        Ok(())
    }

    /// The node nearest to `axial` (m).
    pub(crate) fn node(&self, axial: f64) -> usize {
        let pairs = self.positions.iter().zip(&self.nodes);
        let nearest = pairs.min_by(|a, b| (a.0 - axial).abs().total_cmp(&(b.0 - axial).abs()));
        nearest.map_or(0, |(_, node)| *node)
    }
}
