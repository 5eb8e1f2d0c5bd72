#!/usr/bin/env bash
# Builds the consumer in C by pkg-config, shared and static, and runs it.
# Usage: build_with_pkg_config.sh PREFIX LIBRARY-FOLDER BUILD-FOLDER STREAM [FLAG...]
set -euo pipefail
prefix=$1 libraries=$1/$2 build=$3 stream=$4
shift 4
command -v pkg-config >/dev/null || { echo "SKIP: pkg-config is missing (Debian: pkg-config)"; exit 77; }
export PKG_CONFIG_PATH=$libraries/pkgconfig
consumer=$(dirname "$0")/consumer/consumer.c
flags=(-std=c11 -Wall -Wextra -pedantic -Werror "$@")
mkdir -p "$build"

# shellcheck disable=SC2046 # pkg-config prints words
"${CC:-cc}" "${flags[@]}" "$consumer" -o "$build/shared" $(pkg-config --cflags --libs zerotree)
LD_LIBRARY_PATH=$libraries "$build/shared" "$stream"

# The archive by its name, because beside a shared library -lzerotree means the latter.
# shellcheck disable=SC2046
"${CC:-cc}" "${flags[@]}" "$consumer" -o "$build/static" $(
  pkg-config --static --cflags --libs zerotree | sed 's/-lzerotree\b/-l:libzerotree.a/')
"$build/static" "$stream"
if readelf -d "$build/static" | grep -F '[libzerotree.so'; then
  echo "the static consumer needs the shared library of $prefix" >&2
  exit 1
fi
