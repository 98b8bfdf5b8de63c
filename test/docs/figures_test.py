# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""What `scripts/report check` sees and what it leaves alone, and that blocks follow the rows."""
import importlib.machinery
import importlib.util
import json
import pathlib
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "scripts"
sys.path.insert(0, str(SCRIPTS))
loader = importlib.machinery.SourceFileLoader("report", str(SCRIPTS / "report"))
report = importlib.util.module_from_spec(importlib.util.spec_from_loader("report", loader))
loader.exec_module(report)
from figures import measure, names, tables  # noqa: E402
HEADERS = names.headers
tables.ratio = lambda rows, *key: f"{rows.ratio(*key):.1f}"  # a block of one row

RUN = {"run": "falling", "command": "kios_bench falling", "machine": "M", "load": 0.1,
       "date": "2026-01-02", "commit": "abc"}
ROW = {"scenario": "falling", "query": "distance", "bv": "kios", "frames": 2, "median_us": 12.34,
       "ratio_to_fcl_obbrss": 30}  # of frames; tables show quotients of what stands beside them
THEIRS = {**ROW, "bv": "fcl_obbrss", "median_us": 349.2}
STRIPS = {**ROW, "scenario": "strips", "median_us": 100.0}
THEIR_STRIPS = {**STRIPS, "bv": "fcl_obbrss", "median_us": 521.0}
PAGE = """FCL takes <!-- report:ratio strips distance -->{}<!-- /report --> times as long;
<!-- report:ratio falling distance -->
{}
<!-- /report -->
<!-- report:run falling -->{}<!-- /report -->"""

TYPED = ["12.7 us", "12.7us", "3 ms", "20 ns", "0.24 s", "1.5 to 2.5 times", "three times", "4 %",
         "65 times", "20%", "1/11", "2x", "half as long", "a third faster", "twice as fast",
         "a quarter of the time", "slower by a tenth",
         "the default is a million", "the default\nof 12", "12 by default",
         "`max_boxes` (12"]
LEFT_ALONE = ["within 16 eps L", "2^-46 L", "1e-300 to 1e300", "128 bytes a node", "k = 5",
              "20,000 triangles", "`12 us`", "```\n12 us\n```", "see [it](12us.md)", "FCL 0.7",
              "pi/6", "a^2/c", "u = eps / 2", "version 3 or 4", "sometimes", "ray_1/2.md",
              "| volume | k |\n|---|--:|\n| RSS | 3 |"]


class Figures(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "falling.jsonl").write_text("\n".join(map(
            json.dumps, [RUN, ROW, THEIRS, STRIPS, THEIR_STRIPS])))
        self.rows = report.Rows(self.folder)

    def typed(self, text):
        return [figure for _, figure, _ in report.typed(text)]

    def test_times_ratios_and_shares_are_seen(self):
        for figure in TYPED:
            self.assertTrue(self.typed(f"A query takes {figure} there."), figure)
        self.assertEqual(self.typed("| volume | us |\n|---|--:|\n| RSS | 354 |\n"), ["354"])
        self.assertEqual(self.typed("| triangles | tightness |\n|---|--:|\n| 16 | 0.75 / 1.2 |\n"),
                         ["0.75 / 1.2"])
        self.assertEqual(list(report.typed("one\ntakes\n12 us\n")), [(3, "12 us", "takes 12 us")])

    def test_bounds_sizes_and_code_are_left_alone(self):
        for text in LEFT_ALONE:
            self.assertEqual(self.typed(text), [], text)
        self.assertEqual(self.typed(PAGE.format("12 us", "12 us", "12 us")), [])

    def test_blocks_follow_the_rows(self):
        self.assertEqual(report.filled(PAGE.format("9", "old", "?"), self.rows),
                         PAGE.format("5.2", "28.3", "M, load 0.1, 2026-01-02, commit abc"))

    def test_a_block_without_rows_or_name_is_refused(self):
        for name in ("default MotionRequest::nothing", "ratio spinning distance", "no_such_table",
                     "Rows", "readme", "number"):
            with self.assertRaises(LookupError, msg=name):
                report.filled(f"<!-- report:{name} --><!-- /report -->", self.rows)

    def test_a_run_takes_the_place_of_the_one_before(self):
        file = self.folder / "tori.jsonl"
        runs = [{**RUN, "run": "falling"}, ROW, {**RUN, "run": "gone"}, ROW,
                {**RUN, "run": "spinning"}, THEIRS, STRIPS, {**RUN, "run": "strips"}, STRIPS]
        file.write_text("\n".join(map(json.dumps, runs)))
        measure.replace(file, "falling", [{**RUN, "commit": "new"}, STRIPS])
        self.assertEqual([json.loads(line) for line in file.read_text().splitlines()],
                         [*runs[2:6], {**RUN, "commit": "new"}, STRIPS])

    def test_names_and_defaults_are_those_of_the_headers(self):
        text = """namespace kios {
/// Finds a: b. More.
template <typename S>
int find(const S& a, int b = 1);
int find(int c);

struct Options {  // no docstring
  int most = 1000, least = 2;
};
using Optionsd = Options<double>;
namespace detail { /// Hides.
int hidden(); }
}"""
        names.headers = lambda: [("x.h", text)]
        self.addCleanup(setattr, names, "headers", HEADERS)
        self.assertEqual(names.public_names(), {"x.h": {"find": "Finds a", "Options": ""}})
        self.assertEqual(names.default(None, "Options::most"), "1,000")
        self.assertEqual(names.default(None, "Options::least"), "2")
        self.assertRaisesRegex(LookupError, "x.h: Options", names.names, None)

    def test_defaults_in_python_are_those_of_the_stubs(self):
        stub = """def collides(self, other: Any) -> bool: ...
    def bracket(self, other: Any,
                rel_err: float = 0.1, threads: Optional[int] = None) -> Bracket: ..."""
        page = "`mesh.bracket(other, rel_err={})` and `mesh.collides(other, X_AB)`"
        self.assertEqual(list(names.wrong_keywords(page.format("0.1"), stub)), [])
        for value in ("0.2", "1e-1, abs_err=0"):
            self.assertEqual(len(list(names.wrong_keywords(page.format(value), stub))), 1, value)

    def test_check_names_what_is_wrong(self):
        report.ROOT, report.MEASURED = self.folder, self.folder
        report.PAGES = [self.folder / "page.md"]
        allowed = self.folder / "allowed.txt"

        def wrong(text, words):
            report.PAGES[0].write_text(text)
            allowed.write_text(words)
            return "\n".join(report.check(self.rows))
        right = report.filled(PAGE.format("9", "old", "?"), self.rows)
        self.assertEqual(wrong(right, "# nothing\n"), "")
        self.assertIn("page.md: its blocks", wrong(right.replace("28.3", "28.4"), ""))
        self.assertIn("page.md:7: '3 ms' is typed", wrong(right + "\n\nIt takes 3 ms.", ""))
        self.assertEqual(wrong(right + "\n\nIt takes 3 ms.", "page.md: takes 3 ms: a test\n"), "")
        self.assertIn("stands nowhere", wrong(right, "page.md: takes 3 ms: a test\n"))


if __name__ == "__main__":
    unittest.main()
