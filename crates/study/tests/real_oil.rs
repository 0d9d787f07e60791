//! Oils, surfaces, elastic layers and heat as study files give them, and the balance of heat.
#![allow(clippy::unwrap_used, clippy::panic, missing_docs)]

use sommerfeld_film::{ContactLaw, Elasticity, Finish};
use sommerfeld_oil::{CompressionLaw, DensityLaw, PressureLaw, ShearThinning};
use sommerfeld_study::input::{HeatPlan, Study, study_from_text};
use sommerfeld_study::output::summary;
use sommerfeld_study::run::solve;
use sommerfeld_study::templates;
use std::fs;
use std::ops::ControlFlow;
use std::path::Path;

const BEARING: &str = "schema = 1\nanalysis = \"equilibrium\"\n\
    [bearing]\ndiameter = \"72 mm\"\nwidth = \"30 mm\"\ndiametral_clearance = \"72 um\"\n\
    [operation]\nspeed = \"2000 rpm\"\nload = [\"10 kN\", \"0 N\"]\n\
    [film]\ncavitation = \"reynolds\"\ngrid = [48, 12]\n";

fn study(sections: &str) -> Study {
    let text = format!("{BEARING}{sections}");
    study_from_text("study.toml", &text, Path::new("")).unwrap_or_else(|errors| panic!("{errors}"))
}

fn near(a: f64, b: f64, tolerance: f64) {
    assert!((a / b - 1.0).abs() <= tolerance, "{a} {b}");
}

#[test]
fn laws_of_an_oil_in_si() {
    let study = study(
        "[oil]\nviscosity = { law = \"astm-d341\", kv40 = \"65 mm2/s\", kv100 = \"11 mm2/s\" }\n\
         viscosity_pressure = { law = \"roelands\", alpha = \"9.5 1/GPa\" }\n\
         shear_thinning = { law = \"cross\", hths = \"3.2 mPa.s\" }\ngrade = \"5W-30\"\n\
         density = { value = \"850 kg/m3\", temperature = \"15 degC\", expansion = \"7e-4 1/K\", \
         pressure = \"bulk-modulus\", bulk_modulus = \"1.6 GPa\" }\n\
         heat_capacity = \"2 kJ/(kg K)\"\n",
    );
    let oil = &study.bearing_case().unwrap().lubricant;
    assert!(
        matches!(oil.viscosity_pressure, PressureLaw::Roelands { alpha, .. } if (alpha / 9.5e-9 - 1.0).abs() < 1e-12)
    );
    let hths = oil.viscosity_at_shear(423.15, 0.0, 1e6).value;
    near(hths, 3.2e-3, 1e-9);
    assert_eq!(
        oil.density,
        DensityLaw::ThermalExpansion {
            density: 850.0,
            temperature: 288.15,
            expansion: 7e-4
        }
    );
    assert_eq!(
        oil.density_pressure,
        CompressionLaw::BulkModulus {
            bulk_modulus: 1.6e9
        }
    );
    near(oil.heat_capacity.at(373.15).value, 2000.0, 1e-12);
}

#[test]
fn an_oil_of_the_library_with_a_law_in_place_of_its_own() {
    let named = study("[oil]\noil = \"sander-rig\"\n");
    let oil = &named.bearing_case().unwrap().lubricant;
    assert!(matches!(oil.viscosity_pressure, PressureLaw::Barus { .. }));
    assert!(named.warnings.is_empty());
    let own = study(
        "[oil]\noil = \"sander-rig\"\nviscosity_pressure = { law = \"none\" }\ntemperature = \"90 degC\"\n",
    );
    let oil = &own.bearing_case().unwrap().lubricant;
    assert_eq!(oil.viscosity_pressure, PressureLaw::None);
    assert_eq!(oil.shear_thinning, ShearThinning::None);
    near(oil.density(363.15, 0.0).value, 832.5, 1e-12);
    assert!(
        own.warnings[0]
            .message
            .contains("outside the data of the oil sander-rig")
    );
}

#[test]
fn surfaces_and_layer_in_si() {
    let study = study(
        "[oil]\nviscosity = \"8 mPa.s\"\n[bearing.surface]\nroughness_journal = \"0.28 um\"\n\
         roughness_shell = \"0.13 um\"\npeklenik_shell = 4\nboundary_friction = 0.02\n\
         contact = { law = \"greenwood-tripp\", factor = 1e-3, asperity_product = 0.05, \
         modulus = \"53.3 GPa\" }\n[bearing.shell]\nelastic = \"layer\"\nthickness = \"2 mm\"\n\
         modulus = \"29 GPa\"\npoisson = 0.33\n",
    );
    let bearing = &study.bearing_case().unwrap().bearing;
    let Finish::Rough(rough) = &bearing.finish else {
        panic!()
    };
    near(rough.roughness.journal, 0.28e-6, 1e-12);
    near(rough.roughness.peklenik_shell, 4.0, 1e-12);
    assert!(
        matches!(&rough.contact, ContactLaw::GreenwoodTripp(law) if (law.modulus / 53.3e9 - 1.0).abs() < 1e-12
            && law.summit_height == 0.0 && law.summit_roughness.is_none())
    );
    assert!(matches!(bearing.elasticity, Elasticity::Layer { poisson, .. } if poisson == 0.33));
    let smooth = self::study("[oil]\nviscosity = \"8 mPa.s\"\n[bearing.surface]\n");
    let case = smooth.bearing_case().unwrap();
    assert_eq!(case.bearing.finish, Finish::Smooth);
    assert_eq!(case.heat, HeatPlan::Given);
}

