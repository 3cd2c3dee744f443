//! A rigid joint with friction under a position loop, and its log.

/// J·q̈ = K·u − V·q̇ − C·sign(q̇) with u from a loop of 10 Hz and damping 0.7, per unit of the current.
#[derive(Debug, Clone, Copy)]
pub struct RigidJoint {
    /// Inertia J.
    pub inertia: f64,
    /// Viscous friction V.
    pub viscous: f64,
    /// Coulomb friction C.
    pub coulomb: f64,
    /// Time between samples of loop and log \[s\].
    pub sample_time_s: f64,
    /// Steps of the simulation per sample.
    pub steps: usize,
}

/// What a loop logs.
#[derive(Debug, Clone, PartialEq)]
pub struct RigidLog {
    /// Times \[s\].
    pub time_s: Vec<f64>,
    /// Current, held from each sample to the next.
    pub held: Vec<f64>,
    /// Current as a sensor shows it that averages around each sample.
    pub measured: Vec<f64>,
    /// Motor angle \[rad\].
    pub angle: Vec<f64>,
    /// Motor speed \[rad/s\].
    pub speed: Vec<f64>,
}

impl Default for RigidJoint {
    fn default() -> Self {
        Self { inertia: 0.01, viscous: 0.02, coulomb: 0.15, sample_time_s: 2e-3, steps: 10 }
    }
}

impl RigidJoint {
    /// Follows a reference \[rad\] for `samples` samples, from rest at 0.
    pub fn follow(&self, samples: usize, reference: impl Fn(f64) -> f64) -> RigidLog {
        let (mut q, mut w) = (0.0_f64, 0.0_f64);
        let mut log = RigidLog {
            time_s: (0..samples).map(|k| k as f64 * self.sample_time_s).collect(),
            held: Vec::with_capacity(samples),
            measured: Vec::with_capacity(samples),
            angle: Vec::with_capacity(samples),
            speed: Vec::with_capacity(samples),
        };
        let omega = std::f64::consts::TAU * 10.0;
        let h = self.sample_time_s / self.steps as f64;
        for k in 0..samples {
            let error = reference(log.time_s[k]) - q;
            let u = self.inertia * (omega * omega * error - 1.4 * omega * w);
            log.measured.push(f64::midpoint(u, log.held.last().copied().unwrap_or(u)));
            log.held.push(u);
            log.angle.push(q);
            log.speed.push(w);
            for _ in 0..self.steps {
                let next = self.speed_after(w, u, h);
                q += 0.5 * (w + next) * h;
                w = next;
            }
        }
        log
    }

    fn speed_after(&self, w: f64, u: f64, h: f64) -> f64 {
        if w == 0.0 && u.abs() <= self.coulomb {
            return 0.0;
        }
        let direction = if w == 0.0 { u.signum() } else { w.signum() };
        let next = w + (u - direction * self.coulomb - self.viscous * w) / self.inertia * h;
        if next * direction < 0.0 { 0.0 } else { next }
    }
}

/// Two sines of 0.3 and 0.9 Hz: the motion of a test log.
pub fn two_sines(time_s: f64) -> f64 {
    let omega = std::f64::consts::TAU * time_s;
    1.2 * (0.3 * omega).sin() + 0.3 * (0.9 * omega + 0.7).sin()
}
