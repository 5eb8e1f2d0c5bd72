"""Measures the runtime beside its peers for runtime.sh, which builds what this needs."""

import hashlib
import json
import os
import platform
import re
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from rate_distortion import BIN, OUT, draco_point, error_of, run

# Errors at which both sides are compared, in 1e-4 of the diagonal, and the position bits that
# Draco's smallest file of that error may have.
TARGETS = {1.0: (10, 11, 12), 3.0: (9, 10, 11)}
THROUGHPUT_RATE = 8  # bits per vertex of the original, where vertices per second are compared
# Faces of an error of 1.0 after a simplifier that places vertices where they err least, which needs
# fewer than ours, which keeps them where they are. Only times are taken of these files.
FEWER_FACES = {"horse": 14960, "dragon_vrip": 47000}
# Where the speed of synthesis is measured; a stream of as many vertices as that serves as well.
DEEP_LEVEL = 6
MANY_VERTICES = 500_000
REPETITIONS = 9
# How much a shorter prefix or fewer faces raise the error, roughly: error ~ size ** -SLOPE.
SLOPE = 0.85
CLOSE_ENOUGH = 1.012


def smallest(error_at, target, guess, most):
    """About the smallest size up to `most` with error_at(size) <= target; None if there is none.

    error_at falls with the size but for noise."""
    below = above = None  # (size, error) of the largest that is too small, the smallest that is not
    size = min(guess, most)
    for _ in range(10):
        error = error_at(size)
        if error <= target:
            above = (size, error)
        elif size >= most or (below and size > 1.3 * below[0] and error > 0.97 * below[1]):
            return None
        else:
            below = (size, error)
        if not below:
            size = int(size * (error / target) ** (1 / SLOPE) * 0.99)
        elif not above:
            size = min(most, int(size * max((error / target) ** (1 / SLOPE), 1.02) * 1.01))
        elif above[0] <= CLOSE_ENOUGH * below[0]:
            break
        else:
            share = (below[1] - target) / max(below[1] - above[1], 1e-9)
            share = min(max(share, 0.08), 0.92)
            size = int(below[0] * (above[0] / below[0]) ** share) + 1
    return above[0] if above else None


def convert(original, folder, name, *options):
    """The stream and report of a conversion; kept on disk."""
    stream, report = folder / f"{name}.zt", folder / f"{name}.json"
    if not (stream.exists() and report.exists()):
        made = folder / f"{name}.made.zt"
        run(BIN / "zerotree", "convert", original, "-o", folder / f"{name}.glb", "--stream", made,
            "--report", report, "--threads", 2, *options)
        made.rename(stream)
    return stream, json.loads(report.read_text())


class OurErrors:
    """The error of a prefix of a stream as the mesh of a level; kept on disk."""

    def __init__(self, original, stream, folder):
        self.original, self.stream, self.folder = original, stream, folder
        self.size = stream.stat().st_size
        self.tag = hashlib.sha256(stream.read_bytes()).hexdigest()[:12]

    def __call__(self, size, level):
        kept = self.folder / f"balanced_{self.tag}_{size}_{level}.json"
        if kept.exists():
            return json.loads(kept.read_text())
        decoded = kept.with_suffix(".ply")
        run(BIN / "zerotree", "decode", self.stream, "-o", decoded, "--bytes", size,
            "--level", level, "--balanced")
        error = error_of(self.original, decoded)
        decoded.unlink()
        kept.write_text(json.dumps(error))
        return error


def our_pairs(errors, levels, vertices, target):
    """[(bytes, level, error)]: the shortest prefix of the two coarsest levels that reach it."""
    reaching = []
    for level in range(levels, 0, -1):
        if errors(errors.size, level) > target:
            break
        reaching.append(level)
    pairs = []
    for level in reaching[:-3:-1]:
        size = smallest(lambda n: errors(n, level), target, int(vertices / 8 / target ** 1.2),
                        errors.size)
        # Errors are not quite monotone in the bytes; a level that the search misses is left out.
        if size is not None:
            pairs.append((size, level, errors(size, level)))
    return pairs


def draco_file(original, faces, bits, folder, level):
    coded = folder / f"draco_{faces}_{bits}_cl{level}.drc"
    if not coded.exists():
        simple = coded.with_suffix(".ply")
        run(BIN / "simplify_mesh", original, simple, faces)
        run("draco_encoder", "-i", simple, "-o", coded, "-cl", level, "-qp", bits)
        simple.unlink()
    return coded


def smallest_draco(original, faces_in, folder, target):
    """{"faces", "bits", "error", "file"} of Draco's smallest file of an error."""
    def best_of(bits):
        faces = smallest(lambda n: draco_point(original, n, bits, folder)[1], target,
                         int(0.15 * faces_in / target ** 1.1), faces_in)
        return faces and (draco_point(original, faces, bits, folder), faces, bits)

    with ThreadPoolExecutor(2) as pool:
        points = [p for p in pool.map(best_of, TARGETS[target]) if p]
    if not points:
        sys.exit(f"runtime: Draco does not reach an error of {target}e-4 on {original}")
    (_, error), faces, bits = min(points)
    return {"faces": faces, "bits": bits, "error": error,
            "file": draco_file(original, faces, bits, folder, 10)}


