#!/usr/bin/env bash
# Checks what the shared library gives and needs: only zt_ functions, all of zerotree.h, and no
# library beyond OpenSubdiv and those of the compiler.
# Usage: check_exports.sh LIBRARY HEADER [ALLOWED...]     ALLOWED: more libraries that it may need
set -euo pipefail
library=$1 header=$2
shift 2
allowed=(libosdCPU libstdc++ libm libgcc_s libc ld-linux-x86-64 "$@")
failed=0
complain() { echo "$library: $*" >&2; failed=1; }

exported=$(nm -D --defined-only "$library" | awk '{print $3}' | sort)
declared=$(grep -o '^ZT_API.* \**zt_[a-z_]*(' "$header" | grep -o 'zt_[a-z_]*($' | tr -d '(' | sort)
[[ -n $declared ]] || complain "no ZT_API function was found in $header"
difference=$(diff <(echo "$declared") <(echo "$exported") | grep '^[<>]' || true)
[[ -z $difference ]] || complain $'exports (>) and zerotree.h (<) differ; see exports.map:\n'"$difference"

needed=$(readelf -d "$library" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p')
for name in $needed; do
  printf '%s\n' "${allowed[@]}" | grep -qxF -- "${name%.so*}" ||
    complain "needs $name, which a runtime must not (allowed: ${allowed[*]})"
done
if readelf -d "$library" | grep -E '\((RPATH|RUNPATH)\)'; then complain "has a run path"; fi
echo "$(wc -l <<<"$exported") functions; needs" $needed
exit "$failed"
