#!/usr/bin/env bash
# Configures a project that has Zerotree in a subfolder, and looks into what its build would do: it
# makes the command first and validates with that.
# Usage: check_add_subdirectory.sh ZEROTREE-SOURCES ASSETS WORK-FOLDER
set -euo pipefail
sources=$1 assets=$2 work=$3 log=$3/log.txt
rm -rf "$work"
mkdir -p "$work/project"
cp "$assets/good.glb" "$work/project"
cat >"$work/project/CMakeLists.txt" <<'CMAKE'
cmake_minimum_required(VERSION 3.25)
project(consumer LANGUAGES C CXX)
add_subdirectory(${ZEROTREE_SOURCES} zerotree EXCLUDE_FROM_ALL)
zerotree_validate_assets(TARGET assets FILES good.glb)
CMAKE
die() {
  echo "check_add_subdirectory: $*" >&2
  cat "$log" >&2
  exit 1
}
cmake -S "$work/project" -B "$work/build" -G Ninja -DZEROTREE_SOURCES="$sources" >"$log" 2>&1 ||
  die "cannot configure"
ninja -C "$work/build" -t commands assets >"$log" || die "there is no target for the assets"
line_of() { grep -n -m 1 -F -- "$1" "$log" | cut -d : -f 1 || true; }
linked=$(line_of "-o bin/zerotree ")
validated=$(line_of "$work/build/bin/zerotree validate $work/project/good.glb")
[[ -n $linked && -n $validated ]] || die "the command is not linked, or does not validate"
((linked < validated)) || die "the command validates before it is linked"
