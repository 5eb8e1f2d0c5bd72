#!/usr/bin/env bash
# Writes tests/results/results.csv anew: bytes and errors of the tests' own scans and of the shared
# meshes that are there.
# Usage: tests/results/write_results.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
cmake --preset release >/dev/null
cmake --build --preset release --target zerotree write_sample_scans >&2
bin=build/release/bin
scans=build/release/tests/results/scans
"$bin/write_sample_scans" "$scans"
python3 tests/results/check_results.py --write "$bin/zerotree" "$scans" \
  closed.ply bounded.ply creased.ply
python3 tests/results/check_results.py --write "$bin/zerotree" ../shared/data/paper5 \
  venus.off feline.off horse.ply bunny.off fandisk.obj
