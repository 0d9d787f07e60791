//! The keys of the study file, schema 1.

use super::schema::Kind::{
    Choice, Flag, Grid, Integer, Limit, List, NotBuilt, Number, Pair, Quantity, QuantityOrLaw,
    Table, TableList, Text, Vary,
};
use super::schema::Mode::{self, Coefficients, Dimensionless, Equilibrium, Film, LoadCycle, Sweep};
use super::schema::Presence::{self, Default, Optional, Required};
use super::schema::{Key, Kind, Range};
use super::units::Dimension;

const ALL: &[Mode] = &[Film, Dimensionless, Equilibrium, Coefficients, LoadCycle];
const EVERY: &[Mode] = &[
    Film,
    Dimensionless,
    Equilibrium,
    Coefficients,
    LoadCycle,
    Sweep,
];
const SWEEP: &[Mode] = &[Sweep];
const PHYSICAL: &[Mode] = &[Film, Equilibrium, Coefficients, LoadCycle];
const OPERATED: &[Mode] = &[Film, Equilibrium, Coefficients];
const STEADY: &[Mode] = &[Equilibrium, Coefficients];
const TURNING: &[Mode] = &[Coefficients];
const ONE_FILM: &[Mode] = &[Film];
const ANY_FILM: &[Mode] = &[Film, Dimensionless];
const SCALED: &[Mode] = &[Dimensionless];
const CYCLE: &[Mode] = &[LoadCycle];

/// Diameter and width of a bearing: from those of watches to those of mills.
const SIZE: Range = Range::between(0.1, 10_000.0, "mm");
/// Grooves and holes: finer ones let no oil through.
const FEED: Range = Range::between(0.1, 10_000.0, "mm");
/// Lengths of reliefs.
const RELIEF: Range = Range::between(0.001, 10_000.0, "mm");
/// No clearance is thinner than a few molecules of the oil.
const CLEARANCE: Range = Range::between(0.001, 10_000.0, "um");
/// Forces beyond those of any machine are slips of the unit.
pub(super) const FORCE: Range = Range::between(-1000.0, 1000.0, "MN");
/// A journal that tilts further fits into no bearing.
const TILT: Range = Range::between(-1000.0, 1000.0, "mrad");
/// Moments beyond those of any machine.
pub(super) const MOMENT: Range = Range::between(-1e6, 1e6, "kN.m");
/// Gauge pressures: down to vacuum, up to what no seal holds.
const GAUGE: Range = Range::between(-1.013_25, 10_000.0, "bar");
const SPEED: Range = Range::between(-1e6, 1e6, "rpm");
const KINEMATIC: Range = Range::above(0.0, 1e6, "mm2/s");
const DENSITY: Range = Range::between(100.0, 20_000.0, "kg/m3");

/// A key with its meaning and typical values.
const fn key(
    path: &'static str,
    kind: Kind,
    presence: Presence,
    used_by: &'static [Mode],
    meaning: &'static str,
    typical: &'static str,
) -> Key {
    Key {
        path,
        kind,
        presence,
        used_by,
        meaning,
        typical,
    }
}

/// A key that is planned and refused by name.
const fn planned(path: &'static str, meaning: &'static str) -> Key {
    key(path, NotBuilt, Optional, ALL, meaning, "")
}

