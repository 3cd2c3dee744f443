//! The output-error method with few evaluations: it ends with what it has, reports that, and gives the same result again.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::time::Duration;

use lissom::identify::{
    Effort, Identified, Interrupt, Method, Options, SearchEnd, Stage, identify,
};
use lissom::record::Campaign;
use lissom::rig::{Experiment, Settle};
use lissom_testmodels::report_rig;

fn campaign() -> Campaign {
    let rig = report_rig(Some(12));
    let run = |omega: f64| {
        let sine = Experiment::sine(omega, 0.5, 20.0).unwrap();
        let settled = sine.settling(Settle::Wait { wait_s: 300.0 });
        rig.run(&format!("{omega} rad/s"), &settled, 0).unwrap().run
    };
    Campaign::new(rig.channels(0..1).unwrap(), [3.0, 9.0].map(run).into()).unwrap()
}

fn identified(campaign: &Campaign, most_evaluations: Option<u64>) -> Identified {
    let options = Options { most_evaluations, ..Options::default() };
    identify(campaign, &options, |_| ()).unwrap()
}

fn is_reported(found: &Identified) -> bool {
    found.findings.iter().any(|f| f.code() == "budget-spent")
}

#[test]
fn a_spent_budget_is_reported_and_reproducible() {
    let campaign = campaign();
    let whole = identified(&campaign, None);
    assert_eq!(whole.method, Some(Method::OutputError));
    assert!(!is_reported(&whole));
    let needed = whole.output_error.as_ref().unwrap().evaluations;
    let few = identified(&campaign, Some(needed / 20));
    let found = few.output_error.as_ref().unwrap();
    assert!(found.end == SearchEnd::Evaluations && is_reported(&few));
    // Each move that was begun is finished, and the covariance is computed.
    assert!(found.evaluations < needed / 4, "{} of {needed}", found.evaluations);
    // Friction, inertia and coupling are given all the same, by the regression.
    assert!(few.friction.coulomb.is_some() && few.inertia.is_some());
    let again = identified(&campaign, Some(needed / 20));
    assert_eq!(found.evaluations, again.output_error.as_ref().unwrap().evaluations);
    assert_eq!(few.friction, again.friction);
    assert_eq!(found.arm, again.output_error.as_ref().unwrap().arm);
}

/// Whoever waits may end the search: the result is the best so far, and says so.
#[test]
fn an_interrupt_ends_the_search() {
    let campaign = campaign();
    let interrupt = Interrupt::default();
    let options = Options { interrupt: interrupt.clone(), ..Options::default() };
    let asks = |stage| {
        if stage == Stage::OutputError {
            interrupt.ask();
        }
    };
    let found = identify(&campaign, &options, asks).unwrap();
    let search = found.output_error.as_ref().unwrap();
    assert!(search.end == SearchEnd::Interrupted && is_reported(&found));
    assert!(found.friction.coulomb.is_some() && found.inertia.is_some());
    let over = Options { interrupt: Interrupt::after(Duration::ZERO), ..Options::default() };
    let after = identify(&campaign, &over, |_| ()).unwrap();
    assert_eq!(after.output_error.as_ref().unwrap().end, SearchEnd::Interrupted);
}

/// Without effort there is no search.
#[test]
fn a_quick_effort_makes_no_search() {
    let options = Options { effort: Effort::Quick, ..Options::default() };
    let found = identify(&campaign(), &options, |_| ()).unwrap();
    assert!(found.output_error.is_none() && found.friction.coulomb.is_some());
}
