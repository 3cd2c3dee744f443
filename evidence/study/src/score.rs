//! Compares estimates with the truth.

use lissom::identify::findings::{Finding, LawSource, Severity, rows};
use lissom::identify::{Estimate, Identified, ModeEstimate, RunKind, corrected};
use num_complex::Complex64;
use serde::{Deserialize, Serialize};

use crate::bound::Bound;
use crate::scored_parameter::ScoredParameter;
use crate::statistics::NORMAL_95;
use crate::truth::Truth;

/// Error, in standard errors, above which an estimate without a warning is silently wrong.
const SILENT: f64 = 5.0;

/// Radius of a response's 95 % circle in standard errors √E|Ĝ − G|²: √(−ln 0.05), for a circular
/// normal error.
pub(crate) const CIRCLE_95: f64 = 1.730_818_382_6;

/// One parameter of one campaign.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct EstimateScore {
    /// The parameter.
    pub parameter: ScoredParameter,
    /// Its true value.
    pub truth: f64,
    /// The estimate; `None`: refused.
    #[serde(with = "estimate")]
    pub estimate: Option<Estimate>,
    /// Whether a warning or refusal affects it.
    pub warned: bool,
    /// The smallest standard error of an unbiased estimator; `None` if it is not known.
    pub bound: Option<f64>,
}

impl EstimateScore {
    /// Signed relative error.
    pub fn error(&self) -> Option<f64> {
        self.estimate.map(|e| e.value / self.truth - 1.0)
    }

    /// Signed error in standard errors; infinite if the standard error is zero.
    pub fn standard_errors(&self) -> Option<f64> {
        self.estimate.map(|e| (e.value - self.truth) / e.std)
    }

    /// Width of its 95 % interval divided by that of the bound.
    pub fn width_over_bound(&self) -> Option<f64> {
        let [low, high] = self.estimate?.ci95();
        Some((high - low) / (2.0 * NORMAL_95 * self.bound?))
    }

    /// Signed error divided by the bound.
    pub fn error_over_bound(&self) -> Option<f64> {
        Some((self.estimate?.value - self.truth) / self.bound?)
    }

    /// Whether the 95 % interval contains the true value.
    pub fn covers(&self) -> Option<bool> {
        self.estimate.map(|e| {
            let [low, high] = e.ci95();
            (low..=high).contains(&self.truth)
        })
    }

    /// More than five standard errors off, without a warning.
    pub fn silently_wrong(&self) -> bool {
        // NaN counts as wrong, as a large error does.
        !self.warned && self.standard_errors().is_some_and(|d| d.is_nan() || d.abs() > SILENT)
    }

    /// Given without a warning.
    pub fn vouched(&self) -> bool {
        self.estimate.is_some() && !self.warned
    }
}

/// One frequency of the motor's response; errors are |Ĝ − G|/|G|.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PointScore {
    /// Frequency \[rad/s\].
    pub omega_rad_s: f64,
    /// Whether it is of a sinusoidal run; otherwise it is of a band.
    pub sinusoidal: bool,
    /// Error as measured.
    pub raw: f64,
    /// Error of (30) with the friction that the third harmonic gives.
    pub third_harmonic: Option<f64>,
    /// Error of the corrected response.
    pub corrected: Option<f64>,
    /// The same in standard errors.
    pub standard_errors: Option<f64>,
    /// Whether it is vouched for: no finding speaks against it, and its 95 % interval is within 5 %.
    pub vouched: bool,
}

impl PointScore {
    /// Whether the 95 % circle around the corrected point contains the truth.
    pub fn covers(&self) -> Option<bool> {
        self.standard_errors.map(|d| d <= CIRCLE_95)
    }

    /// Vouched for, and more than five standard errors off.
    pub fn silently_wrong(&self) -> bool {
        // NaN counts as wrong, as a large error does.
        self.vouched && self.standard_errors.is_some_and(|d| d.is_nan() || d > SILENT)
    }

