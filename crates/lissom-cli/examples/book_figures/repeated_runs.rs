//! `interval.svg`: intervals of one run that is repeated with other noise.

use lissom::identify::{Estimate, NORMAL_95, Options, identify};
use lissom_report::{Axis, LinePlot, Role, Trace};

use crate::Drawn;
use crate::arms::noisy_rig;
use crate::experiments::{campaign, settled_sine};

const OMEGA_RAD_S: f64 = 3.1;
const AMPLITUDE_RAD: f64 = 0.5;
const RECORD_S: f64 = 12.0;
/// Noise of both angles \[rad\].
const NOISE_RAD: f64 = 1e-3;
/// mN·m in one N·m.
const MILLI: f64 = 1e3;
/// Seeds of the noise.
const SEEDS: std::ops::Range<u64> = 1000..1040;

/// Estimates of Coulomb friction with 95 % intervals, and the truth.
pub(crate) fn figure() -> Drawn {
    let rig = noisy_rig(NOISE_RAD)?;
    let experiment = settled_sine(OMEGA_RAD_S, AMPLITUDE_RAD, RECORD_S)?;
    let truth = rig.arm.coulomb.forward();
    let (mut inside, mut outside) = (Vec::new(), Vec::new());
    for (number, seed) in (1..).zip(SEEDS) {
        let campaign = campaign(&rig, std::slice::from_ref(&experiment), seed)?;
        let found = identify(&campaign, &Options::default(), |_| ())?;
        let coulomb = found.friction.coulomb.ok_or("no estimate")?;
        let [low, high] = coulomb.ci95();
        let list = if (low..=high).contains(&truth) { &mut inside } else { &mut outside };
        list.push((f64::from(number), coulomb));
    }
    let bars = |label: &str, role: Role, list: &[(f64, Estimate)]| {
        Trace::points_with_bars(
            label,
            role,
            list.iter().map(|p| p.0).collect(),
            list.iter().map(|p| MILLI * p.1.value).collect(),
            list.iter().map(|p| MILLI * NORMAL_95 * p.1.std).collect(),
        )
    };
    let all = inside.len() + outside.len();
    let ends = vec![0.0, all as f64 + 1.0];
    let plot = LinePlot::new(
        format!("Coulomb friction from {all} noisy repetitions of one run"),
        Axis::linear("repetition"),
        Axis::linear("Coulomb friction (mN·m)"),
    )
    .subtitle(format!("{} of {all} intervals of 95 % contain the true value", inside.len()))
    .trace(Trace::line("true value", Role::Truth, ends, vec![MILLI * truth; 2]))
    .trace(bars("interval contains it", Role::Corrected, &inside))
    .trace(bars("interval does not", Role::Raw, &outside));
    Ok(Box::new(plot))
}
