#!/usr/bin/env bash
# Checks what the C loader writes against what the command decodes.
# Usage: check_c_loader.sh LOADER ZEROTREE FILE.glb OUT-FOLDER
set -euo pipefail
loader=$1 zerotree=$2 glb=$3 out=$4
die() { echo "check_c_loader: $*" >&2; exit 1; }

rms() { "$zerotree" compare "$1" "$2" --samples 20000 --json | sed -n '/"symmetric"/,/}/s/.*"rms": \([^,]*\),/\1/p'; }
is_below() { awk -v a="$1" -v b="$2" 'BEGIN { exit !(a + 0 < b + 0) }'; }

# Every edge of a closed surface lies in two triangles, which run through it in opposite directions.
check_closed() {
  awk '$1 == "v" { ++vertices }  $1 == "vn" { ++normals }
       $1 == "f" { ++faces; for (k = 2; k <= 4; ++k) { split($k, corner, "/"); v[k] = corner[1] }
                   v[5] = v[2]; for (k = 2; k <= 4; ++k) ++edges[v[k], v[k + 1]] }
       END { for (edge in edges) { split(edge, e, SUBSEP)
                                   if (edges[edge] != 1 || edges[e[2], e[1]] != 1) exit 1 }
             exit !(faces > 0 && vertices == normals && faces == 2 * vertices - 4) }' "$1" ||
    die "$1 is no closed surface of genus 0 with a normal for each vertex"
}

rm -rf "$out"
mkdir -p "$out"
"$loader" "$glb" "$out/scan" 1e-4 | tee "$out/lines.txt"
[[ $(wc -l <"$out/lines.txt") == 5 ]] || die "not one line per prefix"
"$zerotree" decode "$glb" -o "$out/full.ply" >/dev/null
last=1
for part in 16 8 4 2 1; do
  check_closed "$out/scan-1of$part.obj"
  error=$(rms "$out/full.ply" "$out/scan-1of$part.obj")
  echo "1/$part: $error off the full decode"
  is_below "$error" "$last" || die "1/$part of the payload is no better than less of it"
  last=$error
done
is_below "$last" 1e-4 || die "all of the payload is $last off what 'zerotree decode' makes of it"

# A file that was cut off within its payload shows its prefix; one without a base is refused.
head -c "$(($(stat -c %s "$glb") - 1000))" "$glb" >"$out/cut.glb"
"$loader" "$out/cut.glb" "$out/cut" >/dev/null || die "a cut payload is refused"
head -c 300 "$glb" >"$out/short.glb"
if "$loader" "$out/short.glb" "$out/short" 2>"$out/message.txt"; then die "300 bytes are taken"; fi
grep -q 'short.glb: ' "$out/message.txt" || die "the message does not name the file"
