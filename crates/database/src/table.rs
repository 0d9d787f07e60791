//! Nodes of an aligned film over width ratio, relative eccentricity and direction, and their file.
//!
//! What a node holds is dimensionless, per unit effective velocity w (see `direction`):
//! ```text
//! force    [force_along, force_across] eta |w| R^3 B / (2 c^3)     along and across the line of centres
//! pressure peak_pressure eta |w| R^2 / c^3                         at peak_angle from the narrowest gap
//! flow     side_flow |w| R B                                       at each end
//! ```
//! The angle of a direction node depends on the eccentricity, so the file spells it out.

use crate::axis::{Axis, Spacing};
use crate::contents::{Contents, Value};
use crate::direction::{Direction, Position, from_logarithms, to_logarithms};
use crate::error::DatabaseError;
use crate::recipe::Recipe;
use crate::surface::{Mirrored, Surface};
use std::path::Path;

/// What the attribute `scheme` of the file says.
pub const SCHEME: &str = "combined";

/// One film of a table.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Node {
    /// Force along and across the line of centres; along is positive away from the shell's centre.
    pub force: [f64; 2],
    /// Largest pressure.
    pub peak: f64,
    /// Its angle from the narrowest gap, rad; 0 to pi, as the direction's.
    pub peak_angle: f64,
    /// Oil leaving at each end.
    pub side_flow: f64,
    /// Share of the bearing area under pressure.
    pub full_film_share: f64,
    /// Error of the force over its size, as the solver states it.
    pub error: f64,
}

/// How far a table errs.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Errors {
    /// Error of the force over its size that 99.9 % of the samples stay below, and so on.
    pub quantile_999: f64,
    /// Half of the samples stay below.
    pub median: f64,
    /// Largest of the samples.
    pub maximum: f64,
    /// Largest error of the peak pressure over itself.
    pub peak_maximum: f64,
    /// Largest error of the nodes themselves, as the solver states it.
    pub node_maximum: f64,
}

/// A table of an aligned film.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    recipe: Recipe,
    axes: Axes,
    nodes: Vec<Node>,
    errors: Errors,
    forces: Vec<Surface<2>>,
    figures: Vec<Surface<4>>,
}

/// Axes of a table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axes {
    /// Width over diameter.
    pub width_ratio: Axis,
    /// Relative eccentricity.
    pub eccentricity: Axis,
    /// Coordinate of the direction, -1 (opening) to 1 (closing).
    pub direction: Axis,
}

impl Axes {
    /// Axes with these numbers of nodes.
    ///
    /// # Errors
    /// As [`Axis::new`].
    pub fn new(
        recipe: &Recipe,
        [widths, eccentricities, directions]: [usize; 3],
    ) -> Result<Self, DatabaseError> {
        let [narrow, wide] = recipe.width_ratios;
        let last = recipe.last_eccentricity;
        let logarithmic = Spacing::Logarithmic;
        Ok(Self {
            width_ratio: Axis::new("width_ratio", logarithmic, narrow, wide, widths)?,
            eccentricity: Axis::new("eccentricity", Spacing::Atanh, 0.0, last, eccentricities)?,
            direction: Axis::new("direction", Spacing::Linear, -1.0, 1.0, directions)?,
        })
    }

    /// Nodes along each axis: width ratio, eccentricity, direction.
    #[must_use]
    pub fn counts(&self) -> [usize; 3] {
        [&self.width_ratio, &self.eccentricity, &self.direction].map(Axis::count)
    }

    /// Angle of the effective velocity from the line of centres at a node, rad, pi to 0.
    #[must_use]
    pub fn angle(&self, eccentricity: usize, direction: usize) -> f64 {
        Direction::angle(
            self.eccentricity.value(eccentricity),
            self.direction.value(direction),
        )
    }
}

impl Table {
    /// A table of nodes, direction fastest, then eccentricity, then width ratio.
    ///
    /// # Errors
    /// [`DatabaseError::Unsupported`] for axes that no spline runs through, or a node without a
    /// dissipation.
    pub fn new(
        recipe: Recipe,
        axes: Axes,
        nodes: Vec<Node>,
        errors: Errors,
    ) -> Result<Self, DatabaseError> {
        let [widths, eccentricities, directions] = axes.counts();
        let per_width = eccentricities * directions;
        let mut logarithms = Vec::with_capacity(nodes.len());
        let mut figures = Vec::with_capacity(nodes.len());
        for (at, node) in nodes.iter().enumerate() {
            let place = at % per_width;
            let angle = axes.angle(place / directions, place % directions);
            logarithms.push(to_logarithms(node.force, angle));
            figures.push([
                node.peak.ln(),
                node.side_flow,
                node.full_film_share,
                node.peak_angle,
            ]);
        }
        let finite = logarithms.iter().flatten().chain(figures.iter().flatten());
        if nodes.len() != widths * per_width || !finite.clone().all(|value| value.is_finite()) {
            return Err(DatabaseError::Unsupported {
                reason: "a table needs a film with a dissipation and a pressure at each of its nodes",
            });
        }
        let counts = [eccentricities, directions];
        let per_node = 2.0 / (directions - 1).max(1) as f64;
        let bends: Vec<f64> = (0..eccentricities)
            .map(|e| per_node * Position::new(axes.eccentricity.value(e)).bend())
            .collect();
        let mirrored = [Mirrored::Same, Mirrored::Negative];
        let forces = logarithms.chunks_exact(per_width);
        let shown = figures.chunks_exact(per_width);
        Ok(Self {
            forces: forces
                .map(|slice| Surface::through(counts, slice, mirrored, &bends))
                .collect::<Result<_, _>>()?,
            figures: shown
                .map(|slice| Surface::through(counts, slice, SHOWN, &bends))
                .collect::<Result<_, _>>()?,
            recipe,
            axes,
            nodes,
            errors,
        })
    }

