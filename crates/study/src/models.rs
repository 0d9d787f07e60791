//! Every physical model the program can use, with where it comes from.
//!
//! Results name the models of their run, so that a reader can judge a number without the study
//! file. A DOI stands here only where it is known for certain.

use serde::Serialize;
use sommerfeld_film::{Bearing, Cavitation, ContactLaw, Elasticity, FilmShear, Finish, Inlet};
use sommerfeld_oil::{CompressionLaw, Lubricant, PressureLaw, ShearThinning, ViscosityLaw};

/// One model: what it is and where it is published.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Model {
    /// What it models, for example `cavitation`: the key of the study file where there is one.
    pub family: &'static str,
    /// Its name within the family, as in the study file.
    pub name: &'static str,
    /// What it is, in one line.
    pub description: &'static str,
    /// Author, year, title, where published; empty for a definition that needs no source.
    pub reference: &'static str,
    /// Digital object identifier without the resolver's address.
    pub doi: Option<&'static str>,
}

/// Every model, in the order of reports: film, cavitation, inlet, shear, oil, surfaces, shell, heat.
pub const MODELS: &[Model] = &[
    Model {
        family: "film",
        name: "field",
        description: "Reynolds equation of the thin film, solved on a grid over angle and width",
        reference: "Reynolds, O. (1886): On the theory of lubrication and its application to \
                    Mr. Beauchamp Tower's experiments. Phil. Trans. R. Soc. 177, 157-234",
        doi: Some("10.1098/rstl.1886.0005"),
    },
    Model {
        family: "film",
        name: "online",
        description: "Reynolds equation of a plain aligned bearing in shapes across the width and \
                      nodes around that follow the line of centres",
        reference: "Reynolds, O. (1886): On the theory of lubrication and its application to \
                    Mr. Beauchamp Tower's experiments. Phil. Trans. R. Soc. 177, 157-234",
        doi: Some("10.1098/rstl.1886.0005"),
    },
    Model {
        family: "film",
        name: "database",
        description: "Films of a plain aligned bearing solved before, wedge and squeeze together, looked \
                      up by relative eccentricity and direction of the motion",
        reference: "Marsalek, O., Novotny, P., Drapal, L., Pistek, V. (2012): Improvements in \
                    computational modelling of slide bearings, for the idea of the database",
        doi: Some("10.2478/v10138-012-0015-7"),
    },
    Model {
        family: "film",
        name: "superposition",
        description: "Films of wedge and squeeze solved and cut apart, stored, looked up and added",
        reference: "Marsalek, O., Novotny, P., Drapal, L., Pistek, V. (2012): Improvements in \
                    computational modelling of slide bearings",
        doi: Some("10.2478/v10138-012-0015-7"),
    },
    Model {
        family: "film",
        name: "short-bearing",
        description: "Reynolds equation without circumferential pressure flow: narrow bearings",
        reference: "Ocvirk, F. W. (1952): Short-bearing approximation for full journal bearings. \
                    NACA Technical Note 2808",
        doi: None,
    },
    Model {
        family: "film",
        name: "mobility",
        description: "Short-bearing mobility: journal velocity from load, fitted closed form",
        reference: "Booker, J. F. (1965): Dynamically loaded journal bearings: mobility method \
                    of solution. J. Basic Eng. 87, 537-546",
        doi: Some("10.1115/1.3650602"),
    },
    Model {
        family: "film",
        name: "long-bearing",
        description: "Reynolds equation without axial flow: infinitely wide bearings",
        reference: "Sommerfeld, A. (1904): Zur hydrodynamischen Theorie der \
                    Schmiermittelreibung. Z. Math. Phys. 50, 97-155",
        doi: None,
    },
    Model {
        family: "method",
        name: "vogelpohl-fdm",
        description: "Finite differences of the pressure times H^1.5 on steps that follow its gradient, \
                      coarse to fine, point iteration with negative pressures set to 0",
        reference: "Marsalek, O., Novotny, P., Drapal, L., Pistek, V. (2012): Improvements in \
                    computational modelling of slide bearings; transform of Vogelpohl, G. (1937)",
        doi: Some("10.2478/v10138-012-0015-7"),
    },
    Model {
        family: "cavitation",
        name: "gumbel",
        description: "Full film solved, pressures below cavitation pressure cut (half Sommerfeld); \
                      oil is not conserved",
        reference: "Guembel, L. (1914): Das Problem der Lagerreibung. Monatsblaetter des Berliner \
                    Bezirksvereins Deutscher Ingenieure",
        doi: None,
    },
    Model {
        family: "cavitation",
        name: "reynolds",
        description: "Pressure not below cavitation pressure with smooth rupture (Swift-Stieber); \
                      oil is not conserved at reformation",
        reference: "Swift, H. W. (1932): The stability of lubricating films in journal bearings. \
                    Min. Proc. Inst. Civ. Eng. 233, 267-288; Stieber, W. (1933): Das \
                    Schwimmlager. VDI-Verlag, Berlin",
        doi: None,
    },
    Model {
        family: "cavitation",
        name: "mass-conserving",
        description: "Jakobsson-Floberg-Olsson: film fraction transported and stored, oil conserved",
        reference: "Jakobsson, B. and Floberg, L. (1957): The finite journal bearing, considering \
                    vaporization. Trans. Chalmers Univ. Technol. 190; Olsson, K.-O. (1965): \
                    Cavitation in dynamically loaded bearings. Trans. Chalmers Univ. Technol. 308",
        doi: None,
    },
    Model {
        family: "cavitation",
        name: "film-fraction",
        description: "Film fraction as the unknown of the ruptured film",
        reference: "Elrod, H. G. (1981): A cavitation algorithm. J. Lubr. Technol. 103, 350-354",
        doi: Some("10.1115/1.3251669"),
    },
    Model {
        family: "inlet",
        name: "cyclic",
        description: "Film periodic around the full circumference",
        reference: "",
        doi: None,
    },
    Model {
        family: "inlet",
        name: "max-film-line",
        description: "Full film at feed pressure on the line of the widest gap, moving with it",
        reference: "",
        doi: None,
    },
    Model {
        family: "film_shear",
        name: "full-width",
        description: "The ruptured film shears like a full film",
        reference: "",
        doi: None,
    },
    Model {
        family: "film_shear",
        name: "film-fraction",
        description: "Shear stress of the ruptured film weighted by its film fraction",
        reference: "",
        doi: None,
    },
    Model {
        family: "viscosity",
        name: "constant",
        description: "One viscosity for the whole film",
        reference: "",
        doi: None,
    },
    Model {
        family: "viscosity",
        name: "vogel",
        description: "Dynamic viscosity over temperature, a exp(b/(T + c))",
        reference: "Vogel, H. (1921): Das Temperaturabhaengigkeitsgesetz der Viskositaet von \
                    Fluessigkeiten. Phys. Z. 22, 645-646",
        doi: None,
    },
    Model {
        family: "viscosity",
        name: "astm-d341",
        description: "Kinematic viscosity over temperature, lg lg(nu + 0.7) = A - B lg T (Walther)",
        reference: "ASTM D341: Standard practice for viscosity-temperature equations and charts \
                    for liquid petroleum or hydrocarbon products",
        doi: None,
    },
    Model {
        family: "viscosity_pressure",
        name: "barus",
        description: "Viscosity grows exponentially with pressure",
        reference: "Barus, C. (1893): Isothermals, isopiestics and isometrics relative to viscosity. American Journal of Science 45, 87-96",
        doi: None,
    },
    Model {
        family: "viscosity_pressure",
        name: "roelands",
        description: "Viscosity over pressure, growth slowing at high pressure",
        reference: "Roelands, C. J. A. (1966): Correlational aspects of the viscosity-temperature-pressure relationship of lubricating oils. TU Delft",
        doi: None,
    },
    Model {
        family: "shear_thinning",
        name: "cross",
        description: "Viscosity falls with the shear rate to a second plateau",
        reference: "Cross, M. M. (1965). Journal of Colloid Science 20, 417-437",
        doi: None,
    },
    Model {
        family: "shear_thinning",
        name: "carreau",
        description: "Viscosity falls with the shear rate to a second plateau by a power law",
        reference: "Carreau, P. J. (1972). Transactions of the Society of Rheology 16, 99-127",
        doi: None,
    },
    Model {
        family: "density_pressure",
        name: "dowson-higginson",
        description: "Density over pressure, fit to mineral oils",
        reference: "Dowson, D., Higginson, G. R. (1966): Elasto-hydrodynamic Lubrication. Pergamon",
        doi: None,
    },
    Model {
        family: "density_pressure",
        name: "limit-1.34",
        description: "Density over pressure, up to 1.34 times that at ambient pressure",
        reference: "Venner, C. H., Lubrecht, A. A. (2000): Multilevel Methods in Lubrication. Elsevier",
        doi: None,
    },
    Model {
        family: "density_pressure",
        name: "bulk-modulus",
        description: "Density over pressure with a constant bulk modulus",
        reference: "",
        doi: None,
    },
    Model {
        family: "surface",
        name: "patir-cheng",
        description: "Flow between rough surfaces by flow and shear factors",
        reference: "Patir, N., Cheng, H. S. (1978). J. Lubr. Technol. 100, 12-17; Wu, C., Zheng, L. (1989). J. Tribol. 111, 188 (contact factor)",
        doi: None,
    },
    Model {
        family: "contact",
        name: "greenwood-tripp",
        description: "Elastic contact of asperities of Gaussian height",
        reference: "Greenwood, J. A., Tripp, J. H. (1970). Proc. Instn Mech. Engrs 185, 625-633",
        doi: None,
    },
    Model {
        family: "contact",
        name: "table",
        description: "Contact pressure over the gap as given",
        reference: "",
        doi: None,
    },
    Model {
        family: "shell",
        name: "layer",
        description: "Thin elastic layer on a rigid backing: each place moves by its own pressure",
        reference: "Johnson, K. L. (1985): Contact Mechanics, ch. 5.8. Cambridge University Press",
        doi: None,
    },
    Model {
        family: "heat",
        name: "balance",
        description: "One effective temperature, at which power equals heat carried away",
        reference: "ISO 7902-1: Hydrodynamic plain journal bearings under steady-state conditions, calculation",
        doi: None,
    },
    Model {
        family: "extrapolation",
        name: "richardson",
        description: "Integrals extrapolated from the full and half the axial cells, second order",
        reference: "Richardson, L. F. (1911): The approximate arithmetical solution by finite \
                    differences. Phil. Trans. R. Soc. A 210, 307-357",
        doi: Some("10.1098/rsta.1911.0009"),
    },
    Model {
        family: "error_bar",
        name: "three-grids",
        description: "Discretisation errors from three grids: the largest of several shifts towards \
                      the limit, with a safety factor",
        reference: "Roache, P. J. (1994): Perspective: a method for uniform reporting of grid \
                    refinement studies. J. Fluids Eng. 116, 405-413",
        doi: Some("10.1115/1.2910291"),
    },
];

