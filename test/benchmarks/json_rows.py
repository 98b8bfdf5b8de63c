# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""usage: json_rows.py KIOS_BENCH

Every row of kios_bench's JSON has the fields that readers of it count on; what is unknown is null."""
import json
import subprocess
import sys
import tempfile

FIELDS = set("""
scenario query bv triangles frames rel_err abs_err threshold median_us min_us ratio_to_fcl_obbrss
max_abs_error max_rel_error wrong_verdicts bv_tests leaf_tests bytes_per_triangle
build_us_per_triangle skipped_pairs total_pairs simd_target seed
""".split())
KNOWN = {"scenario", "query", "bv", "triangles", "frames", "median_us", "min_us", "seed"}

with tempfile.NamedTemporaryFile() as file:
    subprocess.run([sys.argv[1], "tori/generated", "--quick", "--seed", "3", "--json", file.name],
                   check=True, stdout=subprocess.DEVNULL)
    rows = [json.loads(line) for line in file.read().splitlines()]
assert rows
for row in rows:
    assert FIELDS <= row.keys(), FIELDS - row.keys()
    assert all(row[key] is not None for key in KNOWN), row
    assert row["seed"] == 3 and (row["simd_target"] is not None) == (row["bv"] == "kios"), row
