//! Which beams stand for a crankshaft?
//!
//! Journals and pins are Timoshenko beams on their own axes, webs are bars from the axis of the shaft to
//! that of the pin in the mid-plane of the web. Journals and pins run on to that plane with their own
//! section: the web's face yields under them about as much. Webs between two pins join their axes.
//!
//! Nodes: centres of mains and pins, their ends at the webs, every place of force. Rods press on the
//! pin's axis. An unbalance pulls on a line through the shaft's axis; it is brought there by an arm that
//! carries nothing else: from the web's foot on the axis where the web stands, from the pin beside it.
//!
//! Limits: no stiffening by overlapping of pins and journals, by fillets or counterweights; such webs are
//! fitted ([`Web::Fitted`](crate::Web::Fitted)). Nose and flange carry no bending and are left out.

use super::crank_station::{SAME, Station};
use super::error::{ascending, positive, within};
use crate::{CrankTrain, CrankshaftShape, ShaftError, Throw, Web};
use sommerfeld_flex::{CondensedShaft, Frame, Material, Section};

/// How far lengths may miss the spacing, as a share of it: unlike mains are common, and their journal
/// takes the difference up.
const FIT: f64 = 0.02;
/// A web between two pins is at least this share of the distance of their middles thick.
const LEAST_WEB: f64 = 0.01;
/// Freedoms along and about the axis of the shaft.
const ALONG: [usize; 2] = [2, 5];

/// A crankshaft of beams.
pub(crate) struct CrankFrame {
    pub(crate) frame: Frame,
    /// Node at the centre of each main.
    pub(crate) mains: Vec<usize>,
    stations: Vec<Station>,
    throws: Vec<usize>,
    arm: Section,
}

/// Condenses the crankshaft of `train` onto the centres of its mains. `force_positions`: axial positions
/// (m) of the forces on it, those of the rods first in the order of the cylinders, then the unbalances.
///
/// The shaft is held along its axis and in torsion at its last main: torque leaves at the drive end.
///
/// # Errors
/// [`ShaftError`] for dimensions out of range, lengths that do not fit the spacing of mains and throws,
/// rods beside their pin, and layouts without mains.
pub fn condensed_crankshaft(
    train: &CrankTrain,
    shape: &CrankshaftShape,
    force_positions: &[f64],
) -> Result<CondensedShaft, ShaftError> {
    let layout = &train.layout;
    let rods = layout.cylinders.len();
    if force_positions.len() < rods {
        return Err(ShaftError::ForcesMissing {
            given: force_positions.len(),
            needed: rods,
        });
    }
    let (on_pins, on_axis) = force_positions.split_at(rods);
    let mut crank = CrankFrame::new(&layout.mains, &layout.throws, train.crank_radius, shape)?;
    for (cylinder, axial) in on_pins.iter().enumerate() {
        crank.mark_pin(cylinder, layout.cylinders[cylinder].throw, *axial)?;
    }
    for axial in on_axis {
        within("axial position of an unbalance", *axial, true, "a number")?;
        crank.mark_axis(*axial);
    }
    crank.build(shape)?;
    let mut places = Vec::with_capacity(force_positions.len());
    for (cylinder, axial) in on_pins.iter().enumerate() {
        places.push(crank.pin_node(layout.cylinders[cylinder].throw, *axial));
    }
    for axial in on_axis {
        places.push(crank.axis_node(*axial)?);
    }
    if let Some(drive_end) = crank.mains.last().copied() {
        for freedom in ALONG {
            crank.frame.hold(drive_end, freedom)?;
        }
    }
    Ok(CondensedShaft::from_frame(
        &crank.frame,
        &crank.mains,
        &places,
    )?)
}

impl CrankFrame {
    /// Places journals, webs and pins; [`Self::build`] makes beams of them.
    pub(crate) fn new(
        mains: &[f64],
        throws: &[Throw],
        crank_radius: f64,
        shape: &CrankshaftShape,
    ) -> Result<Self, ShaftError> {
        check(mains, throws, crank_radius, shape)?;
        let material = material(shape);
        let journal = Section::circle(&material, shape.main_diameter, shape.bore_diameter);
        let pin = Section::circle(&material, shape.pin_diameter, shape.bore_diameter);
        let mut stations: Vec<Station> = Vec::with_capacity(mains.len() + throws.len());
        for (index, centre) in mains.iter().enumerate() {
            let name = format!("main {}", index + 1);
            stations.push(Station::new(name, *centre, shape.main_length, journal));
        }
        for (index, throw) in throws.iter().enumerate() {
            let (sin, cos) = throw.angle.sin_cos();
            let name = format!("throw {}", index + 1);
            let mut station = Station::new(name, throw.axial, shape.pin_length, pin);
            station.offset = [crank_radius * cos, crank_radius * sin];
            station.is_pin = true;
            stations.push(station);
        }
        stations.sort_by(|a, b| a.centre.total_cmp(&b.centre));
        for next in 1..stations.len() {
            let middle = web_plane(&stations[next - 1], &stations[next], thickness(&shape.web))?;
            stations[next - 1].ends[1] = middle;
            stations[next].ends[0] = middle;
        }
        let throws = (0..stations.len()).filter(|k| stations[*k].is_pin);
        Ok(Self {
            frame: Frame::new(),
            mains: Vec::new(),
            throws: throws.collect(),
            stations,
            arm: journal,
        })
    }