def throughput_draco(original, vertices, faces_in, folder):
    """Draco's most exact file of THROUGHPUT_RATE bits per vertex with -cl 7, as smallest_draco."""
    budget = THROUGHPUT_RATE * vertices / 8
    points = []
    for bits in (11, 12, 13):
        per_face = 0.85 + 0.27 * (bits - 11)
        faces = min(int(budget / per_face), faces_in)
        while draco_file(original, faces, bits, folder, 7).stat().st_size > budget:
            faces = int(faces * 0.98 * min(1, budget / draco_file(
                original, faces, bits, folder, 7).stat().st_size))
        # -cl changes bytes, not the surface.
        points.append((draco_point(original, faces, bits, folder)[1], faces, bits))
    error, faces, bits = min(points)
    return {"faces": faces, "bits": bits, "error": error,
            "file": draco_file(original, faces, bits, folder, 7)}


def measure(stream, deep, pairs, files, folder):
    """{name: its best repetition: {"real_time" in microseconds and counters}}"""
    out = folder / "benchmark.json"
    run(BIN / "runtime_benchmark", stream, f"--deep={deep}",
        *(f"--pair={size}:{level}" for size, level in pairs), *(f"--draco={f}" for f in files),
        "--benchmark_min_time=0.02", f"--benchmark_repetitions={REPETITIONS}",
        "--benchmark_report_aggregates_only", "--benchmark_enable_random_interleaving=true",
        f"--benchmark_out={out}", "--benchmark_out_format=json")
    return {re.sub("(/iterations:[0-9]+)?/manual_time$", "", b["run_name"]): b
            for b in json.loads(out.read_text())["benchmarks"] if b["aggregate_name"] == "min"}


class Mesh:
    """What is compared on a mesh: all files, made once."""

    def __init__(self, path):
        tag = hashlib.sha256(path.read_bytes()).hexdigest()[:12]
        self.name = path.name.split(".")[0]
        self.folder = OUT / "runtime" / f"{self.name}_{tag}"
        draco_folder = OUT / "draco" / f"{path.stem}_{tag}"  # rate_distortion.py's
        for folder in (self.folder, draco_folder):
            folder.mkdir(parents=True, exist_ok=True)
        self.stream, report = convert(path, self.folder, "ours")
        self.vertices, faces = report["input"]["vertices"], report["input"]["faces"]
        self.facts = json.loads(run(BIN / "runtime_benchmark", self.stream, "--facts"))
        levels = self.facts["levels"]
        is_deep = levels >= DEEP_LEVEL or self.facts["vertices"][-1] >= MANY_VERTICES
        self.deep = self.stream if is_deep else convert(
            path, self.folder, "deep", "--levels", DEEP_LEVEL)[0]
        errors = OurErrors(path, self.stream, self.folder)
        self.pairs = {t: our_pairs(errors, levels, self.vertices, t) for t in TARGETS}
        self.draco = {t: smallest_draco(path, faces, draco_folder, t) for t in TARGETS}
        size = min(int(THROUGHPUT_RATE * self.vertices / 8), errors.size)
        as_fine = min(range(levels + 1),
                      key=lambda level: abs(self.facts["vertices"][level] - self.vertices))
        self.fast_pairs = [(size, level, errors(size, level)) for level in {as_fine, levels}]
        self.fast_draco = throughput_draco(path, self.vertices, faces, draco_folder)
        self.fewer_faces = None
        if self.name in FEWER_FACES:
            self.fewer_faces = draco_file(path, FEWER_FACES[self.name], 12, draco_folder, 10)

    def measure(self):
        pairs = {p[:2] for some in (*self.pairs.values(), self.fast_pairs) for p in some}
        files = {d["file"] for d in (*self.draco.values(), self.fast_draco)}
        if self.fewer_faces:
            files.add(self.fewer_faces)
        self.times = measure(self.stream, self.deep, sorted(pairs), sorted(files), self.folder)

    def ms(self, name):
        return self.times[name]["real_time"] / 1000


def at(pair):
    return f"{pair[0]}:{pair[1]}"


