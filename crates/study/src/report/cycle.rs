//! The report of a load cycle: key figures, orbit, curves over crank angle, maps, convergence.

use super::chart::{Chart, Mark, Series};
use super::detail::Detail;
use super::film::{self, in_film};
use super::format::{MICROMETRE, Unit, Units, angle, significant};
use super::page::{
    Card, Figure, FilmPart, Page, Section, Table, badge, checks, error, exact, outer_circle,
    subject,
};
use super::spark::spark;
use super::steady::further_cards;
use super::{compare_models, contact, cycle_tables, figures, heat, surfaces, wear};
use crate::limits::Quantity;
use crate::results::{CycleResults, Header, degrees, magnitude, place, specific_load};
use serde_json::{Value, json};
use sommerfeld_bearing::CyclePoint;
use sommerfeld_film::Extreme;

/// What a page shows of one cycle.
pub(super) struct CyclePart {
    /// Key figures.
    pub cards: Vec<Card>,
    /// Tables in the order of the page.
    pub tables: Vec<Table>,
    /// The film through the cycle, if the film model has fields.
    pub film: Option<FilmPart>,
    /// Figures by the question they answer.
    pub sections: Vec<Section>,
    /// Where an oil hole in the journal would be loaded least, in words; empty without fields.
    pub hole: String,
    /// Data of the figures.
    pub data: Value,
}

/// Fills cards, figures and tables; returns the data of the figures.
pub(super) fn fill(page: &mut Page, header: &Header, cycle: &CycleResults) -> Value {
    let part = part(
        header,
        cycle,
        &units(std::iter::once(cycle)),
        &Detail::ALONE,
    );
    page.subject = subject(&cycle.bearing);
    page.cards = part.cards;
    page.tables = part.tables;
    page.film = part.film;
    page.sections = part.sections;
    part.data
}

/// One cycle in the units of its page and as finely as the page has room for.
pub(super) fn part(
    header: &Header,
    cycle: &CycleResults,
    units: &Units,
    detail: &Detail,
) -> CyclePart {
    let mut cards = cards(header, cycle, units);
    let of_contact = contact::cycle_cards(header, cycle, units);
    cards.extend(further_cards(heat::cards(header), of_contact));
    let mut part = CyclePart {
        cards,
        tables: cycle_tables::all(header, cycle, units),
        film: None,
        sections: Vec::new(),
        hole: String::new(),
        data: json!({}),
    };
    if cycle.orbit.points.is_empty() {
        return part;
    }
    let fields = cycle.fields.as_ref();
    let instants = fields.map_or_else(Vec::new, |fields| film::instants(cycle, fields, detail));
    part.film = instants
        .first()
        .map(|_| film::part(&cycle.bearing, &instants, detail));
    part.sections = vec![load_and_orbit(cycle), over_the_cycle(cycle)];
    part.sections.extend(compare_models::section(header));
    part.sections.extend(contact::section(cycle));
    part.sections.extend(wear::section(cycle));
    if let Some(fields) = fields {
        part.hole = surfaces::hole_sentence(&cycle.bearing, &fields.on_journal, units);
        // Where speeds share the places of the figures, the sentence stands with each speed.
        let caption = if detail.is_packed {
            "Dashed circle: where an oil hole in the journal would be loaded least."
        } else {
            &part.hole
        };
        part.sections.push(Section {
            id: "surfaces",
            title: "What the surfaces have seen",
            lead:
                "Every point of shell and journal over the whole cycle: pressure tires it, a thin \
               film wears it. The journal turns under the load, so that its maps differ from those \
               of the shell."
                    .to_owned(),
            figures: surfaces::figures(caption, fields.on_shell.wear.is_some(), detail),
        });
    }
    part.data = json!({
        "units": figures::unit_symbols(units),
        "cycle": figures::cycle_data(header, cycle, units, detail),
        "charts": charts(header, cycle, units, detail),
        "film": film::film_data(&cycle.bearing, &instants, units, detail),
        "surfaces": fields
            .map(|fields| {
                let ran = cycle.running_in.as_ref();
                let worn = ran.map(|ran| ran.depth.as_slice());
                let worn = worn.filter(|worn| worn.len() == fields.on_shell.maximum_pressure.len());
                surfaces::surface_data(&cycle.bearing, fields, worn, (units, detail))
            }),
    });
    part
}

