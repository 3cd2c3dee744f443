//! MuJoCo: a whole model of an arm of known dimensions, its beam as a chain of hinges.

use std::fmt::Write as _;

use super::export_error::ExportError;
use super::export_model::ExportModel;
use super::hinge_chain::{DamperKind, HingeChain, STEP_RADIANS, STEP_S, Segment};
use super::mjcf_text::{end, motor_joint, start};
use super::number_text::number;

/// Deepest chain: XML readers limit the depth of elements.
const MOST_HINGES: usize = 200;
/// Mass and inertia of links that have none, over those of the beam: MuJoCo needs positive numbers.
const LIGHT_SHARE: f64 = 1e-10;
/// Radius of the beam in pictures, over its length.
const DRAWN: f64 = 0.01;

/// A whole model: the motor as a joint with friction, and the beam as rigid segments between elastic hinges
/// ([`HingeChain`]). Sites have the names of the masses or span ends. The actuator's control is the command.
///
/// MuJoCo cannot carry: friction that sticks exactly (its friction is a soft constraint), friction other than Coulomb and
/// viscous friction, and bending other than at the hinges. Large deflections are those of the chain; dampers to the
/// frame and of modes are for small deflections.
///
/// # Errors
/// [`ExportError::TooManySpans`] if the chain would have more than 200 hinges.
pub(super) fn mjcf_chain(model: &ExportModel, chain: &HingeChain) -> Result<String, ExportError> {
    if chain.hinges.len() > MOST_HINGES {
        let (file, found) = (model.file.clone(), chain.ends_m.len());
        return Err(ExportError::TooManySpans { file, found, hinges: MOST_HINGES });
    }
    let step_s = rounded_down((STEP_RADIANS / chain.limit_rad_s).min(STEP_S));
    let mut text = start(model, &about(chain), step_s, None);
    let light = Light::of(chain);
    for (i, segment) in chain.segments.iter().enumerate() {
        let pad = " ".repeat(2 + i.min(20));
        let before = i.checked_sub(1).map_or(0.0, |j| chain.segments[j].from_m);
        let (name, joint) = if i == 0 {
            ("motor".to_owned(), motor_joint(model, step_s, None))
        } else {
            let k = chain.hinges[i - 1].stiffness_nm_per_rad;
            let joint = format!(
                "<joint name=\"hinge_{i}\" type=\"hinge\" axis=\"0 0 1\" stiffness=\"{}\" damping=\"{}\" armature=\"{}\"/>",
                number(k),
                number(k * chain.damping_s),
                number(k / (chain.limit_rad_s * chain.limit_rad_s))
            );
            (format!("segment_{i}"), joint)
        };
        let _ = write!(
            text,
            "{pad}<body name=\"{name}\" pos=\"{} 0 0\">{joint}\n{pad} {}{}\n",
            number(segment.from_m - before),
            light.inertial(segment),
            drawn(chain, segment)
        );
        for (site, x, _) in sites(chain).into_iter().filter(|(_, _, segment)| *segment == i) {
            let at = number(x - segment.from_m);
            let _ = writeln!(text, "{pad} <site name=\"{site}\" pos=\"{at} 0 0\"/>");
        }
    }
    let _ = writeln!(text, "  {}", "</body>".repeat(chain.segments.len()));
    text.push_str(" </worldbody>\n");
    text.push_str(&tendons(chain));
    text.push_str(&end(model));
    Ok(text)
}

/// What the chain is, and what it does not contain.
fn about(chain: &HingeChain) -> Vec<String> {
    let mut lines = vec![
        format!(
            "The beam is a chain of rigid segments between {} elastic hinges, two at the Gauss points of each cell: static \
             deflections are exact. Natural frequencies of the beam: with the motor held {} rad/s, with the motor free {} rad/s.",
            chain.hinges.len(),
            list(&chain.held_rad_s),
            list(&chain.free_rad_s)
        ),
        format!(
            "The armature of the hinges keeps all frequencies below {:.4e} rad/s, so that the time step is stable; it lowers a \
             frequency w by the part (w/{:.4e})^2/2. With more armature, a longer time step is possible.",
            chain.limit_rad_s, chain.limit_rad_s
        ),
        "Sites mass_1, mass_2 and so on are the points of the masses (the ends of spans): site_xpos gives their motion."
            .to_owned(),
        "Not in this model: shear, torsion, stretch, and rotary inertia of cross sections. Large deflections are those of \
         the chain; lissom's own model is linear."
            .to_owned(),
        "Gravity is off, because lissom knows none for a beam. The segments have their true masses: set gravity in <option> \
         if the arm does not turn in a horizontal plane."
            .to_owned(),
    ];
    if chain.damping_s > 0.0 {
        lines.push(format!(
            "Damping of each hinge is its stiffness times {:.4e} s: it gives a mode the damping ratio {:.4e} times its \
             frequency.",
            chain.damping_s,
            0.5 * chain.damping_s
        ));
    }
    let has = |kind| chain.dampers.iter().any(|d| d.kind == kind);
    if has(DamperKind::Mode) {
        lines.push(
            "The tendons mode_n_damper add damping to single modes, so that each mode has its own ratio; links without \
             mass have that of the hinges."
                .to_owned(),
        );
    }
    if has(DamperKind::Ground) {
        lines.push(
            "The tendons ground_n are dampers between points of the beam and the fixed frame, exact for small deflections at \
             any angle of the motor."
                .to_owned(),
        );
    }
    lines
}

