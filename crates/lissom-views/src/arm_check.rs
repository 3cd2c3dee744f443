//! Comparison of the identified arm with an arm.toml, in words and as a section of the page: which number of
//! the file explains the difference best.

use lissom::identify::{ArmQuantity, Explanation, GeometryCheck};
use lissom_report::{Cells, Page, Table, interval, with_uncertainty};

/// Adds the comparison to the HTML page.
pub(crate) fn section(page: Page, check: Option<&GeometryCheck>) -> Page {
    let Some(check) = check else { return page };
    let mut page = page.heading("Comparison with arm.toml");
    for line in lines(check) {
        page = page.paragraph(&sentence(&line));
    }
    if check.agrees() || check.explanations.is_empty() {
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
        let f = e.factor;
        table = table.row([
            name(e.quantity),
            with_uncertainty(f.value, f.std),
            interval(f.ci95(), f.value, f.std),
            percent(e.left),
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
pub fn lines(check: &GeometryCheck) -> Vec<String> {
    let before = percent(check.before);
    let compared = "inertia, frequencies and couplings";
    if check.agrees() {
        return vec![format!("arm.toml agrees with the logs: {compared} within {before} (rms)")];
    }
    let mut text = vec![format!("{compared} differ from arm.toml by {before} (rms)")];
    let Some(best) = check.explanations.first() else { return text };
    if best.left > 0.5 * check.before {
        text.push(format!(
            "no single number of arm.toml explains this: if {} is {}, the difference is still {}",
            name(best.quantity),
            factor(best),
            percent(best.left)
        ));
        return text;
    }
    let all: Vec<&Explanation> = check.as_good().collect();
    for (i, explanation) in all.iter().enumerate() {
        text.push(format!(
            "{} {} is {}; the difference is then {}",
            if i == 0 { "best explanation:" } else { "equally good:" },
            name(explanation.quantity),
            factor(explanation),
            percent(explanation.left)
        ));
    }
    text
}

fn factor(e: &Explanation) -> String {
    let f = e.factor;
    let range = interval(f.ci95(), f.value, f.std);
    format!(
        "{} times the value in the file (95 % interval {range})",
        with_uncertainty(f.value, f.std)
    )
}

fn percent(share: f64) -> String {
    format!("{:.2} %", 100.0 * share)
}

fn name(quantity: ArmQuantity) -> String {
    let of = |what: &str, which: Option<usize>| match which {
        Some(i) => format!("the {what} of span {}", i + 1),
        None => format!("the {what} of all spans"),
    };
    match quantity {
        ArmQuantity::Length(which) => of("length", which),
        ArmQuantity::Stiffness(which) => of("flexural rigidity", which),
        ArmQuantity::Mass(which) => of("mass", which),
        ArmQuantity::Payload => "the payload".to_owned(),
        ArmQuantity::MotorInertia => "the motor's inertia".to_owned(),
    }
}