    /// Asks for a node on the pin of `throw` at `axial` for the rod of `cylinder`.
    fn mark_pin(&mut self, cylinder: usize, throw: usize, axial: f64) -> Result<(), ShaftError> {
        let Some(station) = self.throws.get(throw) else {
            return Err(ShaftError::UnknownThrow {
                cylinder,
                throw,
                throws: self.throws.len(),
            });
        };
        let station = &mut self.stations[*station];
        let pin = station.faces();
        if !axial.is_finite() || axial < pin[0] - SAME || axial > pin[1] + SAME {
            return Err(ShaftError::OffPin {
                cylinder,
                axial,
                pin,
            });
        }
        station.mark(axial);
        Ok(())
    }

    /// Asks for a node where a force at `axial` acts on the axis of the shaft.
    fn mark_axis(&mut self, axial: f64) {
        let at = self.nearest(axial);
        if let Some(station) = self.stations.get_mut(at) {
            let [from, to] = station.faces();
            station.mark(if station.is_pin {
                axial.clamp(from, to)
            } else {
                axial
            });
        }
    }

    /// The station at `axial`, the journal where a web's plane is; the first or last beyond the ends.
    fn nearest(&self, axial: f64) -> usize {
        let behind = |station: &Station| {
            let end = station.ends[1];
            axial > end + SAME || (station.is_pin && axial > end - SAME)
        };
        let at = self.stations.iter().take_while(|s| behind(s)).count();
        at.min(self.stations.len().saturating_sub(1))
    }

    /// Adds nodes and beams of the marked places.
    pub(crate) fn build(&mut self, shape: &CrankshaftShape) -> Result<(), ShaftError> {
        for at in 0..self.stations.len() {
            let (before, rest) = self.stations.split_at_mut(at);
            let station = &mut rest[0];
            let Some(last) = before.last() else {
                station.build(&mut self.frame, None)?;
                continue;
            };
            let foot = last.nodes.last().copied();
            if last.is_in_line(station) {
                station.build(&mut self.frame, foot)?;
                continue;
            }
            station.build(&mut self.frame, None)?;
            if let (Some(from), Some(to)) = (foot, station.nodes.first()) {
                // between two pins the web fills the gap
                let thickness = if last.is_pin && station.is_pin {
                    gap(last, station)
                } else {
                    thickness(&shape.web)
                };
                let section = web_section(shape, thickness);
                // local y along the shaft: thickness; local z across the arm: width
                self.frame.add_beam([from, *to], section, [0.0, 0.0, 1.0])?;
            }
        }
        let mains = self.stations.iter().filter(|station| !station.is_pin);
        self.mains = mains.map(|station| station.node(station.centre)).collect();
        Ok(())
    }

    /// The node on the pin of `throw` at `axial`, marked before.
    pub(crate) fn pin_node(&self, throw: usize, axial: f64) -> usize {
        self.stations[self.throws[throw]].node(axial)
    }

    /// The node on the axis of the shaft at `axial`, marked before; with an arm to it where the shaft
    /// is not there itself.
    fn axis_node(&mut self, axial: f64) -> Result<usize, ShaftError> {
        let at = self.nearest(axial);
        let station = &self.stations[at];
        if !station.is_pin {
            return Ok(station.node(axial));
        }
        let [from, to] = station.faces();
        let neighbour = if axial < from {
            at.checked_sub(1)
                .and_then(|before| self.stations.get(before))
        } else if axial > to {
            self.stations.get(at + 1)
        } else {
            None
        };
        let foot = match neighbour {
            Some(journal) if !journal.is_pin => journal.node(axial),
            _ => station.node(axial.clamp(from, to)),
        };
        let [x, y, z] = self.frame.nodes()[foot];
        if x.hypot(y) < SAME && (z - axial).abs() < SAME {
            return Ok(foot);
        }
        let end = self.frame.add_node([0.0, 0.0, axial]);
        let is_slanted = x.hypot(y) > SAME;
        let across = if is_slanted {
            [-y, x, 0.0]
        } else {
            [1.0, 0.0, 0.0]
        };
        self.frame.add_beam([foot, end], self.arm, across)?;
        Ok(end)
    }
}

