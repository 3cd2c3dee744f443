//! Bristles that bend before the joint slips, and the friction of a joint on them over a step in time.

/// Exponents below which `1 − (1 − e^{−u})/u` is taken by its series.
const SMALL: f64 = 1e-2;

/// What yields before the joint slips: the joint's dry friction is
///
/// ```text
/// F = σ0·z + σ1·ż,   ż = θ̇ − σ0·|θ̇|/g·z
/// ```
///
/// with the deflection z \[rad\] and the level g \[N·m\], the friction of steady motion. There is no sticking: the joint swings on its bristles.
///
/// # Source
/// `[deWit1995, eqs. (2)-(5)]`; viscous friction, the source's σ2, is the arm's own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Bristles {
    /// σ0 \[N·m/rad\].
    pub(crate) stiffness_nm_per_rad: f64,
    /// σ1 \[N·m·s/rad\].
    pub(crate) damping_nm_s_per_rad: f64,
}

/// What bends the bristles over a step: velocities and levels at its beginning, halfway and at its end, the
/// deflection at its beginning, σ0 and σ1.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Bending {
    pub(crate) velocity: [f64; 3],
    pub(crate) z: f64,
    pub(crate) level: [f64; 3],
    pub(crate) stiffness: f64,
    pub(crate) damping: f64,
}

/// Friction over a step: its torque at both ends, how far its mean over time is above the mean of both ends, and the
/// deflection halfway and at the end.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Bristled {
    pub(crate) from: f64,
    pub(crate) to: f64,
    pub(crate) beyond: f64,
    pub(crate) middle_z: f64,
    pub(crate) z: f64,
}

impl Bending {
    /// Friction at the beginning.
    pub(crate) fn now(&self) -> f64 {
        self.torque(self.z, 0)
    }

    /// Over a step: z follows its level over the travel exactly where that is linear in it, in two halves; the
    /// torque's mean is Simpson's of σ0·z, and exact of σ1·ż.
    pub(crate) fn over(&self, duration_s: f64) -> Bristled {
        let [first, middle, last] = self.velocity;
        // Of a parabola through the three velocities.
        let part = |near: f64, far: f64| (near * 5.0 + middle * 8.0 - far) * (duration_s / 24.0);
        let half_s = 0.5 * duration_s;
        let bent = self.half(self.z, 0, part(first, last), half_s);
        let middle_z = self.z + bent;
        let bent = bent + self.half(middle_z, 1, part(last, first), half_s);
        let z = self.z + bent;
        let (from, to) = (self.now(), self.torque(z, 2));
        let mean_z = (self.z + middle_z * 4.0 + z) * (1.0 / 6.0);
        let mean = self.stiffness * mean_z + (self.damping * bent) * (1.0 / duration_s);
        Bristled { from, to, beyond: mean - (from + to) * 0.5, middle_z, z }
    }

    /// σ0·z + σ1·ż at place `at` of the three.
    fn torque(&self, z: f64, at: usize) -> f64 {
        let rate = self.velocity[at] - self.forgets(at) * z;
        self.stiffness * z + self.damping * rate
    }

    /// Rate at which they forget what they were bent by, σ0·|v|/g.
    fn forgets(&self, at: usize) -> f64 {
        self.stiffness * self.velocity[at].abs() / self.level[at]
    }

    /// Change of the deflection over half a step from place `at` to the next, over which the motor turns by `travel`; where it
    /// reverses, the velocity is taken for linear in time.
    fn half(&self, z: f64, at: usize, travel: f64, half_s: f64) -> f64 {
        let [before, after] = [self.velocity[at], self.velocity[at + 1]];
        // Bent as in steady motion that way.
        let steady = |at: usize, way: f64| self.level[at] / self.stiffness * way;
        let [forgets, then] = [self.forgets(at), self.forgets(at + 1)];
        if before * after >= 0.0 {
            let way = if before + after < 0.0 { -1.0 } else { 1.0 };
            let mut u = (forgets + then) * (0.5 * half_s);
            if travel * (before + after) > 0.0 {
                u = u * travel / ((before + after) * (0.5 * half_s));
            }
            return follows(z, [steady(at, way), steady(at + 1, way)], u);
        }
        // To rest, and away from it the other way.
        let until = before / (before - after);
        let first = steady(at, before.signum());
        let to_rest = follows(z, [first; 2], (forgets * until) * (0.5 * half_s));
        let second = steady(at + 1, after.signum());
        let rest = 1.0 - until;
        to_rest + follows(z + to_rest, [second; 2], (then * rest) * (0.5 * half_s))
    }
}

/// Change of z with `dz/du = ζ − z` over u, ζ linear in it.
fn follows(z: f64, [from, to]: [f64; 2], u: f64) -> f64 {
    let forgotten = -(-u).exp_m1();
    let lags = if u < SMALL {
        u * (0.5 - u * (1.0 / 6.0 - u * (1.0 / 24.0)))
    } else {
        1.0 - forgotten / u
    };
    (from - z) * forgotten + (to - from) * lags
}
