//! Dimensions as exponents of the SI base units.

use std::fmt;

/// Exponents of kilogram, metre, second and ampere. Angles are plain numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Dimension {
    /// Exponent of the kilogram.
    pub kg: i32,
    /// Exponent of the metre.
    pub m: i32,
    /// Exponent of the second.
    pub s: i32,
    /// Exponent of the ampere.
    pub a: i32,
}

impl Dimension {
    /// A plain number, or an angle in rad.
    pub const NUMBER: Self = Self::new(0, 0, 0, 0);
    /// m
    pub const LENGTH: Self = Self::new(0, 1, 0, 0);
    /// kg
    pub const MASS: Self = Self::new(1, 0, 0, 0);
    /// s
    pub const TIME: Self = Self::new(0, 0, 1, 0);
    /// A
    pub const CURRENT: Self = Self::new(0, 0, 0, 1);
    /// A/(rad·s)
    pub const CURRENT_RATE: Self = Self::new(0, 0, -1, 1);
    /// N/m
    pub const STIFFNESS: Self = Self::new(1, 0, -2, 0);
    /// rad/s
    pub const RATE: Self = Self::new(0, 0, -1, 0);
    /// m/s
    pub const VELOCITY: Self = Self::new(0, 1, -1, 0);
    /// rad/s²
    pub const ANGULAR_ACCELERATION: Self = Self::new(0, 0, -2, 0);
    /// m/s²
    pub const ACCELERATION: Self = Self::new(0, 1, -2, 0);
    /// N
    pub const FORCE: Self = Self::new(1, 1, -2, 0);
    /// N·m
    pub const TORQUE: Self = Self::new(1, 2, -2, 0);
    /// kg·m²
    pub const INERTIA: Self = Self::new(1, 2, 0, 0);
    /// Pa
    pub const PRESSURE: Self = Self::new(1, -1, -2, 0);
    /// kg/m³
    pub const DENSITY: Self = Self::new(1, -3, 0, 0);
    /// kg/m
    pub const LINEAR_DENSITY: Self = Self::new(1, -1, 0, 0);
    /// N·m²
    pub const FLEXURAL_RIGIDITY: Self = Self::new(1, 3, -2, 0);
    /// N·m·s/rad
    pub const VISCOUS_ROTARY: Self = Self::new(1, 2, -1, 0);
    /// N·s/m
    pub const VISCOUS_LINEAR: Self = Self::new(1, 0, -1, 0);
    /// N·s/rad
    pub const FORCE_PER_RATE: Self = Self::new(1, 1, -1, 0);
    /// V
    pub const VOLTAGE: Self = Self::new(1, 2, -3, -1);
    /// Ω
    pub const RESISTANCE: Self = Self::new(1, 2, -3, -2);
    /// N·m/A, which is V·s/rad
    pub const TORQUE_PER_CURRENT: Self = Self::new(1, 2, -2, -1);
    /// N/A, which is V·s/m
    pub const FORCE_PER_CURRENT: Self = Self::new(1, 1, -2, -1);
    /// N·m/V, which is A·s/rad
    pub const TORQUE_PER_VOLTAGE: Self = Self::new(0, 0, 1, 1);
    /// N/V
    pub const FORCE_PER_VOLTAGE: Self = Self::new(0, -1, 1, 1);

    /// A dimension by its exponents.
    pub const fn new(kg: i32, m: i32, s: i32, a: i32) -> Self {
        Self { kg, m, s, a }
    }

    /// Name of a quantity of this dimension, and an example.
    fn known(self) -> Option<(&'static str, &'static str)> {
        Some(match self {
            Self::NUMBER => ("a plain number or angle", "360 deg"),
            Self::LENGTH => ("a length", "7 in"),
            Self::MASS => ("a mass", "0.121 lb"),
            Self::TIME => ("a time", "3 ms"),
            Self::CURRENT => ("a current", "4.12 A"),
            Self::RATE => ("an angular rate or frequency", "5 Hz"),
            Self::VELOCITY => ("a speed", "0.2 m/s"),
            Self::ANGULAR_ACCELERATION => ("an angular acceleration", "20 rad/s^2"),
            Self::ACCELERATION => ("an acceleration", "9.81 m/s^2"),
            Self::FORCE => ("a force", "20 N"),
            Self::TORQUE => ("a torque", "0.25 N*m"),
            Self::INERTIA => ("a moment of inertia", "0.005529 lbf*in*s^2"),
            Self::PRESSURE => ("a pressure or modulus", "200 GPa"),
            Self::DENSITY => ("a density", "7850 kg/m^3"),
            Self::LINEAR_DENSITY => ("a mass per length", "0.03 kg/m"),
            Self::FLEXURAL_RIGIDITY => ("a flexural rigidity", "0.00443 N*m^2"),
            Self::VISCOUS_ROTARY => ("a torque per angular rate", "0.01216 lbf*in*s/rad"),
            Self::VISCOUS_LINEAR => ("a force per velocity", "0.2 N*s/m"),
            Self::FORCE_PER_RATE => ("a force per angular rate", "0.04 N*s/rad"),
            Self::VOLTAGE => ("a voltage", "24 V"),
            Self::RESISTANCE => ("a resistance", "3.29 ohm"),
            Self::TORQUE_PER_CURRENT => {
                ("a torque per current (or voltage per angular rate)", "2.184 lbf*in/A")
            }
            Self::FORCE_PER_CURRENT => ("a force per current (or voltage per velocity)", "12 N/A"),
            Self::TORQUE_PER_VOLTAGE => {
                ("a torque per voltage (or current per angular rate)", "0.15 N*m/V")
            }
            Self::FORCE_PER_VOLTAGE => ("a force per voltage", "35.15 N/V"),
            _ => return None,
        })
    }

    /// An example of a quantity of this dimension.
    pub fn example(self) -> Option<&'static str> {
        self.known().map(|(_, example)| example)
    }

    pub(super) fn times(self, other: Self, power: i32) -> Self {
        let add = |a: i32, b: i32| a.saturating_add(b.saturating_mul(power));
        Self {
            kg: add(self.kg, other.kg),
            m: add(self.m, other.m),
            s: add(self.s, other.s),
            a: add(self.a, other.a),
        }
    }
}

impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let bases = [("kg", self.kg), ("m", self.m), ("s", self.s), ("A", self.a)];
        let units: Vec<String> = bases
            .into_iter()
            .filter(|&(_, power)| power != 0)
            .map(
                |(name, power)| {
                    if power == 1 { name.to_owned() } else { format!("{name}^{power}") }
                },
            )
            .collect();
        let units = units.join("*");
        match self.known() {
            Some((name, _)) if units.is_empty() => f.write_str(name),
            Some((name, _)) => write!(f, "{name} [{units}]"),
            None => write!(f, "a quantity in [{units}]"),
        }
    }
}
