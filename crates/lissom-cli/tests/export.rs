//! `lissom export`: what is written holds the numbers of the result, and a C compiler accepts it.
#![expect(clippy::unwrap_used, reason = "tests")]

mod simulated_axis;

use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::Value;
use tempfile::TempDir;

use simulated_axis::simulated_axis;

/// A folder with the result of a rigid axis.
fn result() -> (TempDir, Value) {
    let folder = simulated_axis();
    let made = ["identify", "made/campaign.toml", "--quick", "--json", "result.json"];
    let (code, _, error) = simulated_axis::lissom(folder.path(), &made);
    assert_eq!(code, Some(0), "{error}");
    let text = fs::read_to_string(folder.path().join("result.json")).unwrap();
    (folder, serde_json::from_str(&text).unwrap())
}

/// Runs the command: exit code and standard error.
fn lissom(folder: &Path, arguments: &[&str]) -> (Option<i32>, String) {
    let (code, _, error) = simulated_axis::lissom(folder, arguments);
    (code, error)
}

fn export(folder: &Path, more: &[&str]) -> (Option<i32>, String) {
    lissom(folder, &[&["export", "result.json", "--to"], more].concat())
}

#[test]
fn the_c_code_compiles_and_gives_the_torque() {
    let (folder, result) = result();
    let (code, error) = export(folder.path(), &["c", "--out", "c"]);
    assert_eq!(code, Some(0), "{error}");
    let main = "#include <stdio.h>\n#include \"lissom_feedforward.h\"\nint main(void) { printf(\"%.9g %.9g %.9g\\n\", \
                lissom_friction(2.0f, 0.3f, 0.1f), lissom_friction(-2.0f, 0.3f, 0.1f), \
                lissom_command(3.0f, 0.0f, 0.0f, 0.1f)); return 0; }\n";
    fs::write(folder.path().join("c/main.c"), main).unwrap();
    let flags = ["-std=c99", "-Wall", "-Wextra", "-Werror", "main.c", "lissom_feedforward.c"];
    let compiled = Command::new("cc")
        .current_dir(folder.path().join("c"))
        .args(flags)
        .args(["-o", "main", "-lm"])
        .output();
    let compiled = compiled.unwrap();
    assert!(compiled.status.success(), "{}", String::from_utf8_lossy(&compiled.stderr));
    let run = Command::new(folder.path().join("c/main")).output().unwrap();
    let printed = String::from_utf8(run.stdout).unwrap();
    let numbers: Vec<f64> = printed.split_whitespace().map(|n| n.parse().unwrap()).collect();
    let arm = |key: &str| result["arm"][key].as_f64().unwrap();
    let near = result["arm"]["near_rest"].as_object().map_or(0.0, |n| {
        let number = |key: &str| n[key].as_f64().unwrap();
        number("amplitude") * (-2.0 / number("speed")).exp()
    });
    let size = arm("coulomb") + near;
    let forward = size + arm("offset") + 2.0 * arm("viscous_forward");
    let backward = -size + arm("offset") - 2.0 * arm("viscous_backward");
    assert!((numbers[0] / forward - 1.0).abs() < 1e-5, "{numbers:?} {forward}");
    assert!((numbers[1] / backward - 1.0).abs() < 1e-5, "{numbers:?} {backward}");
    let command = (3.0 * arm("inertia") + arm("offset")) / 0.5;
    assert!((numbers[2] / command - 1.0).abs() < 1e-5, "{numbers:?} {command}");
}

/// Coulomb friction of a pair: the simulated law has no change near rest, and the estimated one is small.
fn near_coulomb(found: Option<&str>, result: &Value) {
    let (found, coulomb): (f64, _) =
        (found.unwrap().parse().unwrap(), result["arm"]["coulomb"].as_f64().unwrap());
    assert!((found / coulomb - 1.0).abs() < 1e-3, "{found} {coulomb}");
}

