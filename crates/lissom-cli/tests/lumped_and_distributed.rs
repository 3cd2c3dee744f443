//! `docs/src/theory/lumped-and-distributed.md` shows the tables that its command prints.

#[path = "../examples/lumped_to_distributed/convergence.rs"]
mod convergence;
#[path = "../examples/lumped_to_distributed/inertia.rs"]
mod inertia;
#[path = "../examples/lumped_to_distributed/tables.rs"]
mod tables;

#[test]
fn the_page_shows_what_the_command_prints() {
    let path =
        concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/src/theory/lumped-and-distributed.md");
    let page = std::fs::read_to_string(path).unwrap();
    for (title, table) in tables::all().unwrap() {
        assert!(page.contains(&table), "{title}: the page has another table than\n{table}");
    }
}
