"""Measures rate and distortion for rate_distortion.sh, which builds what this needs."""

import csv
import hashlib
import json
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BIN = ROOT / "build/release/bin"
OUT = ROOT / "build/bench"
RATES = [0.25, 0.5, 1, 2, 4, 8]  # bits per vertex of the original
# Faces and position bits that are tried with Draco for a budget of N bytes: after about 120 bytes
# of its own, 0.85 to 2 bytes a face pay off. Each pair serves every rate it fits in.
DRACO_OVERHEAD = 120
BYTES_PER_FACE = [0.85, 1.05, 1.3, 1.6, 2.0]
QUANTISATION_BITS = [8, 9, 10, 11, 12, 13, 14]
# Relative errors are given in units of 1e-4 of the bounding box diagonal, as the paper does.
UNIT = 1e-4


def run(*command):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{Path(sys.argv[0]).stem}: {' '.join(map(str, command))}\n"
                 f"{done.stderr or done.stdout}")
    return done.stdout


def error_of(original, mesh):
    report = json.loads(run(BIN / "zerotree", "compare", original, mesh, "--json"))
    return report["symmetric"]["rms"] / UNIT


def measure_ours(original, folder):
    """(vertices, {rate: (bytes, error)}) of the stream cut to each rate."""
    stream, report = folder / "ours.zt", folder / "ours.json"
    run(BIN / "zerotree", "convert", original, "--stream", stream, "-o", folder / "ours.glb",
        "--report", report)
    vertices = json.loads(report.read_text())["input"]["vertices"]
    points = {}
    for rate in RATES:
        size = min(int(rate * vertices / 8), stream.stat().st_size)
        cut, decoded = folder / "cut.zt", folder / "ours.ply"
        cut.write_bytes(stream.read_bytes()[:size])  # the decoder never sees more than the prefix
        run(BIN / "zerotree", "decode", cut, "-o", decoded)
        points[rate] = (size, error_of(original, decoded))
    return vertices, points


def draco_point(original, faces, bits, folder):
    """(bytes, error) of one simplification and quantisation; kept on disk."""
    kept = folder / f"draco_{faces}_{bits}.json"
    if kept.exists():
        return tuple(json.loads(kept.read_text()))
    work = folder / f"{faces}_{bits}"
    simple, coded, decoded = (work.with_suffix(s) for s in (".ply", ".drc", ".out.ply"))
    run(BIN / "simplify_mesh", original, simple, faces)
    run("draco_encoder", "-i", simple, "-o", coded, "-cl", 10, "-qp", bits)
    run("draco_decoder", "-i", coded, "-o", decoded)
    point = (coded.stat().st_size, error_of(original, decoded))
    kept.write_text(json.dumps(point))
    for file in (simple, coded, decoded):
        file.unlink()
    return point


def measure_draco(original, vertices, folder):
    """{rate: (bytes, error)} on the lower envelope of all points within each rate."""
    jobs = set()
    for rate in RATES:
        budget = rate * vertices / 8
        for per_face in BYTES_PER_FACE:
            faces = min(int((budget - DRACO_OVERHEAD) / per_face), 2 * vertices)
            # Bits that fit a rate: coarse ones for few faces, fine ones for many.
            middle = QUANTISATION_BITS[min(RATES.index(rate) + 1, 5)]
            jobs |= {(faces, b) for b in (middle - 1, middle, middle + 1)
                     if b in QUANTISATION_BITS and faces >= 20}
    with ThreadPoolExecutor(2) as pool:
        points = list(pool.map(lambda job: draco_point(original, *job, folder), sorted(jobs)))
    best = {}
    for rate in RATES:
        fitting = [p for p in points if p[0] <= rate * vertices / 8]
        if fitting:
            best[rate] = min(fitting, key=lambda p: p[1])
    return best


def read_paper():
    with open(ROOT / "tests/bench/paper_table2.csv", newline="") as file:
        return {row["mesh"]: {r: float(row[f"{r:g}"]) for r in RATES if row[f"{r:g}"]}
                for row in csv.DictReader(file)}