/// Units that suit the largest numbers of all cycles of a page.
pub(super) fn units<'a>(cycles: impl Iterator<Item = &'a CycleResults> + Clone) -> Units {
    let largest = |value: &dyn Fn(&CyclePoint) -> f64| {
        let points = cycles.clone().flat_map(|cycle| &cycle.orbit.points);
        points
            .map(|point| value(point).abs())
            .filter(|value| value.is_finite())
            .fold(f64::NAN, f64::max)
    };
    Units::choose(
        largest(&|p| magnitude(p.load)),
        largest(&|p| p.summary.peak_film_pressure.value),
        largest(&|p| p.summary.power_loss()),
        largest(&side_flow),
        largest(&|p| p.reaction.friction_torque_journal),
    )
}

/// What leaves at both ends, m3/s.
pub(super) fn side_flow(point: &CyclePoint) -> f64 {
    point.summary.side_flow[0] + point.summary.side_flow[1]
}

/// What a card shows of the points of a cycle.
struct CardSource<'a> {
    label: &'static str,
    key: &'static str,
    value: &'a dyn Fn(&CyclePoint) -> f64,
    unit: Unit,
    limited: Option<Quantity>,
}

impl CardSource<'_> {
    /// The card without its number.
    fn card(&self, header: &Header, cycle: &CycleResults, at: Option<f64>) -> Card {
        let points = &cycle.orbit.points;
        let places: Vec<f64> = points.iter().map(|point| point.crank_angle).collect();
        let values: Vec<f64> = points.iter().map(self.value).collect();
        let limit = header
            .limits
            .iter()
            .find(|check| Some(check.limit.quantity) == self.limited)
            .map(|check| check.limit.value);
        Card {
            label: self.label,
            key: self.key,
            unit: self.unit.symbol,
            error: error(header, self.key, self.unit),
            checks: self
                .limited
                .map_or_else(Vec::new, |quantity| checks(header, quantity, self.unit)),
            spark: spark(&places, &values, at, limit),
            ..Card::default()
        }
    }

    /// A card for the value of one point: its badge is the point's own failure before the run's.
    fn of_point(
        &self,
        header: &Header,
        cycle: &CycleResults,
        point: Option<&CyclePoint>,
        place: impl Fn(&CyclePoint) -> String,
    ) -> Card {
        let value = point.map_or(f64::NAN, self.value);
        Card {
            value: self.unit.number(value),
            exact: exact(value),
            detail: point.map_or_else(String::new, |point| {
                let crank = angle(degrees(point.crank_angle));
                format!("crank angle {crank}{}", place(point))
            }),
            badge: point
                .and_then(|point| badge(point.outcome))
                .or(badge(header.status)),
            ..self.card(header, cycle, point.map(|point| point.crank_angle))
        }
    }

    /// A card for the mean over the cycle.
    fn of_mean(&self, header: &Header, cycle: &CycleResults, detail: String) -> Card {
        let value = cycle.mean(self.value);
        Card {
            value: self.unit.number(value),
            exact: exact(value),
            detail,
            badge: badge(header.status),
            ..self.card(header, cycle, None)
        }
    }
}

