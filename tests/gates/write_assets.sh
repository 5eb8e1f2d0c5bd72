#!/usr/bin/env bash
# Writes the assets of these tests: good.glb, split.gltf with its two buffers, and bad.glb, of whose
# base mesh one byte is another one.
# Usage: write_assets.sh ZEROTREE SCAN OUT-FOLDER
set -euo pipefail
zerotree=$1 scan=$2 out=$3
rm -rf "$out"
mkdir -p "$out"
"$zerotree" convert "$scan" -o "$out/good.glb" >/dev/null
"$zerotree" convert "$scan" -o "$out/split.gltf" --split >/dev/null

json_length=$(od -An -t u4 -j 12 -N 4 "$out/good.glb")
first_of_base=$((20 + json_length + 8)) # two chunk headers of 8 bytes after the file's 12
cp "$out/good.glb" "$out/bad.glb"
byte=$(od -An -t u1 -j "$first_of_base" -N 1 "$out/good.glb")
printf "\\x$(printf %x $((byte ^ 1)))" |
  dd of="$out/bad.glb" bs=1 seek="$first_of_base" conv=notrunc status=none
