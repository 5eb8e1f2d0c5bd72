#!/usr/bin/env bash
# Speed and memory of the runtime beside libdraco and libmeshoptimizer at equal error, in one run:
# bytes in memory to positions, normals and indices, the parts of it, steps, threads and budgets.
# Usage: tests/bench/runtime.sh [MESH...]     default: horse and dragon_vrip
# Writes build/bench/runtime.md; streams, Draco's files and errors are kept in build/bench/runtime
# and build/bench/draco (remove the former after a change of the format or the converter).
set -euo pipefail

meshes=("$@")
for i in "${!meshes[@]}"; do
  [[ -f ${meshes[i]} ]] || { echo "runtime: there is no file '${meshes[i]}'" >&2; exit 2; }
  meshes[i]=$(realpath -- "${meshes[i]}")
done
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
if ((${#meshes[@]} == 0)); then
  folder=${ZEROTREE_DATA:-../shared/data}
  for name in paper5/horse.ply large/dragon_vrip.ply.gz; do
    [[ -f $folder/$name ]] || {
      echo "runtime: $folder/$name is missing; get the meshes, set ZEROTREE_DATA to their folder," \
        "or name your own" >&2
      exit 2
    }
    meshes+=("$(realpath "$folder/$name")")
  done
fi
for tool in draco_encoder draco_decoder python3; do
  command -v "$tool" >/dev/null || {
    echo "runtime: $tool is missing; run samples/install_packages.sh test" >&2
    exit 2
  }
done

echo "Building" >&2
cmake --preset release >/dev/null
cmake --build --preset release --target zerotree simplify_mesh runtime_benchmark >&2
exec python3 tests/bench/runtime.py "${meshes[@]}"
