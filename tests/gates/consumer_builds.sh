# Sourced by check_cmake_*.sh: makes a copy of the consumer and of the package, and builds it.
# Arguments: GENERATOR PREFIX ASSETS WORK-FOLDER
generator=$1 prefix=$4/prefix given=$3 work=$4 # the package is moved once more, and touched
project=$work/project log=$work/log.txt
rm -rf "$work"
mkdir -p "$work"
cp -a "$2" "$prefix"
cp -a "$(dirname "$0")/consumer" "$project"
mkdir -p "$project/assets/levels"

die() {
  echo "$(basename "$0"): $*; the output was:" >&2
  cat "$log" >&2
  exit 1
}
configure() {
  cmake -S "$project" -B "$work/build" -G "$generator" -DCMAKE_PREFIX_PATH="$prefix" "$@" \
    >"$log" 2>&1
}
build() { cmake --build "$work/build" "$@" >"$log" 2>&1; }
says() { tr -s ' \n' ' ' <"$log" | grep -qF -- "$1"; } # CMake wraps its messages

# good WHAT: a build that succeeds. bad WHAT TEXT...: one that fails and says each TEXT.
good() { build || die "$1: the build fails"; }
bad() {
  local what=$1 text
  shift
  if build; then die "$what: the build succeeds"; fi
  for text in "$@"; do says "$text" || die "$what: the output does not say '$text'"; done
}
# checked FILE...: the last build checked these files and no others of the assets.
checked() {
  local expected found
  expected=$(printf '%s\n' "$@" | sort)
  found=$(sed -n 's/^.*Validating //p' "$log" | sort)
  [[ $expected == "$found" ]] ||
    die "checked were '${found//$'\n'/, }', not '${expected//$'\n'/, }'"
}
