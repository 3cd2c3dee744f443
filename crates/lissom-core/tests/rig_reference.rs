//! The rig against an independent solution of the same equations.
//!
//! The reference was computed in 50-digit arithmetic (Taylor series between events, isolated roots
//! for the events) by a program that shares nothing with this one; it agrees with an adaptive
//! Runge-Kutta of order 8 with events, and with matrix exponentials, to 3e-13 over 12 s.

#![expect(clippy::unwrap_used, reason = "tests")]

use lissom::arm::Arm;
use lissom::drive::Coulomb;
use lissom::rig::{HeldArm, HeldMotion, Hybrid, Mode, Motion, Quantiser};
use lissom_testmodels::report_arm;

/// Angles agree to this \[rad\]: the reference's own agreement is 2e-14.
const ANGLE_RAD: f64 = 1e-12;
/// Velocities and currents agree to this \[rad/s, A\]: the derivative gain amplifies rounding.
const RATE: f64 = 2e-11;
/// Time spent sticking agrees to this \[s\]: events are where velocities vanish.
const STUCK_S: f64 = 1e-11;
const SAMPLE_TIME_S: f64 = 0.003;
const LIMIT_A: f64 = 4.12;

struct Case {
    name: &'static str,
    amplitude_rad: f64,
    omega_rad_s: f64,
    gains: (f64, f64),
    bits: Option<u32>,
    coulomb: (f64, f64),
    initial: [f64; 4],
    /// Samples of 3 ms to run.
    steps: usize,
    /// Phases of sticking begun (a start at rest counts) and their total time \[s\].
    sticks: (usize, f64),
    /// Sample, θ_m, θ̇_m, θ_t, θ̇_t, current that acts from it on.
    samples: &'static [(usize, f64, f64, f64, f64, f64)],
}

const SYM_A0_5_W3: Case = Case {
    name: "sym_A0.5_w3",
    amplitude_rad: 0.5,
    omega_rad_s: 3.0,
    gains: (8.0, 0.2),
    bits: None,
    coulomb: (0.032_572_170_390_713_56, 0.032_572_170_390_713_56),
    initial: [0.0, 0.0, 0.0, 0.0],
    steps: 4000,
    sticks: (12, 1.057_051_164_880_843_8),
    samples: &[
        (
            100,
            0.368_492_834_792_848_44,
            0.958_317_905_446_938_8,
            0.199_152_436_859_081_9,
            1.760_003_640_464_698_4,
            0.180_322_913_284_018_3,
        ),
        (
            500,
            -0.478_791_146_100_495,
            -0.264_646_689_643_076_36,
            -0.586_835_685_534_985_9,
            1.228_911_323_769_602,
            -0.090_052_587_828_446_33,
        ),
        (
            1000,
            0.224_637_138_486_321_33,
            -1.435_315_716_508_606_8,
            0.195_507_571_981_932_33,
            -3.124_832_745_819_213,
            -0.134_915_705_697_697_9,
        ),
        (
            2000,
            -0.402_421_220_776_728_6,
            0.959_086_382_015_701_4,
            -0.649_906_422_992_938_9,
            0.288_961_223_866_415_7,
            0.221_748_684_087_347_05,
        ),
        (
            3999,
            -0.490_984_202_540_560_24,
            -0.211_223_290_123_407_26,
            -0.781_160_331_613_049_5,
            -0.073_097_960_545_370_17,
            -0.033_202_122_199_720_935,
        ),
    ],
};