    /// Whether the error of the corrected point is at least `times` smaller than that of (30); `None` without (30).
    /// A point that is not corrected counts as not nearer.
    pub fn nearer(&self, times: f64) -> Option<bool> {
        let third = self.third_harmonic?;
        Some(self.corrected.is_some_and(|c| c < third && times * c <= third))
    }
}

/// One point of the friction curve of true Coulomb and viscous friction.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CurveScore {
    /// Relative error.
    pub error: f64,
    /// The same in standard errors.
    pub standard_errors: f64,
}

impl CurveScore {
    /// Whether the 95 % band contains the true value.
    pub fn covers(&self) -> bool {
        self.standard_errors.abs() <= NORMAL_95
    }
}

/// The parts of a finding that are used here.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct FindingScore {
    /// Its code.
    pub code: String,
    /// Whether it reports that the equation of motion is wrong.
    pub law_alarm: bool,
}

/// All scores of one campaign.
#[derive(Debug, Default, Clone, PartialEq, Serialize, Deserialize)]
pub struct Score {
    /// Parameters, two of each mode at the end.
    pub estimates: Vec<EstimateScore>,
    /// Points of the motor's response.
    pub points: Vec<PointScore>,
    /// Points of the friction curve.
    pub curve: Vec<CurveScore>,
    /// The findings.
    pub findings: Vec<FindingScore>,
    /// Number of modes found that the arm does not have.
    pub surplus_modes: usize,
}

impl Score {
    /// The score of one parameter.
    pub fn of(&self, parameter: ScoredParameter) -> Option<&EstimateScore> {
        self.estimates.iter().find(|f| f.parameter == parameter)
    }

    /// Adds the bounds of the parameters.
    #[must_use]
    pub fn with_bound(mut self, bound: Option<&Bound>) -> Self {
        for parameter in &mut self.estimates {
            parameter.bound = bound.and_then(|b| b.std(parameter.parameter));
        }
        self
    }

    /// The codes of the findings that report a wrong equation of motion: warnings and refusals about
    /// the whole campaign that affect friction, inertia or coupling and are not about its data; and
    /// `offset`, which reports that friction differs by direction.
    pub fn law_alarms(&self) -> Vec<&str> {
        self.findings.iter().filter(|f| f.law_alarm).map(|f| f.code.as_str()).collect()
    }
}

/// Compares a result with the truth.
pub fn score(truth: &Truth, id: &Identified) -> Score {
    let named = |parameter: ScoredParameter| {
        let speaks = |f: &Finding| {
            f.severity() >= Severity::Warning && f.affects().contains(&parameter.key())
        };
        id.findings.iter().any(speaks)
    };
    let one = |parameter: ScoredParameter, truth: f64, estimate: Option<Estimate>| EstimateScore {
        parameter,
        truth,
        estimate,
        warned: named(parameter),
        bound: None,
    };
    // The truth is the law's own Coulomb and viscous friction.
    let line = &id.friction;
    let [coulomb, forward, backward, viscous] = match &line.law {
        Some(law) => [law.coulomb, law.forward, law.backward, law.viscous],
        None => [line.coulomb, line.forward, line.backward, line.viscous],
    };
    let mut estimates = vec![
        one(ScoredParameter::Coulomb, truth.coulomb_nm, coulomb),
        one(ScoredParameter::Forward, truth.coulomb_by_direction_nm[0], forward),
        one(ScoredParameter::Backward, truth.coulomb_by_direction_nm[1], backward),
        one(ScoredParameter::Inertia, truth.inertia_kg_m2, id.inertia),
        one(ScoredParameter::Coupling, truth.coupling_nm_per_rad, id.beam.coupling),
        one(ScoredParameter::Viscous, truth.viscous_nm_s_per_rad, viscous),
    ];
    let modes = matched(&truth.modes, &id.beam.modes);
    for (k, ((omega, zeta), found)) in truth.modes.iter().zip(modes).enumerate() {
        estimates.push(one(
            ScoredParameter::Frequency(k),
            *omega,
            found.map(|m| m.natural_frequency_rad_s),
        ));
        estimates.push(one(ScoredParameter::Damping(k), *zeta, found.map(|m| m.damping_ratio)));
    }
    Score {
        estimates,
        points: points(truth, id),
        curve: curve(truth, id),
        findings: id.findings.iter().map(FindingScore::of).collect(),
        surplus_modes: id.beam.modes.len().saturating_sub(truth.modes.len()),
    }
}

