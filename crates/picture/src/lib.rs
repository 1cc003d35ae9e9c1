//! Pictures for papers, slides and browsers: curves over a shared axis, mechanisms in motion, the report of a run.
//!
//! A figure is laid out once, in points (1/72 inch), as a [`Scene`] of lines, areas and texts; [`svg`] and [`raster`] write
//! the same scene, so that both look alike. Texts are measured with the font that the raster is drawn with (Liberation Sans,
//! whose widths are those of Arial and Helvetica), which makes the layout the same on every machine. What a mechanism is made
//! of is described once, as a [`Shape`], and drawn by the same signs in figures, films and pages.
//!
//! | file        | does                                                            |
//! | ----------- | --------------------------------------------------------------- |
//! | `chart`     | what a figure of curves is: panels, curves, axes                |
//! | `layout`    | places its parts on the page                                    |
//! | `scale`     | value → place, ticks, tick labels                               |
//! | `trace`     | values → polylines: gaps, clipping, thinning                    |
//! | `style`     | colours, dashes and markers that differ in grey print too       |
//! | `palette`   | all colours, of figures and of the page                         |
//! | `scene`     | lines, areas, texts                                             |
//! | `sign`      | what a sign is made of, and how it gets onto a page             |
//! | `symbols`   | markers, and the signs of joints, springs, drivers and loads    |
//! | `font`      | the vendored font: widths and outlines                          |
//! | `svg`       | scene → SVG                                                     |
//! | `raster`    | scene → pixels, PNG                                             |
//! | `film`      | pixels → GIF                                                    |
//! | `cut`       | where an axis ends, so that peaks do not flatten the rest       |
//! | `shape`     | what a mechanism is made of, from a model or a summary          |
//! | `poses`     | where its bodies are, from a table of results                   |
//! | `mechanism` | shape and poses → scene, or parts that a page moves             |
//! | `report`    | shape, summary and results → `report.html`                      |
//! | `accuracy_page` | levels, contributions, worst configurations → `report.html` of accuracy |
//! | `charts_page` | figures of curves → a page                                  |
//! | `films_page` | mechanisms in motion → a page                                |
//! | `compare_page` | several runs over each other → `compare.html`                |
//! | `optimise_page` | before and after, history, limits → `report.html` of optimise |
//! | `study_page` | what was varied, what came of it, motions of variants → `report.html` of study |
//! | `watch_page` | the report of each run of `--watch`, and a slider for each parameter |
//! | `validate_page` | claims of validation cases → pages                          |
//! | `numbers`   | numbers of a page as compact text                               |
//! | `html`      | one frame, head, rules and scripts for all pages; data and a policy → one file |
//! | `played`    | scenes → an SVG that moves                                      |
//! | `sheet`     | a page without scripts                                          |
//! | `swing`     | shapes of small motions → a page                                |
//! | `diagnosis` | a model with its names, loops and faults → a page               |
//! | `words`     | names and units as printed                                      |
//! | `fault`     | why a figure can't be drawn                                     |

pub mod accuracy_page;
pub mod chart;
pub mod charts_page;
pub mod compare_page;
mod cut;
pub mod diagnosis;
pub mod film;
pub mod films_page;
pub mod font;
pub mod mechanism;
pub mod optimise_page;
pub mod palette;
pub mod poses;
pub mod raster;
pub mod report;
pub mod scene;
pub mod shape;
pub mod study_page;
pub mod svg;
pub mod swing;
pub mod validate_page;
pub mod watch_page;
pub mod words;

mod fault;
mod html;
mod layout;
mod numbers;
mod played;
mod scale;
mod sheet;
mod sign;
mod style;
mod symbols;
mod trace;

pub use accuracy_page::AccuracyPage;
pub use chart::{Axis, Chart, Curve, Mark, Panel};
pub use compare_page::{ComparePage, ComparedRun};
pub use cut::Cut;
pub use fault::{Fault, MOST_CURVES, MOST_FILM_PIXELS, MOST_PIXELS};
pub use films_page::{MovingMechanism, films_page};
pub use layout::{MovingChart, Side};
pub use mechanism::Mechanism;
pub use optimise_page::OptimisePage;
pub use report::Report;
pub use scene::{POINTS_PER_MM, Scene};
pub use shape::Shape;
pub use study_page::StudyPage;
pub use symbols::hull;
