//! What is told of a table beside its rows: in the metadata of the Parquet files, and in `study.json`.

use super::shard::Shard;
use crate::parameter::{AxisValues, Distribution, Parameter, Variation};
use crate::study::Study;
use serde_json::{Value as Json, json};

/// What a reader of the table can use: columns with units, parameters, what is kept, how it is drawn.
pub(crate) fn describe(study: &Study) -> Json {
    let kept: Vec<&String> = study.keeps().iter().map(|(name, _)| name).collect();
    json!({
        "name": study.name(),
        "title": study.title(),
        "columns": study.columns(),
        "parameters": study.parameters().iter().map(describe_parameter).collect::<Vec<_>>(),
        "kept": kept,
        "axes": study.axes(),
        "repetitions": study.repetitions(),
        "runs": study.runs(),
        "seed": study.read.seed,
        "sampling": study.read.sampling,
        "plot": study.plot(),
        "fingerprint": study.fingerprint(),
        "version": env!("CARGO_PKG_VERSION"),
    })
}

fn describe_parameter(parameter: &Parameter) -> Json {
    let columns: Vec<&String> = parameter.columns().iter().map(|column| &column.name).collect();
    let mut told = json!({
        "name": parameter.name,
        "keys": parameter.keys,
        "unit": parameter.unit,
        "columns": columns,
    });
    match &parameter.variation {
        Variation::Axis { axis, steps } => {
            let is_logarithmic = matches!(steps, AxisValues::Grid { is_logarithmic: true, .. });
            told["axis"] = json!(axis);
            told["count"] = json!(steps.count());
            told["scale"] = json!(if is_logarithmic { "log" } else { "linear" });
        }
        Variation::Random { distribution, .. } => {
            let (word, numbers) = match *distribution {
                Distribution::Uniform { from, to } => ("uniform", vec![from, to]),
                Distribution::LogUniform { from, to } => ("log_uniform", vec![from, to]),
                Distribution::Normal { mean, deviation } => ("normal", vec![mean, deviation]),
                Distribution::Rotation => ("rotation", Vec::new()),
                Distribution::Direction { from, to } => ("direction", vec![from, to]),
            };
            told["random"] = json!({ "distribution": word, "numbers": numbers });
            told["scale"] = json!(if word == "log_uniform" { "log" } else { "linear" });
        }
    }
    told
}

/// The content of `study.json`.
pub(crate) fn manifest(study: &Study, shard: Shard) -> Json {
    let mut manifest = describe(study);
    let read = &study.read;
    let settings: serde_json::Map<String, Json> =
        read.settings.iter().map(|(key, value)| (key.clone(), json!(value))).collect();
    let overrides = study.overrides(&study.values(study.place(0)));
    let overrides: Vec<String> = overrides.iter().map(ToString::to_string).collect();
    manifest["shard"] = json!({ "number": shard.number(), "count": shard.count() });
    manifest["recordings"] = json!(read.recordings);
    manifest["max_steps"] = json!(read.max_steps);
    manifest["set"] = Json::Object(settings);
    manifest["first_run"] = json!(overrides);
    manifest["study"] = json!({ "text": study.source().text, "overrides": study.source().overrides });
    manifest["scene"] = json!({ "name": study.template().name(), "text": study.template().text() });
    manifest
}
