//! The report page: hints of a program, stored results, and the names of the figures.

use lissom::identify::LogPrediction;
use lissom::prelude::*;
use lissom_io::ResultFile;
use lissom_views::report_page::{self, PageContent};
use lissom_views::{ProgramHints, own_logs, result_figures};

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
    let result = &found.file();
    let page = |hints| {
        let content = PageContent { result, logs: None, reference: None, hints: &hints };
        report_page::page("axis", content).to_html()
    };
    assert!(!found.findings().is_empty());
    let of_findings = vec![Some(HINT); found.findings().len()];
    let with = page(ProgramHints { of_findings, ..ProgramHints::NONE });
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
    let figures = result_figures(&found.file(), None);
    let names: Vec<&str> = figures.iter().map(|figure| figure.name.as_str()).collect();
    assert_eq!(names, ["bode-motor", "friction-curve"]);
    for figure in figures {
        assert!(figure.figure.to_svg()?.starts_with("<svg"), "{}", figure.name);
    }
    Ok(())
}

#[test]
fn the_page_of_a_stored_result_is_that_of_the_identification() -> Outcome {
    let campaign = logs(&[1.0, 3.0])?;
    let found = Identify::new(&campaign).effort(Effort::Quick).run()?;
    let own = own_logs(&campaign, found.arm()).ok_or("no arm")?;
    let stored = ResultFile::of_text("result.json", &serde_json::to_string(&found)?)?;
    let page = |result: &ResultFile, logs: Option<(&Campaign, &LogPrediction)>| {
        let content = PageContent { result, logs, reference: None, hints: &ProgramHints::NONE };
        report_page::page("axis", content).to_html()
    };
    let logs_of_result = Some((&campaign, &own));
    let whole = page(&stored, logs_of_result);
    assert_eq!(whole, page(&found.file(), logs_of_result));
    for (heading, alone) in [
        ("Parameters", true),
        ("Frequency responses", true),
        ("Harmonics", true),
        ("Measured and predicted motion", false),
        ("Residuals", false),
    ] {
        let heading = format!("{heading}</h2>");
        assert!(whole.contains(&heading), "{heading}");
        assert_eq!(page(&stored, None).contains(&heading), alone, "{heading}");
    }
    assert!(!whole.contains("The result is not from these runs"));
    let others = logs(&[2.0, 3.0, 4.0])?;
    let predicted = own_logs(&others, found.arm()).ok_or("no arm")?;
    assert!(
        page(&stored, Some((&others, &predicted))).contains("The result is not from these runs")
    );
    Ok(())
}
