//! Takes a schema that `gyration schema` has written, where `GYRATION_SCHEMA` names one: the module of a page is
//! smaller without what would make it there.

fn main() {
    println!("cargo::rustc-check-cfg=cfg(written_schema)");
    println!("cargo::rerun-if-env-changed=GYRATION_SCHEMA");
    if let Some(path) = std::env::var_os("GYRATION_SCHEMA") {
        println!("cargo::rerun-if-changed={}", path.display());
        println!("cargo::rustc-cfg=written_schema");
    }
}