def write_markdown(results, path):
    shown = lambda value: "-" if value is None else f"{value:.2f}"
    lines = ["# Rate and distortion", "",
             "Symmetric RMS distance to the original in 1e-4 of its bounding box diagonal, at bits"
             " per vertex of the original. Draco: simplified by meshoptimizer, `-cl 10`, best of a"
             " sweep of ratios and quantisation bits. That simplifier keeps vertices where they"
             " are; one that moves them (quadrics, optimal placement) can do better.", ""]
    for name, (vertices, curves) in results.items():
        lines += [f"## {name} ({vertices} vertices)", "",
                  "| b/v | " + " | ".join(f"{r:g}" for r in RATES) + " |",
                  "|---" * (len(RATES) + 1) + "|"]
        for curve, points in curves.items():
            cells = [shown(points[r][1] if r in points else None) for r in RATES]
            lines.append(f"| {curve} | " + " | ".join(cells) + " |")
        if "paper" in curves:
            ratio = [curves["ours"][r][1] / curves["paper"][r][1] if r in curves["paper"] else None
                     for r in RATES]
            lines.append("| ours / paper | " + " | ".join(map(shown, ratio)) + " |")
        lines.append("")
    path.write_text("\n".join(lines))


def write_csv(results, path):
    with open(path, "w", newline="") as file:
        table = csv.writer(file)
        table.writerow(["mesh", "vertices", "curve", "bits_per_vertex", "bytes", "error_1e-4"])
        for name, (vertices, curves) in results.items():
            for curve, points in curves.items():
                for rate, (size, error) in points.items():
                    table.writerow([name, vertices, curve, f"{rate:g}", size, f"{error:.4f}"])


def write_plot(results, path):
    columns = min(3, len(results))
    rows = -(-len(results) // columns)
    styles = {"ours": "lc rgb '#c2410c' lw 3 pt 7", "paper": "lc rgb '#1d4ed8' lw 2 dt 2 pt 5",
              "Draco": "lc rgb '#6b7280' lw 2 pt 9"}
    script = [f"set terminal pngcairo size {560 * columns},{440 * rows} font 'DejaVu Sans,11'",
              f"set output '{path}'", f"set multiplot layout {rows},{columns}",
              "set logscale x 2", "set logscale y", "set grid lc rgb '#dddddd'", "set key top right",
              "set xlabel 'bits per vertex'", "set ylabel 'RMS error / diagonal [1e-4]'",
              "set xrange [0.2:10]", "set xtics ('1/4' .25, '1/2' .5, '1' 1, '2' 2, '4' 4, '8' 8)",
              "set ytics (.2, .5, 1, 2, 5, 10, 20, 50, 100)"]
    for number, (name, (_, curves)) in enumerate(results.items()):
        plots = []
        for curve, points in curves.items():
            block = f"$curve{number}_{curve}"
            script += [f"{block} << EOD", *(f"{r:g} {e:g}" for r, (_, e) in points.items()), "EOD"]
            plots.append(f"{block} with linespoints {styles[curve]} ps 1.1 title '{curve}'")
        script += [f"set title \"{name}\" noenhanced", "plot " + ", ".join(plots)]
    script.append("unset multiplot")
    subprocess.run(["gnuplot"], input="\n".join(script) + "\n", text=True, check=True)


def main(meshes):
    paper = read_paper()
    results = {}
    for mesh in map(Path, meshes):
        print(f"Measuring {mesh.name}", file=sys.stderr)
        tag = hashlib.sha256(mesh.read_bytes()).hexdigest()[:12]
        kept = OUT / "draco" / f"{mesh.stem}_{tag}"
        kept.mkdir(parents=True, exist_ok=True)
        vertices, ours = measure_ours(mesh, kept)
        curves = {"ours": ours}
        if mesh.stem in paper:
            curves["paper"] = {r: (int(r * vertices / 8), e) for r, e in paper[mesh.stem].items()}
        curves["Draco"] = measure_draco(mesh, vertices, kept)
        results[mesh.stem] = (vertices, curves)
    write_markdown(results, OUT / "rate_distortion.md")
    write_csv(results, OUT / "rate_distortion.csv")
    write_plot(results, OUT / "rate_distortion.png")
    print((OUT / "rate_distortion.md").read_text())


if __name__ == "__main__":
    main(sys.argv[1:])
