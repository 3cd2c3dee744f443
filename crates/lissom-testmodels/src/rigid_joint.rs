//! A rigid joint with friction under a position loop, and its log.

/// J·q̈ = u − V·q̇ − (C + μ·|load(q)|)·sign(q̇) − load(q), per unit of the current; friction may be another function of speed.
#[derive(Debug, Clone, Copy)]
pub struct RigidJoint {
    /// Inertia J.
    pub inertia: f64,
    /// Viscous friction V.
    pub viscous: f64,
    /// Coulomb friction C.
    pub coulomb: f64,
    /// Friction over the magnitude of the speed, in place of C + V·|q̇|.
    pub friction: Option<fn(f64) -> f64>,
    /// Coulomb and viscous friction backward, where they are others.
    pub backward: Option<[f64; 2]>,
    /// Torque of a load at an angle.
    pub load: fn(f64) -> f64,
    /// Friction that the load adds, per its size.
    pub per_load: f64,
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
        Self {
            inertia: 0.01,
            viscous: 0.02,
            coulomb: 0.15,
            friction: None,
            backward: None,
            load: |_| 0.0,
            per_load: 0.0,
            sample_time_s: 2e-3,
            steps: 10,
        }
    }
}

impl RigidJoint {
    /// Follows a reference \[rad\] for `samples` samples, from rest at 0, in a loop of 10 Hz and damping 0.7.
    pub fn follow(&self, samples: usize, reference: impl Fn(f64) -> f64) -> RigidLog {
        let omega = std::f64::consts::TAU * 10.0;
        self.drive(samples, |t, q, w| {
            self.inertia * (omega * omega * (reference(t) - q) - 1.4 * omega * w)
        })
    }

    /// Is driven by a current of time, angle and speed for `samples` samples, from rest at 0.
    pub fn drive(&self, samples: usize, command: impl Fn(f64, f64, f64) -> f64) -> RigidLog {
        let (mut q, mut w) = (0.0_f64, 0.0_f64);
        let mut log = RigidLog {
            time_s: (0..samples).map(|k| k as f64 * self.sample_time_s).collect(),
            held: Vec::with_capacity(samples),
            measured: Vec::with_capacity(samples),
            angle: Vec::with_capacity(samples),
            speed: Vec::with_capacity(samples),
        };
        let h = self.sample_time_s / self.steps as f64;
        for k in 0..samples {
            let u = command(log.time_s[k], q, w);
            log.measured.push(f64::midpoint(u, log.held.last().copied().unwrap_or(u)));
            log.held.push(u);
            log.angle.push(q);
            log.speed.push(w);
            for _ in 0..self.steps {
                let next = self.speed_after(w, u, (self.load)(q), h);
                q += 0.5 * (w + next) * h;
                w = next;
            }
        }
        log
    }

    /// Friction against the motion in a direction (+1 or −1).
    fn braking(&self, speed: f64, load: f64, direction: f64) -> f64 {
        let alone = match (self.backward, self.friction) {
            (Some([coulomb, viscous]), _) if direction < 0.0 => coulomb + viscous * speed,
            (_, Some(of)) => of(speed),
            _ => self.coulomb + self.viscous * speed,
        };
        alone + self.per_load * load.abs()
    }

    fn speed_after(&self, w: f64, command: f64, load: f64, h: f64) -> f64 {
        let torque = command - load;
        let direction = if w == 0.0 { torque.signum() } else { w.signum() };
        if w == 0.0 && torque.abs() <= self.braking(0.0, load, direction) {
            return 0.0;
        }
        let next =
            w + (torque - direction * self.braking(w.abs(), load, direction)) / self.inertia * h;
        if next * direction < 0.0 { 0.0 } else { next }
    }
}

/// Two sines of 0.3 and 0.9 Hz: the motion of a test log.
pub fn two_sines(time_s: f64) -> f64 {
    let omega = std::f64::consts::TAU * time_s;
    1.2 * (0.3 * omega).sin() + 0.3 * (0.9 * omega + 0.7).sin()
}
