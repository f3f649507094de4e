//! Finds the compiled right-hand side, `libcube.so`, in the folder CUBE_LIBRARY.

fn main() {
    println!("cargo:rerun-if-env-changed=CUBE_LIBRARY");
    if let Ok(folder) = std::env::var("CUBE_LIBRARY") {
        println!("cargo:rustc-link-search=native={folder}");
        println!("cargo:rustc-link-arg=-Wl,-rpath,{folder}");
    }
    println!("cargo:rustc-link-lib=dylib=cube");
}