const SYM_A0_2_W9: Case = Case {
    name: "sym_A0.2_w9",
    amplitude_rad: 0.2,
    omega_rad_s: 9.0,
    gains: (8.0, 0.2),
    bits: None,
    coulomb: (0.032_572_170_390_713_56, 0.032_572_170_390_713_56),
    initial: [0.0, 0.0, 0.0, 0.0],
    steps: 4000,
    sticks: (35, 1.440_458_268_052_377),
    samples: &[
        (
            100,
            0.106_434_386_197_917_52,
            -1.579_604_324_539_000_1,
            0.169_031_910_785_379_05,
            1.059_118_452_687_195_7,
            -0.177_102_021_732_481_19,
        ),
        (
            500,
            0.137_452_042_949_252_98,
            0.944_435_381_751_199_1,
            -0.208_065_588_107_794_35,
            -2.921_069_983_626_188_6,
            0.211_845_804_414_359_1,
        ),
        (
            1000,
            0.175_029_142_241_034_52,
            0.0,
            -0.098_249_012_677_204_44,
            1.838_536_608_736_336_8,
            0.029_458_858_714_182_305,
        ),
        (
            2000,
            -0.086_185_228_662_846_99,
            -1.376_527_960_168_599,
            0.271_872_170_107_444_6,
            2.439_960_880_012_383_5,
            -0.227_950_416_327_456_55,
        ),
        (
            3999,
            0.164_516_780_963_426_15,
            0.667_108_049_241_389_3,
            -0.036_976_951_447_260_81,
            -1.191_431_865_133_613_8,
            0.160_849_005_563_269_86,
        ),
    ],
};

const ASYM_A0_3_W5: Case = Case {
    name: "asym_A0.3_w5",
    amplitude_rad: 0.3,
    omega_rad_s: 5.0,
    gains: (8.0, 0.2),
    bits: None,
    coulomb: (0.037_013_829_989_447_23, 0.027_143_475_325_594_635),
    initial: [0.0, 0.0, 0.0, 0.0],
    steps: 4000,
    sticks: (21, 1.271_138_957_924_257),
    samples: &[
        (
            100,
            0.277_855_751_027_842_3,
            0.153_261_424_599_341_72,
            0.180_198_532_841_694_38,
            1.487_206_443_891_127,
            0.161_861_563_923_515_78,
        ),
        (
            500,
            0.277_281_913_557_663_3,
            0.703_655_197_006_242_8,
            0.729_155_832_381_291_8,
            5.034_846_353_883_760_5,
            -0.003_816_800_730_845_697_3,
        ),
        (
            1000,
            0.220_398_869_372_833_65,
            -1.303_970_287_612_981_5,
            0.358_981_505_981_281_2,
            -5.535_338_178_282_501,
            -0.169_697_522_820_647_43,
        ),
        (
            2000,
            -0.312_847_253_248_801_3,
            0.0,
            -1.061_309_278_334_917_6,
            -1.522_975_948_372_319_3,
            0.175_552_798_352_590_94,
        ),
        (
            3999,
            -0.084_767_369_832_717_39,
            -1.521_794_734_922_437_2,
            -0.445_392_658_482_093_75,
            -3.163_128_031_063_799,
            -0.001_646_074_614_640_466_3,
        ),
    ],
};

const CREEP_A0_05_W0_5: Case = Case {
    name: "creep_A0.05_w0.5",
    amplitude_rad: 0.05,
    omega_rad_s: 0.5,
    gains: (8.0, 0.2),
    bits: None,
    coulomb: (0.032_572_170_390_713_56, 0.032_572_170_390_713_56),
    initial: [0.0, 0.0, 0.0, 0.0],
    steps: 4000,
    sticks: (3, 5.427_407_416_758_11),
    samples: &[
        (100, 0.0, 0.0, 0.0, 0.0, 0.064_719_666_918_066_03),
        (
            500,
            0.017_692_405_896_317_848,
            0.017_911_314_695_265_003,
            0.020_601_132_799_079_627,
            0.004_793_140_692_860_458,
            0.131_190_788_228_082_03,
        ),
        (
            1000,
            0.033_298_421_851_217_31,
            0.002_297_449_779_195_602_6,
            0.031_572_089_285_258_974,
            0.018_198_028_890_665_272,
            0.132_506_216_465_484_86,
        ),
        (
            2000,
            0.023_659_312_361_614_66,
            -0.024_707_155_964_399_558,
            0.025_922_648_684_288_743,
            -0.025_765_185_331_324_25,
            -0.132_836_075_482_849_76,
        ),
        (
            3999,
            -0.030_612_713_014_672_336,
            0.022_873_020_662_130_854,
            -0.032_687_492_044_240_25,
            -0.004_685_756_401_958_219_4,
            0.132_783_882_136_367_55,
        ),
    ],
};

