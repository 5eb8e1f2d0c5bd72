#!/usr/bin/env bash
# Installs the Debian packages that Zerotree needs; does nothing, and needs no rights, if all are
# there already.
# Usage: samples/install_packages.sh run|test     run: build and use; test: also tests, benchmarks, samples
set -euo pipefail

# GoogleTest is here because one build folder (preset release) serves samples and tests.
run_packages=(
  cmake ninja-build g++ pkg-config ca-certificates
  libosd-dev libtinygltf-dev libopenmesh-dev libeigen3-dev libcli11-dev nlohmann-json3-dev
  libtbb-dev libembree-dev libdraco-dev libmeshoptimizer-dev libpugixml-dev libstb-dev zlib1g-dev
  fonts-dejavu-core libgtest-dev)
test_packages=(
  assimp-utils draco gnuplot-nox python3 python3-jsonschema clang-format libbenchmark-dev
  libjansson-dev libogre-1.12-dev xvfb xauth libgl1-mesa-dri
  make pre-commit python3-yaml)

case "${1:-}" in
  run) wanted=("${run_packages[@]}") ;;
  test) wanted=("${run_packages[@]}" "${test_packages[@]}") ;;
  *) echo "usage: $0 run|test" >&2; exit 2 ;;
esac
# Node.js may come from elsewhere with its own npm; Debian's two belong together.
command -v npm >/dev/null && command -v node >/dev/null || wanted+=(nodejs npm)

missing=()
for package in "${wanted[@]}"; do
  state=$(dpkg-query -W -f '${Status}' "$package" 2>/dev/null || true)
  [[ $state == "install ok installed" ]] || missing+=("$package")
done
((${#missing[@]})) || exit 0

as_root=()
if ((EUID != 0)); then
  command -v sudo >/dev/null || {
    echo "Packages are missing: ${missing[*]}" >&2
    echo "Install them as root: apt-get install ${missing[*]}" >&2
    exit 1
  }
  as_root=(sudo)
fi
echo "Installing ${#missing[@]} packages: ${missing[*]}" >&2
log=$(mktemp)
trap 'rm -f "$log"' EXIT
install() {
  "${as_root[@]}" apt-get update -qq &&
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
      apt-get install -qq --yes --no-install-recommends "${missing[@]}"
}
if ! install >"$log" 2>&1; then
  tail -n 20 "$log" >&2
  echo "The packages could not be installed (see above). Is the network there?" >&2
  exit 1
fi
