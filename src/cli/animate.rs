//! `linkdyn animate`: the mechanism in motion, as a GIF or an animated PNG for slides, or as poses for a paper.

use std::path::PathBuf;

use clap::Args;

use super::exit::{BadInput, Exit, Failure};
use super::measures::{dpi, mark, number_within};
use super::open;
use super::plot::{FilmCurves, film_chart};
use super::results::{Results, extension, write_file};
use super::streams::print;
use linkdyn_ask::shape::for_table;
use linkdyn_ask::text::{Page, count, number};
use linkdyn_output::TIME;
use linkdyn_picture::film::{Film, Format, Length};
use linkdyn_picture::mechanism::{Layout, Mechanism};
use linkdyn_picture::poses::Poses;
use linkdyn_picture::{
    Fault, MOST_FILM_PIXELS, Mark, MovingChart, POINTS_PER_MM, Shape, Side, chart, raster, svg,
};

/// Width of a GIF by default \[pixels\]; pixels per point, so that lines and letters have the size of a screen.
const WIDTH: u32 = 480;
const PIXELS_PER_POINT: f64 = 4.0 / 3.0;
/// Shortest and longest film if none is requested \[s\].
const DURATION: [f64; 2] = [2.0, 12.0];
/// Time of a film that the tails of points show \[s\].
const TAIL: f64 = 0.6;
/// Frames of a film, at most.
const MOST_FRAMES: f64 = 5000.0;
/// Frames that the palette is made from.
const SAMPLES: usize = 8;
/// Where none is requested.
const FPS: f64 = 25.0;
/// Where none is requested in an animated PNG, and the most that screens show.
const SMOOTH_FPS: f64 = 60.0;
/// Programs that show GIFs slow frames of less than two hundredths of a second down.
const MOST_GIF_FPS: f64 = 50.0;
const POSES: usize = 6;
const DPI: f64 = 300.0;

#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub struct Options {
    /// A directory that `run -o` has left, or the results.csv in it
    #[arg(value_name = "RESULTS")]
    results: PathBuf,
    /// Path or bundled name of the model, for results without summary.json
    #[arg(long, value_name = "MODEL")]
    model: Option<PathBuf>,
    /// File to write: .gif or .apng for a film, .svg or .png for poses
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Columns whose curves stand below the mechanism in a film, with a cursor; * stands for any text, ? for one character
    #[arg(long, value_name = "COLUMN", num_args = 1..)]
    y: Vec<String>,
    /// Column of the x axis of these curves, with or without its [unit]
    #[arg(long, value_name = "COLUMN", default_value = "time", requires = "y")]
    x: String,
    /// Units of these curves, each for all columns that it can measure: deg,mm,rpm,kN
    #[arg(long, value_name = "UNIT,…", value_delimiter = ',', requires = "y")]
    units: Vec<String>,
    /// Thin vertical line at X of these curves, with a text; may be given more than once
    #[arg(long, value_name = "X[=TEXT]", allow_hyphen_values = true, value_parser = mark, requires = "y")]
    mark: Vec<Mark>,
    /// These curves beside the mechanism instead of below
    #[arg(long, requires = "y")]
    beside: bool,
    /// Width: of a film in pixels, of poses in millimetres
    #[arg(long, value_name = "PX|MM", value_parser = width)]
    width: Option<f64>,
    /// Frames per second of a film, 50 at most of a .gif, 60 of an .apng [default: 25 of a .gif, 60 of an .apng]
    #[arg(long, value_name = "N", value_parser = fps)]
    fps: Option<f64>,
    /// Length of a film in seconds; left out: that of the motion, but 2 s at least and 12 s at most
    #[arg(long, value_name = "S", value_parser = duration)]
    duration: Option<f64>,
    /// Number of poses, equally spaced in the driver's value where there is one driver, else in time [default: 6]
    #[arg(long, value_name = "N")]
    poses: Option<usize>,
    /// Poses side by side instead of over each other
    #[arg(long)]
    strip: bool,
    /// Resolution of a PNG [dots per inch] [default: 300]
    #[arg(long, value_name = "DPI", value_parser = dpi)]
    dpi: Option<f64>,
}

const HELP: &str = "  linkdyn run four-bar -o out
  linkdyn animate out -o motion.gif
  linkdyn animate out -o smooth.apng --fps 60
  linkdyn animate out --y driver.motor.effort -o torque.gif
  linkdyn animate out --poses 8 --strip --width 180 -o poses.svg";

