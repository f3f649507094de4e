//! Measures the writer: MB/s appended, the cost of a flush, and the same late in a long run.
//!
//! `cargo run --release -p gyration-record --example appending -- FOLDER [ROWS]`

use gyration_record::{
    ArraySpec, Attributes, Dimension, Layout, RecordError, Recording, Writer, chunk_rows_for, export,
};
use std::path::Path;
use std::time::Instant;

fn main() -> Result<(), RecordError> {
    let folder = std::env::args().nth(1).unwrap_or_else(|| ".".into());
    let rows = std::env::args().nth(2).and_then(|rows| rows.parse().ok()).unwrap_or(400_000);
    let path = Path::new(&folder).join("appending.gyr");
    // Like one rigid body: position, P, velocity, Ṗ, gap, force and sixteen entries of the ledger.
    let sizes: [&[usize]; 6] = [&[3], &[3, 3], &[3], &[3, 3], &[], &[3]];
    let dims = |sizes: &[usize]| {
        let names = ["row", "col"].iter().skip(2 - sizes.len());
        sizes.iter().zip(names).map(|(size, name)| Dimension::new(*name, *size)).collect()
    };
    let shapes = sizes.into_iter().chain(std::iter::repeat_n(&[] as &[usize], 16));
    let spec = |(at, sizes)| ArraySpec { name: format!("a{at}"), dims: dims(sizes), ..ArraySpec::default() };
    let mut layout = Layout { arrays: shapes.enumerate().map(spec).collect(), ..Layout::default() };
    let row = (0..layout.row_len()).map(|i| (i as f64).sin()).collect::<Vec<_>>();
    layout.chunk_rows = chunk_rows_for(row.len(), rows);
    let megabytes = (rows * (row.len() + 1) * 8) as f64 / 1e6;
    println!("{rows} rows of {} numbers, {megabytes:.0} MB, {} rows a chunk", row.len(), layout.chunk_rows);

    let mut writer = Writer::create(&path, &layout, Attributes::new())?;
    for part in 1..=4 {
        let start = Instant::now();
        for k in writer.rows()..rows * part / 4 {
            writer.append(k as f64, &row)?;
        }
        let rate = megabytes / 4.0 / start.elapsed().as_secs_f64();
        let mut slowest = 0.0_f64;
        let mut sum = 0.0;
        for k in 0..20 {
            writer.append(k as f64, &row)?;
            let start = Instant::now();
            writer.flush(&[0; 1000])?;
            let seconds = start.elapsed().as_secs_f64();
            (sum, slowest) = (sum + seconds, slowest.max(seconds));
        }
        println!("quarter {part}: {rate:.0} MB/s, flush {:.2} ms, slowest {:.2} ms", sum / 20.0 * 1e3, slowest * 1e3);
    }
    writer.finish(Attributes::new(), &[])?;
    let recording = Recording::open(&path)?;
    let start = Instant::now();
    export::npz(&recording, &path.with_extension("npz"))?;
    println!("npz: {:.0} MB/s", megabytes / start.elapsed().as_secs_f64());
    gyration_record::remove(&path)
}