const ROBOT: &str = "<?xml version=\"1.0\"?>\n<!-- <joint name=\"elbow\"/> is a comment -->\n<mujoco>\n  <default>\n    \
                     <joint damping=\"1\"/>\n  </default>\n  <worldbody>\n    <body>\n      <joint name=\"elbow\" type='hinge' \
                     damping='9'\n             axis=\"0 0 1\"/>\n      <geom size=\".1\"/>\n    </body>\n  </worldbody>\n  \
                     <actuator><motor joint=\"elbow\"/></actuator>\n</mujoco>\n";

#[test]
fn a_joint_of_a_model_gets_the_numbers_and_nothing_else_changes() {
    let (folder, result) = result();
    fs::write(folder.path().join("robot.xml"), ROBOT).unwrap();
    let into = ["mjcf", "--into", "robot.xml", "--joint", "elbow", "--out", "new.xml"];
    let (code, error) = export(folder.path(), &into);
    assert_eq!(code, Some(0), "{error}");
    let arm = |key: &str| result["arm"][key].as_f64().unwrap().to_string();
    let new = fs::read_to_string(folder.path().join("new.xml")).unwrap();
    let document = roxmltree::Document::parse(&new).unwrap();
    let joint = document.descendants().find(|n| n.attribute("name") == Some("elbow")).unwrap();
    assert_eq!(joint.attribute("armature"), Some(arm("inertia").as_str()));
    near_coulomb(joint.attribute("frictionloss"), &result);
    assert_eq!(joint.attribute("axis"), Some("0 0 1"));
    assert!(new.starts_with(&ROBOT[..ROBOT.find("<joint name=\"elbow\" type").unwrap()]), "{new}");
    assert!(new.ends_with(&ROBOT[ROBOT.find("axis=").unwrap()..]), "{new}");
    let (code, error) = export(
        folder.path(),
        &["mjcf", "--into", "robot.xml", "--joint", "wrist", "--out", "no.xml"],
    );
    assert_eq!(code, Some(1));
    assert!(error.contains("there is no joint \"wrist\"; the joints are \"elbow\""), "{error}");
    assert!(!folder.path().join("no.xml").exists());
    // A file of the user's is not written over, a former output is.
    fs::write(folder.path().join("notes.txt"), "mine").unwrap();
    let (code, error) = export(folder.path(), &["python", "--out", "notes.txt"]);
    assert_eq!(code, Some(1));
    assert!(error.contains("is not an earlier output"), "{error}");
    assert_eq!(export(folder.path(), &into).0, Some(0));
    let slide = ROBOT.replace("'hinge'", "'slide'");
    fs::write(folder.path().join("slide.xml"), slide).unwrap();
    let (code, error) = export(
        folder.path(),
        &["mjcf", "--into", "slide.xml", "--joint", "elbow", "--out", "s.xml"],
    );
    assert_eq!(code, Some(1));
    assert!(error.contains("is of type \"slide\"; the axis of the result needs hinge"), "{error}");
    // The user's own file is not an output.
    let (code, error) = export(
        folder.path(),
        &["mjcf", "--into", "robot.xml", "--joint", "elbow", "--out", "robot.xml"],
    );
    assert_eq!(code, Some(1));
    assert!(error.contains("is an input; it is not overwritten"), "{error}");

    for joint in [
        "<joint name=\"j\" type=\"revolute\"/>",
        "<joint name=\"j\" type=\"continuous\"><dynamics friction=\"3\"/></joint><transmission><joint name=\"j\"/></transmission>",
    ] {
        fs::write(folder.path().join("robot.urdf"), format!("<robot>{joint}</robot>")).unwrap();
        let (code, error) = export(
            folder.path(),
            &["urdf", "--into", "robot.urdf", "--joint", "j", "--out", "new.urdf"],
        );
        assert_eq!(code, Some(0), "{error}");
        let new = fs::read_to_string(folder.path().join("new.urdf")).unwrap();
        let document = roxmltree::Document::parse(&new).unwrap();
        let dynamics: Vec<_> =
            document.descendants().filter(|n| n.has_tag_name("dynamics")).collect();
        assert_eq!(dynamics.len(), 1, "{new}");
        near_coulomb(dynamics[0].attribute("friction"), &result);
        assert!(dynamics[0].attribute("damping").is_some());
    }
}

