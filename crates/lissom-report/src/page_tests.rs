use roxmltree::{Document, ParsingOptions};

use super::*;
use crate::page_parts::Severity;
use crate::{Axis, LinePlot, Role, Trace};

const HOSTILE: &str = "<script>alert(\"x\")</script>&'\u{0}";

fn plot() -> LinePlot {
    LinePlot::new(HOSTILE, Axis::linear(HOSTILE), Axis::linear("y")).trace(Trace::line(
        HOSTILE,
        Role::Raw,
        vec![0.0, 1.0],
        vec![0.0, 1.0],
    ))
}

fn full() -> String {
    let finding = Finding {
        run: Some(HOSTILE.to_owned()),
        affects: vec![HOSTILE.to_owned()],
        ..Finding::new(Severity::Info, HOSTILE, HOSTILE)
    };
    let figure = KeyFigure {
        name: HOSTILE.to_owned(),
        value: Some(0.131_97),
        std: Some(0.0012),
        ci95: Some([0.1296, 0.1344]),
        unit: "A".to_owned(),
        doubted_by: vec![HOSTILE.to_owned()],
        ..KeyFigure::default()
    };
    let refused = KeyFigure {
        name: "viscous".to_owned(),
        note: "too few runs".to_owned(),
        ..KeyFigure::default()
    };
    Page::new(HOSTILE)
        .summary(HOSTILE)
        .contents()
        .heading(HOSTILE)
        .heading(HOSTILE)
        .paragraph(HOSTILE)
        .key_figures(HOSTILE, &[figure, refused])
        .table(
            &Table::new("t", &[("a", Cells::Text), (HOSTILE, Cells::Numbers)])
                .row([HOSTILE])
                .row(["1", "2", "3"]),
        )
        .figure(&plot(), HOSTILE)
        .figure(&plot(), "again")
        .figure(&LinePlot::default(), "nothing")
        .findings(&[finding.hint(HOSTILE), Finding::new(Severity::Refusal, "stuck", "No slip.")])
        .details(HOSTILE, HOSTILE)
        .footer(HOSTILE)
        .to_html()
}

#[test]
fn the_page_is_well_formed_and_nothing_breaks_out() {
    let html = full();
    // Written so that it is well-formed XML too, which a parser can check to the last tag.
    let document = Document::parse_with_options(
        &html,
        ParsingOptions { allow_dtd: true, ..ParsingOptions::default() },
    )
    .unwrap();
    let names =
        |name: &'static str| document.descendants().filter(move |n| n.tag_name().name() == name);
    // The data of two figures, and the script of the page.
    let scripts: Vec<_> = names("script").collect();
    assert_eq!(scripts.len(), 3);
    let data: serde_json::Value = serde_json::from_str(scripts[0].text().unwrap()).unwrap();
    assert_eq!(data["title"], HOSTILE);
    assert_eq!(names("figure").count(), 3);
    assert_eq!(names("details").count(), 1);
    assert_eq!(
        names("h1").next().and_then(|n| n.text()).unwrap(),
        HOSTILE.replace('\u{0}', "\u{fffd}")
    );
}

#[test]
fn nothing_is_loaded_and_no_id_clashes() {
    let html = full();
    // The script of the page is tested in a browser.
    let html = html.replace(SCRIPT, "");
    for foreign in ["src=", "url(", "@import"] {
        assert!(!html.contains(foreign), "{foreign}");
    }
    let ids: Vec<&str> =
        html.split(" id=\"").skip(1).filter_map(|rest| rest.split('"').next()).collect();
    let distinct: HashSet<&str> = ids.iter().copied().collect();
    assert_eq!(ids.len(), distinct.len(), "{ids:?}");
    let links = html.split(" href=\"").skip(1).filter_map(|rest| rest.split('"').next());
    for link in links {
        assert!(link.strip_prefix('#').is_some_and(|id| distinct.contains(id)), "{link}");
    }
    let addresses = html.matches("http").count();
    assert_eq!(
        addresses,
        html.matches("http-equiv").count()
            + html.matches("xmlns=\"http://www.w3.org/2000/svg\"").count()
    );
}

#[test]
fn figures_findings_and_refusals_read_right() {
    let html = full();
    let cell = |class: &str, label: &str, text: &str| {
        format!("<td{class} data-label=\"{label}\">{text}</td>")
    };
    let number = " class=\"n\"";
    for expected in [
        cell(number, "value ± standard error", "0.1320 ± 0.0012"),
        cell(number, "95 % interval", "0.1296 … 0.1344"),
        cell("", "quantity", "viscous") + &cell(number, "value ± standard error", "refused"),
        cell("", "note", "too few runs"),
    ] {
        assert!(html.contains(&expected), "{expected}");
    }
    assert!(html.contains("Not drawn: figure &quot;&quot; has no point to draw"));
    assert!(html.find(">info<").unwrap() < html.find("stuck").unwrap(), "in the order given");
    assert!(Page::new("t").findings(&[]).to_html().contains("No findings."));
}

#[test]
fn only_the_script_of_the_page_may_run() {
    use base64::Engine as _;
    use sha2::Digest as _;
    let digest = sha2::Sha256::digest(SCRIPT.as_bytes());
    let hash = base64::engine::general_purpose::STANDARD.encode(digest);
    assert_eq!(SCRIPT_HASH, hash);
    assert!(full().contains(&format!("script-src 'sha256-{hash}';")));
    assert!(!SCRIPT.contains("</script") && SCRIPT.ends_with("//]]>"));
    // A page without figures needs no script.
    assert!(!Page::new("t").paragraph("p").to_html().contains("<script"));
}