impl FindingScore {
    fn of(finding: &Finding) -> Self {
        Self { code: finding.code().to_owned(), law_alarm: is_law_alarm(finding) }
    }
}

/// Whether a finding reports that the equation of motion is wrong.
fn is_law_alarm(finding: &Finding) -> bool {
    // No alarm if the estimates are those of the law.
    let law = |row: &rows::FrictionLaw| {
        !matches!(row.source, LawSource::SlipPhases { replayed_without: true, .. })
    };
    if finding.is::<rows::Offset>() || finding.get().is_some_and(law) {
        return true;
    }
    let warns = finding.severity() >= Severity::Warning;
    warns && about_equation(finding) && !about_data(finding.code())
}

/// Whether a finding about the whole campaign affects a parameter of the motor's equation of motion.
fn about_equation(finding: &Finding) -> bool {
    let affects = finding.affects();
    let named = |parameter: ScoredParameter| affects.contains(&parameter.key());
    let estimates = [
        ScoredParameter::Coulomb,
        ScoredParameter::Viscous,
        ScoredParameter::Inertia,
        ScoredParameter::Coupling,
    ];
    finding.run.is_none() && estimates.into_iter().any(named)
}

/// Whether a finding is about the information in the runs, not about the equation of motion.
fn about_data(code: &str) -> bool {
    let about_data = [
        rows::DeadChannel::CODE,
        rows::DampingKind::CODE,
        rows::FaintMode::CODE,
        rows::ModesNotFound::CODE,
        rows::MoreModesThanTips::CODE,
        rows::PoorExcitation::CODE,
        rows::NoPairs::CODE,
        rows::ThirdHarmonicDisagrees::CODE,
        rows::OddHarmonics::CODE,
    ];
    about_data.contains(&code)
}

/// The mode found for each true one: in order if there are as many, otherwise the nearest of the remaining ones.
fn matched(truth: &[(f64, f64)], found: &[ModeEstimate]) -> Vec<Option<ModeEstimate>> {
    if truth.len() == found.len() {
        return found.iter().copied().map(Some).collect();
    }
    let mut left = found.to_vec();
    let distance =
        |omega: f64, mode: &ModeEstimate| (mode.natural_frequency_rad_s.value / omega).ln().abs();
    let mut by_truth = vec![None; truth.len()];
    while !left.is_empty() {
        let free = (0..truth.len()).filter(|k| by_truth[*k].is_none());
        let nearest = free.flat_map(|k| (0..left.len()).map(move |m| (k, m))).min_by(|a, b| {
            let far = |(k, m): &(usize, usize)| distance(truth[*k].0, &left[*m]);
            far(a).total_cmp(&far(b))
        });
        let Some((k, m)) = nearest else { break };
        by_truth[k] = Some(left.swap_remove(m));
    }
    by_truth
}

