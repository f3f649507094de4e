#!/bin/sh
# Builds the peers and runs them and the library side by side: see README.md. Everything made lies in $WORK.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
work=${WORK:-/tmp/gyration-peers}
mkdir -p "$work"

[ -d "$work/venv" ] || { python3 -m venv "$work/venv" && "$work/venv/bin/pip" -q install numpy scipy; }
[ -e /usr/include/cvode/cvode.h ] || { echo "CVODE is missing: apt-get install libsundials-dev" >&2; exit 1; }

# -O2 with vectorisation measured faster than -O3 (which spills the accumulators): the rival is to be a strong one.
cc -O2 -ftree-vectorize -march=native -ffast-math -shared -fPIC "$here/cube.c" -o "$work/libcube.so" -lm
cc -O2 "$here/sundials.c" -o "$work/sundials" "$work/libcube.so" -Wl,-rpath,"$work" -lsundials_cvode \
    -lsundials_nvecserial -lsundials_sunmatrixdense -lsundials_sunlinsoldense -lsundials_sunnonlinsolfixedpoint \
    -lsundials_generic -lm
(cd "$here/ode-solvers" && CUBE_LIBRARY="$work" CARGO_TARGET_DIR="$work/target" cargo build --release --quiet)
cargo bench --quiet --manifest-path "$here/../Cargo.toml" --bench trajectory --no-run

python="$work/venv/bin/python"
[ -s "$work/reference.txt" ] || "$python" "$here/scipy_peers.py" "$work/libcube.so" reference "$work/reference.txt"
{
    cargo bench --quiet --manifest-path "$here/../Cargo.toml" --bench trajectory -- "$work/reference.txt"
    "$work/target/release/peer-ode-solvers" "$work/reference.txt"
    "$work/sundials" "$work/reference.txt"
    "$python" "$here/scipy_peers.py" "$work/libcube.so" measure "$work/reference.txt"
} | tee "$work/results.txt"
"$python" "$here/table.py" "$work/results.txt"
