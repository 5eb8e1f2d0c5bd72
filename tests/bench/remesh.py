"""Measures the remesh for remesh.sh, which builds what this needs."""

import csv
import json
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
ZEROTREE = ROOT / "build/release/bin/zerotree"
OUT = ROOT / "build/bench/remesh"
# Relative errors are given in units of 1e-5 of the bounding box diagonal, as the paper's E_r.
UNIT = 1e-5
MOST_FACES = 4  # times the input's
FIRST_LEVEL = 3  # of the tangential details that count
# Of meshes with these names speed is measured with one and two threads each.
SPEED_MESHES = "dragon"
MOST_SECONDS = {1: 40, 2: 25}  # per million input vertices
MOST_MEMORY = 1000  # bytes per input vertex


def name_of(mesh):
    return mesh.name.split(".")[0].removesuffix("_poly")


def convert(mesh, threads=None):
    """The report of a conversion with all defaults but the number of threads."""
    tag = name_of(mesh) + (f"_{threads}" if threads else "")
    report = OUT / f"{tag}.json"
    command = [ZEROTREE, "convert", mesh, "--stream", OUT / f"{tag}.zt", "--report", report]
    command += ["--threads", threads] if threads else []
    print(f"Converting {mesh.name}", file=sys.stderr)
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"remesh: {' '.join(map(str, command))}\n{done.stderr or done.stdout}")
    return json.loads(report.read_text())


def remesh_stages(report):
    """What is run from the first `clean` to the last `fit`."""
    names = [stage["name"] for stage in report["stages"]]
    last = len(names) - 1 - names[::-1].index("fit")
    return report["stages"][names.index("clean"):last + 1]


def cost_of(report):
    """(seconds per million input vertices, peak bytes per input vertex) of the remesh."""
    stages, vertices = remesh_stages(report), report["input"]["vertices"]
    return (sum(stage["seconds"] for stage in stages) / vertices * 1e6,
            max(stage["peakMemoryBytes"] for stage in stages) / vertices)


def figures_of(report):
    remesh = report["remesh"]
    ratios = {level["level"]: (level["tangential"] / level["normal"]) ** 2 if level["normal"] else 0
              for level in remesh["levelDetails"] if level["level"] >= FIRST_LEVEL}
    seconds, memory = cost_of(report)
    return {"vertices": report["input"]["vertices"], "base": report["base"]["vertices"],
            "levels": remesh["levels"],
            "faces": report["base"]["faces"] * 4 ** remesh["levels"] / report["input"]["faces"],
            "error": remesh["error"] / UNIT, "discretisation": remesh["discretisationError"] / UNIT,
            "ratios": ratios, "turned": remesh.get("turnedFaces"),
            "negative": remesh.get("negativeTriangles"), "remark": remesh["remark"],
            "seconds": seconds, "memory": memory}


def read_paper():
    with open(ROOT / "tests/bench/paper_table1.csv", newline="") as file:
        return {row["mesh"]: {k: float(v) for k, v in row.items() if k != "mesh" and v}
                for row in csv.DictReader(file)}


def shown(value, digits=2):
    return "-" if value is None else f"{value:.{digits}f}"


def misses_of(name, f, goals):
    """What of the targets a mesh misses, in words."""
    target, limit = goals.get("target_1e-5"), goals.get("energy_ratio_limit")
    if target and f["error"] > target:
        yield f"{name}: E_r {f['error']:.2f} is above {target:g}"
    if f["faces"] > MOST_FACES:
        yield f"{name}: {f['faces']:.2f} times the input's faces are more than {MOST_FACES}"
    for level, ratio in f["ratios"].items():
        if limit and ratio > limit:
            yield f"{name}: tangential / normal energy {ratio:.2f} at level {level} is above {limit:g}"
    for kind in ("turned", "negative"):
        if f[kind]:
            yield f"{name}: {f[kind]} {kind} faces"
    if f["error"] > 3 * f["discretisation"] and not f["remark"]:
        yield f"{name}: E_r above three times E_d, and the report does not say why"


def quality_table(results, paper):
    lines = ["| mesh | vertices | base (paper) | levels | faces ratio | E_r | paper | target | E_d |"
             f" tangential / normal energy, levels {FIRST_LEVEL}.. | turned, negative faces |"
             " s / Mv | B / v |", "|---" * 13 + "|"]
    for name, f in results.items():
        goals = paper.get(name, {})
        base = goals.get("base_vertices")
        cells = [name, f["vertices"], f"{f['base']} ({shown(base, 0)})", f["levels"],
                 shown(f["faces"]), shown(f["error"]), shown(goals.get("remeshing_error_1e-5"), 1),
                 shown(goals.get("target_1e-5"), 1), shown(f["discretisation"]),
                 " ".join(shown(r) for r in f["ratios"].values()) or "-",
                 f"{shown(f['turned'], 0)}, {shown(f['negative'], 0)}", shown(f["seconds"], 1),
                 shown(f["memory"], 0)]
        lines.append("| " + " | ".join(map(str, cells)) + " |")
    return lines


def speed_table(speeds):
    """Its lines and the misses in words."""
    lines = ["| mesh | threads | s / Mv | allowed | B / v | allowed |", "|---" * 6 + "|"]
    misses = []
    for (name, threads), (seconds, memory) in speeds.items():
        allowed = MOST_SECONDS[threads]
        lines.append(f"| {name} | {threads} | {seconds:.1f} | {allowed} | {memory:.0f} |"
                     f" {MOST_MEMORY} |")
        if seconds > allowed:
            misses.append(f"{name}: {seconds:.1f} s / Mv with {threads} threads, allowed {allowed}")
        if memory > MOST_MEMORY:
            misses.append(f"{name}: {memory:.0f} B / v with {threads} threads")
    return lines, misses


def markdown(results, speeds, paper):
    lines = ["# Remesh", "",
             "All defaults. E_r: symmetric RMS distance of the remesh from the input; E_d: of the"
             " input from a smooth surface through its vertices; both in 1e-5 of the bounding box"
             " diagonal. Seconds and peak memory are those of the stages from clean to fit, per"
             " input vertex; what was read before counts as memory too.", ""]
    lines += quality_table(results, paper)
    misses = [m for name, f in results.items() for m in misses_of(name, f, paper.get(name, {}))]
    if speeds:
        table, slow = speed_table(speeds)
        lines += ["", *table]
        misses += slow
    lines += ["", "Missed:" if misses else "No target is missed.", *(f"- {m}" for m in misses)]
    return "\n".join(lines) + "\n"


def main(meshes):
    OUT.mkdir(parents=True, exist_ok=True)
    results, speeds = {}, {}
    for mesh in map(Path, meshes):
        name = name_of(mesh)
        if name.startswith(SPEED_MESHES):
            for threads in MOST_SECONDS:
                report = convert(mesh, threads)
                speeds[name, threads] = cost_of(report)
        else:
            report = convert(mesh)
        results[name] = figures_of(report)
    table = markdown(results, speeds, read_paper())
    (OUT.parent / "remesh.md").write_text(table)
    print(table, end="")


if __name__ == "__main__":
    main(sys.argv[1:])