    /// What the table was built from.
    #[must_use]
    pub fn recipe(&self) -> &Recipe {
        &self.recipe
    }

    /// Its axes.
    #[must_use]
    pub fn axes(&self) -> &Axes {
        &self.axes
    }

    /// Its nodes, direction fastest, then eccentricity, then width ratio.
    #[must_use]
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// How far it errs.
    #[must_use]
    pub fn errors(&self) -> &Errors {
        &self.errors
    }

    /// The same table with other errors.
    #[must_use]
    pub fn with_errors(self, errors: Errors) -> Self {
        Self { errors, ..self }
    }

    /// Errors of the force, over its size, of a table with every second node along one axis, at the nodes
    /// left out, with their index.
    pub(crate) fn errors_of_half(&self, axis: usize) -> Result<Vec<(usize, f64)>, DatabaseError> {
        let counts = self.axes.counts();
        let mut fewer = counts;
        fewer[axis] = counts[axis].div_ceil(2);
        let place = |at: usize| {
            [
                at / (counts[1] * counts[2]),
                at / counts[2] % counts[1],
                at % counts[2],
            ]
        };
        let kept = |at: usize| place(at)[axis].is_multiple_of(2);
        let nodes = self
            .nodes
            .iter()
            .enumerate()
            .filter(|(at, _)| kept(*at))
            .map(|(_, node)| *node);
        let axes = Axes::new(&self.recipe, fewer)?;
        let half = Self::new(self.recipe, axes, nodes.collect(), Errors::default())?;
        let mut errors = Vec::new();
        let (mut width, mut slice) = (usize::MAX, None);
        for (at, node) in self.nodes.iter().enumerate().filter(|(at, _)| !kept(*at)) {
            let [own_width, own, direction] = place(at);
            if own_width != width {
                width = own_width;
                slice = Some(half.slice(self.axes.width_ratio.value(width))?.0);
            }
            let Some(slice) = &slice else { continue };
            let fewer = |place: usize, axis_of: usize| {
                if axis_of == axis {
                    0.5 * place as f64
                } else {
                    place as f64
                }
            };
            let found = slice.look(fewer(own, 1), fewer(direction, 2)).value;
            let force = from_logarithms(found, self.axes.angle(own, direction));
            let off = (force[0] - node.force[0]).hypot(force[1] - node.force[1]);
            errors.push((at, off / node.force[0].hypot(node.force[1])));
        }
        Ok(errors)
    }

    /// The surfaces at one width ratio: forces, and ln of the peak pressure, side flow, share of the full
    /// film, angle of the peak.
    pub(crate) fn slice(
        &self,
        width_ratio: f64,
    ) -> Result<(Surface<2>, Surface<4>), DatabaseError> {
        let [narrow, wide] = self.recipe.width_ratios;
        let round_off = 1e-9;
        if !(width_ratio >= narrow * (1.0 - round_off) && width_ratio <= wide * (1.0 + round_off)) {
            return Err(DatabaseError::Recipe {
                key: "width over diameter",
                value: width_ratio.to_string(),
                allowed: "the width ratios of the table: build one that holds this bearing",
            });
        }
        let axis = &self.axes.width_ratio;
        Ok((
            Surface::between(&self.forces, axis, width_ratio)?,
            Surface::between(&self.figures, axis, width_ratio)?,
        ))
    }

    /// Writes the table as an HDF5 file.
    ///
    /// # Errors
    /// [`DatabaseError::File`] where that cannot be done.
    pub fn save(&self, path: &Path) -> Result<(), DatabaseError> {
        let mut contents = contents(&self.recipe, &self.axes, &self.nodes);
        let errors = &self.errors;
        for (name, value) in [
            ("error_maximum", errors.maximum),
            ("error_quantile_999", errors.quantile_999),
            ("error_median", errors.median),
            ("error_peak_pressure_maximum", errors.peak_maximum),
            ("error_nodes_maximum", errors.node_maximum),
        ] {
            contents.attribute(name, Value::Number(value));
        }
        let norm = "|F table - F solved| / |F solved|, no floor: the force of a unit velocity never vanishes";
        contents.attribute("error_norm", Value::Text(norm.to_owned()));
        contents.write(path, SCHEME)
    }

