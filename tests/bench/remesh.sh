#!/usr/bin/env bash
# Quality and cost of the remesh: error, depth, base size, tangential details, turned faces, time
# and memory, beside the paper's Table 1 and this project's targets.
# Usage: tests/bench/remesh.sh [MESH...]     default: the paper's five meshes, igea, koala,
#                                            lion_vase and dragon_vrip (with 1 and 2 threads)
# Writes build/bench/remesh.md and each conversion's report to build/bench/remesh/.
set -euo pipefail

meshes=("$@")
for i in "${!meshes[@]}"; do
  [[ -f ${meshes[i]} ]] || { echo "remesh: there is no file '${meshes[i]}'" >&2; exit 2; }
  meshes[i]=$(realpath -- "${meshes[i]}")
done
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
if ((${#meshes[@]} == 0)); then
  folder=${ZEROTREE_DATA:-../shared/data}
  for name in paper5/{venus.off,feline.off,horse.ply,bunny.off,fandisk.obj} \
    large/{igea.ply,koala.obj,lion_vase_poly.off,dragon_vrip.ply.gz}; do
    [[ -f $folder/$name ]] || {
      echo "remesh: $folder/$name is missing; get the meshes, set ZEROTREE_DATA to their folder," \
        "or name your own" >&2
      exit 2
    }
    meshes+=("$(realpath "$folder/$name")")
  done
fi
command -v python3 >/dev/null || {
  echo "remesh: python3 is missing; run samples/install_packages.sh test" >&2
  exit 2
}

echo "Building" >&2
cmake --preset release >/dev/null
cmake --build --preset release --target zerotree >&2
exec python3 tests/bench/remesh.py "${meshes[@]}"