#[test]
fn a_matlab_file_and_scripts_have_the_model() {
    let (folder, result) = result();
    let (code, error) = export(folder.path(), &["mat", "--out", "arm.mat"]);
    assert_eq!(code, Some(0), "{error}");
    let read = lissom_formats::read(&folder.path().join("arm.mat")).unwrap();
    let den = read.channels.iter().find(|c| c.name == "lissom/den").unwrap();
    let expected: Vec<f64> = result["models"]["motor"]["den"]
        .as_array()
        .unwrap()
        .iter()
        .map(|v| v.as_f64().unwrap())
        .collect();
    assert_eq!(den.values.len(), expected.len());
    for (found, expected) in den.values.iter().zip(&expected) {
        assert!((found - expected).abs() <= 1e-9 * expected.abs(), "{found} {expected}");
    }
    for (target, name) in [("python", "arm.py"), ("m", "arm.m")] {
        let (code, error) = export(folder.path(), &[target, "--out", name]);
        assert_eq!(code, Some(0), "{error}");
        let text = fs::read_to_string(folder.path().join(name)).unwrap();
        let coulomb = result["arm"]["coulomb"].as_f64().unwrap().to_string();
        assert!(text.contains(&coulomb), "{target}: {text}");
    }
    let (code, error) = export(folder.path(), &["mjcf", "--out", "arm.xml"]);
    assert_eq!(code, Some(0), "{error}");
    let text = fs::read_to_string(folder.path().join("arm.xml")).unwrap();
    let document = roxmltree::Document::parse(&text).unwrap();
    let motor = document.descendants().find(|n| n.attribute("name") == Some("motor")).unwrap();
    let joint = motor.children().find(|n| n.has_tag_name("joint")).unwrap();
    near_coulomb(joint.attribute("frictionloss"), &result);
    let (code, error) =
        lissom(folder.path(), &["export", "axis.toml", "--to", "python", "--out", "known.py"]);
    assert_eq!(code, Some(0), "{error}");
    assert!(fs::read_to_string(folder.path().join("known.py")).unwrap().contains("dry = 0.25"));
    let (code, error) = export(folder.path(), &["urdf", "--out", "arm.urdf"]);
    assert_eq!(code, Some(1));
    assert!(error.contains("--into robot.urdf --joint NAME"), "{error}");
}

/// A uniform beam with a payload, and a friction law that changes near rest.
const UNIFORM: &str = r#"
[beam]
flexural_rigidity = "1.4 N*m^2"
mass_per_length = "0.162 kg/m"
spans = [{ length = "0.5 m" }]
payload = { mass = "0.1 kg" }
damping = { mass_proportional = "0.2 1/s", stiffness_proportional = "2e-4 s" }
[drive]
inertia = "2e-3 kg*m^2"
viscous = "5e-2 N*m*s/rad"
torque_constant = "0.2 N*m/A"
coulomb = "0.05 N*m"
rest = { friction = "0.09 N*m", velocity = "0.4 rad/s" }
"#;
/// Two masses on spans without mass.
const TWO: &str = r#"
[beam]
flexural_rigidity = "0.9 N*m^2"
spans = [{ length = "0.2 m", mass = "0.15 kg" }, { length = "0.3 m", mass = "0.1 kg" }]
damping = { ratios = [0.01, 0.03] }
[drive]
inertia = "1e-3 kg*m^2"
torque_constant = "0.2 N*m/A"
"#;
/// Relative error of mass and inertia \[1\]: links without mass have 1e-10 of the beam's each.
const LINKS: f64 = 1e-8;
/// Relative error of the tip's flexibility \[1\]: two Gauss points are exact, this is rounding.
const FLEXIBILITY: f64 = 1e-12;

