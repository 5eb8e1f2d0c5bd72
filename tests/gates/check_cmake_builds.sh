#!/usr/bin/env bash
# Builds a project that validates its assets: a bad one fails the build, and only what changed is
# validated again.
# Usage: check_cmake_builds.sh GENERATOR PREFIX ASSETS WORK-FOLDER
set -euo pipefail
source "$(dirname "$0")/consumer_builds.sh"
assets=$project/assets one="assets/good one.glb" split="assets/split & more.gltf"
cp "$given/good.glb" "$assets/good one.glb"
cp "$given/good.glb" "$assets/levels/first.glb"
sed 's/split\.zt\.bin/split%20p%C3%A4yload.zt.bin/' "$given/split.gltf" >"$assets/split & more.gltf"
cp "$given/split.zt.bin" "$assets/split päyload.zt.bin"
cp "$given/split.bin" "$assets"

configure -DCONSUMER_CASE=builds -DPACKAGE_COMPONENTS="COMPONENTS;command" || die "cannot configure"
good "first build"
checked "$one" ../build/generated.glb "$split" assets/levels/first.glb
good "second build"
checked

touch "$assets/good one.glb"
good "a file touched"
checked "$one" ../build/generated.glb
touch "$assets/split päyload.zt.bin"
good "a payload beside its file touched"
checked "$split"
touch "$prefix/bin/zerotree"
good "the command touched"
checked "$one" ../build/generated.glb "$split" assets/levels/first.glb

cp "$given/bad.glb" "$assets/good one.glb"
bad "a bad file" "PAYLOAD_BASE_MISMATCH" "good one.glb"
bad "still bad" "PAYLOAD_BASE_MISMATCH"
cp "$given/good.glb" "$assets/good one.glb"
good "repaired"

rm "$work/build/game.built"
truncate -s 5 "$assets/split päyload.zt.bin"
bad "a payload cut short" "split & more.gltf: error"
[[ ! -e $work/build/game.built ]] || die "the target that needs the assets is built"
rm "$assets/split päyload.zt.bin"
bad "a payload gone" "split & more.gltf: error"
cp "$given/split.zt.bin" "$assets/split päyload.zt.bin"
good "repaired again"
[[ -e $work/build/game.built ]] || die "the target that needs the assets is not built"

mkdir "$assets/levels/deep"
cp "$given/bad.glb" "$assets/levels/deep/second.glb"
bad "a bad file that came" "PAYLOAD_BASE_MISMATCH" "second.glb"
rm "$assets/levels/deep/second.glb"
good "and went"
