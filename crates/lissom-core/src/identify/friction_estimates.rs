//! Estimates of friction.

use crate::drive::Falloff;
use crate::friction::Root;
use crate::identify::estimate::Estimate;
use crate::identify::methods::friction_law::{LawTerm, NEAR_REST_STEP};
use crate::identify::thresholds::SIGN_SHOWN;
use crate::replay::{DryTerms, FrictionNumber, NearRestNumber};

/// Friction, as torque \[N·m\] or force \[N\]; in the unit of the command if the torque constant is unknown.
///
/// The line F = C + V·|v| is what results are compared by: where friction has further terms, it is the line that is nearest
/// to the whole law at the speeds and under the mean load of the log, weighted with time.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Friction {
    /// Coulomb friction of the line, mean of both directions.
    pub coulomb: Option<Estimate>,
    /// The same while moving forward, a magnitude.
    pub forward: Option<Estimate>,
    /// The same while moving backward, a magnitude.
    pub backward: Option<Estimate>,
    /// Offset, (forward − backward)/2.
    pub offset: Option<Estimate>,
    /// Viscous friction of the line \[N·m·s/rad\], without the damping by back-EMF.
    pub viscous: Option<Estimate>,
    /// The whole law, if it has terms beyond the line.
    pub law: Option<LawEstimates>,
}

/// A friction law with terms beyond Coulomb and one viscous friction: its own values, which predict friction.
///
/// `s·(C + A_s·e^{−|v|/v_s} + A_r·√|v| + μ·|τ_g| + Σ A·cos(kθ + φ)) + O + V_±·v`, and torque ripples.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct LawEstimates {
    /// Coulomb friction C, mean of both directions.
    pub coulomb: Option<Estimate>,
    /// The same while moving forward, a magnitude.
    pub forward: Option<Estimate>,
    /// The same while moving backward, a magnitude.
    pub backward: Option<Estimate>,
    /// Viscous friction V, mean of both directions \[N·m·s/rad\], without the damping by back-EMF.
    pub viscous: Option<Estimate>,
    /// Viscous friction forward and backward, if they differ.
    pub viscous_by_direction: Option<(Estimate, Estimate)>,
    /// Change of friction near rest.
    pub near_rest: Option<NearRestEstimate>,
    /// Coefficient A_r of friction that grows with the square root of speed \[N·m/√(rad/s)\].
    pub root: Option<Estimate>,
    /// Coefficient μ of friction that grows with the torque τ_g of gravity, `s·μ·|τ_g|` \[1\].
    pub with_load: Option<Estimate>,
    /// Ripples of friction over the travel.
    pub ripples: Vec<RippleEstimate>,
    /// Ripples of torque over the travel (cogging), which act in both directions alike.
    pub torque_ripples: Vec<RippleEstimate>,
}

impl Friction {
    /// Friction against the motion at a speed in a direction (+1 or −1) without a load \[N·m\], without ripples; positive if it
    /// brakes. `None` if one of its parameters is refused.
    ///
    /// `CF_± + V_±·|v| + A_s·e^{−|v|/v_s} + A_r·√|v|` of the law, or the line without one.
    pub fn at(&self, speed: f64, direction: f64) -> Option<f64> {
        let forward = direction > 0.0;
        let one_way = |f: Option<Estimate>, b: Option<Estimate>| if forward { f } else { b };
        let Some(law) = &self.law else {
            return Some(one_way(self.forward, self.backward)?.value + self.viscous?.value * speed);
        };
        let viscous = match law.viscous_by_direction {
            Some((f, b)) => one_way(Some(f), Some(b))?,
            None => law.viscous?,
        };
        let near =
            law.near_rest.map_or(0.0, |n| n.torque.value * n.falloff.share(speed / n.speed.value));
        let root = law.root.map_or(0.0, |r| r.value * Root::growth(speed));
        Some(one_way(law.forward, law.backward)?.value + viscous.value * speed + near + root)
    }
}

impl LawEstimates {
    /// The estimates of the terms of an arm: `number` gives that of one of their numbers where it was free, `any` that
    /// of anything made of them.
    pub(crate) fn of_terms(
        terms: &DryTerms,
        number: impl Fn(FrictionNumber) -> Option<Estimate>,
        any: impl Fn(&dyn Fn(&DryTerms) -> f64) -> Estimate,
        at_rest: impl Fn() -> Estimate,
    ) -> Self {
        let near_rest = terms.near_rest.and_then(|n| {
            let torque = number(FrictionNumber::NearRest(NearRestNumber::Torque))?;
            let speed = number(FrictionNumber::NearRest(NearRestNumber::Speed))?;
            Some(NearRestEstimate { torque, at_rest: at_rest(), speed, falloff: n.falloff })
        });
        let ripple = |i: usize| RippleEstimate {
            torque: any(&|terms| terms.ripples[i].amplitude_nm()),
            per_angle: any(&|terms| terms.ripples[i].per_rad),
            phase_rad: phase_rad(terms.ripples[i].cosine_nm, terms.ripples[i].sine_nm),
        };
        let ripples = (0..terms.ripples.len()).map(ripple).collect();
        let root = number(FrictionNumber::Root);
        let with_load = number(FrictionNumber::WithLoad);
        Self { near_rest, root, with_load, ripples, ..Self::default() }
    }

