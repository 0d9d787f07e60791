//! The keys of the study file, schema 1.

use super::schema::Kind::{
    Choice, Files, Flag, Grid, Integer, Integers, Limit, List, Number, Numbers, Pair, Quantity,
    QuantityOrLaw, Table, TableList, TableOrList, Text, Vary, Words,
};
use super::schema::Mode::{
    self, Coefficients, Database, Dimensionless, Engine, Equilibrium, Film, LoadCycle, Shaft, Sweep,
};
use super::schema::Presence::{self, Default, Optional, Required};
use super::schema::{Key, Kind, Range};
use super::units::Dimension;

const ALL: &[Mode] = &[
    Film,
    Dimensionless,
    Equilibrium,
    Coefficients,
    LoadCycle,
    Engine,
    Shaft,
];
const EVERY: &[Mode] = &[
    Database,
    Film,
    Dimensionless,
    Equilibrium,
    Coefficients,
    LoadCycle,
    Engine,
    Shaft,
    Sweep,
];
const SWEEP: &[Mode] = &[Sweep];
const DATABASE: &[Mode] = &[Database];
/// What has a size, and may share its file with the database of its films.
const SIZED: &[Mode] = &[
    Film,
    Equilibrium,
    Coefficients,
    LoadCycle,
    Engine,
    Shaft,
    Database,
];
/// What has closures of the film.
const CLOSED: &[Mode] = &[
    Film,
    Dimensionless,
    Equilibrium,
    Coefficients,
    LoadCycle,
    Engine,
    Shaft,
    Database,
];
const PHYSICAL: &[Mode] = &[Film, Equilibrium, Coefficients, LoadCycle, Engine, Shaft];
const REFINED: &[Mode] = &[Film, Dimensionless, Equilibrium, Coefficients, LoadCycle];
const COMPARED: &[Mode] = &[Film, Equilibrium, Coefficients, LoadCycle];
const OPERATED: &[Mode] = &[Film, Equilibrium, Coefficients];
const STEADY: &[Mode] = &[Equilibrium, Coefficients];
const TURNING: &[Mode] = &[Coefficients];
const ONE_FILM: &[Mode] = &[Film];
const ANY_FILM: &[Mode] = &[Film, Dimensionless];
const SCALED: &[Mode] = &[Dimensionless];
const CYCLE: &[Mode] = &[LoadCycle];
/// Journals that run over a cycle.
const CYCLIC: &[Mode] = &[LoadCycle, Engine, Shaft];
const ENGINE: &[Mode] = &[Engine];
const SHAFT: &[Mode] = &[Shaft];
const MACHINE: &[Mode] = &[Engine, Shaft];

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
/// Dimensions of engines and shafts.
const LENGTH: Range = Range::above(0.0, 100_000.0, "mm");
/// Places along or across engines and shafts.
const PLACE: Range = Range::between(-100_000.0, 100_000.0, "mm");
const ENGINE_SPEED: Range = Range::above(0.0, 1e6, "rpm");
const PART_MASS: Range = Range::above(0.0, 1e5, "kg");
const INERTIA: Range = Range::above(0.0, 1e6, "kg.m2");
const UNBALANCE: Range = Range::between(0.0, 1e5, "kg.m");
const MODULUS: Range = Range::between(0.1, 10_000.0, "GPa");
const SUPPORT: Range = Range::above(0.0, 1e15, "N/m");
/// Stiffness against twist or tilt.
const TWIST: Range = Range::above(0.0, 1e15, "N.m/rad");
const TWIST_DAMPING: Range = Range::between(0.0, 1e9, "N.m.s/rad");
const SECTION: Range = Range::above(0.0, 1e15, "N.m2");
/// Absolute pressures of gases.
const ABSOLUTE: Range = Range::between(0.0, 10_000.0, "bar");
/// Crank angles of one or two turns either way.
const TURNS: Range = Range::between(-720.0, 720.0, "deg");
const KINEMATIC: Range = Range::above(0.0, 1e6, "mm2/s");
/// Roughness beyond this is a slip of the unit.
const ROUGHNESS: Range = Range::between(0.0, 100.0, "um");
/// 1/9 to 9: where flow factors are known.
const PEKLENIK: Range = Range::between(0.1112, 9.0, "");
/// Young's moduli of solids, polymers included.
const SOLID: Range = Range::between(0.001, 10_000.0, "GPa");
const POISSON: Range = Range::between(0.0, 0.49, "");
/// Thermal expansion of solids.
const EXPANSION: Range = Range::between(0.0, 1000e-6, "1/K");
const CAPACITY: Range = Range::between(100.0, 10_000.0, "J/(kg.K)");
const CONDUCTIVITY: Range = Range::between(0.01, 100.0, "W/(m.K)");
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

