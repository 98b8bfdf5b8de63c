# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs of kios_bench, kept with what a reader must know of them."""
import datetime
import json
import os
import pathlib
import platform
import re
import subprocess
import time

PAPER = "--bv kios,kios_method_ii,kios_tree,fcl_rss_tree,fcl_obbrss"
PAIR = "--bv kios,fcl_obbrss"
RUNS = {  # scenario: options
    "falling": f"--frames 2400 --repeats 5 {PAPER}",
    "spinning": f"--frames 2400 --repeats 5 {PAPER}",
    "generated": f"--frames 300 --repeats 5 {PAIR}",
    "strips": f"--frames 20 --repeats 5 {PAIR}",
    "robots": f"--frames 60 --repeats 3 --oracle 100 {PAIR}",
    "world": "--repeats 3 --oracle 20 --bv kios,fcl_rss,fcl_obbrss",
    "coal": "--repeats 3 --oracle 20",
    "crowds": "--repeats 3 --oracle 100",
    "scaling": f"--frames 32 --repeats 5 {PAIR}",
    "build": "--repeats 5",
    "refit": f"--repeats 3 --max-triangles 5000 {PAIR}",
    "error": "--frames 300 --repeats 5 --bv kios,fcl_rss,fcl_obbrss",
    "scene": "--frames 100 --repeats 3",
    "shapes": "--frames 60 --repeats 5",
    "octrees": "--frames 60 --repeats 5",
    "continuous": "--frames 40 --repeats 5",
    "solids": "--repeats 5",
    "motions": "--frames 200 --repeats 3 --oracle 1000",
    "mbm": f"--frames 700 {PAIR}",
    "rays": "--frames 4096 --repeats 5",
    "paper": "--frames 20 --repeats 2",
    "fits": "--frames 100 --repeats 3",
    "packing": "--repeats 5",
    "exact": "--repeats 5",
    "stability": "--frames 2000 --repeats 1",
    "preload": "--repeats 3",
}

# Runs of a thousand rows are kept without what no page has.
UNKEPT = dict.fromkeys(("world", "coal"), (
    "min_us", "rel_err", "abs_err", "bv_tests", "leaf_tests", "bytes_per_triangle",
    "build_us_per_triangle", "simd_target", "seed"))


def header(root, scenario, command):
    def output(*words):
        return subprocess.run(words, cwd=root, capture_output=True, text=True).stdout.strip()
    cpu = re.search(r"model name\s*: (.*)", pathlib.Path("/proc/cpuinfo").read_text())
    commit = output("git", "rev-parse", "--short", "HEAD")
    changed = output("git", "status", "--porcelain", "--", "src", "include", "addons",
                     "benchmarks")
    return {"run": scenario, "command": command,
            "machine": f"{cpu[1] if cpu else platform.processor()}, {os.cpu_count()} cores",
            "load": round(os.getloadavg()[0], 1), "date": datetime.date.today().isoformat(),
            "commit": commit + (" and changes" if changed else "")}


def slim(row, unkept=()):
    """The row without what is unknown, to five digits."""
    return {key: float(f"{value:.5g}") if isinstance(value, float) else value
            for key, value in row.items() if value is not None and key not in unkept}


def measure(root, folder, scenarios):
    program = os.environ.get("KIOS_BENCH", root / "build/release/benchmarks/kios_bench")
    logs = root / "build/report"
    logs.mkdir(parents=True, exist_ok=True)
    start, rowless = time.monotonic(), []
    for i, scenario in enumerate(scenarios, 1):
        command = f"kios_bench {scenario} {RUNS[scenario]}"
        print(f"report: {time.monotonic() - start:4.0f} s, {i} of {len(scenarios)}: {command}",
              flush=True)
        head, rows = header(root, scenario, command), logs / f"{scenario}.jsonl"
        with open(logs / f"{scenario}.log", "w", encoding="utf-8") as log:
            subprocess.run([program, *command.split()[1:], "--json", rows], check=True, stdout=log)
        lines = [slim(json.loads(line), UNKEPT.get(scenario, ()))
                 for line in rows.read_text().splitlines()]
        if not lines:
            rowless.append(scenario)
            continue
        lines = [json.dumps(line) + "\n" for line in [head, *lines]]
        (folder / rows.name).write_text("".join(lines))
    print(f"report: {time.monotonic() - start:4.0f} s, done; now: scripts/report write")
    if rowless:
        raise LookupError(f"no row, so that what was measured before stays, of {', '.join(rowless)}"
                          f": {logs}/*.log say why")
