//! Builds the page of `viewer/` with Node, if there is Node, and hands it to the crate to embed, compressed.
//!
//! A build without a page is a build all the same: the program then says how to get it. `GYRATION_PAGE=FILE` embeds a
//! page built elsewhere, `GYRATION_PAGE=none` none at all. Packages are installed into `viewer/node_modules`, once. In
//! a package from a registry there is no `viewer/`: the page stands beside this file.

use miniz_oxide::deflate::compress_to_vec_zlib;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

/// How hard the page is compressed, of ten.
const LEVEL: u8 = 9;

/// The page of a package.
const PACKAGED: &str = "page.html";

/// What the page is built from, in `viewer/`.
const SOURCES: [&str; 7] =
    ["index.html", "package.json", "package-lock.json", "shaders.ts", "src", "tsconfig.json", "vite.config.ts"];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("cargo:rerun-if-env-changed=GYRATION_PAGE");
    println!("cargo:rerun-if-changed=build.rs");
    let out = PathBuf::from(env::var_os("OUT_DIR").ok_or("cargo sets OUT_DIR")?);
    let viewer = Path::new("../../viewer");
    // A path that is not there would have this run at every build.
    for source in SOURCES.iter().map(|source| viewer.join(source)).filter(|source| source.exists()) {
        println!("cargo:rerun-if-changed={}", source.display());
    }
    let page = out.join("page.html");
    let given = env::var("GYRATION_PAGE");
    let made = match &given {
        Ok(given) if given == "none" => Err("GYRATION_PAGE=none".to_owned()),
        Ok(given) => {
            println!("cargo:rerun-if-changed={given}");
            fs::copy(given, &page).map(drop).map_err(|error| format!("GYRATION_PAGE={given}: {error}"))
        }
        Err(_) if !viewer.exists() => {
            println!("cargo:rerun-if-changed={PACKAGED}");
            fs::copy(PACKAGED, &page).map(drop).map_err(|error| format!("neither viewer/ nor {PACKAGED}: {error}"))
        }
        Err(_) => build(viewer, &out).and_then(|built| {
            fs::copy(&built, &page).map(drop).map_err(|error| format!("{}: {error}", built.display()))
        }),
    };
    let compressed = made.and_then(|()| {
        let html = fs::read(&page).map_err(|error| format!("{}: {error}", page.display()))?;
        let path = page.with_extension("z");
        fs::write(&path, compress_to_vec_zlib(&html, LEVEL)).map_err(|error| format!("{}: {error}", path.display()))
    });
    let constant = match compressed {
        Ok(()) => "Ok(include_bytes!(concat!(env!(\"OUT_DIR\"), \"/page.z\")))".to_owned(),
        Err(reason) => {
            if given.as_deref() != Ok("none") {
                // Tried again at the next build: this path is not there.
                println!("cargo:rerun-if-changed={}", out.join("no-page-yet").display());
            }
            println!("cargo:warning=built without the page of `gyration view` and `gyration report`: {reason}");
            format!("Err({reason:?})")
        }
    };
    fs::write(out.join("page.rs"), constant)?;
    Ok(())
}

/// Builds the page; its path.
fn build(viewer: &Path, out: &Path) -> Result<PathBuf, String> {
    let npm = if cfg!(windows) { "npm.cmd" } else { "npm" };
    let run = |arguments: &[&str]| {
        let output = Command::new(npm).args(arguments).current_dir(viewer).output();
        match output {
            Ok(output) if output.status.success() => Ok(()),
            Ok(output) => {
                let said = [output.stdout, output.stderr].concat();
                let said = String::from_utf8_lossy(&said).split_whitespace().collect::<Vec<_>>().join(" ");
                Err(format!("`npm {}` failed: {}", arguments.join(" "), said.chars().take(600).collect::<String>()))
            }
            Err(error) => Err(format!("npm cannot be started ({error}); install Node 20 or later")),
        }
    };
    if !packages_are_current(viewer) {
        // No scripts of packages are run, and a registry that is not there is given up soon.
        run(&["ci", "--ignore-scripts", "--no-audit", "--no-fund", "--fetch-retries=1", "--fetch-timeout=60000"])?;
    }
    let folder = out.join("page");
    let folder_text = folder.to_str().ok_or("the target folder has no name in UTF-8")?;
    run(&["run", "--silent", "build", "--", "--outDir", folder_text, "--emptyOutDir"])?;
    Ok(folder.join("index.html"))
}

/// Whether the packages installed are at least as new as the list of them.
fn packages_are_current(viewer: &Path) -> bool {
    let modified = |path: &str| fs::metadata(viewer.join(path)).and_then(|found| found.modified()).ok();
    match (modified("node_modules/.package-lock.json"), modified("package-lock.json")) {
        (Some(installed), Some(wanted)) => installed >= wanted,
        _ => false,
    }
}
