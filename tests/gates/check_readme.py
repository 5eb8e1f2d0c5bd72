#!/usr/bin/env python3
"""Runs the blocks of the README's section "For build steps" on good assets and on bad ones.

Usage: check_readme.py README.md HOOKS.yaml PREFIX ASSETS WORK-FOLDER
"""
import json
import os
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as xml
from pathlib import Path

import yaml

BLOCK = re.compile(r"^<!-- run by tests/gates -->\n```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
PROJECT = """cmake_minimum_required(VERSION 3.25)
project(readme LANGUAGES NONE)
add_custom_target(game ALL)
"""


def check(condition, message):
    if not condition:
        sys.exit(f"check_readme: {message}")


def read_blocks(readme):
    blocks = BLOCK.findall(readme.read_text())
    languages = [language for language, _ in blocks]
    check(languages == ["cmake", "yaml", "sh", "yaml"], f"the marked blocks are {languages}")
    return [text for _, text in blocks]


def run(command, folder, environment):
    result = subprocess.run(command, cwd=folder, env=environment, text=True, timeout=60,
                            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                            stderr=subprocess.STDOUT)
    return result.returncode, result.stdout


def lay_out(folder, ship, assets):
    """A folder with assets/ship.glb, a copy of the asset `ship`, and assets/rock.gltf."""
    shutil.rmtree(folder, ignore_errors=True)
    (folder / "assets").mkdir(parents=True)
    shutil.copy(assets / ship, folder / "assets/ship.glb")
    shutil.copy(assets / "split.gltf", folder / "assets/rock.gltf")
    for buffer in ("split.bin", "split.zt.bin"):
        shutil.copy(assets / buffer, folder / "assets" / buffer)


def check_reports(folder, errors, output):
    reports = json.loads((folder / "validation.json").read_text())
    counts = {Path(report["uri"]).name: report["issues"]["numErrors"] for report in reports}
    check(counts == {"rock.gltf": 0, "ship.glb": errors},
          f"validation.json counts {counts}\n{output}")
    cases = xml.parse(folder / "validation.xml").getroot().findall(".//testcase")
    failed = [case for case in cases if case.find("failure") is not None]
    check(len(cases) == 2 and len(failed) == min(errors, 1),
          f"validation.xml has {len(failed)} failures in {len(cases)} cases\n{output}")


def check_shell(command, work, assets, environment):
    for ship, code in (("good.glb", 0), ("bad.glb", 1)):
        lay_out(work, ship, assets)
        status, output = run(["bash", "-euc", command], work, environment)
        check(status == code, f"{command}ends with {status} on {ship}, not {code}\n{output}")
        check_reports(work, code, output)


def check_cmake(text, work, assets, environment):
    builds = (("good.glb", "all", 0), ("bad.glb", "assets", 1), ("bad.glb", "game", 1))
    for ship, target, code in builds:
        lay_out(work, ship, assets)
        (work / "CMakeLists.txt").write_text(PROJECT + text)
        status, output = run(["cmake", "-G", "Ninja", "-S", ".", "-B", "build"], work, environment)
        check(status == 0, f"the CMake block does not configure\n{output}")
        status, output = run(["cmake", "--build", "build", "--target", target], work, environment)
        check((status != 0) == (code != 0),
              f"the build of {target} ends with {status} on {ship}\n{output}")
        check(code == 0 or "PAYLOAD_BASE_MISMATCH" in output,
              f"no word of what is wrong\n{output}")
        if target != "game":
            check_reports(work / "build", code, output)


def main():
    readme, hooks_file, prefix, assets, work = map(Path.resolve, map(Path, sys.argv[1:]))
    environment = dict(os.environ, PATH=f"{prefix}/bin:{os.environ['PATH']}",
                       CMAKE_PREFIX_PATH=str(prefix))
    cmake, pre_commit, shell, actions = read_blocks(readme)

    hooks = {hook["id"] for hook in yaml.safe_load(hooks_file.read_text())}
    shown = {hook["id"] for repo in yaml.safe_load(pre_commit)["repos"] for hook in repo["hooks"]}
    check(shown == hooks, f"the README shows the hooks {shown}, there are {hooks}")

    steps = yaml.safe_load(actions)["jobs"]["validate"]["steps"]
    commands = [step["run"] + "\n" for step in steps if "run" in step]
    check(commands == [shell], f"the workflow runs {commands}, the shell {shell!r}")
    check_shell(shell, work / "shell", assets, environment)
    check_cmake(cmake, work / "cmake", assets, environment)


main()
