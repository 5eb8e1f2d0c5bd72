#!/usr/bin/env bash
# Error at 1/4 to 8 bits per vertex: ours from a truncated stream, beside the paper's Table 2 and
# beside Draco on meshes simplified to the best ratio for each rate.
# Usage: tests/bench/rate_distortion.sh [MESH...]     default: the paper's five meshes
# Writes build/bench/rate_distortion.{md,csv,png}; Draco's results are kept in build/bench/draco.
set -euo pipefail

meshes=("$@")
for i in "${!meshes[@]}"; do
  [[ -f ${meshes[i]} ]] || { echo "rate_distortion: there is no file '${meshes[i]}'" >&2; exit 2; }
  meshes[i]=$(realpath -- "${meshes[i]}")
done
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
if ((${#meshes[@]} == 0)); then
  folder=../shared/data/paper5
  for name in venus.off feline.off horse.ply bunny.off fandisk.obj; do
    [[ -f $folder/$name ]] || {
      echo "rate_distortion: $folder/$name is missing; get the meshes or name your own" >&2
      exit 2
    }
    meshes+=("$(realpath "$folder/$name")")
  done
fi
for tool in draco_encoder draco_decoder gnuplot python3; do
  command -v "$tool" >/dev/null || {
    echo "rate_distortion: $tool is missing; run samples/install_packages.sh test" >&2
    exit 2
  }
done

echo "Building" >&2
cmake --preset release >/dev/null
cmake --build --preset release --target zerotree simplify_mesh >&2
exec python3 tests/bench/rate_distortion.py "${meshes[@]}"