fn list(frequencies: &[f64]) -> String {
    frequencies.iter().map(|w| format!("{w:.4}")).collect::<Vec<_>>().join(", ")
}

/// The numbers of links without mass.
struct Light {
    mass_kg: f64,
    inertia_kg_m2: f64,
}

impl Light {
    fn of(chain: &HingeChain) -> Self {
        let mass: f64 = chain.segments.iter().map(|s| s.mass_kg).sum();
        let about = |s: &Segment| s.mass_kg * s.centre_m * s.centre_m + s.inertia_kg_m2;
        let inertia: f64 = chain.segments.iter().map(about).sum();
        Self { mass_kg: LIGHT_SHARE * mass, inertia_kg_m2: LIGHT_SHARE * inertia }
    }

    fn inertial(&self, segment: &Segment) -> String {
        let inertia = number(segment.inertia_kg_m2.max(self.inertia_kg_m2));
        format!(
            "<inertial pos=\"{} 0 0\" mass=\"{}\" diaginertia=\"{inertia} {inertia} {inertia}\"/>",
            number(segment.centre_m - segment.from_m),
            number(segment.mass_kg.max(self.mass_kg))
        )
    }
}

/// The segment in pictures; it touches nothing.
fn drawn(chain: &HingeChain, segment: &Segment) -> String {
    let tip = chain.ends_m.last().copied().unwrap_or(0.0);
    format!(
        "<geom type=\"capsule\" fromto=\"0 0 0 {} 0 0\" size=\"{}\" contype=\"0\" conaffinity=\"0\"/>",
        number(segment.to_m - segment.from_m),
        number(DRAWN * tip)
    )
}

/// Names, places and segments of the points that a user reads.
fn sites(chain: &HingeChain) -> Vec<(String, f64, usize)> {
    let point = |(i, x): (usize, &f64)| (format!("mass_{}", i + 1), *x, chain.segment_at(*x));
    let masses = chain.ends_m.iter().enumerate().map(point);
    let payload = chain.payload_m.map(|x| ("payload".to_owned(), x, chain.hinges.len()));
    masses.chain(payload).collect()
}

fn tendons(chain: &HingeChain) -> String {
    if chain.dampers.is_empty() {
        return String::new();
    }
    let mut text = String::from(" <tendon>\n");
    for (i, damper) in chain.dampers.iter().enumerate() {
        let name = match damper.kind {
            DamperKind::Ground => format!("ground_{}", i + 1),
            DamperKind::Mode => format!("mode_{}_damper", i + 1),
        };
        let _ = writeln!(text, "  <fixed name=\"{name}\" damping=\"{}\">", number(damper.damping));
        for (joint, lever) in &damper.levers {
            let joint = if *joint == 0 { "motor".to_owned() } else { format!("hinge_{joint}") };
            let _ = writeln!(text, "   <joint joint=\"{joint}\" coef=\"{}\"/>", number(*lever));
        }
        text.push_str("  </fixed>\n");
    }
    text.push_str(" </tendon>\n");
    text
}

/// The next number below with one digit: 1, 2 or 5 times a power of ten.
fn rounded_down(value: f64) -> f64 {
    let power = 10.0_f64.powf(value.log10().floor());
    let digit = [5.0, 2.0].into_iter().find(|d| d * power <= value).unwrap_or(1.0);
    digit * power
}

#[cfg(test)]
mod tests {
    use super::rounded_down;

    #[test]
    fn a_time_step_has_one_digit() {
        for (value, wanted) in [(1e-4, 1e-4), (7.3e-5, 5e-5), (4.9e-6, 2e-6), (1.9e-3, 1e-3)] {
            assert!((rounded_down(value) / wanted - 1.0).abs() < 1e-12, "{value}");
        }
    }
}
