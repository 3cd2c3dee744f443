//! Hints of a program on the report page, and the names of the figures.

use lissom::identify::findings::FindingKind;
use lissom::prelude::*;
use lissom_views::{ProgramHints, report_page, result_figures};

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// A hint of a program.
const HINT: &str = "press the button Refine";

/// Logs of a rigid axis, one for each frequency \[rad/s\].
fn logs(omega_rad_s: &[f64]) -> Result<Campaign, Box<dyn std::error::Error>> {
    let motor = Motor::builder().inertia_kg_m2(2e-3).viscous_nm_s_per_rad(5e-3);
    let arm = Arm::builder().motor(motor).coulomb_nm(0.02).build()?;
    let rig = Rig::builder(arm).sample_time_s(2e-3).controller(Pd::new(8.0, 0.25)?).build()?;
    let runs = omega_rad_s.iter().map(|omega| Experiment::sine(*omega, 0.5, 20.0));
    let logs = rig.campaign(runs)?;
    Ok(AsRef::<Campaign>::as_ref(&logs).clone())
}

#[test]
fn a_page_has_the_hints_of_its_program_and_no_others() -> Outcome {
    let campaign = logs(&[3.0])?;
    let found = Identify::new(&campaign).effort(Effort::Quick).run()?;
    let page = |hints| {
        report_page::page("axis", &campaign, found.identified(), None, None, None, hints).to_html()
    };
    assert!(!found.findings().is_empty());
    let of_finding = |_: &FindingKind| Some(HINT);
    let with = page(ProgramHints { of_finding, ..ProgramHints::NONE });
    let all = with.split("<h2 id=\"findings\">").nth(1).ok_or("no findings")?;
    assert_eq!(all.matches(HINT).count(), found.findings().len());
    let without = page(ProgramHints::NONE);
    for named in ["lissom identify", "lissom equivalent", "--quick", "--window"] {
        assert!(!without.contains(named), "{named}");
    }
    Ok(())
}

#[test]
fn figures_have_the_names_of_their_files() -> Outcome {
    let campaign = logs(&[1.0, 3.0])?;
    let found = Identify::new(&campaign).effort(Effort::Quick).run()?;
    let figures = result_figures(&campaign.channels, found.identified(), None);
    let names: Vec<&str> = figures.iter().map(|figure| figure.name.as_str()).collect();
    assert_eq!(names, ["bode-motor", "friction-curve"]);
    for figure in figures {
        assert!(figure.figure.to_svg()?.starts_with("<svg"), "{}", figure.name);
    }
    Ok(())
}