    /// The same of the terms of a law with their amplitudes; `at_rest` is friction at rest.
    pub(crate) fn of_law_terms(
        terms: &[(LawTerm, Vec<Estimate>)],
        at_rest: Option<Estimate>,
    ) -> Self {
        let mut found = Self::default();
        for (term, amplitude) in terms {
            match (*term, &amplitude[..]) {
                (LawTerm::NearRest { speed, falloff }, [torque, scanned @ ..]) => {
                    let listed = Estimate { value: speed, std: NEAR_REST_STEP * speed };
                    let speed = scanned.first().copied().unwrap_or(listed);
                    found.near_rest = at_rest.map(|at_rest| NearRestEstimate {
                        torque: *torque,
                        at_rest,
                        speed,
                        falloff,
                    });
                }
                (LawTerm::Root, [root]) => found.root = Some(*root),
                (LawTerm::WithLoad { .. }, [coefficient]) => found.with_load = Some(*coefficient),
                (LawTerm::Ripple { per_angle }, amplitude) => {
                    found.ripples.extend(RippleEstimate::of(per_angle, amplitude));
                }
                (LawTerm::TorqueRipple { per_angle }, amplitude) => {
                    found.torque_ripples.extend(RippleEstimate::of(per_angle, amplitude));
                }
                _ => {}
            }
        }
        found
    }

    /// Whether there is a term beyond the line.
    pub(crate) fn has_terms(&self) -> bool {
        let Self { viscous_by_direction, near_rest, root, with_load, .. } = self;
        viscous_by_direction.is_some()
            || near_rest.is_some()
            || root.is_some()
            || with_load.is_some()
            || !self.ripples.is_empty()
            || !self.torque_ripples.is_empty()
    }

    /// Its terms as those of a law, with their amplitudes.
    pub(crate) fn law_terms(&self) -> Vec<(LawTerm, Vec<Estimate>)> {
        let near = self.near_rest.iter().map(|n| {
            let term = LawTerm::NearRest { speed: n.speed.value, falloff: n.falloff };
            (term, vec![n.torque])
        });
        let ripple =
            |r: &RippleEstimate| (LawTerm::Ripple { per_angle: r.per_angle.value }, vec![r.torque]);
        let root = self.root.map(|root| (LawTerm::Root, vec![root]));
        near.chain(root).chain(self.ripples.iter().map(ripple)).collect()
    }
}

/// Change of friction near rest: `s·A_s·e^{−|v|/v_s}` or `s·A_s·e^{−(v/v_s)²}`, with the direction of motion s = ±1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NearRestEstimate {
    /// A \[N·m\]: friction at rest minus Coulomb friction.
    pub torque: Estimate,
    /// Friction at rest, C + A \[N·m\].
    pub at_rest: Estimate,
    /// v_s \[rad/s\]: speed over which friction changes.
    pub speed: Estimate,
    /// Exponential or Gaussian.
    pub falloff: Falloff,
}

impl NearRestEstimate {
    /// Static friction C + A, if friction at rest is significantly more than Coulomb friction.
    pub fn static_friction(&self) -> Option<Estimate> {
        (self.torque.value > SIGN_SHOWN * self.torque.std).then_some(self.at_rest)
    }
}

/// Ripple of friction over the travel: `s·A·cos(k·θ + φ)`, with the direction of motion s = ±1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RippleEstimate {
    /// Amplitude A \[N·m\].
    pub torque: Estimate,
    /// k: phase of the ripple per angle \[rad/rad\], or per length on a linear axis \[1/m\].
    pub per_angle: Estimate,
    /// Phase φ \[rad\].
    pub phase_rad: f64,
}

/// φ of `A·cos(x + φ)`, which is `cosine·cos x + sine·sin x`.
fn phase_rad(cosine: f64, sine: f64) -> f64 {
    (-sine).atan2(cosine)
}

impl RippleEstimate {
    /// Of the amplitudes of cosine and sine, and of the frequency where it was estimated with them.
    fn of(per_angle: f64, amplitude: &[Estimate]) -> Option<Self> {
        let [cosine, sine, rate @ ..] = amplitude else { return None };
        let unknown = Estimate { value: per_angle, std: f64::INFINITY };
        let torque =
            Estimate { value: cosine.value.hypot(sine.value), std: cosine.std.hypot(sine.std) };
        let per_angle = rate.first().copied().unwrap_or(unknown);
        Some(Self { torque, per_angle, phase_rad: phase_rad(cosine.value, sine.value) })
    }

    /// Period 2π/k \[rad or m\]; its relative standard error is that of k.
    pub fn period(&self) -> Estimate {
        let value = std::f64::consts::TAU / self.per_angle.value;
        Estimate { value, std: value * self.per_angle.std / self.per_angle.value }
    }
}
