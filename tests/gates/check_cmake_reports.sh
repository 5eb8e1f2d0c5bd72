#!/usr/bin/env bash
# Builds a project with budgets and reports: a budget exceeded fails the build, and there are
# reports of builds that succeed and of those that fail.
# Usage: check_cmake_reports.sh GENERATOR PREFIX ASSETS WORK-FOLDER
set -euo pipefail
source "$(dirname "$0")/consumer_builds.sh"
cp "$given/good.glb" "$project/assets/good one.glb"
cp "$given"/split.* "$project/assets/levels"
json="$work/build/reports/all assets.json" junit=$work/build/reports/assets.xml

budgets() { configure -DCONSUMER_CASE=reports -DBUDGETS="$1" || die "cannot configure $1"; }
# reports TEXT [COUNT]: both reports are whole, name both files and say TEXT in COUNT of them.
reports() {
  python3 - "$json" "$junit" "$@" <<'PYTHON' >>"$log" 2>&1 || die "the reports are wrong"
import json, sys, xml.etree.ElementTree as xml
reports = json.load(open(sys.argv[1]))
cases = xml.parse(sys.argv[2]).getroot().findall(".//testcase")
assert [r["uri"].split("/")[-1] for r in reports] == ["good one.glb", "split.gltf"], reports
codes = [{m["code"] for m in r["issues"]["messages"]} for r in reports]
assert len(cases) == 2 and sum(sys.argv[3] in c for c in codes) == int(sys.argv[4]), codes
failed = [c for c in cases if c.find("failure") is not None]
assert len(failed) == int(sys.argv[4]), failed
PYTHON
}

budgets "MAX_BYTES;1M;MAX_ERROR;1e-4;MAX_TRIANGLES;1000000"
good "within the budgets"
checked "2 assets"
reports none 0
good "second build"
checked
for budget in BYTES:100 ERROR:1e-6 TRIANGLES:10; do
  budgets "MAX_${budget/:/;}"
  bad "$budget" "BUDGET_${budget%:*}" "good one.glb" "split.gltf"
  reports "BUDGET_${budget%:*}" 2
done
budgets "OPTIONS;--max-triangles;10"
bad "a budget among the options" "BUDGET_TRIANGLES"

budgets ""
cp "$given/bad.glb" "$project/assets/good one.glb"
bad "a bad file" "PAYLOAD_BASE_MISMATCH"
reports PAYLOAD_BASE_MISMATCH 1
