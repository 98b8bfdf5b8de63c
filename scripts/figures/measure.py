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
RUNS = {  # run: its file in docs/measured, and what kios_bench is asked
    "falling": ("tori", f"tori/falling --frames 2400 --repeats 5 {PAPER}"),
    "spinning": ("tori", f"tori/spinning --frames 2400 --repeats 5 {PAPER}"),
    "generated": ("tori", f"tori/generated --frames 300 --repeats 5 {PAIR}"),
    "scaling": ("tori", f"tori/scaling --frames 32 --repeats 5 {PAIR}"),
    "robots": ("robots", f"robots --frames 60 --repeats 3 --oracle 100 {PAIR}"),
    "world": ("world", "world --repeats 3 --oracle 20 --bv kios,fcl_rss,fcl_obbrss"),
    "coal": ("world", "world/coal --repeats 3 --oracle 20"),
    "scene": ("robots", "scene/bodies --frames 100 --repeats 3"),
    "build": ("build", "build/models --repeats 5"),
    "refit": ("build", f"build/refit --repeats 3 {PAIR}"),
    "error": ("error", "error --frames 300 --repeats 5 --bv kios,fcl_rss,fcl_obbrss"),
    "shapes": ("shapes", "shapes --frames 60 --repeats 5"),
    "rays": ("shapes", "rays --frames 4096 --repeats 5"),
    "solids": ("shapes", "solids/contains solids/penetration --repeats 5"),
    "depth": ("shapes", "solids/depth --repeats 5"),
    "points": ("shapes", "solids/points --repeats 5"),
    "clashes": ("world", "clashes/1000 clashes/10000 --repeats 5"),
    "pieces": ("world", "clashes/pieces --repeats 3"),
    "continuous": ("motions", "motions/continuous --frames 40 --repeats 5"),
    "moved": ("motions", "motions/moved --repeats 5"),
    "motions": ("motions", "motions/paths --frames 200 --repeats 3 --oracle 1000"),
    "range": ("motions", "motions/range --repeats 3"),
    "mbm": ("motions", f"mbm --frames 700 {PAIR}"),
    "fits": ("tori", "paper --frames 100 --repeats 3"),
    "stability": ("stability", "stability/triangles --frames 2000 --repeats 1"),
    "stress": ("stability", "stability/queries"),
    "preload": ("preload", "preload --repeats 3"),
}

# What no page has isn't kept.
UNKEPT = ("min_us", "ratio_to_fcl_obbrss", "max_rel_error", "bracket_width", "skipped_pairs",
          "simd_target", "seed")


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


def slim(row):
    """The row without what is unknown or unkept, to five digits."""
    return {key: float(f"{value:.5g}") if isinstance(value, float) else value
            for key, value in row.items() if value is not None and key not in UNKEPT}


def replace(file, run, lines):
    """Puts the lines of a run, of which the first is its header, in the place of those before, and
    of rows of the same scenarios that another run had. All other rows stay."""
    fresh = {row["scenario"] for row in lines[1:]}
    kept = []  # runs, each with its rows
    for line in map(json.loads, file.read_text().splitlines() if file.exists() else []):
        if "run" in line:
            kept.append([line])
        elif line["scenario"] not in fresh:
            kept[-1].append(line)
    kept = [of for of in kept if of[0]["run"] != run and len(of) > 1]
    file.write_text("".join(json.dumps(line) + "\n" for of in [*kept, lines] for line in of))


def measure(root, folder, runs):
    program = os.environ.get("KIOS_BENCH", root / "build/release/benchmarks/kios_bench")
    logs = root / "build/report"
    logs.mkdir(parents=True, exist_ok=True)
    start, rowless = time.monotonic(), []
    for i, run in enumerate(runs, 1):
        file, asked = RUNS[run]
        command = f"kios_bench {asked}"
        print(f"report: {time.monotonic() - start:4.0f} s, {i} of {len(runs)}: {command}",
              flush=True)
        head, rows = header(root, run, command), logs / f"{run}.jsonl"
        with open(logs / f"{run}.log", "w", encoding="utf-8") as log:
            subprocess.run([program, *asked.split(), "--json", rows], check=True, stdout=log)
        lines = [slim(json.loads(line)) for line in rows.read_text().splitlines()]
        if lines:
            replace(folder / f"{file}.jsonl", run, [head, *lines])
        else:
            rowless.append(run)
    print(f"report: {time.monotonic() - start:4.0f} s, done; now: scripts/report write")
    if rowless:
        raise LookupError(f"no row, so that what was measured before stays, of {', '.join(rowless)}"
                          f": {logs}/*.log say why")