fn points(truth: &Truth, id: &Identified) -> Vec<PointScore> {
    let third = id.third_harmonic.as_ref().map(|t| t.coulomb_command);
    id.responses
        .iter()
        .map(|point| {
            let exact = truth.response(point.omega_rad_s);
            let off = |value: Complex64| (value - exact).norm() / exact.norm();
            let by_report = point.run.and_then(|run| {
                let RunKind::Sinusoidal(s) = &id.runs.get(run)?.kind else { return None };
                let response = corrected(s.motor.get(1)?, s.command.get(1)?, third?);
                Some(off(response.value))
            });
            let given = point.motor_corrected;
            PointScore {
                omega_rad_s: point.omega_rad_s,
                sinusoidal: point.run.is_some(),
                raw: off(point.motor_raw.value),
                third_harmonic: by_report,
                corrected: given.map(|r| off(r.value)),
                standard_errors: given.map(|r| (r.value - exact).norm() / r.std),
                vouched: point.is_vouched_for(),
            }
        })
        .collect()
}

fn curve(truth: &Truth, id: &Identified) -> Vec<CurveScore> {
    let points = id.friction_law.iter().flat_map(|law| &law.curve);
    points
        .map(|point| {
            let [forward, backward] = truth.coulomb_by_direction_nm;
            let coulomb = if point.direction > 0.0 { forward } else { backward };
            let exact = coulomb + truth.viscous_nm_s_per_rad * point.speed;
            let off = point.friction.value - exact;
            CurveScore { error: off / exact, standard_errors: off / point.friction.std }
        })
        .collect()
}