fn cards(header: &Header, cycle: &CycleResults, units: &Units) -> Vec<Card> {
    let source = |label, key, value, unit, limited| CardSource {
        label,
        key,
        value,
        unit,
        limited,
    };
    let bearing = &cycle.bearing;
    let at = |extreme: &Extreme| format!(", {}", in_film(extreme, bearing.width));
    let parts = format!(
        "friction {}, squeeze {}",
        units.power.show(cycle.mean(|p| p.summary.friction_power)),
        units.power.show(cycle.mean(|p| p.summary.squeeze_power))
    );
    let ends = [0, 1].map(|end| units.flow.number(cycle.mean(|p| p.summary.side_flow[end])));
    let side = cycle.mean(side_flow);
    let feed = cycle.mean(|p| p.summary.feed_flow);
    vec![
        source(
            "Minimum film thickness",
            "minimum_film_thickness_m",
            &|p: &CyclePoint| p.summary.minimum_film_thickness.value,
            MICROMETRE,
            Some(Quantity::MinimumFilmThickness),
        )
        .of_point(header, cycle, cycle.minimum_film_thickness(), |p| {
            at(&p.summary.minimum_film_thickness)
        }),
        source(
            "Peak film pressure",
            "peak_film_pressure_pa",
            &|p: &CyclePoint| p.summary.peak_film_pressure.value,
            units.pressure,
            Some(Quantity::PeakFilmPressure),
        )
        .of_point(header, cycle, cycle.peak_film_pressure(), |p| {
            at(&p.summary.peak_film_pressure)
        }),
        source(
            "Maximum specific load F/(B D)",
            "maximum_specific_load_pa",
            &|p: &CyclePoint| specific_load(bearing, p.load),
            units.pressure,
            Some(Quantity::MaximumSpecificLoad),
        )
        .of_point(header, cycle, cycle.maximum_load(), |p| {
            format!(", load {}", units.force.show(magnitude(p.load)))
        }),
        source(
            "Mean power loss",
            "mean_power_loss_w",
            &|p: &CyclePoint| p.summary.power_loss(),
            units.power,
            Some(Quantity::PowerLoss),
        )
        .of_mean(header, cycle, parts),
        source(
            "Mean side flow",
            "mean_side_flow_m3_s",
            &side_flow,
            units.flow,
            None,
        )
        .of_mean(
            header,
            cycle,
            format!("{}; front {}, rear {}", per_minute(side), ends[0], ends[1]),
        ),
        source(
            "Mean feed flow",
            "mean_feed_flow_m3_s",
            &|p: &CyclePoint| p.summary.feed_flow,
            units.flow,
            None,
        )
        .of_mean(header, cycle, per_minute(feed)),
    ]
}

fn per_minute(flow: f64) -> String {
    format!("{} l/min", significant(flow * 6e4))
}

fn failed_note(cycle: &CycleResults) -> &'static str {
    if cycle.not_converged().next().is_some() {
        " Crosses: steps that did not converge."
    } else {
        ""
    }
}

fn figure(kind: &'static str, title: &'static str, caption: impl Into<String>) -> Figure {
    Figure {
        kind,
        title,
        caption: caption.into(),
        size: "",
    }
}

fn load_and_orbit(cycle: &CycleResults) -> Section {
    let failed = failed_note(cycle);
    Section {
        id: "orbit",
        title: "Load and journal orbit",
        lead:
            "+X to the right, +Y up; angles count from +X in the sense of rotation. Rings: crank \
               angles, named; dots every 10°, wide apart where things change fast."
                .to_owned(),
        figures: vec![
            figure(
                "load-polar",
                "Load in the shell frame",
                "Tip of the load vector on the journal, as the shell sees it. Colour: journal \
                 speed relative to the shell.",
            ),
            figure(
                "load-polar-journal",
                "Load in the journal frame",
                "The same vector turned back by the journal angle: where the load presses the \
                 journal. The side it never reaches is the side for an oil hole.",
            ),
            figure(
                "orbit",
                "Journal orbit",
                format!(
                    "Path of the journal centre over the radial clearance. {}{failed}",
                    outer_circle(&cycle.bearing)
                ),
            ),
            Figure {
                size: "stack",
                ..figure(
                    "eccentricity",
                    "Relative eccentricity",
                    format!(
                        "Distance of the centres in the mid-plane over the radial clearance; 1 \
                         is contact of an untilted journal.{failed}"
                    ),
                )
            },
        ],
    }
}