/// A chain, added up: mass, inertia about the motor's axis, and the tip's flexibility `Σ (L − x)²/k`.
fn chain(text: &str, length: f64) -> (f64, f64, f64) {
    let document = roxmltree::Document::parse(text).unwrap();
    let number = |n: roxmltree::Node<'_, '_>, key: &str| -> Vec<f64> {
        let words = n.attribute(key).unwrap().split_whitespace();
        words.map(|w| w.parse().unwrap()).collect()
    };
    let (mut mass, mut inertia, mut flexibility) = (0.0, 0.0, 0.0);
    for body in document.descendants().filter(|n| n.has_tag_name("body")) {
        let bodies = body.ancestors().filter(|n| n.has_tag_name("body"));
        let at: f64 = bodies.map(|b| number(b, "pos")[0]).sum();
        let child = |tag: &str| body.children().find(|n| n.has_tag_name(tag)).unwrap();
        let (inertial, joint) = (child("inertial"), child("joint"));
        let centre = at + number(inertial, "pos")[0];
        let m = number(inertial, "mass")[0];
        mass += m;
        inertia += m * centre * centre + number(inertial, "diaginertia")[2];
        if joint.has_attribute("stiffness") {
            flexibility += (length - at).powi(2) / number(joint, "stiffness")[0];
        }
    }
    (mass, inertia, flexibility)
}

#[test]
fn a_beam_of_known_dimensions_becomes_a_chain_with_its_mass_inertia_and_flexibility() {
    let folder = tempfile::tempdir().unwrap();
    let near = |found: f64, wanted: f64, most: f64| {
        assert!((found / wanted - 1.0).abs() < most, "{found} {wanted}");
    };
    let made = |name: &str, arm: &str| {
        fs::write(folder.path().join("arm.toml"), arm).unwrap();
        let to = ["export", "arm.toml", "--to", "mjcf", "--out", name];
        let (code, error) = lissom(folder.path(), &to);
        assert_eq!(code, Some(0), "{error}");
        fs::read_to_string(folder.path().join(name)).unwrap()
    };
    let (l, mu, payload) = (0.5_f64, 0.162, 0.1);
    let text = made("uniform.xml", UNIFORM);
    let (mass, inertia, flexibility) = chain(&text, l);
    near(mass, mu * l + payload, LINKS);
    near(inertia, mu * l.powi(3) / 3.0 + payload * l * l, LINKS);
    near(flexibility, l.powi(3) / (3.0 * 1.4), FLEXIBILITY);
    assert!(text.contains("<site name=\"mass_1\""), "{text}");
    // Friction is a line through the whole law, here up to 5 times 0.4 rad/s.
    let document = roxmltree::Document::parse(&text).unwrap();
    let motor = document.descendants().find(|n| n.has_tag_name("joint")).unwrap();
    let loss: f64 = motor.attribute("frictionloss").unwrap().parse().unwrap();
    let decay = (-5.0_f64).exp();
    let (m0, m1) = ((1.0 - decay) / 5.0, (1.0 - 6.0 * decay) / 25.0);
    near(loss, 0.05 + 0.04 * (4.0 * m0 - 6.0 * m1), 1e-9);
    assert!(
        text.contains(
            "line of least squares through the whole law, which from 0 to 2.0000e0 rad/s"
        ),
        "{text}"
    );

    let text = made("two.xml", TWO);
    let (mass, inertia, flexibility) = chain(&text, l);
    near(mass, 0.25, LINKS);
    near(inertia, 0.15 * 0.04 + 0.1 * 0.25, LINKS);
    near(flexibility, l.powi(3) / (3.0 * 0.9), FLEXIBILITY);
    assert!(text.contains("<site name=\"mass_2\"") && text.contains("mode_1_damper"), "{text}");

    let many = TWO.replace("0.1 kg\" }]", "0.1 kg\", count = 200 }]");
    fs::write(folder.path().join("arm.toml"), many).unwrap();
    let to = ["export", "arm.toml", "--to", "mjcf", "--out", "many.xml"];
    let (code, error) = lissom(folder.path(), &to);
    assert_eq!(code, Some(1));
    assert!(error.contains("a beam of 201 spans needs more than 200 hinges"), "{error}");
}
