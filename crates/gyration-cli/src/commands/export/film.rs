//! Films and pictures of the bodies: GIF and PNG by ourselves, MP4 by ffmpeg.

use crate::error::CliError;
use gyration_plot::{Asked, Film, Format, PlotQuantity, TimeSpan, bodies_at, of_recording};
use gyration_record::{Recording, write_file};
use std::io::{self, Write};
use std::path::Path;
use std::process::{Command, Stdio};

/// Pictures a second of an MP4.
const RATE: u32 = 25;

fn film(recording: &Recording, span: TimeSpan) -> Result<Film, CliError> {
    Ok(of_recording(recording, Asked { quantities: &[PlotQuantity::Motion], span, ..Asked::default() })?.film())
}

/// Writes a GIF; tells what it has.
pub fn gif(recording: &Recording, span: TimeSpan, path: &Path) -> Result<String, CliError> {
    let film = film(recording, span)?;
    write_file(path, &film.gif())?;
    Ok(told(&film))
}

/// Writes the bodies at a time; tells which.
pub fn png(recording: &Recording, time: Option<f64>, path: &Path) -> Result<String, CliError> {
    let (figure, time) = bodies_at(recording, time)?;
    write_file(path, &figure.render(Format::Png))?;
    Ok(format!("the bodies at t = {time} s"))
}

/// Writes an MP4 by ffmpeg; tells what it has.
pub fn mp4(recording: &Recording, span: TimeSpan, path: &Path) -> Result<String, CliError> {
    let film = film(recording, span)?;
    let [width, height] = film.size();
    let size = format!("{width}x{height}");
    let rate = RATE.to_string();
    let mut command = Command::new("ffmpeg");
    command.args(["-y", "-loglevel", "error", "-f", "rawvideo", "-pixel_format", "rgba", "-video_size", &size]);
    command.args(["-framerate", &rate, "-i", "-", "-pix_fmt", "yuv420p", "-movflags", "+faststart"]).arg(path);
    let mut encoder =
        command.stdin(Stdio::piped()).stdout(Stdio::null()).spawn().map_err(|fault| no_encoder(&fault))?;
    let fed = encoder.stdin.take().map_or(Ok(()), |mut pictures| feed(&film, &mut pictures));
    let ended = encoder.wait();
    match ended {
        Ok(status) if status.success() && fed.is_ok() => Ok(told(&film)),
        _ => Err(CliError::arguments(
            format!("ffmpeg has not written {}", path.display()),
            "what it says stands above; `--format gif` needs no other program",
        )),
    }
}

/// Every picture as often as it stays.
fn feed(film: &Film, out: &mut impl Write) -> io::Result<()> {
    let (mut ends, mut written) = (0.0, 0);
    for frame in film.frames() {
        ends += frame.stays;
        let until = (ends * f64::from(RATE)).round() as u64;
        for _ in written..until {
            out.write_all(&frame.rgba)?;
        }
        written = until.max(written);
    }
    out.flush()
}

fn no_encoder(fault: &io::Error) -> CliError {
    let message = match fault.kind() {
        io::ErrorKind::NotFound => "a film is written by the program ffmpeg, which is not on this machine".to_owned(),
        _ => format!("ffmpeg, which writes films, cannot be started: {fault}"),
    };
    CliError::arguments(message, "install ffmpeg, or write a GIF: `--format gif`")
}

fn told(film: &Film) -> String {
    let [width, height] = film.size();
    format!("{width} × {height} pixels, {:.1} s", film.lasts())
}