/// Every key of the study file, in the order in which `explain` and the schema show them.
#[rustfmt::skip] // one key per entry reads as a table
pub const KEYS: &[Key] = &[
    key("schema", Integer(1, 1), Required, EVERY, "Version of the study file format.", "1"),
    key("title", Text, Default(""), EVERY, "Title of the study, shown in the report.", "\"Big end, 2000 rpm\""),
    key("analysis", Choice(&["film", "equilibrium", "coefficients", "load-cycle", "engine", "shaft", "database", "sweep"], &[]),
        Required, EVERY, "What is calculated: one film, the position under a constant load, stiffness and damping there, the journal orbit over a load cycle, every bearing of an engine or of a shaft, films stored to be looked up, or one of these for many values of some keys.", "\"load-cycle\""),

    key("bearing", TableOrList, Required, SIZED, "The bearing: its size, clearance and oil supply. An engine or shaft has several: write [[bearing]] for each kind, and one with numbers for those that differ from it.", ""),
    key("bearing.of", Choice(&["main", "big-end", "small-end", "piston-boss", "shaft"], &[]), Optional, MACHINE,
        "Kind of the bearings of an engine: main and big-end must be there, small-end and piston-boss may. Those of a shaft are all of kind shaft.", "\"main\""),
    key("bearing.numbers", Integers(1, 1000), Optional, MACHINE,
        "The bearings of the kind that this one describes, counted from the free end (mains, bearings of a shaft) or by cylinder; what it leaves out is taken from the [[bearing]] of the kind without numbers.", "[4]"),
    key("bearing.offset", Pair(Dimension::Length, Range::between(-10.0, 10.0, "mm")), Optional, MACHINE,
        "Position of the bore against the common line of the bores, along X and Y; of main bearings of an elastic crankshaft and bearings of an elastic shaft.", "[\"10 um\", \"0 um\"]"),
    key("bearing.diameter", Quantity(Dimension::Length, SIZE), Required, SIZED, "Bore diameter.", "\"30 mm\" to \"500 mm\""),
    key("bearing.width", Quantity(Dimension::Length, SIZE), Required, SIZED, "Bearing width along the axis.", "0.2 to 1 times the diameter"),
    key("bearing.diametral_clearance", Quantity(Dimension::Length, CLEARANCE), Optional, PHYSICAL,
        "Bore diameter minus journal diameter: twice the radial clearance. Give this or relative_clearance.", "0.7 to 2 um per mm of diameter"),
    key("bearing.relative_clearance", Number(Range::between(1e-6, 0.1, "")), Optional, PHYSICAL,
        "Diametral clearance over diameter. Give this or diametral_clearance.", "0.7e-3 to 2e-3"),
    key("bearing.groove", TableList, Optional, PHYSICAL, "A groove or hole that holds oil at its feed pressure; write [[bearing.groove]] for each.", ""),
    key("bearing.groove.kind", Choice(&["circumferential", "axial", "rectangle", "hole"], &[]), Required, PHYSICAL,
        "Outline: circumferential (all around), axial or rectangle (length around, width along the axis), hole (round).", "\"hole\""),
    key("bearing.groove.carried_by", Choice(&["shell", "journal"], &[]), Default("shell"), PHYSICAL, "Surface that carries it; what the journal carries turns with it.", "\"shell\""),
    key("bearing.groove.angle", Quantity(Dimension::Angle, Range::ANY), Optional, PHYSICAL, "Angle of its centre from +X of its carrier, in the sense of rotation; in the pin of a big end from the outward end of its crank arm. Not for circumferential grooves.", "\"90 deg\""),
    key("bearing.groove.position", Quantity(Dimension::Length, Range::between(-10_000.0, 10_000.0, "mm")), Default("0 mm"), PHYSICAL, "Axial position of its centre from the mid-plane.", "\"0 mm\""),
    key("bearing.groove.diameter", Quantity(Dimension::Length, FEED), Optional, PHYSICAL, "Diameter of a hole.", "\"3 mm\" to \"10 mm\""),
    key("bearing.groove.length", Quantity(Dimension::Length, FEED), Optional, PHYSICAL, "Length around the circumference of an axial or rectangular groove.", "0.1 to 0.25 times the diameter"),
    key("bearing.groove.width", Quantity(Dimension::Length, FEED), Optional, PHYSICAL, "Width along the axis of every groove but a hole.", "\"3 mm\", up to 0.8 times the bearing width"),
    key("bearing.groove.pressure", Quantity(Dimension::Pressure, GAUGE), Optional, PHYSICAL, "Supply pressure (gauge). Give this or pressure_file.", "\"1 bar\" to \"6 bar\""),
    key("bearing.groove.pressure_file", Text, Optional, CYCLIC,
        "CSV beside the study with the supply pressure (gauge) over the period: crank_angle[deg],pressure[bar]. Give this or pressure.", "\"feed.csv\""),
    key("bearing.groove.line_resistance", Quantity(Dimension::FlowResistance, Range::between(0.0, 1e6, "bar.s/cm3")), Optional, PHYSICAL,
        "Pressure drop per flow in the line between supply and groove; without it the supply pressure holds in the groove.", "\"0.1 bar.s/cm3\" to \"2 bar.s/cm3\""),
    key("bearing.groove.drilling_inlet_radius", Quantity(Dimension::Length, Range::between(0.0, 10_000.0, "mm")), Optional, PHYSICAL,
        "Distance from the crank axis at which the drilling in the crank takes its oil; with drilling_outlet_radius: their centrifugal head adds to the supply pressure.", "\"0 mm\", or the radius of the main journal"),
    key("bearing.groove.drilling_outlet_radius", Quantity(Dimension::Length, Range::between(0.0, 10_000.0, "mm")), Optional, PHYSICAL,
        "Distance from the crank axis at which the drilling opens into the film; with drilling_inlet_radius.", "\"90 mm\": crank radius plus pin radius"),
    key("bearing.groove.fed_by", Integers(1, 1000), Optional, ENGINE,
        "Of a hole in the pin of a big end, in place of pressure: the main bearing whose grooves feed it through a drilling in the crank, with its centrifugal head at each speed; one for all cylinders, or one for each.", "[1, 2, 3, 4]"),
    key("bearing.groove.drilling_inlet_angle", Quantity(Dimension::Angle, Range::ANY), Optional, ENGINE,
        "With fed_by: angle at which the drilling opens into the main journal, from the crank arm of the pin; where the grooves of the main do not reach around, they feed in this part of the turn only.", "\"180 deg\""),
    key("bearing.groove.drilling_inlet_diameter", Quantity(Dimension::Length, FEED), Optional, ENGINE,
        "With fed_by: diameter of the drilling where it opens into the main journal. Default: that of the hole.", "\"6 mm\""),
    key("bearing.shell", Table, Optional, PHYSICAL, "The shell as a body.", ""),
    key("bearing.shell.elastic", Choice(&["rigid", "layer"], &["compliance", "modal"]), Default("rigid"), PHYSICAL,
        "How the shell gives way under pressure: layer is a thin layer bonded to a rigid backing, which each place compresses by its own pressure.", "\"rigid\""),
    key("bearing.shell.thickness", Quantity(Dimension::Length, Range::above(0.0, 1000.0, "mm")), Optional, PHYSICAL, "Thickness of the layer.", "\"0.3 mm\" to \"3 mm\""),
    key("bearing.shell.modulus", Quantity(Dimension::Pressure, SOLID), Optional, PHYSICAL, "Young's modulus of the layer.", "\"60 GPa\" aluminium, \"1 GPa\" polymer"),
    key("bearing.shell.poisson", Number(POISSON), Optional, PHYSICAL, "Poisson's ratio of the layer: one near 0.5 gives way sideways, which this model cannot.", "0.33"),
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
    key("bearing.surface", Table, Optional, PHYSICAL, "Roughness of both surfaces, and what their asperities carry. Without it both are smooth.", ""),
    key("bearing.surface.roughness_journal", Quantity(Dimension::Length, ROUGHNESS), Default("0 um"), PHYSICAL, "rms roughness of the journal (Rq, about 1.25 Ra).", "\"0.1 um\" to \"0.5 um\""),
    key("bearing.surface.roughness_shell", Quantity(Dimension::Length, ROUGHNESS), Default("0 um"), PHYSICAL, "rms roughness of the shell (Rq, about 1.25 Ra).", "\"0.2 um\" to \"1 um\""),
    key("bearing.surface.peklenik_journal", Number(PEKLENIK), Default("1"), PHYSICAL, "Peklenik number of the journal: correlation length around over that along the axis; above 1 for marks that run around.", "1 isotropic, 3 to 9 ground or turned"),
    key("bearing.surface.peklenik_shell", Number(PEKLENIK), Default("1"), PHYSICAL, "Peklenik number of the shell: correlation length around over that along the axis; above 1 for marks that run around.", "1 isotropic, 3 to 9 bored"),
    key("bearing.surface.boundary_friction", Number(Range::between(0.0, 1.0, "")), Optional, PHYSICAL, "Shear stress over contact pressure where asperities touch; contact needs it.", "0.02 to 0.12"),
    key("bearing.surface.contact", Table, Optional, PHYSICAL,
        "What asperities carry: { law = \"greenwood-tripp\", factor, asperity_product, modulus, summit_height, summit_roughness } or { law = \"table\", file }.", ""),
    key("bearing.surface.contact.law", Choice(&["greenwood-tripp", "table", "none"], &[]), Required, PHYSICAL,
        "greenwood-tripp: factor modulus F_5/2((gap - summit_height) / roughness), elastic asperities; table: pressure over gap from a file; none: asperities carry nothing.", "\"greenwood-tripp\""),
    key("bearing.surface.contact.factor", Number(Range::above(0.0, 1.0, "")), Optional, PHYSICAL,
        "Greenwood-Tripp: (16 sqrt2 pi/15)(n b s)^2 sqrt(s/b), with n asperities per area of radius b and the composite rms roughness s.", "3e-4 to 3e-3"),
    key("bearing.surface.contact.asperity_product", Number(Range::above(0.0, 1.0, "")), Optional, PHYSICAL, "Greenwood-Tripp: n b s.", "0.03 to 0.05"),
    key("bearing.surface.contact.modulus", Quantity(Dimension::Pressure, SOLID), Optional, PHYSICAL, "Greenwood-Tripp: composite modulus E', 1/E' = (1 - nu_J^2)/E_J + (1 - nu_S^2)/E_S.", "\"53.3 GPa\""),
    key("bearing.surface.contact.summit_height", Quantity(Dimension::Length, ROUGHNESS), Optional, PHYSICAL,
        "Greenwood-Tripp: mean height of the summits above the mean planes, of both surfaces together; asperities touch from that much further away. Without it the summits lie about the mean planes.", "0, or 1 to 2 times the rms roughness from measured summits"),
    key("bearing.surface.contact.summit_roughness", Quantity(Dimension::Length, Range::above(0.0, 100.0, "um")), Optional, PHYSICAL,
        "Greenwood-Tripp: rms of the summit heights about their means, of both surfaces together (root of the sum of squares); takes the place of the composite rms roughness in contact. Without it the summits spread as the surfaces do.", "0.6 to 0.9 times the composite rms roughness"),
    key("bearing.surface.contact.file", Text, Optional, PHYSICAL,
        "CSV beside the study, of law table: gap[um],pressure[MPa], the nominal gap (negative where the mean planes overlap) rising and the mean contact pressure falling to 0 in the last row.", "\"contact.csv\""),

    key("oil", Table, Required, PHYSICAL, "The lubricant.", ""),
    key("oil.oil", Text, Optional, PHYSICAL, "Name of an oil of the library; laws given beside it take the place of its own. Give this or viscosity.", "\"nominal-5w-30\""),
    key("oil.viscosity", QuantityOrLaw(Dimension::DynamicViscosity, Range::above(0.0, 1000.0, "Pa.s")), Optional, PHYSICAL,
        "Dynamic viscosity, or a law: { law = \"vogel\", a, b, c } or { law = \"astm-d341\", kv40, kv100 }. Give this or oil.", "\"5 mPa.s\" to \"50 mPa.s\""),
    key("oil.viscosity.law", Choice(&["vogel", "astm-d341"], &[]), Required, PHYSICAL,
        "vogel: a exp(b/(T + c)), T in K; astm-d341: the line lg lg(nu + 0.7) = A - B lg T through kv40 and kv100, times oil.density.", "\"astm-d341\""),
    key("oil.viscosity.a", Quantity(Dimension::DynamicViscosity, Range::above(0.0, 1000.0, "Pa.s")), Optional, PHYSICAL, "Vogel: viscosity at infinite temperature.", "\"0.05 mPa.s\" to \"0.2 mPa.s\""),
    key("oil.viscosity.b", Quantity(Dimension::TemperatureDifference, Range::above(0.0, 1e5, "K")), Optional, PHYSICAL, "Vogel: steepness.", "\"700 K\" to \"1300 K\""),
    key("oil.viscosity.c", Quantity(Dimension::TemperatureDifference, Range::between(-1e4, 1e4, "K")), Optional, PHYSICAL,
        "Vogel: temperature offset for T in K; where data give 110 for T in degC, this is 110 - 273.15.", "\"-163.15 K\""),
    key("oil.viscosity.kv40", Quantity(Dimension::KinematicViscosity, KINEMATIC), Optional, PHYSICAL, "ASTM D341: kinematic viscosity at 40 degC.", "\"65 mm2/s\""),
    key("oil.viscosity.kv100", Quantity(Dimension::KinematicViscosity, KINEMATIC), Optional, PHYSICAL, "ASTM D341: kinematic viscosity at 100 degC.", "\"11 mm2/s\""),
    key("oil.temperature", Quantity(Dimension::Temperature, Range::between(-100.0, 500.0, "degC")), Default("100 degC"), PHYSICAL, "Temperature of the film. With heat.model = \"balance\" the film finds its own, and this one is not used.", "\"60 degC\" to \"130 degC\""),
    key("oil.density", QuantityOrLaw(Dimension::Density, DENSITY), Default("850 kg/m3"), PHYSICAL,
        "Density, or { value, temperature, expansion, pressure }: how it follows temperature and pressure.", "\"850 kg/m3\""),
    key("oil.density.value", Quantity(Dimension::Density, DENSITY), Required, PHYSICAL, "Density at ambient pressure; with expansion, at oil.density.temperature.", "\"850 kg/m3\""),
    key("oil.density.temperature", Quantity(Dimension::Temperature, Range::between(-100.0, 500.0, "degC")), Optional, PHYSICAL, "Temperature of the value; with expansion.", "\"15 degC\""),
    key("oil.density.expansion", Quantity(Dimension::ThermalExpansion, Range::between(0.0, 2e-3, "1/K")), Optional, PHYSICAL, "Thermal expansion: value (1 - expansion (T - temperature)). Without it the density is the same at every temperature.", "\"6e-4 1/K\" to \"8e-4 1/K\""),
    key("oil.density.pressure", Choice(&["constant", "dowson-higginson", "limit-1.34", "bulk-modulus"], &[]), Default("constant"), PHYSICAL,
        "How the density follows the pressure: dowson-higginson 1 + 0.6 p/(1 + 1.7 p), p in GPa; limit-1.34 (0.59 + 1.34 p)/(0.59 + p), p in GPa; bulk-modulus exp(p / bulk_modulus).", "\"dowson-higginson\""),
    key("oil.density.bulk_modulus", Quantity(Dimension::Pressure, Range::between(0.1, 200.0, "GPa")), Optional, PHYSICAL, "Isothermal bulk modulus, of pressure = \"bulk-modulus\".", "\"1.6 GPa\""),
    key("oil.viscosity_pressure", Table, Optional, PHYSICAL, "How the viscosity follows the pressure: { law = \"barus\" | \"roelands\", alpha }. Without it, not at all.", ""),
    key("oil.viscosity_pressure.law", Choice(&["barus", "roelands", "none"], &[]), Required, PHYSICAL,
        "barus: exp(alpha p), to about 100 MPa; roelands: thickens less at high pressure, to about 500 MPa; none: takes the law of an oil of the library out.", "\"roelands\""),
    key("oil.viscosity_pressure.alpha", Quantity(Dimension::PressureCoefficient, Range::between(0.0, 100.0, "1/GPa")), Optional, PHYSICAL, "Pressure-viscosity coefficient: slope of ln(viscosity) at ambient pressure.", "\"9.5e-9 1/Pa\", \"20 1/GPa\""),
    key("oil.viscosity_pressure.temperature", Quantity(Dimension::Temperature, Range::between(-100.0, 500.0, "degC")), Optional, PHYSICAL,
        "Roelands: temperature of alpha, which then falls as the oil warms. Left out, alpha is the same at every temperature.", "\"40 degC\""),
    key("oil.shear_thinning", Table, Optional, PHYSICAL,
        "How the viscosity falls with the shear rate: { law = \"cross\" | \"carreau\", hths }, or critical_shear_rate in place of hths. Without it, not at all.", ""),
    key("oil.shear_thinning.law", Choice(&["cross", "carreau", "none"], &[]), Required, PHYSICAL,
        "With s = rate / critical_shear_rate and r = second_newtonian_ratio: cross r + (1 - r)/(1 + s^exponent); carreau r + (1 - r)(1 + s^2)^((exponent - 1)/2); none: takes the law of an oil of the library out.", "\"cross\""),
    key("oil.shear_thinning.hths", Quantity(Dimension::DynamicViscosity, Range::above(0.0, 1000.0, "Pa.s")), Optional, PHYSICAL, "Viscosity at 150 degC and 1e6 1/s, from which the critical shear rate follows; it moves with temperature and pressure. Give this or critical_shear_rate.", "\"2.9 mPa.s\""),
    key("oil.shear_thinning.critical_shear_rate", Quantity(Dimension::Rate, Range::above(0.0, 1e15, "1/s")), Optional, PHYSICAL, "Critical shear rate, the same at every temperature. Give this or hths.", "\"1e6 1/s\""),
    key("oil.shear_thinning.second_newtonian_ratio", Number(Range::between(0.0, 0.999, "")), Default("0.5"), PHYSICAL, "Viscosity at unlimited shear over that at low shear, about that of the base oil over that of the blend.", "0.4 to 0.7"),
    key("oil.shear_thinning.exponent", Number(Range::between(0.0, 1.0, "")), Optional, PHYSICAL, "Cross: 0.1 to 1, left out 2/3 (Cross 1965); carreau: exponent of the power law, 0 to below 1, which must be given, from a fit to the oil's flow curve.", "0.667"),
    key("oil.heat_capacity", QuantityOrLaw(Dimension::HeatCapacity, CAPACITY), Optional, PHYSICAL,
        "Heat capacity, or { value, temperature, slope }. Default: mineral oil of relative density 0.87, 2170 J/(kg.K) at 100 degC.", "\"2000 J/(kg.K)\""),
    key("oil.heat_capacity.value", Quantity(Dimension::HeatCapacity, CAPACITY), Required, PHYSICAL, "Heat capacity at oil.heat_capacity.temperature.", "\"2000 J/(kg.K)\""),
    key("oil.heat_capacity.temperature", Quantity(Dimension::Temperature, Range::between(-100.0, 500.0, "degC")), Required, PHYSICAL, "Temperature of the value.", "\"40 degC\""),
    key("oil.heat_capacity.slope", Quantity(Dimension::HeatCapacitySlope, Range::between(-100.0, 100.0, "J/(kg.K2)")), Required, PHYSICAL, "Change over temperature.", "\"3.6 J/(kg.K2)\""),
    key("oil.conductivity", QuantityOrLaw(Dimension::Conductivity, CONDUCTIVITY), Optional, PHYSICAL,
        "Heat conductivity, or { value, temperature, slope }. Default: mineral oil of relative density 0.87, 0.128 W/(m.K) at 100 degC.", "\"0.14 W/(m.K)\""),
    key("oil.conductivity.value", Quantity(Dimension::Conductivity, CONDUCTIVITY), Required, PHYSICAL, "Conductivity at oil.conductivity.temperature.", "\"0.14 W/(m.K)\""),
    key("oil.conductivity.temperature", Quantity(Dimension::Temperature, Range::between(-100.0, 500.0, "degC")), Required, PHYSICAL, "Temperature of the value.", "\"40 degC\""),
    key("oil.conductivity.slope", Quantity(Dimension::ConductivitySlope, Range::between(-1.0, 1.0, "W/(m.K2)")), Required, PHYSICAL, "Change over temperature.", "\"-7e-5 W/(m.K2)\""),
    key("oil.grade", Text, Optional, PHYSICAL, "Viscosity grade of SAE J300 that the oil must have: its kinematic viscosity at 100 degC and its viscosity at 150 degC and 1e6 1/s are held against the windows of the grade.", "\"5W-30\""),

    key("heat", Table, Optional, PHYSICAL, "Where the temperature of the film comes from.", ""),
    key("heat.model", Choice(&["given", "balance", "field"], &[]), Default("given"), PHYSICAL,
        "given: oil.temperature; balance: one effective temperature of the film at which its power equals the heat that side flow and conduction carry away; field: the temperature of every place of the film.", "\"balance\""),
    key("heat.supply_temperature", Quantity(Dimension::Temperature, Range::between(-100.0, 500.0, "degC")), Optional, PHYSICAL, "Temperature of the oil that is supplied; balance and field need it.", "\"60 degC\" to \"120 degC\""),
    key("heat.conductance", Quantity(Dimension::Conductance, Range::between(0.0, 1e6, "W/K")), Default("0 W/K"), PHYSICAL, "Balance: heat that shaft and housing conduct away, per difference of film and surroundings.", "\"5 W/K\" to \"50 W/K\""),
    key("heat.surroundings_temperature", Quantity(Dimension::Temperature, Range::between(-100.0, 500.0, "degC")), Optional, PHYSICAL, "Balance: temperature of the surroundings; conductance needs it.", "\"20 degC\""),
    key("heat.outlet_weight", Number(Range::above(0.0, 1.0, "")), Default("0.5"), PHYSICAL, "Balance: weight of the outlet in the effective temperature, supply + weight (outlet - supply).", "0.5"),
    key("heat.wall_coefficient", Quantity(Dimension::HeatTransfer, Range::between(0.0, 1e9, "W/(m2.K)")), Default("0 W/(m2.K)"), PHYSICAL, "Field: heat that the film gives to both surfaces together, per area and difference to wall_temperature; 0 is an adiabatic film.", "\"0 W/(m2.K)\" to \"2000 W/(m2.K)\""),
    key("heat.carry_over", Number(Range::between(0.0, 1.0, "")), Default("1"), PHYSICAL, "Field: share of the oil which a groove takes from the film that mixes into what it gives; the rest leaves with its heat and fresh oil replaces it.", "0.4 to 1"),
    key("heat.wall_temperature", Quantity(Dimension::Temperature, Range::between(-100.0, 500.0, "degC")), Optional, PHYSICAL, "Field: temperature of the surfaces; wall_coefficient needs it.", "\"90 degC\""),
    key("heat.expansion", Table, Optional, PHYSICAL, "How the clearance follows the temperature. The clearance of the bearing is then that of the assembled bearing at reference_temperature; without it, that of the warm bearing.", ""),
    key("heat.expansion.reference_temperature", Quantity(Dimension::Temperature, Range::between(-100.0, 500.0, "degC")), Default("20 degC"), PHYSICAL, "Temperature at which the clearance was measured.", "\"20 degC\""),
    key("heat.expansion.journal", Quantity(Dimension::ThermalExpansion, EXPANSION), Required, PHYSICAL, "Thermal expansion of the journal.", "\"11.5e-6 1/K\" steel"),
    key("heat.expansion.housing", Quantity(Dimension::ThermalExpansion, EXPANSION), Required, PHYSICAL, "Thermal expansion of the housing.", "\"11.5e-6 1/K\" steel, \"23e-6 1/K\" aluminium"),
    key("heat.expansion.journal_excess", Quantity(Dimension::TemperatureDifference, Range::between(-500.0, 500.0, "K")), Default("0 K"), PHYSICAL, "Temperature of the journal over that of the film.", "\"0 K\""),
    key("heat.expansion.housing_excess", Quantity(Dimension::TemperatureDifference, Range::between(-500.0, 500.0, "K")), Default("0 K"), PHYSICAL, "Temperature of shell and housing over that of the film.", "\"-20 K\""),
    key("heat.expansion.shell", Table, Optional, PHYSICAL, "A shell of another material pressed into the housing. Without it the bore is the housing's own.", ""),
    key("heat.expansion.shell.thickness", Quantity(Dimension::Length, LENGTH), Required, PHYSICAL, "Wall thickness of the shell.", "\"1.8 mm\" to \"3 mm\""),
    key("heat.expansion.shell.modulus", Quantity(Dimension::Pressure, SOLID), Default("210 GPa"), PHYSICAL, "Young's modulus of the shell.", "\"210 GPa\" steel"),
    key("heat.expansion.shell.poisson", Number(POISSON), Default("0.3"), PHYSICAL, "Poisson's ratio of the shell.", "0.3"),
    key("heat.expansion.shell.expansion", Quantity(Dimension::ThermalExpansion, EXPANSION), Default("11.5e-6 1/K"), PHYSICAL, "Thermal expansion of the shell.", "\"11.5e-6 1/K\" steel"),
    key("heat.expansion.shell.housing_diameter", Quantity(Dimension::Length, LENGTH), Required, PHYSICAL, "Outer diameter of the housing, taken as a ring.", "1.3 to 2 times the diameter"),
    key("heat.expansion.shell.housing_modulus", Quantity(Dimension::Pressure, SOLID), Default("210 GPa"), PHYSICAL, "Young's modulus of the housing.", "\"70 GPa\" aluminium, \"210 GPa\" steel"),
    key("heat.expansion.shell.housing_poisson", Number(POISSON), Default("0.3"), PHYSICAL, "Poisson's ratio of the housing.", "0.33 aluminium"),
    key("heat.expansion.shell.interference", Quantity(Dimension::Length, Range::between(0.0, 10.0, "mm")), Required, PHYSICAL, "Diametral interference at reference_temperature: outer diameter of the free shell minus inner diameter of the free housing.", "\"40 um\" to \"100 um\""),

    key("film", Table, Optional, CLOSED, "How the film is modelled.", ""),
    key("film.model", Choice(&["field", "online", "database", "superposition", "short-bearing", "mobility", "long-bearing"], &[]), Default("field"), ALL,
        "field: Reynolds equation on a grid; online: the film of a plain bearing without feeds, solved in microseconds with the closure gumbel (its default), whose journal may tilt, or reynolds, aligned; database: the same bearing looked up in the films of film.database, with their closure; superposition: the same with wedge and squeeze stored apart and their forces added, as in the paper, for comparison; the others are closed forms, estimates outside their range.", "\"field\""),
    key("film.database", Files, Optional, PHYSICAL,
        "HDF5 file beside the study, or a list of files, that hold the films of the models looked up in databases; `sommerfeld database build` or an analysis \"database\" makes one. Of several files each bearing takes the first that holds its closure and its width over diameter.", "\"big-end-films/table.h5\""),
    key("film.feeds", Choice(&["used", "left-out"], &[]), Default("used"), PHYSICAL,
        "left-out: the film is that of the bearings without their grooves and holes, for film models that have none.", "\"used\""),
    key("film.method", Choice(&["finite-volume", "vogelpohl-fdm"], &[]), Default("finite-volume"), ALL,
        "How a dimensionless film is solved. finite-volume: cells and active sets, direct; vogelpohl-fdm: the paper's finite differences of the pressure times H^1.5 on variable steps with point iteration, closure reynolds, for comparison.", "\"finite-volume\""),
    key("film.cavitation", Choice(&["gumbel", "reynolds", "mass-conserving"], &[]), Default("mass-conserving"), CLOSED,
        "Closure for the ruptured film: cut negative pressures, smooth rupture (Swift-Stieber), or Jakobsson-Floberg-Olsson. A database has reynolds where it is left out, and a film looked up in one the closure of the database.", "\"mass-conserving\""),
    key("film.inlet", Choice(&["cyclic", "max-film-line"], &[]), Default("cyclic"), CLOSED,
        "Where the film starts: periodic, or full at inlet_pressure on the line of the widest gap, which moves.", "\"cyclic\""),
    key("film.inlet_pressure", Quantity(Dimension::Pressure, GAUGE), Default("0 bar"), PHYSICAL, "Pressure (gauge) on the line of the widest gap; with inlet = \"max-film-line\".", "\"0 bar\""),
    key("film.ends", Choice(&["air", "flooded"], &[]), Default("air"), ALL, "What surrounds the bearing ends: air (oil may leave, none enters) or an oil bath.", "\"air\""),
    key("film.ambient_pressure", Quantity(Dimension::Pressure, GAUGE), Default("0 bar"), PHYSICAL, "Pressure (gauge) at the bearing ends; not below cavitation_pressure.", "\"0 bar\""),
    key("film.cavitation_pressure", Quantity(Dimension::Pressure, GAUGE), Default("0 bar"), PHYSICAL, "Pressure (gauge) of the ruptured film.", "\"0 bar\", \"-0.7 bar\""),
    key("film.grid", Grid, Default("[128, 32]"), ALL, "Cells around the circumference and along the axis.", "[128, 32]"),
    key("film.film_shear", Choice(&["full-width", "film-fraction"], &[]), Optional, PHYSICAL,
        "Shear in the ruptured film: as if full, or weighted by the film fraction. Default: film-fraction for mass-conserving, else full-width.", "\"film-fraction\""),
    key("film.linear_solver", Choice(&["auto", "banded"], &["multigrid"]), Default("auto"), ALL, "Solver of the linear systems.", "\"auto\""),
    key("film.relative_error_target", Number(Range::between(1e-6, 0.1, "")), Optional, REFINED,
        "Refine the grid, from half of film.grid on, and extrapolate until the estimated discretisation error of every figure is below this: relative to the force or moment vector, the flow, a radian, else to the figure. Load cycles refine their time step too and extrapolate nothing. At most 512 x 128 cells (load cycles 256 x 64 and a quarter of crank_step) or 8 times film.grid in each direction; a figure that misses the target there is named in the messages with its error, and the run still counts as converged.", "1e-3"),
    key("film.compare", Words(&["plain", "field", "online", "database", "superposition", "short-bearing", "mobility", "long-bearing"]), Optional, COMPARED,
        "Runs the study once more with each of these and reports the differences. plain: smooth surfaces, a rigid shell, an oil of constant viscosity and density, one temperature; that of the heat balance with its clearance, of the supply where the temperature is a field, else oil.temperature. The others are film models, as under model: one that cannot do what the study asks is named with the reason.", "[\"plain\", \"short-bearing\"]"),

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

    key("wear", Table, Optional, CYCLIC, "Wear of bearings whose surfaces touch; needs [bearing.surface] with contact.", ""),
    key("wear.coefficient", Quantity(Dimension::WearCoefficient, Range::above(0.0, 1e-9, "1/Pa")), Required, CYCLIC,
        "Archard coefficient of the shell: depth worn over contact pressure times sliding distance.", "\"1e-16 m2/N\"; 1e-18 to 1e-15 m2/N lubricated"),
    key("wear.running_in", Table, Optional, CYCLIC, "Wear the bore of the shell and its summits over a time, then calculate the worn bearing. For load cycles; of an engine or a shaft, run the loads-<name>.csv of a bearing as one.", ""),
    key("wear.running_in.hours", Quantity(Dimension::Time, Range::above(0.0, 1e6, "h")), Required, CYCLIC, "Time over which the shell runs in; it ends sooner where the map of the wear settles.", "\"10 h\""),
    key("wear.running_in.steps", Integer(1, 10_000), Default("50"), CYCLIC, "Steps at most, each with an orbit of its own.", "50"),
    key("wear.running_in.step_depth", Number(Range::above(0.0, 1.0, "")), Default("0.2"), CYCLIC, "Largest depth worn in one step, over the composite roughness; steps are shorter where a wear rate would change by more than half of the largest.", "0.1 to 0.5"),
    key("wear.running_in.settled_below", Number(Range::between(0.0, 1.0, "")), Default("0.02"), CYCLIC, "The shell has run in when no wear rate changes in a step by more than this share of the largest one, or when the largest has faded to this share of the first one; 0 runs the whole time.", "0.02"),
    key("wear.running_in.roughness", Choice(&["truncated", "kept"], &[]), Default("truncated"), CYCLIC, "What becomes of the roughness of the shell. truncated: its Gaussian summits are worn off first, down to 0.584 of the rms when all are gone, by the mean worn depth of the worn zone; kept: wear moves the profile alone.", "\"truncated\""),

    key("database", Table, Required, DATABASE, "A database of films that is to be built.", ""),
    key("database.scheme", Choice(&["combined", "superposition"], &[]), Default("combined"), DATABASE,
        "combined: wedge and squeeze solved together at every ratio of one to the other, exact up to the stated error; superposition: each solved apart and their forces added, as in the paper, which errs by tens of percent where both act.", "\"combined\""),
    key("database.width_ratios", Numbers(Range::between(0.05, 4.0, "")), Optional, DATABASE,
        "Width over diameter of the bearings: one, or the smallest and the largest, between which every one is held. Left out, it is that of [bearing].", "0.4, [0.3, 0.5]"),
    key("database.journal", Choice(&["aligned", "tilted"], &[]), Default("aligned"), DATABASE,
        "aligned: the journal stays parallel to the bore; tilted: films over eccentricity and both tilts, of scheme superposition alone. Minutes, not seconds.", "\"aligned\""),
    key("database.target", Number(Range::between(1e-5, 0.05, "")), Optional, DATABASE, "Largest error of the force over its size, on states drawn at random; of superposition that of force and moment of wedge and squeeze each. Nodes are added, of superposition cells too, until it is met; a superposition that may have no more says so as its status. Default: 1e-3; 2e-2 of tilted journals.", "1e-3"),
    key("database.last_eccentricity", Number(Range::between(0.5, 0.9999, "")), Optional, DATABASE, "Largest relative eccentricity of the nodes; the film is continued smoothly beyond. Default: 0.999; of superposition 0.99, of tilted journals 0.95.", "0.999"),
    key("database.smallest_gap", Number(Range::between(0.005, 0.5, "")), Optional, DATABASE, "Smallest film thickness over the radial clearance, anywhere in the bearing, down to which a database of tilted journals states its error. Default: 0.02.", "0.05"),
    key("database.nodes", Numbers(Range::between(5.0, 257.0, "")), Optional, DATABASE, "Nodes that a superposition begins with: along the eccentricity, and of tilted journals along the tilt in the plane of the narrowest gap and across it, both odd. Default: 25; [21, 21, 15] of tilted journals.", "[21, 21, 15]"),
    key("database.most_films", Integer(50, 10_000_000), Optional, DATABASE, "Most films at the nodes of a superposition: where they do not meet the target, its status is not-converged. Default: 60000.", "20000"),
    key("database.samples", Integer(8, 1_000_000), Optional, DATABASE, "States drawn at random at which the database is held against films solved for them; of superposition for each of its three drives. Default: 400; of superposition 200, of tilted journals 1000.", "400"),
    key("database.seed", Integer(0, i64::MAX), Default("1"), DATABASE, "Where the random states begin: another number draws others.", "1"),

    key("limits", Table, Optional, PHYSICAL, "Design limits, shown with OK or exceeded.", ""),
    key("limits.minimum_film_thickness", Limit(Dimension::Length, Range::above(0.0, 10.0, "mm")), Optional, PHYSICAL, "Smallest film thickness allowed.", "{ value = \"1 um\", source = \"house rule\" }"),
    key("limits.peak_film_pressure", Limit(Dimension::Pressure, Range::above(0.0, 1e5, "bar")), Optional, PHYSICAL, "Largest film pressure allowed.", "{ value = \"200 MPa\", source = \"supplier\" }"),
    key("limits.maximum_specific_load", Limit(Dimension::Pressure, Range::above(0.0, 1e5, "bar")), Optional, PHYSICAL, "Largest load over diameter times width allowed.", "{ value = \"60 MPa\", source = \"supplier\" }"),
    key("limits.power_loss", Limit(Dimension::Power, Range::above(0.0, 1e9, "W")), Optional, PHYSICAL, "Largest power lost in the film allowed (mean over a cycle).", "{ value = \"1 kW\", source = \"heat budget\" }"),

    key("output", Table, Optional, CYCLE, "What is written.", ""),
    key("output.fields", Choice(&["all", "frames", "none"], &[]), Default("all"), CYCLE,
        "Crank angles of which results.h5 holds the fields: every one, at most 72 evenly spaced ones, or none.", "\"frames\""),

    key("engine", Table, Required, ENGINE, "The engine: layout, dimensions, masses, gas, crankshaft. All cylinders are alike; cylinders, throws and main bearings are numbered from the free end.", ""),
    key("engine.layout", Choice(&["inline", "vee", "boxer"], &[]), Required, ENGINE,
        "inline: a throw for each cylinder; vee: cylinders 1 to n/2 in the bank that the turning arm passes first, the others in the second, and one of each side by side on a throw; boxer: odd and even cylinders opposed, each with a throw of its own.", "\"inline\""),
    key("engine.cylinders", Integer(1, 64), Required, ENGINE, "Number of cylinders.", "6"),
    key("engine.strokes", Integer(2, 4), Default("4"), ENGINE, "Strokes of a working cycle, 2 or 4.", "4"),
    key("engine.firing_order", Integers(1, 64), Optional, ENGINE, "Numbers of the cylinders in the order in which they fire, beginning with 1. It may be left out for one cylinder.", "[1, 5, 3, 6, 2, 4]"),
    key("engine.firing_intervals", List(Dimension::Angle, Range::between(0.0, 720.0, "deg")), Optional, ENGINE,
        "Crank angle from each firing to the next, in the firing order; the last leads back to cylinder 1, so that all add up to one cycle. Default: even.", "[\"90 deg\", \"150 deg\", \"90 deg\", \"150 deg\", \"90 deg\", \"150 deg\"]"),
    key("engine.throw_angles", List(Dimension::Angle, TURNS), Optional, ENGINE,
        "Direction of each throw from the free end, in the sense of rotation and against any of them. As many as cylinders in a vee: split pins, a throw for each rod. Default: what layout and firing order ask for.", "[\"0 deg\", \"180 deg\", \"180 deg\", \"0 deg\"]"),
    key("engine.bank_angle", Quantity(Dimension::Angle, Range::between(0.0, 180.0, "deg")), Optional, ENGINE, "Angle between the banks of a vee.", "\"90 deg\""),
    key("engine.cylinder_spacing", Quantity(Dimension::Length, LENGTH), Required, ENGINE, "Axial distance of neighbouring cylinders of a bank; of a single cylinder, of its two main bearings.", "\"124 mm\", 1.1 to 1.3 times the bore"),
    key("engine.main_positions", List(Dimension::Length, PLACE), Optional, ENGINE, "Axial positions of the main bearings, ascending from the free end. Default: one beside every throw.", "[\"0 mm\", \"124 mm\"]"),
    key("engine.rod_offset", Quantity(Dimension::Length, PLACE), Optional, ENGINE, "Of a vee: axial distance of the two rods on a pin. Of a boxer: of the axes of a pair of cylinders.", "\"20 mm\""),
    key("engine.bore", Quantity(Dimension::Length, LENGTH), Required, ENGINE, "Cylinder bore.", "\"105 mm\""),
    key("engine.stroke", Quantity(Dimension::Length, LENGTH), Required, ENGINE, "Stroke: twice the crank radius.", "\"137 mm\""),
    key("engine.rod_length", Quantity(Dimension::Length, LENGTH), Required, ENGINE, "Length of the connecting rod between the centres of its bearings.", "\"207 mm\""),
    key("engine.pin_offset", Quantity(Dimension::Length, PLACE), Default("0 mm"), ENGINE, "Distance of the piston pin from the crank axis, 90 deg ahead of the cylinder axis in the sense of rotation.", "\"0 mm\" to \"1 mm\""),
    key("engine.speed", List(Dimension::AngularSpeed, ENGINE_SPEED), Required, ENGINE, "Speed of the crankshaft, or a list of speeds.", "[\"1000 rpm\", \"2000 rpm\"]"),
    key("engine.crankcase_pressure", Quantity(Dimension::Pressure, ABSOLUTE), Default("1 bar"), ENGINE, "Absolute pressure under the pistons.", "\"1 bar\""),
    key("engine.piston_mass", Quantity(Dimension::Mass, PART_MASS), Required, ENGINE, "Mass of a piston with rings and pin.", "\"1.7 kg\""),
    key("engine.rod_mass", Quantity(Dimension::Mass, PART_MASS), Required, ENGINE, "Mass of a connecting rod with its shells.", "\"2.4 kg\""),
    key("engine.rod_centre_of_gravity", Quantity(Dimension::Length, LENGTH), Required, ENGINE, "Distance of the centre of gravity of the rod from the centre of its big end.", "\"65 mm\", a third of its length"),
    key("engine.rod_inertia", Quantity(Dimension::Inertia, INERTIA), Required, ENGINE, "Moment of inertia of the rod about its centre of gravity, axis along the crankshaft.", "\"0.02 kg.m2\""),
    key("engine.pin_fit", Choice(&["floating", "fixed-in-piston", "fixed-in-rod"], &[]), Default("floating"), ENGINE,
        "How the piston pin is held; the speed of a floating one follows from the friction of its films.", "\"floating\""),
    key("engine.pin_speed_share", Number(Range::between(0.0, 1.0, "")), Optional, ENGINE, "Of a floating pin: the share of the speed of the rod with which it turns, in place of the friction balance.", "0.5"),
    key("engine.throw_unbalance", Quantity(Dimension::MassMoment, UNBALANCE), Optional, ENGINE, "Mass of pin and webs of one throw times its distance from the crank axis, towards the pin.", "\"0.15 kg.m\""),
    key("engine.counterweight", Quantity(Dimension::MassMoment, UNBALANCE), Optional, ENGINE, "Mass of the counterweights of one throw times its distance from the crank axis, away from the pin.", "\"0.12 kg.m\""),
    key("engine.unbalance", TableList, Optional, ENGINE, "A further mass out of balance on the crankshaft; write [[engine.unbalance]] for each.", ""),
    key("engine.unbalance.throw", Integer(1, 64), Optional, ENGINE, "Number of the throw at which it sits. Give this or position.", "1"),
    key("engine.unbalance.position", Quantity(Dimension::Length, PLACE), Optional, ENGINE, "Axial position. Give this or throw.", "\"-50 mm\""),
    key("engine.unbalance.moment", Quantity(Dimension::MassMoment, UNBALANCE), Required, ENGINE, "Mass times its distance from the crank axis.", "\"0.02 kg.m\""),
    key("engine.unbalance.angle", Quantity(Dimension::Angle, Range::ANY), Default("0 deg"), ENGINE, "Its direction in the sense of rotation: from the arm of its throw, or from that of the throw of cylinder 1 where position is given.", "\"180 deg\""),

    key("engine.gas", Table, Optional, ENGINE, "Measured gas pressure. Give this, with file or [[engine.diagram]], or [engine.combustion].", ""),
    key("engine.gas.file", Text, Optional, ENGINE, "CSV beside the study with the pressure in a cylinder over one working cycle, for every speed: crank_angle[deg],pressure[bar].", "\"pressure.csv\""),
    key("engine.gas.firing_tdc", Quantity(Dimension::Angle, TURNS), Default("0 deg"), ENGINE, "Crank angle in the file at which the firing top dead centre stands.", "\"360 deg\""),
    key("engine.gas.shift", Quantity(Dimension::Angle, TURNS), Default("0 deg"), ENGINE, "Correction of the encoder, added to the crank angles of the file before firing_tdc is looked for.", "\"0.3 deg\""),
    key("engine.gas.gauge", Flag, Default("false"), ENGINE, "The pressures in the files are gauge: ambient is added to them.", "true"),
    key("engine.gas.ambient", Quantity(Dimension::Pressure, ABSOLUTE), Default("1.01325 bar"), ENGINE, "Absolute pressure of the surroundings, for files with gauge pressures.", "\"1 bar\""),
    key("engine.gas.smoothing", Quantity(Dimension::Angle, Range::above(0.0, 30.0, "deg")), Optional, ENGINE, "Half of the width over which the pressures are smoothed; the peak is kept. Default: not at all.", "\"2 deg\""),
    key("engine.gas.peaks", Text, Optional, ENGINE, "CSV beside the study with the peak pressure over the speed, absolute or gauge as the diagrams, to which these are scaled: speed[rpm],peak_pressure[bar].", "\"peaks.csv\""),
    key("engine.diagram", TableList, Optional, ENGINE, "A measured diagram of one speed; write [[engine.diagram]] for each. Between speeds pressures are interpolated.", ""),
    key("engine.diagram.speed", Quantity(Dimension::AngularSpeed, ENGINE_SPEED), Required, ENGINE, "Speed at which it was measured.", "\"2000 rpm\""),
    key("engine.diagram.file", Text, Required, ENGINE, "CSV beside the study, as engine.gas.file; the keys of [engine.gas] hold for it.", "\"pressure-2000.csv\""),

    key("engine.combustion", Table, Optional, ENGINE, "A generated gas pressure, where none was measured: compression, burning, expansion, wall heat. Crank angles count from the firing top dead centre, pressures are absolute.", ""),
    key("engine.combustion.compression_ratio", Number(Range::above(1.0, 60.0, "")), Required, ENGINE, "Largest volume of a cylinder over its smallest.", "10 gasoline, 17 diesel"),
    key("engine.combustion.heat", List(Dimension::Energy, Range::between(0.0, 1e9, "J")), Required, ENGINE, "Heat of the fuel burnt in one cylinder and cycle; one for all speeds, or one for each. 0 J: motored.", "\"1.5 kJ\" for 0.5 l of a naturally aspirated engine at full load"),
    key("engine.combustion.intake_pressure", List(Dimension::Pressure, Range::above(0.0, 100.0, "bar")), Default("[\"1 bar\"]"), ENGINE, "Pressure in the cylinder when the intake closes; one for all speeds, or one for each.", "\"1 bar\", \"2.2 bar\" charged"),
    key("engine.combustion.intake_temperature", List(Dimension::Temperature, Range::between(-70.0, 1200.0, "degC")), Default("[\"70 degC\"]"), ENGINE, "Temperature of the charge when the intake closes; one for all speeds, or one for each.", "\"70 degC\""),
    key("engine.combustion.exhaust_pressure", List(Dimension::Pressure, Range::above(0.0, 100.0, "bar")), Default("[\"1.1 bar\"]"), ENGINE, "Pressure in the cylinder while it exhausts; one for all speeds, or one for each.", "\"1.1 bar\""),
    key("engine.combustion.intake_closes", Quantity(Dimension::Angle, Range::between(-237.0, 0.0, "deg")), Default("-140 deg"), ENGINE, "Crank angle at which the intake closes, negative.", "\"-140 deg\""),
    key("engine.combustion.exhaust_opens", Quantity(Dimension::Angle, Range::between(0.0, 237.0, "deg")), Default("130 deg"), ENGINE, "Crank angle at which the exhaust opens.", "\"130 deg\""),
    key("engine.combustion.blow_down", Quantity(Dimension::Angle, Range::above(0.0, 360.0, "deg")), Default("60 deg"), ENGINE, "Crank angle over which the pressure falls after the exhaust has opened.", "\"60 deg\""),
    key("engine.combustion.overlap", Quantity(Dimension::Angle, Range::between(0.0, 180.0, "deg")), Default("20 deg"), ENGINE, "Crank angle about the gas-exchange dead centre over which the pressure goes from exhaust to intake; of four strokes.", "\"20 deg\""),
    key("engine.combustion.ratio_of_specific_heats", Number(Range::between(1.05, 2.0, "")), Optional, ENGINE, "Constant ratio of the specific heats of the gas. Default: 1.38 at 300 K, falling by 8e-5 per kelvin to 1.2.", "1.35"),
    key("engine.combustion.wall_heat", Choice(&["woschni", "adiabatic"], &[]), Default("woschni"), ENGINE, "How the gas loses heat to the walls.", "\"woschni\""),
    key("engine.combustion.head_temperature", Quantity(Dimension::Temperature, Range::between(-70.0, 1200.0, "degC")), Default("230 degC"), ENGINE, "Temperature of the head in the chamber.", "\"230 degC\""),
    key("engine.combustion.piston_temperature", Quantity(Dimension::Temperature, Range::between(-70.0, 1200.0, "degC")), Default("250 degC"), ENGINE, "Temperature of the piston crown.", "\"250 degC\""),
    key("engine.combustion.liner_temperature", Quantity(Dimension::Temperature, Range::between(-70.0, 1200.0, "degC")), Default("150 degC"), ENGINE, "Temperature of the liner.", "\"150 degC\""),
    key("engine.combustion.head_area_ratio", Number(Range::between(0.5, 5.0, "")), Default("1.2"), ENGINE, "Surface of the head in the chamber over the area of the bore.", "1 flat, 1.3 pent roof"),
    key("engine.combustion.piston_area_ratio", Number(Range::between(0.5, 5.0, "")), Default("1.1"), ENGINE, "Surface of the piston crown over the area of the bore.", "1 flat, 1.4 bowl"),
    key("engine.combustion.swirl", Number(Range::between(0.0, 10.0, "")), Default("0"), ENGINE, "Circumferential speed of the charge over the mean piston speed.", "0 to 2"),
    key("engine.combustion.woschni_constant", Number(Range::between(0.0, 0.1, "")), Default("3.24e-3"), ENGINE, "Constant C2 of the term of combustion, m/(s K): 3.24e-3 for spark ignition and direct injection, 6.22e-3 with a prechamber.", "3.24e-3"),
    key("engine.combustion.burning", TableList, Optional, ENGINE, "A Wiebe function; write [[engine.combustion.burning]] for each part of the heat, as premixed and diffusion burning.", ""),
    key("engine.combustion.burning.start", List(Dimension::Angle, TURNS), Required, ENGINE, "Crank angle at which it begins; one for all speeds, or one for each.", "\"-15 deg\""),
    key("engine.combustion.burning.duration", List(Dimension::Angle, Range::above(0.0, 360.0, "deg")), Required, ENGINE, "Crank angle over which it burns, but for exp(-efficiency); one for all speeds, or one for each.", "\"55 deg\""),
    key("engine.combustion.burning.share", Number(Range::between(0.0, 1.0, "")), Default("1"), ENGINE, "Its share of the heat; all shares add up to 1.", "0.3"),
    key("engine.combustion.burning.efficiency", Number(Range::between(1.0, 20.0, "")), Default("6.908"), ENGINE, "Wiebe's a: 6.908 burns 99.9 % over the duration.", "5 to 6.908"),
    key("engine.combustion.burning.exponent", Number(Range::between(1.0, 20.0, "")), Default("3"), ENGINE, "Wiebe's form and 1.", "2 diesel, 3 gasoline"),

    key("engine.crankshaft", Table, Optional, ENGINE, "How the loads of the main bearings are found.", ""),
    key("engine.crankshaft.model", Choice(&["determinate", "elastic"], &[]), Default("determinate"), ENGINE,
        "determinate: a hinge at each main, neighbours share the loads of their throw as a beam on two supports; elastic: an elastic crankshaft on elastic supports, through clearance and film.", "\"elastic\""),
    key("engine.crankshaft.youngs_modulus", Quantity(Dimension::Pressure, MODULUS), Default("210 GPa"), ENGINE, "Young's modulus of the crankshaft.", "\"210 GPa\" steel, \"170 GPa\" nodular iron"),
    key("engine.crankshaft.poissons_ratio", Number(Range::between(0.0, 0.49, "")), Default("0.3"), ENGINE, "Poisson's ratio of the crankshaft.", "0.3"),
    key("engine.crankshaft.main_length", Quantity(Dimension::Length, LENGTH), Optional, ENGINE, "Length of a main journal between the webs.", "\"38 mm\""),
    key("engine.crankshaft.pin_length", Quantity(Dimension::Length, LENGTH), Optional, ENGINE, "Length of a crankpin between the webs.", "\"38 mm\""),
    key("engine.crankshaft.bore_diameter", Quantity(Dimension::Length, Range::between(0.0, 100_000.0, "mm")), Default("0 mm"), ENGINE, "Bores along journals and pins.", "\"0 mm\""),
    key("engine.crankshaft.web_thickness", Quantity(Dimension::Length, LENGTH), Optional, ENGINE, "Thickness of a web along the crankshaft.", "\"24 mm\""),
    key("engine.crankshaft.web_width", Quantity(Dimension::Length, LENGTH), Optional, ENGINE, "Width of a web across its arm. Give this or the three stiffnesses.", "\"120 mm\""),
    key("engine.crankshaft.web_bending_in_plane", Quantity(Dimension::SectionStiffness, SECTION), Optional, ENGINE, "Bending stiffness EI of the bar that stands for a web, in the plane of the throw, from a finite-element model or a test.", "\"30 kN.m2\""),
    key("engine.crankshaft.web_bending_across", Quantity(Dimension::SectionStiffness, SECTION), Optional, ENGINE, "Bending stiffness EI of that bar across the plane of the throw.", "\"700 kN.m2\""),
    key("engine.crankshaft.web_torsion", Quantity(Dimension::SectionStiffness, SECTION), Optional, ENGINE, "Torsional stiffness GJ of that bar.", "\"40 kN.m2\""),
    key("engine.crankshaft.support_stiffness", Pair(Dimension::Stiffness, SUPPORT), Optional, ENGINE, "Stiffness of what holds each main shell, along X and Y. Default: rigid.", "[\"500 N/um\", \"300 N/um\"]"),
    key("engine.crankshaft.support_coupling", Quantity(Dimension::Stiffness, Range::between(-1e15, 1e15, "N/m")), Default("0 N/m"), ENGINE, "Force along X per displacement along Y of that support, and the other way round.", "\"0 N/m\""),
    key("engine.crankshaft.support_tilt_stiffness", Pair(Dimension::TorsionalStiffness, TWIST), Optional, ENGINE, "Stiffness against tilt of each main shell about X and Y; left out, shells do not tilt.", "[\"500 kN.m/rad\", \"500 kN.m/rad\"]"),
    key("engine.crankshaft.support_matrix", Text, Optional, ENGINE,
        "CSV beside the study with the condensed stiffness matrix of the block over all mains, without a header, in N/m, N and N.m/rad: rows and columns x, y, tilt about x, tilt about y of main 1, then of main 2. In place of support_stiffness.", "\"block.csv\""),

    key("engine.torsion", Table, Optional, ENGINE, "Torsional vibration of the crankshaft: a chain of discs, whose twist enters the motion of every throw. Without it the crankshaft turns evenly.", ""),
    key("engine.torsion.loss_factor", Number(Range::between(0.0, 10.0, "")), Default("0"), ENGINE, "Loss factor of every link that gives none: imaginary over real part of its stiffness.", "0.035"),
    key("engine.torsion.disc", TableList, Optional, ENGINE, "A disc of the chain, from the free end to the flywheel; two or more.", ""),
    key("engine.torsion.disc.inertia", Quantity(Dimension::Inertia, INERTIA), Required, ENGINE, "Moment of inertia, with the mean share of the moving parts.", "\"0.0327 kg.m2\""),
    key("engine.torsion.disc.damping", Quantity(Dimension::TorsionalDamping, TWIST_DAMPING), Default("0 N.m.s/rad"), ENGINE, "Damping of what adds to the even turning of the disc.", "\"2 N.m.s/rad\""),
    key("engine.torsion.disc.throw", Integer(1, 64), Optional, ENGINE, "Number of the throw that drives it; every throw drives one disc.", "1"),
    key("engine.torsion.link", TableList, Optional, ENGINE, "A link between a disc and the next, one fewer than discs.", ""),
    key("engine.torsion.link.stiffness", Quantity(Dimension::TorsionalStiffness, TWIST), Required, ENGINE, "Torsional stiffness.", "\"1.25 MN.m/rad\""),
    key("engine.torsion.link.damping", Quantity(Dimension::TorsionalDamping, TWIST_DAMPING), Default("0 N.m.s/rad"), ENGINE, "Viscous damping between the two discs, as of a damper.", "\"20 N.m.s/rad\""),
    key("engine.torsion.link.loss_factor", Number(Range::between(0.0, 10.0, "")), Optional, ENGINE, "Loss factor of this link.", "0.2"),

    key("shaft", Table, Required, SHAFT, "A straight shaft on several bearings: camshaft, balancer shaft. z = 0 at its free end.", ""),
    key("shaft.speed", List(Dimension::AngularSpeed, ENGINE_SPEED), Required, SHAFT, "Speed of the shaft, or a list of speeds.", "[\"4000 rpm\"]"),
    key("shaft.period", Quantity(Dimension::Angle, Range::above(0.0, 36_000.0, "deg")), Default("360 deg"), SHAFT, "Angle of the shaft after which its loads repeat.", "\"360 deg\""),
    key("shaft.bearing_positions", List(Dimension::Length, Range::between(0.0, 100_000.0, "mm")), Required, SHAFT, "Positions of the bearings along the shaft, ascending.", "[\"20 mm\", \"180 mm\"]"),
    key("shaft.model", Choice(&["determinate", "elastic"], &[]), Default("elastic"), SHAFT, "elastic: the bending of the shaft, through clearance and film; determinate: a hinge at each bearing.", "\"elastic\""),
    key("shaft.youngs_modulus", Quantity(Dimension::Pressure, MODULUS), Default("210 GPa"), SHAFT, "Young's modulus.", "\"210 GPa\""),
    key("shaft.poissons_ratio", Number(Range::between(0.0, 0.49, "")), Default("0.3"), SHAFT, "Poisson's ratio.", "0.3"),
    key("shaft.density", Quantity(Dimension::Density, DENSITY), Default("7850 kg/m3"), SHAFT, "Density, for its weight.", "\"7850 kg/m3\""),
    key("shaft.gravity", Pair(Dimension::Acceleration, Range::between(-1e4, 1e4, "m/s2")), Optional, SHAFT, "Acceleration of gravity along X and Y. Default: none.", "[\"-9.81 m/s2\", \"0 m/s2\"]"),
    key("shaft.support_stiffness", Pair(Dimension::Stiffness, SUPPORT), Optional, SHAFT, "Stiffness of what holds each shell, along X and Y. Default: rigid.", "[\"500 N/um\", \"300 N/um\"]"),
    key("shaft.support_coupling", Quantity(Dimension::Stiffness, Range::between(-1e15, 1e15, "N/m")), Default("0 N/m"), SHAFT, "Force along X per displacement along Y of that support, and the other way round.", "\"0 N/m\""),
    key("shaft.support_tilt_stiffness", Pair(Dimension::TorsionalStiffness, TWIST), Optional, SHAFT, "Stiffness against tilt of each shell about X and Y; left out, shells do not tilt.", "[\"500 kN.m/rad\", \"500 kN.m/rad\"]"),
    key("shaft.support_matrix", Text, Optional, SHAFT, "CSV beside the study with the condensed stiffness matrix of the housing over all bearings, as engine.crankshaft.support_matrix.", "\"housing.csv\""),
    key("shaft.section", TableList, Optional, SHAFT, "A section of the shaft, from its free end; write [[shaft.section]] for each.", ""),
    key("shaft.section.length", Quantity(Dimension::Length, LENGTH), Required, SHAFT, "Length.", "\"40 mm\""),
    key("shaft.section.diameter", Quantity(Dimension::Length, LENGTH), Required, SHAFT, "Outer diameter.", "\"30 mm\""),
    key("shaft.section.bore_diameter", Quantity(Dimension::Length, Range::between(0.0, 100_000.0, "mm")), Default("0 mm"), SHAFT, "Diameter of the bore along it.", "\"0 mm\""),
    key("shaft.unbalance", TableList, Optional, SHAFT, "A mass out of balance; write [[shaft.unbalance]] for each.", ""),
    key("shaft.unbalance.position", Quantity(Dimension::Length, Range::between(0.0, 100_000.0, "mm")), Required, SHAFT, "Position along the shaft.", "\"100 mm\""),
    key("shaft.unbalance.moment", Quantity(Dimension::MassMoment, UNBALANCE), Required, SHAFT, "Mass times its distance from the axis.", "\"5 kg.mm\""),
    key("shaft.unbalance.angle", Quantity(Dimension::Angle, Range::ANY), Default("0 deg"), SHAFT, "Its direction at shaft angle 0, from +X in the sense of rotation.", "\"0 deg\""),
    key("shaft.load", TableList, Optional, SHAFT, "A load on the shaft; write [[shaft.load]] for each.", ""),
    key("shaft.load.position", Quantity(Dimension::Length, Range::between(0.0, 100_000.0, "mm")), Required, SHAFT, "Position along the shaft.", "\"60 mm\""),
    key("shaft.load.force", Pair(Dimension::Force, FORCE), Optional, SHAFT, "Constant force ON the shaft, along X and Y. Give this or file.", "[\"-200 N\", \"0 N\"]"),
    key("shaft.load.file", Text, Optional, SHAFT, "CSV beside the study with the force ON the shaft over its angle: crank_angle[deg],load_x[N],load_y[N]. Give this or force.", "\"cam-1.csv\""),

    key("orbit", Table, Optional, MACHINE, "How the journal orbits of an engine or shaft are computed.", ""),
    key("orbit.crank_step", Quantity(Dimension::Angle, Range::between(0.001, 30.0, "deg")), Default("1 deg"), MACHINE, "Angle between two rows of the results; divides the period.", "\"1 deg\""),
    key("orbit.maximum_cycles", Integer(1, 1000), Default("8"), MACHINE, "Cycles after which an orbit that has not closed is given up.", "8"),
    key("orbit.closure_tolerance", Number(Range::above(0.0, 0.1, "")), Default("1e-4"), MACHINE,
        "An orbit is closed when two cycles differ by less, over the radial clearance.", "1e-4"),

    key("sweep", Table, Required, SWEEP, "Many cases of a base study, some of whose keys vary.", ""),
    key("sweep.base", Text, Required, SWEEP, "The base study, beside this one; the files it names lie beside it.", "\"study.toml\""),
    key("sweep.mode", Choice(&["grid", "zip"], &[]), Default("grid"), SWEEP, "grid: every value with every other, the last key fastest; zip: the first values of all keys, then the second ones.", "\"grid\""),
    key("sweep.vary", Vary, Required, SWEEP,
        "Keys of the base study and the values they take: a list, or a range { from, to, count, scale = \"linear\" | \"log\" }. \"bearing.groove[0].pressure\" is that of the first groove.",
        "{ \"bearing.diametral_clearance\" = [\"60 um\", \"72 um\", \"84 um\"], \"operation.speed\" = { from = \"1000 rpm\", to = \"4000 rpm\", count = 7 } }"),
    key("sweep.keep", Choice(&["summary", "all"], &[]), Default("summary"), SWEEP, "What each case leaves in cases/NNNN: its summary.json, or all of its results (report.html alone takes 5 MB a case).", "\"summary\""),
];
