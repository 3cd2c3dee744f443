//! `plan-precision.svg`: standard errors against the time of the planned campaign.

use lissom::plan::{Kinds, Precision, Wishes, plan};
use lissom_report::{Axis, LinePlot, Role, Trace, TraceStyle};

use crate::Drawn;
use crate::arms::demo_rig;

/// Time allowed \[s\].
const WITHIN_S: [f64; 7] = [20.0, 40.0, 80.0, 160.0, 320.0, 640.0, 1280.0];
/// Relative standard error wished for: finer than any of these campaigns gives.
const WISHED: f64 = 1e-6;
const ROLES: [Role; 6] =
    [Role::Corrected, Role::Raw, Role::Fitted, Role::Truth, Role::Other(0), Role::Other(1)];

/// Expected standard errors of the best campaign within each time.
pub(crate) fn figure() -> Drawn {
    let mut rig = demo_rig()?;
    rig.instruments.tips = vec![rig.instruments.motor];
    let precision = Precision { damping: WISHED, ..Precision::all(WISHED) };
    let mut plans = Vec::new();
    for within_s in WITHIN_S {
        let wishes = Wishes { precision, within_s, kinds: Kinds::Any, ..Wishes::default() };
        plans.push(plan(&rig, &wishes, |_, _| ())?);
    }
    let mut plot = LinePlot::new(
        "Standard errors against the time of the campaign",
        Axis::log("time of all runs (s)"),
        Axis::log("expected standard error (%)"),
    )
    .subtitle("Arm of lissom demo, 12-bit sensors: the best campaigns within 20 s to 1280 s");
    let time: Vec<f64> = plans.iter().map(|p| p.time_s).collect();
    for (k, role) in (0..plans[0].expected.len()).zip(ROLES) {
        let std: Vec<f64> = plans.iter().map(|p| 100.0 * p.expected[k].std).collect();
        let label = plans[0].expected[k].parameter.name();
        plot = plot.trace(Trace::line(label, role, time.clone(), std.clone())).trace(Trace::new(
            "",
            role,
            TraceStyle::Points,
            time.clone(),
            std,
        ));
    }
    Ok(Box::new(plot))
}
