//! Studies to start from: `sommerfeld new TEMPLATE DIR` writes one of these.

use crate::input::schema::nearest_word;

/// A study to start from, with the files it names.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Template {
    /// Its name on the command line; the study is written as `<name>.toml`.
    pub name: &'static str,
    /// What it is, in one line.
    pub meaning: &'static str,
    /// The study.
    pub study: &'static str,
    /// Names and contents of the files beside it.
    pub files: &'static [(&'static str, &'static str)],
}

/// All templates.
pub const TEMPLATES: &[Template] = &[
    Template {
        name: "big-end",
        meaning: "journal orbit of a connecting-rod big end over a four-stroke cycle",
        study: include_str!("big-end.toml"),
        files: &[("loads.csv", include_str!("loads.csv"))],
    },
    Template {
        name: "main-bearing",
        meaning: "equilibrium of a grooved bearing under a constant load",
        study: include_str!("main-bearing.toml"),
        files: &[],
    },
    Template {
        name: "coefficients",
        meaning: "stiffness and damping of a rotor bearing with two axial grooves",
        study: include_str!("coefficients.toml"),
        files: &[],
    },
    Template {
        name: "lemon-bearing",
        meaning: "stability of a rotor in a lemon bearing over its speed",
        study: include_str!("lemon-bearing.toml"),
        files: &[],
    },
    Template {
        name: "clearance-sweep",
        meaning: "sweep of a steady main bearing over clearance and speed",
        study: include_str!("clearance-sweep.toml"),
        files: &[(
            "clearance-sweep-base.toml",
            include_str!("main-bearing.toml"),
        )],
    },
    Template {
        name: "one-axis-cycle",
        meaning: "journal orbit under a load along one axis, short-bearing film",
        study: include_str!("one-axis-cycle.toml"),
        files: &[("one-axis-loads.csv", include_str!("one-axis-loads.csv"))],
    },
    Template {
        name: "engine-i1",
        meaning: "every bearing of a single-cylinder engine",
        study: concat!(
            include_str!("engine-i1.toml"),
            include_str!("engine-parts.toml")
        ),
        files: &[],
    },
    Template {
        name: "engine-i3",
        meaning: "every bearing of an inline three-cylinder engine",
        study: concat!(
            include_str!("engine-i3.toml"),
            include_str!("engine-parts.toml")
        ),
        files: &[],
    },
    Template {
        name: "engine-i4",
        meaning: "every bearing of an inline four-cylinder engine",
        study: concat!(
            include_str!("engine-i4.toml"),
            include_str!("engine-parts.toml")
        ),
        files: &[],
    },
    Template {
        name: "engine-i5",
        meaning: "every bearing of an inline five-cylinder engine",
        study: concat!(
            include_str!("engine-i5.toml"),
            include_str!("engine-parts.toml")
        ),
        files: &[],
    },
    Template {
        name: "engine-i6",
        meaning: "every bearing of an inline six-cylinder engine",
        study: concat!(
            include_str!("engine-i6.toml"),
            include_str!("engine-parts.toml")
        ),
        files: &[],
    },
    Template {
        name: "engine-v6",
        meaning: "every bearing of a V6 engine of 60 deg",
        study: concat!(
            include_str!("engine-v6.toml"),
            include_str!("engine-parts.toml")
        ),
        files: &[],
    },
    Template {
        name: "engine-v8",
        meaning: "every bearing of a V8 engine of 90 deg",
        study: concat!(
            include_str!("engine-v8.toml"),
            include_str!("engine-parts.toml")
        ),
        files: &[],
    },
    Template {
        name: "engine-boxer",
        meaning: "every bearing of a boxer engine of four cylinders",
        study: concat!(
            include_str!("engine-boxer.toml"),
            include_str!("engine-parts.toml")
        ),
        files: &[],
    },
    Template {
        name: "balancer-shaft",
        meaning: "both bearings of a balancer shaft",
        study: include_str!("balancer-shaft.toml"),
        files: &[],
    },
    Template {
        name: "database",
        meaning: "films of a plain bearing, stored, and a big end that looks them up",
        study: include_str!("database.toml"),
        files: &[
            (
                "database-big-end.toml",
                include_str!("database-big-end.toml"),
            ),
            ("database-loads.csv", include_str!("loads.csv")),
        ],
    },
    Template {
        name: "film",
        meaning: "one film at a given journal position",
        study: include_str!("film.toml"),
        files: &[],
    },
    Template {
        name: "dimensionless",
        meaning: "the dimensionless Reynolds equation of a tilted journal",
        study: include_str!("dimensionless.toml"),
        files: &[],
    },
];

/// The name of a template that was most likely meant by one that is not there.
#[must_use]
pub fn nearest(name: &str) -> Option<&'static str> {
    let names: Vec<&'static str> = TEMPLATES.iter().map(|template| template.name).collect();
    nearest_word(&names, name)
}

/// The template with this name.
#[must_use]
pub fn find(name: &str) -> Option<&'static Template> {
    TEMPLATES.iter().find(|template| template.name == name)
}