    /// Reads a table.
    ///
    /// # Errors
    /// [`DatabaseError::File`] where there is no readable file, [`DatabaseError::Contents`] where it is
    /// not a whole table.
    pub fn load(path: &Path) -> Result<Self, DatabaseError> {
        let contents = Contents::read(path, SCHEME)?;
        let (recipe, axes, nodes) = parts(&contents, path)?;
        let number = |name: &str| contents.number(path, name);
        let errors = Errors {
            maximum: number("error_maximum")?,
            quantile_999: number("error_quantile_999")?,
            median: number("error_median")?,
            peak_maximum: number("error_peak_pressure_maximum")?,
            node_maximum: number("error_nodes_maximum")?,
        };
        Self::new(recipe, axes, nodes, errors).map_err(|error| DatabaseError::Contents {
            path: path.to_owned(),
            reason: error.to_string(),
        })
    }
}

/// ln of the peak pressure, side flow, share of the full film, angle of the peak.
const SHOWN: [Mirrored; 4] = [
    Mirrored::Peak,
    Mirrored::Same,
    Mirrored::Same,
    Mirrored::Angle,
];

/// Name, unit, meaning and value of the datasets of nodes.
type Column = (&'static str, &'static str, &'static str, fn(&Node) -> f64);
const COLUMNS: [Column; 7] = [
    (
        "force_along",
        "1",
        "Force on the journal along the line of centres, towards the narrowest gap, over eta |w| R^3 B / (2 c^3)",
        |n| n.force[0],
    ),
    (
        "force_across",
        "1",
        "Force on the journal across the line of centres, 90 degrees on in the sense of rotation, over eta |w| R^3 B / (2 c^3)",
        |n| n.force[1],
    ),
    (
        "peak_pressure",
        "1",
        "Largest pressure over eta |w| R^2 / c^3; in the mid-plane",
        |n| n.peak,
    ),
    (
        "peak_angle",
        "rad",
        "Angle of the largest pressure from the narrowest gap",
        |n| n.peak_angle,
    ),
    (
        "side_flow",
        "1",
        "Oil leaving at each end over |w| R B",
        |n| n.side_flow,
    ),
    (
        "full_film_share",
        "1",
        "Share of the bearing area under pressure",
        |n| n.full_film_share,
    ),
    (
        "node_error",
        "1",
        "Error of the force over its size, as the solver states it",
        |n| n.error,
    ),
];

/// The file of a table, whole or unfinished (nodes that are not a number), without its errors.
pub(crate) fn contents(recipe: &Recipe, axes: &Axes, nodes: &[Node]) -> Contents {
    let mut contents = Contents::default();
    recipe.store(&mut contents);
    let shape = axes.counts();
    contents.array(
        "width_ratio",
        "1",
        "Width over diameter",
        &shape[..1],
        axes.width_ratio.values(),
    );
    contents.array(
        "eccentricity",
        "1",
        "Relative eccentricity",
        &shape[1..2],
        axes.eccentricity.values(),
    );
    contents.array(
        "direction",
        "1",
        "Coordinate of the direction: -1 the gap opens, 0 the journal slides, 1 the gap closes",
        &shape[2..],
        axes.direction.values(),
    );
    let angles = (0..shape[1]).flat_map(|e| (0..shape[2]).map(move |d| axes.angle(e, d)));
    contents.array(
        "angle",
        "rad",
        "Angle of the effective velocity from the line of centres at each node",
        &shape[1..],
        angles.collect(),
    );
    for (name, unit, meaning, of) in COLUMNS {
        contents.array(name, unit, meaning, &shape, nodes.iter().map(of).collect());
    }
    contents
}

/// Recipe, axes and nodes of what [`contents`] wrote.
pub(crate) fn parts(
    contents: &Contents,
    path: &Path,
) -> Result<(Recipe, Axes, Vec<Node>), DatabaseError> {
    let recipe = Recipe::load(contents, path)?;
    let wrong = |reason: String| DatabaseError::Contents {
        path: path.to_owned(),
        reason,
    };
    let mut counts = [0; 3];
    for (count, name) in counts
        .iter_mut()
        .zip(["width_ratio", "eccentricity", "direction"])
    {
        let array = contents.arrays.get(name);
        *count = array.map_or(0, |array| array.values.len());
    }
    let axes = Axes::new(&recipe, counts).map_err(|error| wrong(error.to_string()))?;
    let mut columns = Vec::with_capacity(COLUMNS.len());
    for (name, ..) in COLUMNS {
        columns.push(contents.values(path, name, &counts)?);
    }
    let nodes = (0..counts.iter().product()).map(|at| Node {
        force: [columns[0][at], columns[1][at]],
        peak: columns[2][at],
        peak_angle: columns[3][at],
        side_flow: columns[4][at],
        full_film_share: columns[5][at],
        error: columns[6][at],
    });
    Ok((recipe, axes, nodes.collect()))
}