/// The model of this family and name.
#[must_use]
pub fn find(family: &str, name: &str) -> Option<Model> {
    MODELS
        .iter()
        .find(|model| model.family == family && model.name == name)
        .copied()
}

/// The models that a bearing chooses. On the grid: cavitation, inlet and shear of the ruptured film,
/// surfaces, shell; any other model of the film has the closure alone to choose.
#[must_use]
pub fn of_bearing(bearing: &Bearing, is_field: bool) -> Vec<Model> {
    let cavitation: &[&str] = match bearing.cavitation {
        Cavitation::Gumbel => &["gumbel"],
        Cavitation::Reynolds => &["reynolds"],
        Cavitation::MassConserving => &["mass-conserving", "film-fraction"],
    };
    let closure = cavitation.iter().map(|name| ("cavitation", *name));
    if !is_field {
        return closure
            .filter_map(|(family, name)| find(family, name))
            .collect();
    }
    let inlet = match bearing.inlet {
        Inlet::Cyclic => "cyclic",
        Inlet::MaxFilmLine { .. } => "max-film-line",
    };
    let shear = match bearing.film_shear {
        FilmShear::FullWidth => "full-width",
        FilmShear::FilmFraction => "film-fraction",
    };
    closure
        .chain([("inlet", inlet), ("film_shear", shear)])
        .chain(surface_and_shell(bearing))
        .filter_map(|(family, name)| find(family, name))
        .collect()
}

