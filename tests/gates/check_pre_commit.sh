#!/usr/bin/env bash
# Commits assets to a repository that uses the hooks of this project: good ones are taken, bad ones
# are not. Runs without a network.
# Usage: check_pre_commit.sh HOOKS.yaml PREFIX ASSETS WORK-FOLDER
set -euo pipefail
hooks=$1 given=$3 work=$4 log=$4/log.txt
rm -rf "$work"
mkdir -p "$work"
die() {
  echo "check_pre_commit: $*" >&2
  [[ ! -e $log ]] || cat "$log" >&2
  exit 1
}
command -v pre-commit >/dev/null || die "pre-commit is missing: samples/install_packages.sh test"

export PATH=$2/bin:$PATH PRE_COMMIT_HOME=$work/cache
# No settings of whoever runs this, and no repository around the build folder.
export HOME=$work GIT_CONFIG_NOSYSTEM=1 GIT_CONFIG_GLOBAL=/dev/null
export GIT_AUTHOR_NAME=test GIT_AUTHOR_EMAIL=test@localhost
export GIT_COMMITTER_NAME=$GIT_AUTHOR_NAME GIT_COMMITTER_EMAIL=$GIT_AUTHOR_EMAIL
unset GIT_DIR GIT_WORK_TREE GIT_INDEX_FILE SKIP

# The hooks come from a repository of their own, as with a project's address; here it is a folder.
git init -q "$work/hooks"
cp "$hooks" "$work/hooks/.pre-commit-hooks.yaml"
git -C "$work/hooks" add .
git -C "$work/hooks" commit -qm hooks
git init -q "$work/assets"
cd "$work/assets"
write_config() { # write_config HOOK ARGS
  cat >.pre-commit-config.yaml <<YAML
repos:
  - repo: $work/hooks
    rev: $(git -C "$work/hooks" rev-parse HEAD)
    hooks: [{id: $1, args: $2}]
YAML
}

commit() { git add . && git commit -qm "$1" >"$log" 2>&1; }
taken() { commit "$1" || die "$1: the commit is refused"; }
refused() { # refused WHAT TEXT...
  local what=$1 text
  shift
  if commit "$what"; then die "$what: the commit is taken"; fi
  for text in "$@"; do
    grep -qF -- "$text" "$log" || die "$what: the output does not say '$text'"
  done
}

write_config zerotree-validate "[]"
pre-commit install >"$log" 2>&1 || die "pre-commit cannot be installed"
mkdir "my scans"
cp "$given/good.glb" "$given"/split.* "my scans"
taken "good files"
cp "$given/bad.glb" "my scans/good.glb"
refused "a bad file" "zerotree-validate" PAYLOAD_BASE_MISMATCH "my scans/good.glb"
cp "$given/good.glb" "my scans/good.glb"

write_config zerotree-validate-folder "[my scans]"
echo anything >other.bin
taken "a file that is no asset, with the other hook"
truncate -s 5 "my scans/split.zt.bin"
refused "a payload cut short, alone" "my scans/split.gltf: error"
cp "$given/split.zt.bin" "my scans"

write_config zerotree-validate "[--max-bytes, '100']"
cp "$given/good.glb" new.glb
refused "a file over the budget" BUDGET_BYTES new.glb
