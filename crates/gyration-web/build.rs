//! Has the linker write addresses no longer than they are: a hundredth of what comes over the network.

fn main() {
    if std::env::var("CARGO_CFG_TARGET_FAMILY").is_ok_and(|family| family == "wasm") {
        println!("cargo::rustc-link-arg-cdylib=--compress-relocations");
    }
    println!("cargo::rerun-if-changed=build.rs");
}