fn check(
    mains: &[f64],
    throws: &[Throw],
    crank_radius: f64,
    shape: &CrankshaftShape,
) -> Result<(), ShaftError> {
    if mains.is_empty() {
        return Err(ShaftError::TooFewBearings {
            given: 0,
            needed: 1,
        });
    }
    ascending("mains", mains.iter().copied())?;
    ascending("throws", throws.iter().map(|throw| throw.axial))?;
    positive("crank radius", crank_radius)?;
    positive("youngs_modulus", shape.youngs_modulus)?;
    let nu = shape.poissons_ratio;
    within(
        "poissons_ratio",
        nu,
        nu > -1.0 && nu <= 0.5,
        "above -1, at most 0.5",
    )?;
    positive("main_length", shape.main_length)?;
    positive("pin_length", shape.pin_length)?;
    let bore = shape.bore_diameter;
    let least = shape.main_diameter.min(shape.pin_diameter);
    positive("main_diameter", shape.main_diameter)?;
    positive("pin_diameter", shape.pin_diameter)?;
    let is_inside = (0.0..least).contains(&bore);
    within(
        "bore_diameter",
        bore,
        is_inside,
        "at least 0 and below the diameters of mains and pins",
    )?;
    positive("thickness of the web", thickness(&shape.web))?;
    match shape.web {
        Web::Bar { width, .. } => positive("width of the web", width),
        Web::Fitted {
            bending_in_plane,
            bending_across,
            torsion,
            ..
        } => {
            positive(
                "bending stiffness of the web in its plane",
                bending_in_plane,
            )?;
            positive(
                "bending stiffness of the web across its plane",
                bending_across,
            )?;
            positive("torsional stiffness of the web", torsion)
        }
    }
}

pub(crate) fn material(shape: &CrankshaftShape) -> Material {
    Material {
        youngs_modulus: shape.youngs_modulus,
        poissons_ratio: shape.poissons_ratio,
    }
}

pub(crate) fn thickness(web: &Web) -> f64 {
    match web {
        Web::Bar { thickness, .. } | Web::Fitted { thickness, .. } => *thickness,
    }
}

/// What is left between two stations for a web, m.
fn gap(from: &Station, to: &Station) -> f64 {
    to.centre - from.centre - from.half_length - to.half_length
}

/// Axial position of the mid-plane of the web between two stations.
fn web_plane(from: &Station, to: &Station, thickness: f64) -> Result<f64, ShaftError> {
    let [first, last] = [from.faces()[1], to.faces()[0]];
    let distance = to.centre - from.centre;
    let gap = gap(from, to);
    let is_main_web = from.is_pin != to.is_pin;
    let needed = if is_main_web {
        thickness
    } else if from.is_in_line(to) {
        0.0
    } else {
        LEAST_WEB * distance
    };
    let miss = needed - gap;
    // between two pins, or two journals, what joins them is as long as the gap
    let is_fit = if is_main_web {
        miss.abs() <= FIT * distance
    } else {
        miss <= SAME
    };
    if !is_fit {
        return Err(ShaftError::LengthsDoNotFit {
            from: from.name.clone(),
            to: to.name.clone(),
            distance,
            needed: distance + miss,
        });
    }
    Ok(match (from.is_pin, to.is_pin) {
        (false, true) => last - 0.5 * thickness,
        (true, false) => first + 0.5 * thickness,
        _ => 0.5 * (first + last),
    })
}

/// Section of a web of `thickness` (m): local x from journal to pin, y along the shaft, z across the
/// arm. A fitted web keeps its stiffness in any thickness.
pub(crate) fn web_section(shape: &CrankshaftShape, thickness: f64) -> Section {
    match shape.web {
        Web::Bar { width, .. } => Section::rectangle(&material(shape), thickness, width),
        Web::Fitted {
            thickness,
            bending_in_plane,
            bending_across,
            torsion,
        } => Section {
            // that of the rectangle with this thickness and this bending stiffness in its plane
            axial: 12.0 * bending_in_plane / thickness.powi(2),
            torsion,
            bending: [bending_across, bending_in_plane],
            shear_flexibility: [0.0; 2],
        },
    }
}