fn over_the_cycle(cycle: &CycleResults) -> Section {
    let failed = failed_note(cycle);
    let mut figures = vec![
        figure(
            "thickness",
            "Minimum film thickness",
            format!("Thinnest film anywhere in the bearing at each crank angle.{failed}"),
        ),
        figure(
            "pressure",
            "Peak film pressure",
            "Highest film pressure (gauge) anywhere in the bearing at each crank angle.",
        ),
        figure(
            "place-around",
            "Where around the shell",
            "Angles of the thinnest film and of the peak pressure. Where the journal turns in its \
             place the peak lies upstream of the thinnest film; where it moves across the clearance \
             both lie ahead of it.",
        ),
    ];
    if moves_along(cycle) {
        figures.push(figure(
            "place-along",
            "Where along the axis",
            "Axial places of the thinnest film and of the peak pressure from the mid-plane: \
             front is negative, rear positive. The edges are where a tilted journal runs thin.",
        ));
    }
    figures.extend([
        figure(
            "power",
            "Power loss",
            "Power lost in the film: friction of the turning surfaces and squeeze of the moving \
             journal. A negative squeeze is work that the film gives back.",
        ),
        figure(
            "flow",
            "Oil flow",
            "Oil that leaves at the front (z = −B/2) and at the rear (z = +B/2), that enters \
             through feeds, and that the film stores. Feed = side + storage where the closure \
             conserves oil.",
        ),
    ]);
    if has_feed_flows(cycle) {
        figures.push(figure(
            "feed-flows",
            "Flow of each groove and hole",
            "Into the film; negative where the film pushes oil back.",
        ));
    }
    figures.push(figure(
        "load",
        "Load",
        "Components of the load on the journal in the shell frame, and its magnitude.",
    ));
    if is_tilted(cycle) {
        figures.push(figure(
            "tilt",
            "Tilt",
            "Rotation vector of the journal axis against the shell axis.",
        ));
    }
    // A figure alone in its row takes the whole of it.
    if figures.len() % 2 == 1
        && let Some(last) = figures.last_mut()
    {
        last.size = "wide";
    }
    Section {
        id: "cycle",
        title: "Over the cycle",
        lead: String::new(),
        figures,
    }
}

fn is_tilted(cycle: &CycleResults) -> bool {
    let mut points = cycle.orbit.points.iter();
    points.any(|point| point.state.tilt != [0.0, 0.0])
}

/// Whether the extremes leave the mid-plane.
fn moves_along(cycle: &CycleResults) -> bool {
    cycle.orbit.points.iter().any(|point| {
        let summary = &point.summary;
        [
            summary.minimum_film_thickness.axial,
            summary.peak_film_pressure.axial,
        ]
        .iter()
        .any(|axial| axial.abs() > 1e-6 * cycle.bearing.width)
    })
}

fn has_feed_flows(cycle: &CycleResults) -> bool {
    !cycle.bearing.feeds.is_empty() && cycle.feed_flows.len() == cycle.orbit.points.len()
}

/// Figures that need no drawing of their own, by their kind.
fn charts(header: &Header, cycle: &CycleResults, units: &Units, detail: &Detail) -> Value {
    let points = &cycle.orbit.points;
    let kept = figures::thinned(points.len(), detail.curve_points);
    let over = |value: &dyn Fn(usize) -> f64| kept.iter().map(|&i| value(i)).collect::<Vec<_>>();
    let series = |name: String, mark, value: &dyn Fn(usize) -> f64| Series {
        name,
        x: None,
        y: over(value),
        mark,
    };
    let chart = |y_title: &str, y_range, series| {
        Chart {
            x_title: "Crank angle [°]".to_owned(),
            y_title: y_title.to_owned(),
            y_range,
            series,
        }
        .data(detail)
    };
    let dots =
        |name: &str, value: &dyn Fn(usize) -> f64| series(name.to_owned(), Mark::Dots, value);
    let thinnest = |i: usize| &points[i].summary.minimum_film_thickness;
    let highest = |i: usize| &points[i].summary.peak_film_pressure;
    let edge = 500.0 * cycle.bearing.width;
    let mut charts = json!({
        "place-around": chart("Bearing angle [°]", Some([0.0, 360.0]), vec![
            dots("thinnest film", &|i| place(thinnest(i)).0),
            dots("peak pressure", &|i| place(highest(i)).0),
        ]),
    });
    if moves_along(cycle) {
        charts["place-along"] = chart(
            "Axial position [mm]",
            Some([-edge, edge]),
            vec![
                dots("thinnest film", &|i| place(thinnest(i)).1),
                dots("peak pressure", &|i| place(highest(i)).1),
            ],
        );
    }
    if has_feed_flows(cycle) {
        let flows = (0..cycle.bearing.feeds.len()).map(|feed| {
            let name = cycle_tables::feed_name(&cycle.bearing.feeds[feed], feed);
            series(name, Mark::Line, &|i| {
                let flow = cycle.feed_flows[i].get(feed);
                flow.map_or(f64::NAN, |feed| feed.flow * units.flow.factor)
            })
        });
        let title = format!("Flow [{}]", units.flow.symbol);
        charts["feed-flows"] = chart(&title, None, flows.collect());
    }
    contact::charts(cycle, units, detail, &mut charts);
    compare_models::charts(header, cycle, units, detail, &mut charts);
    wear::charts(cycle, detail, &mut charts);
    charts
}