/// Asperities touch from further away by as much as their summits stand above the mean planes.
#[test]
fn summits_above_the_mean_planes() {
    let with = |more: &str| {
        let study = study(&format!(
            "[oil]\nviscosity = \"8 mPa.s\"\n[bearing.surface]\nroughness_journal = \"0.2 um\"\n\
             roughness_shell = \"0.34 um\"\nboundary_friction = 0.02\n[bearing.surface.contact]\n\
             law = \"greenwood-tripp\"\nfactor = 1e-3\nasperity_product = 0.05\nmodulus = \"53.3 GPa\"\n{more}"
        ));
        study.bearing_case().unwrap().bearing.finish.clone()
    };
    let planes = with("");
    let high = with("summit_height = \"0.6 um\"\n");
    let touch = |finish: &Finish, gap: f64| finish.contact_pressure(gap).value;
    near(touch(&high, 0.9e-6) / touch(&planes, 0.3e-6), 1.0, 1e-9);
    let Finish::Rough(rough) = with("summit_roughness = \"0.3087 um\"\n") else {
        panic!()
    };
    assert!(
        matches!(&rough.contact, ContactLaw::GreenwoodTripp(law) if law.summit_roughness.is_some_and(|s| (s / 0.3087e-6 - 1.0).abs() < 1e-12))
    );
}

/// P = rho c Q (T_out - T_in) + k (T - T_s), T the mean of inlet and outlet, and the clearance is the
/// one at T.
#[test]
fn heat_of_an_equilibrium_is_balanced() {
    let study = study(
        "[oil]\noil = \"nominal-5w-30\"\nheat_capacity = \"2000 J/(kg.K)\"\n\
         [heat]\nmodel = \"balance\"\nsupply_temperature = \"70 degC\"\nconductance = \"4 W/K\"\n\
         surroundings_temperature = \"20 degC\"\n[heat.expansion]\njournal = \"11.5e-6 1/K\"\n\
         housing = \"23e-6 1/K\"\n",
    );
    let results = solve(&study, &mut |_| ControlFlow::Continue(())).unwrap();
    let summary = summary(&results);
    let number = |key: &str| summary[key].as_f64().unwrap_or_else(|| panic!("{key}"));
    assert_eq!(summary["status"], "converged");
    let (effective, outlet) = (
        number("effective_temperature_degc"),
        number("outlet_temperature_degc"),
    );
    near(effective, 0.5 * (70.0 + outlet), 1e-6);
    let carried = 850.0 * 2000.0 * number("side_flow_m3_s") * (outlet - 70.0);
    let conducted = 4.0 * (effective - 20.0);
    near(number("power_loss_w"), carried + conducted, 1e-5);
    let growth = (23e-6 * 72e-3 - 11.5e-6 * (72e-3 - 72e-6)) * (effective - 20.0);
    near(number("warm_diametral_clearance_m"), 72e-6 + growth, 1e-9);
}

/// Rough surfaces under a load that smooth ones carry at a thinner film: asperities carry a part, and
/// the power falls into two parts.
#[test]
fn contact_has_its_own_figures() {
    let study = study(
        "[oil]\nviscosity = \"2 mPa.s\"\n[bearing.surface]\nroughness_journal = \"1 um\"\n\
         roughness_shell = \"1 um\"\nboundary_friction = 0.1\ncontact = { law = \"greenwood-tripp\", \
         factor = 1e-3, asperity_product = 0.05, modulus = \"53.3 GPa\" }\n",
    );
    let results = solve(&study, &mut |_| ControlFlow::Continue(())).unwrap();
    let summary = summary(&results);
    let number = |key: &str| summary[key].as_f64().unwrap_or_else(|| panic!("{key}"));
    assert_eq!(summary["status"], "converged");
    let share = number("contact_load_share");
    assert!(share > 1e-3 && share < 1.2, "{share}");
    assert!(number("peak_contact_pressure_pa") > 1e4);
    assert!(number("boundary_power_w") > 0.0 && number("viscous_power_w") > 0.0);
    let both = number("boundary_power_w") + number("viscous_power_w");
    near(both, number("power_loss_w"), 1e-12);
}

/// The means over the cycle are balanced to 0.05 K: of a rise of several K that is a per cent.
#[test]
fn heat_of_a_load_cycle_is_balanced() {
    let directory = tempfile::tempdir().unwrap();
    let template = templates::find("one-axis-cycle").unwrap();
    for (name, content) in template.files {
        fs::write(directory.path().join(name), content).unwrap();
    }
    let oil = template.study.find("[oil]").unwrap();
    let end = oil + template.study[oil..].find("\n\n").unwrap();
    let text = format!(
        "{}[oil]\noil = \"nominal-15w-40\"\nheat_capacity = \"2000 J/(kg.K)\"\n{}\n[heat]\n\
         model = \"balance\"\nsupply_temperature = \"70 degC\"\n",
        &template.study[..oil],
        &template.study[end..]
    );
    let study = study_from_text("study.toml", &text, directory.path())
        .unwrap_or_else(|errors| panic!("{errors}"));
    let results = solve(&study, &mut |_| ControlFlow::Continue(())).unwrap();
    let summary = summary(&results);
    let number = |key: &str| summary[key].as_f64().unwrap_or_else(|| panic!("{key}"));
    assert_eq!(summary["status"], "converged", "{}", summary["messages"]);
    let rise = number("outlet_temperature_degc") - 70.0;
    near(
        number("effective_temperature_degc"),
        70.0 + 0.5 * rise,
        1e-9,
    );
    let carried = 850.0 * 2000.0 * number("mean_side_flow_m3_s") * rise;
    let power = number("mean_power_loss_w");
    assert!(
        (power / carried - 1.0).abs() < 0.2 / rise,
        "{power} {carried} {rise}"
    );
}
