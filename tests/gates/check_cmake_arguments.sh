#!/usr/bin/env bash
# Configures projects that call zerotree_validate_assets wrongly, and looks for the message of each.
# Usage: check_cmake_arguments.sh GENERATOR PREFIX ASSETS WORK-FOLDER
set -euo pipefail
source "$(dirname "$0")/consumer_builds.sh"
cp "$given/good.glb" "$project/assets"

# refused TEXT ARGUMENT...: the configuration fails, and its output says TEXT.
refused() {
  local text=$1
  shift
  if configure "$@"; then die "$* is taken"; fi
  says "$text" || die "$*: the output does not say '$text'"
}
arguments() { refused "$1" -DARGUMENTS="$2"; }

configure -DARGUMENTS="TARGET;assets;FILES;assets/good.glb" || die "right arguments are refused"
arguments "TARGET is missing" "FILES;assets/good.glb"
arguments "FILES or DIRECTORY is missing" "TARGET;assets"
arguments "unknown arguments: QUICK" "QUICK;TARGET;assets;FILES;assets/good.glb"
arguments "no value for MAX_BYTES" "TARGET;assets;FILES;assets/good.glb;MAX_BYTES"
arguments "there is no file $project/assets/god.glb" "TARGET;assets;FILES;assets/god.glb"
arguments "there is no file $project/assets. FILES" "TARGET;assets;FILES;assets"
arguments "there is no .glb, .gltf or .zt file in $project/assets/levels" \
  "TARGET;assets;DIRECTORY;assets/levels"
refused "an argument is empty" -DCONSUMER_CASE=unset

rm "$prefix/bin/zerotree" "$prefix"/lib*/cmake/zerotree/zerotree_command*.cmake
refused "component \"command\"" -DCONSUMER_CASE= -DARGUMENTS="TARGET;assets;FILES;assets/good.glb"
refused "zerotree::zerotree needs the installation's component \"command\"" \
  -DPACKAGE_COMPONENTS="COMPONENTS;command"
