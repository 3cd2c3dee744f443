//! Which number of an arm.toml explains best that the logs show another arm, in words.

use lissom::identify::{ArmQuantity, Explanation, GeometryCheck, Identified, geometry_check};
use lissom_report::{interval, with_uncertainty};

use crate::print;
use crate::reference::Reference;

/// Prints what the logs say of the arm that a campaign names.
pub(crate) fn print(id: &Identified, reference: Option<&Reference>) {
    let arm = reference.and_then(|r| r.arm.as_ref());
    let found = id.output_error.as_ref().filter(|oe| oe.stands());
    let (Some(arm), Some(found)) = (arm, found) else { return };
    if let Some(check) = geometry_check(arm, found) {
        print::line("");
        for line in lines(&check) {
            print::line(&line);
        }
    }
}

fn lines(check: &GeometryCheck) -> Vec<String> {
    let before = percent(check.before);
    let differ = "inertia, frequencies and couplings";
    if check.agrees() {
        return vec![format!("arm.toml describes this arm: {differ} within {before} (rms)")];
    }
    let mut text = vec![format!("{differ} differ from arm.toml by {before} (rms)")];
    let Some(best) = check.explanations.first() else { return text };
    if best.left > 0.5 * check.before {
        text.push(format!(
            "no single number explains it: with {} {} {} is left",
            name(best.quantity),
            factor(best),
            percent(best.left)
        ));
        return text;
    }
    let all: Vec<&Explanation> = check.as_good().collect();
    for (i, explanation) in all.iter().enumerate() {
        text.push(format!(
            "{} {} {} leaves {}",
            if i == 0 { "explained best:" } else { "or as well:" },
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
    format!("{} times what the file says ({range})", with_uncertainty(f.value, f.std))
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