/// Every key of the study file, in the order in which `explain` and the schema show them.
#[rustfmt::skip] // one key per entry reads as a table
pub const KEYS: &[Key] = &[
    key("schema", Integer(1, 1), Required, EVERY, "Version of the study file format.", "1"),
    key("title", Text, Default(""), EVERY, "Title of the study, shown in the report.", "\"Big end, 2000 rpm\""),
    key("analysis", Choice(&["film", "equilibrium", "coefficients", "load-cycle", "sweep"], &["database", "engine", "shaft"]),
        Required, EVERY, "What is calculated: one film, the position under a constant load, stiffness and damping there, the journal orbit over a load cycle, or any of these for many values of some keys.", "\"load-cycle\""),

    key("bearing", Table, Required, PHYSICAL, "The bearing: its size, clearance and oil supply.", ""),
    key("bearing.diameter", Quantity(Dimension::Length, SIZE), Required, PHYSICAL, "Bore diameter.", "\"30 mm\" to \"500 mm\""),
    key("bearing.width", Quantity(Dimension::Length, SIZE), Required, PHYSICAL, "Bearing width along the axis.", "0.2 to 1 times the diameter"),
    key("bearing.diametral_clearance", Quantity(Dimension::Length, CLEARANCE), Optional, PHYSICAL,
        "Bore diameter minus journal diameter: twice the radial clearance. Give this or relative_clearance.", "0.7 to 2 um per mm of diameter"),
    key("bearing.relative_clearance", Number(Range::between(1e-6, 0.1, "")), Optional, PHYSICAL,
        "Diametral clearance over diameter. Give this or diametral_clearance.", "0.7e-3 to 2e-3"),
    key("bearing.groove", TableList, Optional, PHYSICAL, "A groove or hole that holds oil at its feed pressure; write [[bearing.groove]] for each.", ""),
    key("bearing.groove.kind", Choice(&["circumferential", "axial", "rectangle", "hole"], &[]), Required, PHYSICAL,
        "Outline: circumferential (all around), axial or rectangle (length around, width along the axis), hole (round).", "\"hole\""),
    key("bearing.groove.carried_by", Choice(&["shell", "journal"], &[]), Default("shell"), PHYSICAL, "Surface that carries it; what the journal carries turns with it.", "\"shell\""),
    key("bearing.groove.angle", Quantity(Dimension::Angle, Range::ANY), Optional, PHYSICAL, "Angle of its centre from +X of its carrier, in the sense of rotation. Not for circumferential grooves.", "\"90 deg\""),
    key("bearing.groove.position", Quantity(Dimension::Length, Range::between(-10_000.0, 10_000.0, "mm")), Default("0 mm"), PHYSICAL, "Axial position of its centre from the mid-plane.", "\"0 mm\""),
    key("bearing.groove.diameter", Quantity(Dimension::Length, FEED), Optional, PHYSICAL, "Diameter of a hole.", "\"3 mm\" to \"10 mm\""),
    key("bearing.groove.length", Quantity(Dimension::Length, FEED), Optional, PHYSICAL, "Length around the circumference of an axial or rectangular groove.", "0.1 to 0.25 times the diameter"),
    key("bearing.groove.width", Quantity(Dimension::Length, FEED), Optional, PHYSICAL, "Width along the axis of every groove but a hole.", "\"3 mm\", up to 0.8 times the bearing width"),
    key("bearing.groove.pressure", Quantity(Dimension::Pressure, GAUGE), Optional, PHYSICAL, "Supply pressure (gauge). Give this or pressure_file.", "\"1 bar\" to \"6 bar\""),
    key("bearing.groove.pressure_file", Text, Optional, CYCLE,
        "CSV beside the study with the supply pressure (gauge) over the period: crank_angle[deg],pressure[bar]. Give this or pressure.", "\"feed.csv\""),
    key("bearing.groove.line_resistance", Quantity(Dimension::FlowResistance, Range::between(0.0, 1e6, "bar.s/cm3")), Optional, PHYSICAL,
        "Pressure drop per flow in the line between supply and groove; without it the supply pressure holds in the groove.", "\"0.1 bar.s/cm3\" to \"2 bar.s/cm3\""),
    key("bearing.groove.drilling_inlet_radius", Quantity(Dimension::Length, Range::between(0.0, 10_000.0, "mm")), Optional, PHYSICAL,
        "Distance from the crank axis at which the drilling in the crank takes its oil; with drilling_outlet_radius: their centrifugal head adds to the supply pressure.", "\"0 mm\", or the radius of the main journal"),
    key("bearing.groove.drilling_outlet_radius", Quantity(Dimension::Length, Range::between(0.0, 10_000.0, "mm")), Optional, PHYSICAL,
        "Distance from the crank axis at which the drilling opens into the film; with drilling_inlet_radius.", "\"90 mm\": crank radius plus pin radius"),
    key("bearing.shell", Table, Optional, PHYSICAL, "The shell as a body.", ""),
    key("bearing.shell.elastic", Choice(&["rigid"], &["layer", "compliance", "modal"]), Default("rigid"), PHYSICAL, "How the shell deforms.", "\"rigid\""),
    key("bearing.bore", Table, Optional, PHYSICAL, "How the bore departs from its cylinder. Everything given adds up; angles are from +X of the shell.", ""),
    key("bearing.bore.kind", Choice(&["cylindrical", "lemon", "offset", "table"], &[]), Default("cylindrical"), PHYSICAL,
        "lemon: two arcs shifted towards each other, square to the joint; offset: two halves shifted along the joint, so that the gap narrows in the sense of rotation on the half behind it; table: radial offsets from a file.", "\"lemon\""),
    key("bearing.bore.preload", Number(Range::between(0.0, 0.99, "")), Optional, PHYSICAL,
        "Of lemon and offset: 1 - clearance / clearance of the arcs. Diameter and clearance of the bearing are those of the largest circle in the bore.", "0.3 to 0.6"),
    key("bearing.bore.joint_angle", Quantity(Dimension::Angle, Range::ANY), Default("0 deg"), PHYSICAL,
        "Angle from +X to one of the two joints, for lemon, offset and crush_relief; the other is opposite.", "\"90 deg\""),
    key("bearing.bore.file", Text, Optional, PHYSICAL,
        "CSV beside the study, of kind table: angle[deg],position[mm],offset[um], a row for every pair of angle and axial position; offset is radial, outward. Without angle it is alike around, without position alike along the axis.", "\"bore.csv\""),
    key("bearing.bore.crowning", Quantity(Dimension::Length, Range::between(-1.0, 1.0, "mm")), Optional, PHYSICAL,
        "Parabola along the axis: by how much the gap is wider at both ends than in the mid-plane; negative for a hollow surface.", "\"2 um\" to \"10 um\""),
    key("bearing.bore.relief", Table, Optional, PHYSICAL, "Relief at the ends: the gap widens over a length.", ""),
    key("bearing.bore.relief.depth", Quantity(Dimension::Length, Range::above(0.0, 1.0, "mm")), Required, PHYSICAL, "Radial depth at the end.", "\"2 um\" to \"20 um\""),
    key("bearing.bore.relief.length", Quantity(Dimension::Length, RELIEF), Required, PHYSICAL, "Length along the axis from the end.", "\"2 mm\""),
    key("bearing.bore.relief.form", Choice(&["linear", "circular"], &[]), Default("linear"), PHYSICAL, "linear: a cone; circular: an arc that leaves the cylinder without a bend.", "\"linear\""),
    key("bearing.bore.relief.ends", Choice(&["both", "front", "rear"], &[]), Default("both"), PHYSICAL, "front: the end at -width/2; rear: the end at +width/2.", "\"both\""),
    key("bearing.bore.crush_relief", Table, Optional, PHYSICAL, "Relief on both sides of both joints.", ""),
    key("bearing.bore.crush_relief.depth", Quantity(Dimension::Length, Range::above(0.0, 1.0, "mm")), Required, PHYSICAL, "Radial depth at the joint.", "\"10 um\" to \"40 um\""),
    key("bearing.bore.crush_relief.length", Quantity(Dimension::Length, RELIEF), Required, PHYSICAL, "Length around from the joint to where the relief ends.", "\"4 mm\" to \"10 mm\""),
    key("bearing.bore.harmonic", TableList, Optional, PHYSICAL, "A wave around, amplitude cos(order (angle - phase)), of the radius; write [[bearing.bore.harmonic]] for each.", ""),
    key("bearing.bore.harmonic.order", Integer(1, 500), Required, PHYSICAL, "Waves around.", "2"),
    key("bearing.bore.harmonic.amplitude", Quantity(Dimension::Length, Range::between(-1.0, 1.0, "mm")), Required, PHYSICAL, "Amplitude, half of peak to valley.", "\"1 um\""),
    key("bearing.bore.harmonic.phase", Quantity(Dimension::Angle, Range::ANY), Default("0 deg"), PHYSICAL, "Angle of a crest, where the radius is largest.", "\"0 deg\""),
    key("bearing.journal", Table, Optional, PHYSICAL, "How the journal departs from its cylinder. Everything given adds up; angles are from +X of the journal and turn with it.", ""),
    key("bearing.journal.kind", Choice(&["cylindrical", "table"], &[]), Default("cylindrical"), PHYSICAL, "table: radial offsets from a file.", "\"cylindrical\""),
    key("bearing.journal.file", Text, Optional, PHYSICAL,
        "CSV beside the study, of kind table: angle[deg],position[mm],offset[um], a row for every pair of angle and axial position; offset is radial, outward. Without angle it is alike around, without position alike along the axis.", "\"journal.csv\""),
    key("bearing.journal.crowning", Quantity(Dimension::Length, Range::between(-1.0, 1.0, "mm")), Optional, PHYSICAL,
        "Parabola along the axis: by how much the gap is wider at both ends than in the mid-plane; negative for a hollow surface.", "\"2 um\" to \"10 um\""),
    key("bearing.journal.relief", Table, Optional, PHYSICAL, "Relief at the ends: the gap widens over a length.", ""),
    key("bearing.journal.relief.depth", Quantity(Dimension::Length, Range::above(0.0, 1.0, "mm")), Required, PHYSICAL, "Radial depth at the end.", "\"2 um\" to \"20 um\""),
    key("bearing.journal.relief.length", Quantity(Dimension::Length, RELIEF), Required, PHYSICAL, "Length along the axis from the end.", "\"2 mm\""),
    key("bearing.journal.relief.form", Choice(&["linear", "circular"], &[]), Default("linear"), PHYSICAL, "linear: a cone; circular: an arc that leaves the cylinder without a bend.", "\"linear\""),
    key("bearing.journal.relief.ends", Choice(&["both", "front", "rear"], &[]), Default("both"), PHYSICAL, "front: the end at -width/2; rear: the end at +width/2.", "\"both\""),
    key("bearing.journal.harmonic", TableList, Optional, PHYSICAL, "A wave around, amplitude cos(order (angle - phase)), of the radius; write [[bearing.journal.harmonic]] for each.", ""),
    key("bearing.journal.harmonic.order", Integer(1, 500), Required, PHYSICAL, "Waves around.", "2"),
    key("bearing.journal.harmonic.amplitude", Quantity(Dimension::Length, Range::between(-1.0, 1.0, "mm")), Required, PHYSICAL, "Amplitude, half of peak to valley.", "\"1 um\""),
    key("bearing.journal.harmonic.phase", Quantity(Dimension::Angle, Range::ANY), Default("0 deg"), PHYSICAL, "Angle of a crest, where the radius is largest.", "\"0 deg\""),
    planned("bearing.surface", "Roughness and asperity contact."),

    key("oil", Table, Required, PHYSICAL, "The lubricant.", ""),
    key("oil.viscosity", QuantityOrLaw(Dimension::DynamicViscosity, Range::above(0.0, 1000.0, "Pa.s")), Required, PHYSICAL,
        "Dynamic viscosity, or a law: { law = \"vogel\", a, b, c } or { law = \"astm-d341\", kv40, kv100 }.", "\"5 mPa.s\" to \"50 mPa.s\""),
    key("oil.viscosity.law", Choice(&["vogel", "astm-d341"], &[]), Required, PHYSICAL,
        "vogel: a exp(b/(T + c)), T in K; astm-d341: the line lg lg(nu + 0.7) = A - B lg T through kv40 and kv100, times oil.density.", "\"astm-d341\""),
    key("oil.viscosity.a", Quantity(Dimension::DynamicViscosity, Range::above(0.0, 1000.0, "Pa.s")), Optional, PHYSICAL, "Vogel: viscosity at infinite temperature.", "\"0.05 mPa.s\" to \"0.2 mPa.s\""),
    key("oil.viscosity.b", Quantity(Dimension::TemperatureDifference, Range::above(0.0, 1e5, "K")), Optional, PHYSICAL, "Vogel: steepness.", "\"700 K\" to \"1300 K\""),
    key("oil.viscosity.c", Quantity(Dimension::TemperatureDifference, Range::between(-1e4, 1e4, "K")), Optional, PHYSICAL,
        "Vogel: temperature offset for T in K; where data give 110 for T in degC, this is 110 - 273.15.", "\"-163.15 K\""),
    key("oil.viscosity.kv40", Quantity(Dimension::KinematicViscosity, KINEMATIC), Optional, PHYSICAL, "ASTM D341: kinematic viscosity at 40 degC.", "\"65 mm2/s\""),
    key("oil.viscosity.kv100", Quantity(Dimension::KinematicViscosity, KINEMATIC), Optional, PHYSICAL, "ASTM D341: kinematic viscosity at 100 degC.", "\"11 mm2/s\""),
    key("oil.temperature", Quantity(Dimension::Temperature, Range::between(-100.0, 500.0, "degC")), Default("100 degC"), PHYSICAL, "Temperature of the film.", "\"60 degC\" to \"130 degC\""),
    key("oil.density", QuantityOrLaw(Dimension::Density, DENSITY), Default("850 kg/m3"), PHYSICAL, "Density, or { value = \"..\", pressure = \"constant\" }.", "\"850 kg/m3\""),
    key("oil.density.value", Quantity(Dimension::Density, DENSITY), Required, PHYSICAL, "Density.", "\"850 kg/m3\""),
    key("oil.density.pressure", Choice(&["constant"], &["dowson-higginson", "limit-1.34"]), Default("constant"), PHYSICAL, "How the density follows the pressure.", "\"constant\""),
    planned("oil.oil", "Name of an oil of the library."),
    planned("oil.viscosity_pressure", "How the viscosity follows the pressure."),
    planned("oil.shear_thinning", "How the viscosity falls with the shear rate."),
    planned("oil.heat_capacity", "Specific heat, for the heat balance."),
    planned("oil.conductivity", "Thermal conductivity, for the energy equation."),

    key("film", Table, Optional, ALL, "How the film is modelled.", ""),
    key("film.model", Choice(&["field", "short-bearing", "mobility", "long-bearing"], &["database", "online"]), Default("field"), ALL,
        "field: Reynolds equation on a grid; the others are closed forms, estimates outside their range.", "\"field\""),
    key("film.cavitation", Choice(&["gumbel", "reynolds", "mass-conserving"], &[]), Default("mass-conserving"), ALL,
        "Closure for the ruptured film: cut negative pressures, smooth rupture (Swift-Stieber), or Jakobsson-Floberg-Olsson.", "\"mass-conserving\""),
    key("film.inlet", Choice(&["cyclic", "max-film-line"], &[]), Default("cyclic"), ALL,
        "Where the film starts: periodic, or full at inlet_pressure on the line of the widest gap, which moves.", "\"cyclic\""),
    key("film.inlet_pressure", Quantity(Dimension::Pressure, GAUGE), Default("0 bar"), PHYSICAL, "Pressure (gauge) on the line of the widest gap; with inlet = \"max-film-line\".", "\"0 bar\""),
    key("film.ends", Choice(&["air", "flooded"], &[]), Default("air"), ALL, "What surrounds the bearing ends: air (oil may leave, none enters) or an oil bath.", "\"air\""),
    key("film.ambient_pressure", Quantity(Dimension::Pressure, GAUGE), Default("0 bar"), PHYSICAL, "Pressure (gauge) at the bearing ends; not below cavitation_pressure.", "\"0 bar\""),
    key("film.cavitation_pressure", Quantity(Dimension::Pressure, GAUGE), Default("0 bar"), PHYSICAL, "Pressure (gauge) of the ruptured film.", "\"0 bar\", \"-0.7 bar\""),
    key("film.grid", Grid, Default("[128, 32]"), ALL, "Cells around the circumference and along the axis.", "[128, 32]"),
    key("film.film_shear", Choice(&["full-width", "film-fraction"], &[]), Optional, PHYSICAL,
        "Shear in the ruptured film: as if full, or weighted by the film fraction. Default: film-fraction for mass-conserving, else full-width.", "\"film-fraction\""),
    key("film.linear_solver", Choice(&["auto", "banded"], &["multigrid"]), Default("auto"), ALL, "Solver of the linear systems.", "\"auto\""),
    key("film.relative_error_target", Number(Range::between(1e-6, 0.1, "")), Optional, ALL,
        "Refine the grid, from half of film.grid on, and extrapolate until the estimated discretisation error of every figure is below this: relative to the force or moment vector, the flow, a radian, else to the figure. Load cycles refine their time step too and extrapolate nothing. At most 512 x 128 cells (load cycles 256 x 64 and a quarter of crank_step) or 8 times film.grid in each direction; a figure that misses the target there is named in the messages with its error, and the run still counts as converged.", "1e-3"),

    key("operation", Table, Required, &[Film, Dimensionless, Equilibrium, Coefficients], "How the bearing runs.", ""),
    key("operation.speed", Quantity(Dimension::AngularSpeed, SPEED), Required, OPERATED, "Angular speed of the journal, relative to the frame of the loads.", "\"2000 rpm\""),
    key("operation.shell_speed", Quantity(Dimension::AngularSpeed, SPEED), Default("0 rpm"), OPERATED, "Angular speed of the shell, relative to the frame of the loads.", "\"0 rpm\""),
    key("operation.load", Pair(Dimension::Force, FORCE), Required, STEADY, "Load that the machine puts ON the journal, along X and Y.", "[\"10 kN\", \"0 N\"]"),
    key("operation.moment", Pair(Dimension::Moment, MOMENT), Optional, STEADY, "Moment ON the journal about X and Y; given, the tilt is free and answers it.", "[\"0 N.m\", \"0 N.m\"]"),
    key("operation.rotor_mass", Quantity(Dimension::Mass, Range::above(0.0, 1e6, "kg")), Optional, TURNING, "Mass of the rigid rotor that one bearing carries: is it stable, and how far from whirling?", "\"50 kg\""),
    key("operation.speeds", List(Dimension::AngularSpeed, Range::above(0.0, 1e6, "rpm")), Optional, TURNING,
        "Ascending journal speeds of the stability chart, at this load, oil and clearance; with rotor_mass, the speed where the rotor begins to whirl is found between them.", "[\"1000 rpm\", \"2000 rpm\", \"4000 rpm\"]"),
    key("operation.relative_eccentricity", Number(Range::between(0.0, 1000.0, "")), Required, ANY_FILM, "Distance of the centres over the radial clearance.", "0.5 to 0.99"),
    key("operation.line_of_centres_angle", Quantity(Dimension::Angle, Range::ANY), Default("0 deg"), ONE_FILM, "Angle from +X to the narrowest gap.", "\"30 deg\""),
    key("operation.relative_eccentricity_rate", Quantity(Dimension::Rate, Range::ANY), Default("0 1/s"), ONE_FILM, "How fast the relative eccentricity grows.", "\"20 1/s\""),
    key("operation.line_of_centres_rate", Quantity(Dimension::AngularSpeed, Range::ANY), Default("0 rad/s"), ONE_FILM, "How fast the line of centres turns.", "\"100 rad/s\""),
    key("operation.tilt", Pair(Dimension::Angle, TILT), Optional, OPERATED, "Rotation of the journal axis against the shell axis about X and Y, held fixed.", "[\"0 rad\", \"0.1 mrad\"]"),
    key("operation.tilt_rate", Pair(Dimension::AngularSpeed, Range::between(-1e6, 1e6, "rad/s")), Optional, ONE_FILM, "Rate of the tilt.", "[\"0 rad/s\", \"0 rad/s\"]"),
    key("operation.dimensionless", Flag, Default("false"), ANY_FILM, "Solve the dimensionless film problem, without [bearing] and [oil].", "true"),
    key("operation.d_over_b", Number(Range::above(0.0, 100.0, "")), Required, SCALED, "Diameter over width.", "1 to 4"),
    key("operation.tilt_gamma", Number(Range::ANY), Default("0"), SCALED, "Relative tilt in the plane of the narrowest gap: H = 1 + eps cos(phi) - gamma (1-eps) Z cos(phi) - delta Z sin(phi).", "0 to 1"),
    key("operation.tilt_delta", Number(Range::ANY), Default("0"), SCALED, "Relative tilt across it, over the radial clearance, unscaled.", "0 to 0.5"),
    key("operation.wedge", Number(Range::ANY), Default("1"), SCALED, "Share of the rotation: right side = wedge * 6 dH/dphi + squeeze * 12 cos(phi).", "1"),
    key("operation.squeeze", Number(Range::ANY), Default("0"), SCALED, "Share of the radial motion; negative for a falling eccentricity.", "0"),

    key("load_cycle", Table, Required, CYCLE, "The load over one period.", ""),
    key("load_cycle.file", Text, Required, CYCLE,
        "CSV beside the study: crank_angle[deg],load_x[N],load_y[N](,journal_speed[rad/s],shell_speed[rad/s]), loads ON the journal; with moment_x[N.m],moment_y[N.m] ON the journal the tilt is free, with tilt_x[rad],tilt_y[rad] it is prescribed.", "\"loads.csv\""),
    key("load_cycle.engine_speed", Quantity(Dimension::AngularSpeed, Range::above(0.0, 1e6, "rpm")), Required, CYCLE, "Crank speed: sets time, and the speeds where their columns are missing.", "\"2000 rpm\""),
    key("load_cycle.period", Quantity(Dimension::Angle, Range::above(0.0, 36_000.0, "deg")), Default("720 deg"), CYCLE, "Period of the load.", "\"720 deg\" four-stroke, \"360 deg\" two-stroke"),
    key("load_cycle.journal_mass", Quantity(Dimension::Mass, Range::between(0.0, 1e6, "kg")), Default("0 kg"), CYCLE, "Mass that moves with the journal centre.", "\"0 kg\""),
    key("load_cycle.crank_step", Quantity(Dimension::Angle, Range::between(0.001, 30.0, "deg")), Default("1 deg"), CYCLE, "Crank angle between two rows of the results; divides the period.", "\"1 deg\""),
    key("load_cycle.maximum_cycles", Integer(1, 1000), Default("8"), CYCLE, "Cycles after which an orbit that has not closed is given up.", "8"),
    key("load_cycle.coefficients_at", List(Dimension::Angle, Range::between(-36_000.0, 36_000.0, "deg")), Optional, CYCLE,
        "Crank angles at which stiffness and damping are taken, each at the nearest row of the results.", "[\"10 deg\", \"370 deg\"]"),
    key("load_cycle.closure_tolerance", Number(Range::above(0.0, 0.1, "")), Default("1e-4"), CYCLE,
        "The orbit is closed when two cycles differ by less, over the radial clearance.", "1e-4"),

    key("limits", Table, Optional, PHYSICAL, "Design limits, shown with OK or exceeded.", ""),
    key("limits.minimum_film_thickness", Limit(Dimension::Length, Range::above(0.0, 10.0, "mm")), Optional, PHYSICAL, "Smallest film thickness allowed.", "{ value = \"1 um\", source = \"house rule\" }"),
    key("limits.peak_film_pressure", Limit(Dimension::Pressure, Range::above(0.0, 1e5, "bar")), Optional, PHYSICAL, "Largest film pressure allowed.", "{ value = \"200 MPa\", source = \"supplier\" }"),
    key("limits.maximum_specific_load", Limit(Dimension::Pressure, Range::above(0.0, 1e5, "bar")), Optional, PHYSICAL, "Largest load over diameter times width allowed.", "{ value = \"60 MPa\", source = \"supplier\" }"),
    key("limits.power_loss", Limit(Dimension::Power, Range::above(0.0, 1e9, "W")), Optional, PHYSICAL, "Largest power lost in the film allowed (mean over a cycle).", "{ value = \"1 kW\", source = \"heat budget\" }"),

    key("output", Table, Optional, CYCLE, "What is written.", ""),
    key("output.fields", Choice(&["all", "frames", "none"], &[]), Default("all"), CYCLE,
        "Crank angles of which results.h5 holds the fields: every one, at most 72 evenly spaced ones, or none.", "\"frames\""),

    planned("engine", "An engine, from layout and gas pressure to the loads of its bearings."),
    planned("shaft", "A shaft on several bearings."),
    planned("database", "A hydrodynamic database."),

    key("sweep", Table, Required, SWEEP, "Many cases of a base study, some of whose keys vary.", ""),
    key("sweep.base", Text, Required, SWEEP, "The base study, beside this one; the files it names lie beside it.", "\"study.toml\""),
    key("sweep.mode", Choice(&["grid", "zip"], &[]), Default("grid"), SWEEP, "grid: every value with every other, the last key fastest; zip: the first values of all keys, then the second ones.", "\"grid\""),
    key("sweep.vary", Vary, Required, SWEEP,
        "Keys of the base study and the values they take: a list, or a range { from, to, count, scale = \"linear\" | \"log\" }. \"bearing.groove[0].pressure\" is that of the first groove.",
        "{ \"bearing.diametral_clearance\" = [\"60 um\", \"72 um\", \"84 um\"], \"operation.speed\" = { from = \"1000 rpm\", to = \"4000 rpm\", count = 7 } }"),
    key("sweep.keep", Choice(&["summary", "all"], &[]), Default("summary"), SWEEP, "What each case leaves in cases/NNNN: its summary.json, or all of its results (report.html alone takes 5 MB a case).", "\"summary\""),
];
