#!/bin/sh
# Builds the peers and runs them and the library side by side: see README.md. Everything made lies in $WORK.
#
#     run.sh [rigid|affine]      both if not given
set -eu
here=$(cd "$(dirname "$0")" && pwd)
work=${WORK:-/tmp/gyration-peers}
mkdir -p "$work"

[ -d "$work/venv" ] || { python3 -m venv "$work/venv" && "$work/venv/bin/pip" -q install numpy scipy; }
[ -e /usr/include/cvode/cvode.h ] || { echo "CVODE is missing: apt-get install libsundials-dev" >&2; exit 1; }
cargo bench --quiet --manifest-path "$here/../Cargo.toml" --bench trajectory --no-run
python="$work/venv/bin/python"

for kind in ${1:-rigid affine}; do
    own="$work/$kind"
    mkdir -p "$own"
    case $kind in
    rigid) source=cube.c define= ;;
    affine) source=cube_affine.c define=-DCUBE_AFFINE ;;
    *) echo "no cube $kind" >&2; exit 2 ;;
    esac
    # -O2 with vectorisation measured faster than -O3 (which spills the accumulators): the rival is to be a strong one.
    cc -O2 -ftree-vectorize -march=native -ffast-math -shared -fPIC $define "$here/$source" -o "$own/libcube.so" -lm
    cc -O2 $define "$here/sundials.c" -o "$own/sundials" "$own/libcube.so" -Wl,-rpath,"$own" -lsundials_cvode \
        -lsundials_nvecserial -lsundials_sunmatrixdense -lsundials_sunlinsoldense -lsundials_sunnonlinsolfixedpoint \
        -lsundials_generic -lm
    features=$([ "$kind" = affine ] && echo affine || true)
    (cd "$here/ode-solvers" &&
        CUBE_LIBRARY="$own" CARGO_TARGET_DIR="$own/target" cargo build --release --quiet --features "$features")
    [ -s "$own/reference.txt" ] || "$python" "$here/scipy_peers.py" "$own/libcube.so" reference "$own/reference.txt"
    {
        cargo bench --quiet --manifest-path "$here/../Cargo.toml" --bench trajectory -- "$kind" "$own/reference.txt"
        "$own/target/release/peer-ode-solvers" "$own/reference.txt"
        "$own/sundials" "$own/reference.txt"
        "$python" "$here/scipy_peers.py" "$own/libcube.so" measure "$own/reference.txt"
    } | tee "$own/results.txt"
    echo "$kind"
    "$python" "$here/table.py" "$own/results.txt"
done