const FREE_RELEASE: Case = Case {
    name: "free_release",
    amplitude_rad: 0.0,
    omega_rad_s: 1.0,
    gains: (0.0, 0.0),
    bits: None,
    coulomb: (0.037_013_829_989_447_23, 0.027_143_475_325_594_635),
    initial: [0.0, 0.0, 0.25, 6.0],
    steps: 4000,
    sticks: (2, 11.682_497_364_257_468),
    samples: &[
        (
            100,
            0.622_989_614_569_678,
            2.805_798_683_613_520_3,
            0.875_616_605_762_153_2,
            -1.717_994_169_843_476_9,
            0.0,
        ),
        (
            500,
            0.713_839_018_907_443_5,
            0.0,
            0.446_612_684_476_602_74,
            -0.983_399_014_152_271_2,
            0.0,
        ),
        (
            1000,
            0.713_839_018_907_443_5,
            0.0,
            1.006_032_491_309_476_7,
            0.168_880_878_006_584_88,
            0.0,
        ),
        (2000, 0.713_839_018_907_443_5, 0.0, 0.909_746_716_346_624, -1.208_190_477_270_267_8, 0.0),
        (3999, 0.713_839_018_907_443_5, 0.0, 0.545_604_912_518_905_9, -0.966_116_683_028_884, 0.0),
    ],
};

const BITS12_A0_5_W3: Case = Case {
    name: "bits12_A0.5_w3",
    amplitude_rad: 0.5,
    omega_rad_s: 3.0,
    gains: (8.0, 0.2),
    bits: Some(12),
    coulomb: (0.032_572_170_390_713_56, 0.032_572_170_390_713_56),
    initial: [0.0, 0.0, 0.0, 0.0],
    steps: 300,
    sticks: (2, 0.105_156_023_801_655_2),
    samples: &[
        (1, 0.0, 0.0, 0.0, 0.0, 0.335_995_464_018_370_77),
        (
            2,
            0.000_361_780_766_949_444_9,
            0.240_900_609_686_825_4,
            1.170_335_675_541_041_7e-8,
            1.559_881_098_218_218_8e-5,
            0.371_967_762_571_458_6,
        ),
        (
            10,
            0.023_769_559_217_399_514,
            1.411_174_552_209_343_3,
            7.202_475_498_660_611e-5,
            0.010_106_968_461_335_778,
            0.269_808_852_061_448_67,
        ),
        (
            50,
            0.194_937_001_464_415_23,
            1.383_240_144_207_715_6,
            0.026_033_648_780_528_343,
            0.548_071_608_435_837_5,
            0.145_259_181_793_226_64,
        ),
        (
            100,
            0.368_552_652_774_508_1,
            1.007_912_358_952_184_3,
            0.199_221_040_966_756_44,
            1.759_928_447_934_256,
            0.171_071_711_212_390_6,
        ),
        (
            150,
            0.473_050_359_875_787_75,
            0.449_851_808_416_885_05,
            0.516_103_028_472_009_3,
            2.231_179_926_034_151_6,
            0.087_917_720_893_606_43,
        ),
        (
            200,
            0.490_494_207_171_072_67,
            0.0,
            0.784_009_958_405_707_4,
            1.065_510_563_137_271_2,
            -0.098_445_316_290_107_1,
        ),
        (
            250,
            0.421_008_082_135_616_97,
            -0.899_995_403_494_322_3,
            0.784_060_174_353_493_1,
            -1.139_253_512_556_554,
            -0.233_061_478_773_882_59,
        ),
        (
            299,
            0.245_587_153_003_982_34,
            -1.426_565_323_613_031_3,
            0.462_773_144_136_639_17,
            -3.073_596_801_057_824_3,
            -0.184_167_989_840_566_15,
        ),
        (
            300,
            0.241_344_848_238_118_47,
            -1.401_965_309_533_237_6,
            0.453_511_390_367_905_44,
            -3.100_796_737_791_595_3,
            -0.181_005_213_255_862_55,
        ),
    ],
};

fn near(case: &str, k: usize, what: &str, found: f64, expected: f64, tolerance: f64) {
    let error = (found - expected).abs();
    assert!(error <= tolerance, "{case}, sample {k}: {what} {found}, reference {expected}");
}

/// One of the ways of moving on.
trait Way {
    fn state(&self) -> &[f64];
    fn mode(&self) -> Mode;
    fn sticks(&self) -> usize;
    fn stuck_s(&self) -> f64;
    fn sample(&mut self, torque: f64);
}

