//! Comparison of the identified arm with an arm.toml, in words and as a section of the page: which number of
//! the file explains the difference best.

use lissom_io::result::{ArmQuantityName, ExplanationEntry, GeometryEntry};
use lissom_report::{Cells, Page, Table, interval, with_uncertainty};

/// Adds the comparison to the HTML page.
pub(crate) fn section(page: Page, check: Option<&GeometryEntry>) -> Page {
    let Some(check) = check else { return page };
    let mut page = page.heading("Comparison with arm.toml");
    for line in lines(check) {
        page = page.paragraph(&sentence(&line));
    }
    if check.agrees || check.explanations.is_empty() {
        return page;
    }
    let mut table = Table::new(
        "Changing one number of arm.toml at a time",
        &[
            ("number", Cells::Text),
            ("times the value in the file", Cells::Numbers),
            ("95 % interval", Cells::Numbers),
            ("remaining difference (rms)", Cells::Numbers),
        ],
    );
    for e in &check.explanations {
        let f = &e.factor;
        table = table.row([
            name(e),
            with_uncertainty(f.value, f.std),
            interval(f.ci95, f.value, f.std),
            percent(e.left_rms),
        ]);
    }
    page.table(&table)
}

/// The line with a capital letter and a full stop.
fn sentence(line: &str) -> String {
    let mut letters = line.chars();
    let first = letters.next().map(|c| c.to_uppercase().to_string()).unwrap_or_default();
    format!("{first}{}.", letters.as_str())
}

/// The comparison in words, without a capital letter and a full stop.
pub fn lines(check: &GeometryEntry) -> Vec<String> {
    let before = percent(check.difference_rms);
    let compared = "inertia, frequencies and couplings";
    if check.agrees {
        return vec![format!("arm.toml agrees with the logs: {compared} within {before} (rms)")];
    }
    let mut text = vec![format!("{compared} differ from arm.toml by {before} (rms)")];
    let Some(best) = check.explanations.first() else { return text };
    if best.left_rms > 0.5 * check.difference_rms {
        text.push(format!(
            "no single number of arm.toml explains this: if {} is {}, the difference is still {}",
            name(best),
            factor(best),
            percent(best.left_rms)
        ));
        return text;
    }
    let good = check.explanations.iter().enumerate().filter(|(i, e)| *i == 0 || e.as_good_as_first);
    for (i, explanation) in good {
        text.push(format!(
            "{} {} is {}; the difference is then {}",
            if i == 0 { "best explanation:" } else { "equally good:" },
            name(explanation),
            factor(explanation),
            percent(explanation.left_rms)
        ));
    }
    text
}

fn factor(e: &ExplanationEntry) -> String {
    let f = &e.factor;
    let range = interval(f.ci95, f.value, f.std);
    format!(
        "{} times the value in the file (95 % interval {range})",
        with_uncertainty(f.value, f.std)
    )
}

fn percent(share: f64) -> String {
    format!("{:.2} %", 100.0 * share)
}

fn name(e: &ExplanationEntry) -> String {
    let of = |what: &str| match e.span {
        Some(span) => format!("the {what} of span {span}"),
        None => format!("the {what} of all spans"),
    };
    match e.quantity {
        ArmQuantityName::Length => of("length"),
        ArmQuantityName::FlexuralRigidity => of("flexural rigidity"),
        ArmQuantityName::Mass => of("mass"),
        ArmQuantityName::Payload => "the payload".to_owned(),
        ArmQuantityName::MotorInertia => "the motor's inertia".to_owned(),
    }
}
