//! Figures, tables and the report page of results.
//!
//! The crate makes views of what `lissom` has computed. Its functions are pure: they take results and give plots, tables and
//! HTML of `lissom-report`. They print nothing and write no file; a program does this with what they give.
//!
//! | view | of |
//! |---|---|
//! | [`report_page::page`] | an identification, as one self-contained HTML document |
//! | [`page_figures()`] | the same as the page, figure by figure |
//! | [`result_figures()`] | an identification: Bode plots, friction against speed |
//! | [`parameter_rows()`] | an identification: one row for each parameter |
//! | [`validation_plots()`] | the prediction of another log |
//! | [`compare_page::page`] | results side by side, as a page |
//! | [`equivalent_plots`], [`equivalent_section`] | an equivalent arm |
//! | [`payload_plot`] | a prediction with other payloads |
//! | `fleet_page` (feature `fleet`) | a fleet |
//!
//! ```
//! use lissom::prelude::*;
//! use lissom_views::report_page::{self, PageContent};
//! use lissom_views::{ProgramHints, own_logs, result_figures};
//!
//! # let arm = Arm::builder().motor(Motor::builder().inertia_kg_m2(2e-3)).coulomb_nm(0.02).build()?;
//! # let rig = Rig::builder(arm).sample_time_s(3e-3).controller(Pd::new(8.0, 0.25)?).build()?;
//! # let logs = rig.campaign([1.0, 3.0].map(|w| Experiment::sine(w, 0.5, 20.0)))?;
//! # let campaign: &Campaign = logs.as_ref();
//! let found = Identify::new(campaign).effort(Effort::Quick).run()?;
//! let result = found.file();
//! let own = own_logs(campaign, found.arm());
//! let logs = own.as_ref().map(|own| (campaign, own));
//! let hints = &ProgramHints::NONE;
//! let content = PageContent { result: &result, logs, reference: None, hints };
//! let page = report_page::page("My axis", content);
//! let html = page.to_html();
//! assert!(html.contains("Coulomb friction"));
//! let figures = result_figures(&result, None);
//! assert_eq!(figures[0].name, "bode-motor");
//! let svg = figures[0].figure.to_svg()?;
//! # assert!(svg.starts_with("<svg"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod arm_check;
pub mod bode_plots;
pub mod compare_page;
pub mod compare_words;
pub mod digits;
pub mod equivalent_plots;
pub mod equivalent_section;
#[cfg(feature = "fleet")]
pub mod fleet_page;
pub mod friction_curve;
pub mod friction_speeds;
pub mod known_arm;
mod named_figure;
mod own_logs;
pub mod page_figures;
pub mod parameter_rows;
pub mod payload_plot;
mod pole_zero_map;
mod program_hints;
pub mod report_page;
mod result_figures;
pub mod run_table;
mod separability_section;
pub mod slip_windows;
pub mod third_harmonic;
pub mod unused_torque;
mod validation_plots;
pub mod velocity_friction;

pub use known_arm::Reference;
pub use named_figure::NamedFigure;
pub use own_logs::own_logs;
pub use page_figures::page_figures;
pub use parameter_rows::parameter_rows;
pub use program_hints::ProgramHints;
pub use result_figures::result_figures;
pub use validation_plots::validation_plots;
