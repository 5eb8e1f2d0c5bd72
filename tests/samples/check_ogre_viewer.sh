#!/usr/bin/env bash
# Runs the OGRE viewer without a screen and checks its pictures.
# Usage: check_ogre_viewer.sh VIEWER CHECK-PICTURES FILE.glb OUT-FOLDER
set -euo pipefail
viewer=$1 check_pictures=$2 glb=$3 out=$4
skip() { echo "SKIP: $*"; exit 77; }

[[ -x $viewer ]] || skip "the viewer is not built: OGRE is missing (Debian: libogre-1.12-dev)"
command -v xvfb-run >/dev/null || skip "xvfb-run is missing (Debian: xvfb xauth)"
rm -rf "$out"
LIBGL_ALWAYS_SOFTWARE=1 xvfb-run -a -s '-screen 0 1280x1024x24' \
  timeout 60 "$viewer" "$glb" --screenshots "$out"
"$check_pictures" "$out"/prefix{1,2,3}.png