/// Family and name of what its surfaces and shell do.
fn surface_and_shell(bearing: &Bearing) -> impl Iterator<Item = (&'static str, &'static str)> {
    let (surface, contact) = match &bearing.finish {
        Finish::Smooth => (None, None),
        Finish::Rough(rough) => (
            Some(("surface", "patir-cheng")),
            match rough.contact {
                ContactLaw::None => None,
                ContactLaw::GreenwoodTripp(_) => Some(("contact", "greenwood-tripp")),
                ContactLaw::Table(_) => Some(("contact", "table")),
            },
        ),
    };
    let shell = match bearing.elasticity {
        Elasticity::Rigid => None,
        Elasticity::Layer { .. } => Some(("shell", "layer")),
    };
    [surface, contact, shell].into_iter().flatten()
}

/// The laws of an oil over temperature, and where `is_field` says that the film follows them, over
/// pressure and shear.
#[must_use]
pub fn of_oil(oil: &Lubricant, is_field: bool) -> Vec<Model> {
    let viscosity = match oil.viscosity {
        ViscosityLaw::Constant { .. } => "constant",
        ViscosityLaw::Vogel { .. } => "vogel",
        ViscosityLaw::AstmD341 { .. } => "astm-d341",
    };
    let pressure = match oil.viscosity_pressure {
        PressureLaw::None => None,
        PressureLaw::Barus { .. } => Some(("viscosity_pressure", "barus")),
        PressureLaw::Roelands { .. } => Some(("viscosity_pressure", "roelands")),
    };
    let shear = match oil.shear_thinning {
        ShearThinning::None => None,
        ShearThinning::Cross { .. } => Some(("shear_thinning", "cross")),
        ShearThinning::Carreau { .. } => Some(("shear_thinning", "carreau")),
    };
    let density = match oil.density_pressure {
        CompressionLaw::None => None,
        CompressionLaw::DowsonHigginson => Some(("density_pressure", "dowson-higginson")),
        CompressionLaw::Limit134 => Some(("density_pressure", "limit-1.34")),
        CompressionLaw::BulkModulus { .. } => Some(("density_pressure", "bulk-modulus")),
    };
    let of_field = [pressure, shear, density].into_iter().flatten();
    [("viscosity", viscosity)]
        .into_iter()
        .chain(of_field.filter(|_| is_field))
        .filter_map(|(family, name)| find(family, name))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_unique_within_a_family() {
        for (index, model) in MODELS.iter().enumerate() {
            let twin = MODELS[..index]
                .iter()
                .find(|other| other.family == model.family && other.name == model.name);
            assert!(twin.is_none(), "{} {}", model.family, model.name);
        }
    }

    #[test]
    fn dois_are_bare_identifiers() {
        for doi in MODELS.iter().filter_map(|model| model.doi) {
            assert!(doi.starts_with("10.") && doi.contains('/'), "{doi}");
        }
    }
}