/// Reads, draws, writes, tells.
pub fn execute(options: &Options) -> Result<Exit, Failure> {
    let format = extension(&options.output);
    let file = options.output.display();
    if !["gif", "apng", "svg", "png"].contains(&format.as_str()) {
        return Err(BadInput(vec![format!(
            "{file}: the name of the file must end in .gif, .apng, .svg or .png"
        )]));
    }
    idle(options, &format)?;
    let results = Results::open(&options.results)?;
    let fault = |fault: Fault| BadInput(vec![format!("{file}: {fault}")]);
    let shape = shape_of(options, &results)?;
    let poses = Poses::read(&results.table, &shape).map_err(fault)?;
    let mechanism = Mechanism::new(shape, poses).map_err(fault)?;
    let (content, about) = match format.as_str() {
        "gif" => {
            let curves = curves_of(options)?;
            film_of(options, &mechanism, curves.as_ref(), Format::Gif).map_err(fault)?
        }
        "apng" => {
            let curves = curves_of(options)?;
            film_of(options, &mechanism, curves.as_ref(), Format::Apng).map_err(fault)?
        }
        _ => picture_of(options, &mechanism, &format).map_err(fault)?,
    };
    let written = write_file(&options.output, &content)?;
    let mut page = Page::default();
    page.line(format!(
        "{}: {about}, {} kB",
        written.display(),
        number(content.len() as f64 / 1000.0, 3)
    ));
    print(page.text())?;
    Ok(Exit::Done)
}

/// Refuses options that say nothing about a file of that format.
fn idle(options: &Options, format: &str) -> Result<(), Failure> {
    let of_film = [
        ("--fps", options.fps.is_some()),
        ("--duration", options.duration.is_some()),
        ("--y", !options.y.is_empty()),
    ];
    let of_poses = [
        ("--poses", options.poses.is_some()),
        ("--strip", options.strip),
        ("--dpi", options.dpi.is_some()),
    ];
    let (given, what) = match format {
        "gif" => (
            &of_poses[..],
            "poses, and a .gif is a film (write .svg or .png)",
        ),
        "apng" => (
            &of_poses[..],
            "poses, and an .apng is a film (write .svg or .png)",
        ),
        _ => (
            &of_film[..],
            "a film, and this is a picture of poses (write .gif)",
        ),
    };
    let file = options.output.display();
    let too_fast = options
        .fps
        .filter(|fps| format == "gif" && *fps > MOST_GIF_FPS);
    if let Some(fps) = too_fast {
        return Err(BadInput(vec![format!(
            "--fps {fps}: a GIF shows {MOST_GIF_FPS} frames per second at most (write .apng for {SMOOTH_FPS}): {file}"
        )]));
    }
    let lines: Vec<String> = given
        .iter()
        .filter(|(_, is_given)| *is_given)
        .map(|(option, _)| format!("{option}: only for {what}: {file}"))
        .collect();
    if lines.is_empty() {
        Ok(())
    } else {
        Err(BadInput(lines))
    }
}

/// The shape: of the model that was given, else as the run has kept it.
fn shape_of(options: &Options, results: &Results) -> Result<Shape, Failure> {
    if let Some(path) = &options.model {
        let loaded = open::model(path)?;
        return Ok(for_table(&loaded.model, &results.table));
    }
    let path = results.table.path.with_file_name("summary.json");
    if let Some(shape) = results.summary.as_ref().and_then(Shape::of_summary) {
        return shape.map_err(|fault| BadInput(vec![format!("{}: {fault}", path.display())]));
    }
    let why = match (path.exists(), &results.summary) {
        (false, _) => "no such file",
        (true, None) => "not JSON that can be read",
        (true, Some(_)) => "has no key \"drawing\", which tells the shape of the mechanism",
    };
    Err(BadInput(vec![format!(
        "{}: {why} (name the model with --model, or run it again)",
        path.display()
    )]))
}

