#!/usr/bin/env bash
# From a bare Debian 12 machine to a progressive glTF and a picture of what its prefixes look like.
# Usage: samples/quickstart.sh [SCAN]     as root or with sudo while packages are missing
# SCAN: a mesh (PLY, OBJ, OFF, STL, GLB, glTF, DRC); without it the Stanford bunny is fetched.
# Results lie in build/quickstart/; a second run reuses what is still up to date.
set -euo pipefail

say() { printf '\n== %s\n' "$*" >&2; }
die() { printf 'quickstart: %s\n' "$*" >&2; exit 1; }

scan=
if [[ ${1:-} == -h || ${1:-} == --help ]]; then sed -n '2,5s/^# //p' "$0"; exit; fi
if (($# > 1)) || [[ ${1:-} == -* ]]; then die "usage: samples/quickstart.sh [SCAN]"; fi
if (($# == 1)); then
  [[ -f $1 ]] || die "there is no file '$1'"
  scan=$(realpath -- "$1")
fi
cd "$(dirname "${BASH_SOURCE[0]}")/.."
out=build/quickstart
command_log=$out/build.log
zerotree=build/release/bin/zerotree
rates=(0.25 0.5 1 2 4 8) # bits per vertex of the scan
mkdir -p "$out"

fetch_bunny() {
  local folder
  [[ -s $out/bunny.drc ]] && return
  say "Fetching the Stanford bunny (npm package draco3d 1.5.9)"
  folder=$(mktemp -d)
  (cd "$folder" && npm pack --silent draco3d@1.5.9 >/dev/null && tar -xzf draco3d-1.5.9.tgz) ||
    die "npm could not fetch draco3d@1.5.9: is the network there? Or give a scan of your own."
  mv "$(find "$folder" -name bunny.drc -print -quit)" "$out/bunny.drc" ||
    die "the package draco3d@1.5.9 holds no bunny.drc"
  rm -rf "$folder"
}

build() {
  say "Building the command (a few minutes the first time)"
  { cmake --preset release &&
      cmake --build --preset release --target zerotree; } >"$command_log" 2>&1 || {
    tail -n 30 "$command_log" >&2
    die "the build failed; all of its output is in $command_log"
  }
}

# Value of a number in JSON that the command wrote: json_number FILE KEY [KEY...]
json_number() {
  node -e 'const [file, ...keys] = process.argv.slice(1);
    const value = keys.reduce((v, k) => v?.[k], JSON.parse(require("fs").readFileSync(file)));
    if (typeof value !== "number") { console.error(`no number at ${keys.join(".")} in ${file}`); process.exit(1); }
    console.log(value);' "$@"
}

# The command's and the scan's state: results made with the same ones are still good.
fingerprint() { sha256sum "$zerotree" "$scan" | cut -d ' ' -f 1 | tr '\n' ' '; }

convert() {
  say "Converting $(basename "$scan")"
  rm -f "$out/fingerprint" "$out"/prefix_*.{ply,json}
  "$zerotree" convert "$scan" --stream "$out/scan.zt" -o "$out/scan.glb" --report "$out/report.json"
  fingerprint >"$out/fingerprint"
}

decode_and_measure() {
  local rate=$1 bytes=$2
  [[ -s $out/prefix_$rate.json ]] && return
  "$zerotree" decode "$out/scan.zt" --bytes "$bytes" -o "$out/prefix_$rate.ply"
  "$zerotree" compare "$scan" "$out/prefix_$rate.ply" --json >"$out/prefix_$rate.json.part"
  mv "$out/prefix_$rate.json.part" "$out/prefix_$rate.json"
}

# What stands under a prefix in the picture: caption_of RATE BYTES ERROR
caption_of() {
  LC_ALL=C awk -v rate="$1" -v bytes="$2" -v error="$3" 'BEGIN {
    name = rate == 0.25 ? "¼" : rate == 0.5 ? "½" : rate
    printf "%s bit%s per vertex\\n%d bytes · error %.2g %% of diagonal",
           name, (rate > 1 ? "s" : ""), bytes, 100 * error }'
}

say "Packages"
samples/install_packages.sh run
build
if [[ -z $scan ]]; then
  fetch_bunny
  scan=$(realpath "$out/bunny.drc")
fi
[[ -s $out/fingerprint && $(<"$out/fingerprint") == "$(fingerprint)" ]] || convert

say "Decoding prefixes and measuring them"
vertices=$(json_number "$out/report.json" input vertices)
whole=$(stat -c %s "$out/scan.zt")
meshes=("$scan")
captions=("$(basename "$scan")\nthe scan: $vertices vertices")
printf '%14s  %10s  %14s\n' 'bits per vertex' bytes 'error/diagonal'
for rate in "${rates[@]}"; do
  bytes=$(awk -v r="$rate" -v v="$vertices" 'BEGIN { printf "%d", r * v / 8 }')
  ((bytes <= whole)) || bytes=$whole
  decode_and_measure "$rate" "$bytes" || die "the prefix of $rate bits per vertex failed"
  error=$(json_number "$out/prefix_$rate.json" symmetric rms)
  printf '%15s  %10d  %14.2e\n' "$rate" "$bytes" "$error"
  meshes+=("$out/prefix_$rate.ply")
  captions+=("$(caption_of "$rate" "$bytes" "$error")")
done

say "Drawing them side by side"
caption_options=()
for caption in "${captions[@]}"; do caption_options+=(--caption "$caption"); done
"$zerotree" render "${meshes[@]}" -o "$out/prefixes.png" "${caption_options[@]}"

cat >&2 <<END

Done. Look at:
  $out/prefixes.png   the scan and its prefixes, side by side
  $out/scan.glb       the progressive glTF: any viewer shows its base mesh
  $out/scan.zt        the elementary stream: any prefix of it decodes
  $out/report.json    what the conversion found and did
END
