//! `arm.toml`: an arm's beam, drive and rig in the units of a drawing or data sheet.
//!
//! ```toml
//! [beam]
//! young_modulus = "30e6 psi"                # with section; or flexural_rigidity = "0.00443 N*m^2"
//! section = { round = "0.032 in" }          # or { rectangle = ["25.4 mm", "0.8 mm"] }: width,
//!                                           # thickness in bending
//! spans = [{ length = "7 in", mass = "0.121 lb" }]
//! [drive]
//! inertia = "0.005529 lbf*in*s^2"
//! viscous = "0.01216 lbf*in*s/rad"          # absent: none
//! torque_constant = "2.184 lbf*in/A"
//! coulomb = "0.132 A"                       # current or torque, or { forward, backward }; absent: none
//! [rig]
//! sample_time = "3 ms"
//! current_limit = "4.12 A"                  # absent: none
//! motor_sensor = { bits = 12, range = "360 deg" }
//! controller = { proportional = "9 A/rad", derivative = "0.2 A*s/rad" }
//! [tip]                                     # what acts on the tip; absent: nothing
//! viscous = "0.003 N*s/m"
//! ```
//!
//! A number without unit is in SI; for `damping` of a span in N·s/m, for `coulomb` in N·m.
//!
//! Each span may have its own `young_modulus`, `section` or `flexural_rigidity`, `damping` at the
//! mass at its end (N·s/m, or N·s/rad as ν of the 1989 report) and `count`, which repeats it. The last
//! may have `inertia`. The beam may begin at the rim of a hub, have a payload, damping of the whole beam,
//! and mass along its length:
//!
//! ```toml
//! [beam]
//! young_modulus = "200 GPa"
//! section = { rectangle = ["25 mm", "2 mm"] }
//! density = "7850 kg/m^3"                   # or mass_per_length = "0.39 kg/m"; also per span
//! hub_radius = "20 mm"
//! spans = [{ length = "100 mm", count = 5 }]  # a point mass at each end is optional now
//! payload = { mass = "0.2 kg", inertia = "1e-4 kg*m^2", offset = "30 mm" }
//! damping = { mass_proportional = "0.1 1/s", stiffness_proportional = "1e-4 s" }
//!                                           # or { ratio = 0.01 }, { ratios = [0.01, 0.02] }
//! ```
//!
//! A beam with unknown dimensions may be given by its modes, as many as points:
//!
//! ```toml
//! [beam]
//! modes = [{ frequency = "6.8 Hz", damping_ratio = 0.004, coupling = "0.5 N*m", gains = [1] }]
//! ```
//!
//! A joint with a rigid load has no beam. Gravity of an unbalanced load needs the torque
//! `gravity_torque·sin(θ + phase)` of its motor:
//!
//! ```toml
//! [beam]
//! rigid = true
//! [load]
//! gravity_torque = "2 N*m"                  # m·g·l
//! phase = "30 deg"                          # the load hangs at θ = −30°; absent: 0
//! ```
//!
//! `docs/src/reference/arm.md` explains every key.

pub(crate) mod arm_error;
mod arm_spec;
mod beam_spec;
mod build_arm;
mod build_rig;
mod drive_spec;
mod friction_spec;
mod load_spec;
mod material;
mod mode_specs;
mod read_arm_file;
mod rig_spec;
#[cfg(test)]
mod tests;
mod tip_spec;

pub use arm_spec::ArmFile;
pub use beam_spec::{BeamKind, BeamSpec, SpanSpec};
pub use drive_spec::DriveSpec;
pub use friction_spec::FrictionSpec;
pub use load_spec::LoadSpec;
pub use rig_spec::RigSpec;
pub use tip_spec::TipSpec;
pub(crate) use tip_spec::omega;