/// By the events' polynomials.
impl Way for Hybrid<'_> {
    fn state(&self) -> &[f64] {
        Hybrid::state(self)
    }
    fn mode(&self) -> Mode {
        Hybrid::mode(self)
    }
    fn sticks(&self) -> usize {
        Hybrid::sticks(self)
    }
    fn stuck_s(&self) -> f64 {
        Hybrid::stuck_s(self)
    }
    fn sample(&mut self, torque: f64) {
        Hybrid::advance(self, torque, SAMPLE_TIME_S);
    }
}

/// By the arm's modes.
impl Way for HeldMotion<'_> {
    fn state(&self) -> &[f64] {
        Motion::state(self)
    }
    fn mode(&self) -> Mode {
        HeldMotion::mode(self)
    }
    fn sticks(&self) -> usize {
        HeldMotion::sticks(self)
    }
    fn stuck_s(&self) -> f64 {
        Motion::stuck_s(self)
    }
    fn sample(&mut self, torque: f64) {
        self.advance(torque, SAMPLE_TIME_S).unwrap();
    }
}

/// Every way of moving on.
fn run(case: &Case) {
    let base = report_arm();
    let coulomb = Coulomb::by_direction(case.coulomb.0, case.coulomb.1).unwrap();
    let arm = Arm::new(base.beam().clone(), base.motor, coulomb).unwrap();
    run_by(case, &arm, Hybrid::with_state(&arm, case.initial.to_vec()));
    let held = HeldArm::new(&arm, &[SAMPLE_TIME_S]).unwrap().unwrap();
    run_by(case, &arm, HeldMotion::with_state(&held, &case.initial).unwrap());
    // Of a duration that was not prepared.
    let held = HeldArm::new(&arm, &[]).unwrap().unwrap();
    run_by(case, &arm, HeldMotion::with_state(&held, &case.initial).unwrap());
}

fn run_by(case: &Case, arm: &Arm, mut motion: impl Way) {
    let (proportional, derivative) = case.gains;
    let sensor = case.bits.map(|b| Quantiser::new(b, std::f64::consts::TAU).unwrap());
    let started_at_rest = usize::from(motion.mode() == Mode::Stick);
    let mut before = None;
    for k in 0..=case.steps {
        let angle = motion.state()[0];
        let read = sensor.map_or(angle, |s| s.read(angle));
        let reference = case.amplitude_rad * (case.omega_rad_s * k as f64 * SAMPLE_TIME_S).sin();
        let error = reference - read;
        let rate = (error - before.unwrap_or(error)) / SAMPLE_TIME_S;
        let current = (proportional * error + derivative * rate).clamp(-LIMIT_A, LIMIT_A);
        before = Some(error);
        if let Some(s) = case.samples.iter().find(|s| s.0 == k) {
            let x = motion.state();
            near(case.name, k, "θ_m", x[0], s.1, ANGLE_RAD);
            near(case.name, k, "θ̇_m", x[1], s.2, RATE);
            near(case.name, k, "θ_t", x[2], s.3, ANGLE_RAD);
            near(case.name, k, "θ̇_t", x[3], s.4, RATE);
            near(case.name, k, "current", current, s.5, RATE);
        }
        if k < case.steps {
            motion.sample(arm.motor.torque_constant_nm_per_a() * current);
        }
    }
    assert_eq!(motion.sticks() + started_at_rest, case.sticks.0, "{}: sticks", case.name);
    near(case.name, case.steps, "time stuck", motion.stuck_s(), case.sticks.1, STUCK_S);
}

#[test]
fn slow_sine_that_sticks() {
    run(&SYM_A0_5_W3);
}

#[test]
fn faster_sine() {
    run(&SYM_A0_2_W9);
}

#[test]
fn friction_by_direction_with_a_slip_within_one_sample() {
    run(&ASYM_A0_3_W5);
}

#[test]
fn creep() {
    run(&CREEP_A0_05_W0_5);
}

#[test]
fn release_of_the_beam_moves_the_motor_between_samples() {
    run(&FREE_RELEASE);
}

#[test]
fn twelve_bits() {
    run(&BITS12_A0_5_W3);
}