/// Serialises an estimate as value and standard error; the library's type has no serialisation.
mod estimate {
    use lissom::identify::Estimate;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    #[expect(clippy::ref_option, reason = "serde's signature")]
    pub(super) fn serialize<S: Serializer>(
        of: &Option<Estimate>,
        to: S,
    ) -> Result<S::Ok, S::Error> {
        of.map(|e| (e.value, e.std)).serialize(to)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(
        from: D,
    ) -> Result<Option<Estimate>, D::Error> {
        let pair = Option::<(f64, f64)>::deserialize(from)?;
        Ok(pair.map(|(value, std)| Estimate { value, std }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lissom::identify::findings::{EstimateUnits, JudgedParameter};
    use lissom::record::{Axis, CommandQuantity};

    fn mode(omega: f64) -> ModeEstimate {
        let of = |value| Estimate { value, std: 0.1 };
        ModeEstimate { natural_frequency_rad_s: of(omega), damping_ratio: of(0.01) }
    }

    fn omegas(truth: &[f64], found: &[f64]) -> Vec<Option<f64>> {
        let truth: Vec<(f64, f64)> = truth.iter().map(|w| (*w, 0.01)).collect();
        let found: Vec<ModeEstimate> = found.iter().map(|w| mode(*w)).collect();
        let modes = matched(&truth, &found);
        modes.into_iter().map(|m| Some(m?.natural_frequency_rad_s.value)).collect()
    }

    #[test]
    fn modes_meet_their_truths() {
        // As many: in order, even if one is far off.
        assert_eq!(omegas(&[5.0, 30.0], &[4.0, 5.0]), [Some(4.0), Some(5.0)]);
        // Fewer: the nearest; the others are refused.
        assert_eq!(omegas(&[5.0, 30.0], &[31.0]), [None, Some(31.0)]);
        // More: the surplus is not used.
        assert_eq!(omegas(&[5.0], &[2.0, 5.1, 9.0]), [Some(5.1)]);
        assert_eq!(omegas(&[5.0, 30.0], &[]), [None, None]);
    }

    fn coulomb(value: f64, std: f64, warned: bool) -> EstimateScore {
        let estimate = Some(Estimate { value, std });
        EstimateScore {
            parameter: ScoredParameter::Coulomb,
            truth: 1.0,
            estimate,
            warned,
            bound: Some(0.02),
        }
    }

    #[test]
    fn silently_wrong_is_far_off_without_a_warning() {
        assert!(coulomb(1.06, 0.01, false).silently_wrong());
        assert!(!coulomb(1.04, 0.01, false).silently_wrong());
        assert!(!coulomb(1.06, 0.01, true).silently_wrong());
        assert!(
            coulomb(1.0001, 0.0, false).silently_wrong(),
            "a standard error of zero counts as given"
        );
        assert!(coulomb(1.0, f64::NAN, false).silently_wrong());
        let refused = EstimateScore { estimate: None, ..coulomb(0.0, 0.0, false) };
        assert!(!refused.silently_wrong() && refused.covers().is_none());
    }

    #[test]
    fn intervals_contain_the_values_within() {
        assert_eq!(coulomb(1.019, 0.01, false).covers(), Some(true));
        assert_eq!(coulomb(1.021, 0.01, false).covers(), Some(false));
        assert!((coulomb(1.02, 0.01, false).error().unwrap() - 0.02).abs() < 1e-12);
    }

    #[test]
    fn errors_and_widths_are_counted_in_bounds() {
        let score = coulomb(1.03, 0.01, false);
        assert!((score.width_over_bound().unwrap() - 0.5).abs() < 1e-6);
        assert!((score.error_over_bound().unwrap() - 1.5).abs() < 1e-9);
        assert_eq!(EstimateScore { bound: None, ..score }.error_over_bound(), None);
    }

    fn point(third_harmonic: f64, corrected: f64, standard_errors: f64) -> PointScore {
        PointScore {
            omega_rad_s: 1.0,
            sinusoidal: true,
            raw: 1.0,
            third_harmonic: Some(third_harmonic),
            corrected: Some(corrected),
            standard_errors: Some(standard_errors),
            vouched: true,
        }
    }

    #[test]
    fn points_are_scored_in_circles() {
        assert!((CIRCLE_95.powi(2) + 0.05_f64.ln()).abs() < 1e-9);
        assert_eq!(point(0.1, 0.01, 1.73).covers(), Some(true));
        assert_eq!(point(0.1, 0.01, 1.74).covers(), Some(false));
        assert!(point(0.1, 0.01, 5.1).silently_wrong() && !point(0.1, 0.01, 4.9).silently_wrong());
        assert!(point(0.1, 0.01, f64::NAN).silently_wrong());
        assert!(!PointScore { vouched: false, ..point(0.1, 0.01, 5.1) }.silently_wrong());
    }

    #[test]
    fn a_point_that_is_not_corrected_is_not_nearer() {
        let of = |p: PointScore| (p.nearer(1.0), p.nearer(10.0));
        assert_eq!(of(point(0.1, 0.009, 1.0)), (Some(true), Some(true)));
        assert_eq!(of(point(0.1, 0.02, 1.0)), (Some(true), Some(false)));
        assert_eq!(of(point(0.1, 0.1, 1.0)), (Some(false), Some(false)));
        assert_eq!(of(point(0.1, f64::NAN, 1.0)), (Some(false), Some(false)));
        let without = PointScore { corrected: None, ..point(0.1, 0.0, 1.0) };
        assert_eq!(of(without.clone()), (Some(false), Some(false)));
        assert_eq!(of(PointScore { third_harmonic: None, ..without }), (None, None));
    }

    #[test]
    fn alarms_speak_of_the_law() {
        let unexplained = || Finding::new(rows::UnexplainedTorque { residual_share: 0.3 });
        assert!(is_law_alarm(&unexplained()));
        assert!(!is_law_alarm(&Finding::of_run("a", unexplained())));
        let bands = rows::BandsUncertain { bands: 1, of: 2, limit: 0.02 };
        assert!(!is_law_alarm(&Finding::new(bands)));
        let parameter = JudgedParameter::Inertia;
        assert!(!is_law_alarm(&Finding::new(rows::NotSeparable { parameter })));
        let (offset, axis) = (Estimate { value: 0.1, std: 0.01 }, Axis::Rotary);
        let units = EstimateUnits { axis, command: CommandQuantity::Current, torque_known: true };
        let offset = rows::Offset { offset, units, share: 0.1 };
        assert!(is_law_alarm(&Finding::new(offset)));
    }
}
