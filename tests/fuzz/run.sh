#!/usr/bin/env bash
# Builds the fuzzer with clang and lets it run on the decoder, from seeds made by the release build.
# What it finds it leaves in build/fuzz/findings; a fixed one is kept in tests/fuzz/findings, which
# the test fuzz.replay runs.
# Usage: tests/fuzz/run.sh [SECONDS] [libFuzzer option...]      default: 600
set -euo pipefail
cd "$(dirname "$0")/../.."

seconds=${1:-600}
[[ $seconds =~ ^[0-9]+$ ]] || { echo "usage: $0 [SECONDS] [libFuzzer option...]" >&2; exit 2; }
shift || true

command -v clang++ >/dev/null || {
  echo "clang++ is missing. On Debian 12: apt-get install clang libclang-rt-14-dev" >&2
  exit 1
}
probe=$(mktemp)
trap 'rm -f "$probe"' EXIT
echo 'extern "C" int LLVMFuzzerTestOneInput(const char*, unsigned long) { return 0; }' |
  clang++ -x c++ - -fsanitize=fuzzer,address -o "$probe" 2>/dev/null || {
  echo "clang++ cannot link libFuzzer. On Debian 12: apt-get install libclang-rt-14-dev" >&2
  exit 1
}

cmake --preset release >/dev/null
cmake --build --preset release --target write_fuzz_seeds
cmake --preset fuzz >/dev/null
cmake --build --preset fuzz --target fuzz_decoder

work=build/fuzz
mkdir -p "$work/corpus" "$work/findings"
build/release/bin/write_fuzz_seeds "$work/seeds"
folders=("$work/corpus" "$work/seeds")
[[ -d tests/fuzz/findings ]] && folders+=(tests/fuzz/findings)
"$work/bin/fuzz_decoder" -max_total_time="$seconds" -max_len=4096 -timeout=20 -rss_limit_mb=2048 \
  -artifact_prefix="$work/findings/" -print_final_stats=1 "$@" "${folders[@]}"