def peer_rows(mesh):
    for target, pairs in mesh.pairs.items():
        if not pairs:
            yield f"error {target:g}", "not reached", "", ""
            continue
        pair = min(pairs, key=lambda p: mesh.ms("ours/" + at(p)))
        ours = mesh.ms("ours/" + at(pair))
        shown = (f"{ours:.2f} ms ({pair[0]} bytes, level {pair[1]},"
                 f" {mesh.facts['vertices'][pair[1]]} vertices)")
        files = [(mesh.draco[target]["file"], "")]
        if target == 1.0 and mesh.fewer_faces:
            files.append((mesh.fewer_faces, " of fewer faces"))
        for file, which in files:
            for codec in ("draco", "meshoptimizer"):
                name = f"{codec}/{file.name}"
                counts, peer = mesh.times[name], mesh.ms(name)
                yield (f"error {target:g}, {codec}{which}", shown,
                       f"{peer:.2f} ms ({counts['bytes']:.0f} bytes,"
                       f" {counts['triangles']:.0f} faces)", f"{ours / peer:.2f}")
    file = f"draco/{mesh.fast_draco['file'].name}"
    peer = mesh.times[file]["vertices"] / mesh.ms(file) / 1000
    for pair in mesh.fast_pairs:
        speed = mesh.facts["vertices"][pair[1]] / mesh.ms("ours/" + at(pair)) / 1000
        yield (f"{THROUGHPUT_RATE} bits per vertex, draco -cl 7",
               f"{speed:.1f} Mv/s (level {pair[1]}, error {pair[2]:.2f})",
               f"{peer:.1f} Mv/s (error {mesh.fast_draco['error']:.2f})", f"{speed / peer:.2f}")


def own_rows(mesh):
    for pairs in (*mesh.pairs.values(), mesh.fast_pairs):
        for pair in pairs:
            ms = {part: mesh.ms(f"{part}/{at(pair)}")
                  for part in ("ours", "feed", "first_surface", "indices", "step_feed",
                               "step_surface")}
            yield (f"{pair[0]} bytes at level {pair[1]}, error {pair[2]:.2f}",
                   f"all {ms['ours']:.2f} ms: feed {ms['feed']:.2f}, first surface"
                   f" {ms['first_surface']:.2f}, indices {ms['indices']:.2f}; the last 1 kB of it:"
                   f" feed {ms['step_feed']:.2f}, surface {ms['step_surface']:.2f}")
    once, steps = mesh.ms("feed_at_once"), mesh.ms("feed_in_steps")
    size = mesh.times["feed_at_once"]["bytes"]
    yield (f"feed {size:.0f} bytes at once, in steps of 1 kB",
           f"{once:.2f} ms ({size / once / 1000:.2f} MB/s), {steps:.2f} ms (x {steps / once:.3f})")
    deep = mesh.times["synthesis_positions"]
    of_vertex = 1e6 / deep["vertices"]
    yield (f"synthesis at level {deep['level']:.0f}, {deep['vertices']:.0f} vertices",
           f"{of_vertex * mesh.ms('synthesis_positions'):.1f} ns per vertex, with normals"
           f" {of_vertex * mesh.ms('synthesis_with_normals'):.1f}")
    one, two = mesh.ms("synthesis_wall_one_thread"), mesh.ms("synthesis_wall_two_threads")
    yield "the same with one thread, two (wall)", f"{one:.1f} ms, {two:.1f} ms (x {one / two:.2f})"
    facts, finest = mesh.facts, mesh.facts["vertices"][-1]
    yield (f"memory at level {facts['levels']}, {finest} vertices",
           f"{facts['memory'] / finest:.1f} bytes per vertex, peak {facts['peak'] / finest:.1f}")
    yield "allocations after the first surface", f"{facts['later_allocations']}"
    overruns = facts["overruns"]
    for name in ("feed", "first_surface", "later_surfaces"):
        of = overruns[name]
        yield (f"over a budget of {overruns['budget']} us at most: {name.replace('_', ' ')}",
               f"{of['cpu']:.0f} us (worst pass {of['worst_cpu']:.0f}, by the wall clock"
               f" {of['wall']:.0f})")


def write_markdown(meshes, path):
    lines = ["# The runtime beside its peers", "",
             "One run, one thread, warm memory, processor time of the best of"
             f" {REPETITIONS} repetitions unless it says wall; {platform.machine()}, load"
             f" {os.getloadavg()[0]:.1f}. Ours: bytes in memory -> positions, normals and 32 bit"
             " indices; the peers: positions and indices. Errors in 1e-4 of the diagonal. Draco's"
             " file is its smallest of that error after meshoptimizer's simplifier (`-cl 10`); `of"
             " fewer faces`: as many as the best simplifier known needs for that error."
             " meshoptimizer holds the same meshes.", ""]
    for mesh in meshes:
        lines += [f"## {mesh.name} ({mesh.vertices} vertices)", "",
                  "| line | ours | peer | ours / peer |", "|---|---|---|---|"]
        lines += ["| " + " | ".join(row) + " |" for row in peer_rows(mesh)]
        lines += ["", "| ours | |", "|---|---|"]
        lines += ["| " + " | ".join(row) + " |" for row in own_rows(mesh)]
        lines.append("")
    path.write_text("\n".join(lines))


def main(paths):
    meshes = []
    for path in map(Path, paths):
        print(f"Preparing {path.name}", file=sys.stderr)
        meshes.append(Mesh(path))
    for mesh in meshes:
        print(f"Measuring {mesh.name}", file=sys.stderr)
        mesh.measure()
    write_markdown(meshes, OUT / "runtime.md")
    print((OUT / "runtime.md").read_text())


if __name__ == "__main__":
    main(sys.argv[1:])
