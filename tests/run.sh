#!/usr/bin/env bash
# Installs what the tests need, builds (release and sanitizers) and runs all tests.
# Usage: tests/run.sh            on a bare Debian 12 machine, as root or with sudo.
set -euo pipefail
cd "$(dirname "$0")/.."

say() { printf '\n== %s\n' "$*"; }

say "Packages"
samples/install_packages.sh test

say "npm packages of tests/interop"
(cd tests/interop && npm ci --no-audit --no-fund --loglevel=error)

for preset in asan release; do
  say "Build: $preset"
  cmake --preset "$preset" >/dev/null
  cmake --build --preset "$preset"
done

export ASAN_OPTIONS="${ASAN_OPTIONS:-}:detect_leaks=1"
failed=0
for preset in asan release; do
  say "Tests: $preset"
  ctest --preset "$preset" -j 2 || failed=1
done
exit "$failed"