/// Poses in one picture.
fn picture_of(
    options: &Options,
    mechanism: &Mechanism,
    format: &str,
) -> Result<(Vec<u8>, String), Fault> {
    let layout = if options.strip {
        Layout::Strip
    } else {
        Layout::Overlaid
    };
    let width = options.width.unwrap_or(chart::COLUMN_MM);
    let poses = options.poses.unwrap_or(POSES);
    let scene = mechanism.picture(poses, layout, width)?;
    let content = if format == "svg" {
        svg::write(&scene).into_bytes()
    } else {
        raster::png(&scene, options.dpi.unwrap_or(DPI))?
    };
    let mm = |points: f64| number(points / POINTS_PER_MM, 4);
    Ok((
        content,
        format!(
            "{} × {} mm, {}",
            mm(scene.width),
            mm(scene.height),
            count(poses, "pose")
        ),
    ))
}

/// Width of a film \[pixels\].
fn film_width(options: &Options) -> f64 {
    options.width.unwrap_or(f64::from(WIDTH)).round()
}

/// The curves of a film, if some are requested.
fn curves_of(options: &Options) -> Result<Option<MovingChart>, Failure> {
    if options.y.is_empty() {
        return Ok(None);
    }
    // Peaks between the rows belong to curves, not to poses.
    let mut results = Results::open(&options.results)?;
    results.take_peaks();
    let curves = FilmCurves {
        x: &options.x,
        y: &options.y,
        units: &options.units,
        marks: &options.mark,
    };
    let chart = film_chart(&results, &curves)?;
    let time = results.columns(TIME).into_iter().next();
    let time = time.ok_or_else(|| BadInput(vec![results.unknown("--y", TIME)]))?;
    let time = results.table.values(time)?.to_vec();
    let side = if options.beside {
        Side::Right
    } else {
        Side::Below
    };
    let width = film_width(options) / PIXELS_PER_POINT;
    MovingChart::new(chart, time, side, width)
        .map(Some)
        .map_err(|fault| BadInput(vec![format!("{}: {fault}", options.output.display())]))
}

/// A film.
fn film_of(
    options: &Options,
    mechanism: &Mechanism,
    curves: Option<&MovingChart>,
    format: Format,
) -> Result<(Vec<u8>, String), Fault> {
    let [first, last] = mechanism.span();
    let duration = options
        .duration
        .unwrap_or((last - first).clamp(DURATION[0], DURATION[1]));
    let fps = options.fps.unwrap_or(match format {
        Format::Gif => FPS,
        Format::Apng => SMOOTH_FPS,
    });
    let frames = (duration * fps).round().max(1.0);
    let width = film_width(options) / PIXELS_PER_POINT;
    let own_width = curves.map_or(width, |curves| curves.left_to_mechanism(width));
    // A still picture needs one frame.
    let frames = if last > first { frames } else { 1.0 };
    // Where the end is the beginning it is shown once.
    let steps = if mechanism.returns() {
        frames
    } else {
        (frames - 1.0).max(1.0)
    };
    let tail = TAIL * (last - first) / duration;
    let draw = |frame: f64| {
        let time = first + (last - first) * frame / steps;
        let scene = mechanism.frame(time, tail, own_width);
        let scene = match curves {
            Some(curves) => curves.with(scene, time),
            None => scene,
        };
        raster::draw(&scene, PIXELS_PER_POINT)
    };
    let opening = draw(0.0)?;
    let [w, h] = [opening.width, opening.height].map(u64::from);
    let pixels = (frames * (w * h) as f64) as u64;
    if pixels > MOST_FILM_PIXELS || frames > MOST_FRAMES {
        return Err(Fault::TooMuchFilm(pixels));
    }
    let samples =
        (0..SAMPLES).map(|index| draw((frames - 1.0) * index as f64 / (SAMPLES - 1) as f64));
    let samples = samples.collect::<Result<Vec<_>, _>>()?;
    let length = Length {
        frames: frames as u32,
        duration,
    };
    let mut file = Vec::new();
    let mut film = Film::new(&mut file, format, length, &samples)?;
    for index in 0..length.frames {
        film.push(draw(f64::from(index))?)?;
    }
    film.finish()?;
    let speed = (last - first) / duration;
    let about = format!(
        "{w} × {h} pixels, {} in {} s, {} × real time",
        count(frames as usize, "frame"),
        number(duration, 4),
        number(speed, 3)
    );
    Ok((file, about))
}

fn width(text: &str) -> Result<f64, String> {
    number_within(text, [40.0, 4000.0])
}

fn fps(text: &str) -> Result<f64, String> {
    number_within(text, [0.1, SMOOTH_FPS])
}

fn duration(text: &str) -> Result<f64, String> {
    number_within(text, [0.1, 600.0])
}
