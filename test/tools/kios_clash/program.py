#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""usage: program.py KIOS_CLASH SOURCE_DIR WORK_DIR

kios_clash as a user runs it: planted clashes of generated files, its formats, exit codes, errors."""
import base64
import csv
import io
import json
import os
import struct
import subprocess
import sys
import unittest

PROGRAM, SOURCE, WORK = (os.path.abspath(a) for a in sys.argv[1:4])
with open(os.path.join(SOURCE, "docs", "clash.schema.json"), encoding="utf-8") as schema_file:
    SCHEMA = json.load(schema_file)
TYPES = {"object": dict, "array": list, "string": str, "boolean": bool, "integer": int,
         "number": (int, float), "null": type(None)}


def faults(value, schema, at="$"):
    """What of JSON Schema our schema uses; anything else it might use is a fault, too."""
    if "$ref" in schema:
        schema = {**SCHEMA["$defs"][schema["$ref"].split("/")[-1]], **schema}
    unknown = set(schema) - {
        "$schema", "$ref", "$defs", "title", "description", "type", "required", "properties",
        "additionalProperties", "items", "minItems", "maxItems", "minimum", "enum", "oneOf"}
    found = ["%s: schema has %s" % (at, sorted(unknown))] if unknown else []
    if "type" in schema:
        kinds = schema["type"] if isinstance(schema["type"], list) else [schema["type"]]
        is_bool = isinstance(value, bool)
        if not any(isinstance(value, TYPES[k]) and is_bool == (k == "boolean") for k in kinds):
            return found + ["%s is no %s: %r" % (at, kinds, value)]
    if "enum" in schema and value not in schema["enum"]:
        found.append("%s: %r" % (at, value))
    if "minimum" in schema and value < schema["minimum"]:
        found.append("%s: %r" % (at, value))
    if isinstance(value, dict):
        properties = schema.get("properties", {})
        found += ["%s lacks %s" % (at, k) for k in schema.get("required", []) if k not in value]
        found += ["%s has %s" % (at, k) for k in value
                  if k not in properties and schema.get("additionalProperties") is False]
        for key, of in properties.items():
            found += faults(value[key], of, at + "." + key) if key in value else []
    if isinstance(value, list):
        if not schema.get("minItems", 0) <= len(value) <= schema.get("maxItems", len(value)):
            found.append("%s has %d items" % (at, len(value)))
        for i, item in enumerate(value):
            found += faults(item, schema.get("items", {}), "%s[%d]" % (at, i))
    if "oneOf" in schema and sum(not faults(value, s, at) for s in schema["oneOf"]) != 1:
        found.append("%s is not one of %s" % (at, schema["oneOf"]))
    return found


def path(*names):
    return os.path.join(WORK, *names)


def write(name, text):
    with open(path(name), "w", encoding="utf-8") as file:
        file.write(text)
    return path(name)


def run(*arguments):
    done = subprocess.run([PROGRAM, *arguments], capture_output=True, check=False, timeout=300)
    return done.returncode, done.stdout.decode(), done.stderr.decode()


def make(*arguments):
    subprocess.run([sys.executable, os.path.join(SOURCE, "examples", "clash_files.py"), *arguments],
                   check=True, stdout=subprocess.DEVNULL)


def box(x=0.0, size=1.0, name="box", base=0):
    corners = ["v %r %r %r" % (x + size * (i & 1), size * (i >> 1 & 1), size * (i >> 2))
               for i in range(8)]
    faces = ["1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6"]
    return "\n".join(["o " + name, *corners, *("f " + " ".join(
        str(int(i) + base) for i in face.split()) for face in faces)]) + "\n"


class Program(unittest.TestCase):
    def report(self, *arguments, code):
        status, out, err = run(*arguments, "--json")
        self.assertEqual(status, code, err)
        report = json.loads(out)
        self.assertEqual(faults(report, SCHEMA), [])
        try:
            import jsonschema
        except ImportError:
            pass
        else:
            jsonschema.validate(report, SCHEMA)
        self.assertEqual(sum(report["counts"].values()), len(report["clashes"]))
        self.assertEqual(run(*arguments, "--json", "--threads", "1")[1], out, "not byte-equal")
        return report

    def statuses(self, report):
        return {frozenset((c["a"], c["b"])): c["status"] for c in report["clashes"]}

    def expect(self, report, folder):
        with open(path(folder, "expected.json"), encoding="ascii") as file:
            expected = {frozenset((a, b)): status for a, b, status in json.load(file)}
        found = self.statuses(report)
        self.assertEqual({k: v for k, v in found.items() if expected.get(k) != v}, {})
        self.assertEqual({k: v for k, v in expected.items() if k not in found}, {})
        self.assertTrue(all(clash["decided"] for clash in report["clashes"]))
        return expected

    def test_a_building_has_what_was_planted_and_nothing_else(self):
        for place in ([], ["--site"]):
            with self.subTest(place=place):
                make("building", path("building"), "--bays", "8", "--floors", "4", *place)
                report = self.report(path("building", "building.obj"), "--clearance", "0.05", code=1)
                expected = self.expect(report, "building")
                self.assertEqual(set(expected.values()), {"overlap", "inside", "duplicate",
                                                          "clearance", "touch"})
                self.assertTrue(all(part["solid"] for part in report["parts"]))
                sunk = [c for c in report["clashes"] if c["status"] == "overlap" and
                        {c["a"][:4], c["b"][:4]} == {"colu", "slab"}]
                self.assertTrue(sunk)
                for clash in sunk:  # two centimetres
                    self.assertLessEqual(clash["depth"][0], 0.02 + 1e-8)
                    self.assertGreaterEqual(clash["depth"][1], 0.02 - 1e-8)

    def test_an_assembly_by_its_manifest(self):
        make("assembly", path("assembly"))
        manifest = path("assembly", "assembly.json")
        self.expect(self.report(manifest, code=1), "assembly")
        here = self.statuses(self.report(manifest, "--between", "plates", "fasteners", code=1))
        kinds = [{name.split("#")[0] for name in pair} for pair in here]
        self.assertTrue(here and all("plate" in kind and len(kind) == 2 for kind in kinds))
        ignored = self.statuses(self.report(manifest, "--ignore", "bolt#5:bolt#6", "--ignore",
                                            "nut#4:plate#7", code=1))
        self.assertNotIn("duplicate", ignored.values())
        self.assertEqual(run(manifest, "--ignore", "bolt:screw")[0], 2)
        self.assertEqual(run(manifest, "--between", "plates", "nuts")[0], 2)

    def test_exit_codes_and_numbered_names(self):
        first, second = write("box.obj", box()), write("apart.obj", box(5))
        self.assertEqual(run(first, second)[0], 0)
        report = self.report(first, first, write("touching.obj", box(1)), code=1)
        self.assertEqual([part["name"] for part in report["parts"]], ["box", "box#2", "touching"])
        self.assertEqual(report["counts"]["duplicate"], 1)
        self.assertEqual(report["counts"]["touch"], 2)
        self.assertEqual(run(first, path("touching.obj"))[0], 0)
        self.assertEqual(run(first, second, "--clearance", "5")[0], 1)
        two = write("two.obj", box(name="a b") + box(1, name="a:b", base=8))
        self.assertEqual(list(self.statuses(self.report(two, code=0))), [frozenset(("a b", "a:b"))])
        self.assertEqual(self.report(two, "--ignore", "a:b:a b", code=0)["clashes"], [])

    def test_what_cannot_be_read_is_named_and_all_else_checked(self):
        good = write("good.obj", box())
        cases = {write("bad.obj", "v 1 2\n"): "bad.obj:1", path("missing.stl"): "no such file",
                 write("text.json", "{"): "it is no JSON",
                 write("list.json", "[]"): "a manifest is",
                 write("key.json", json.dumps({"parts": [{"file": "good.obj", "scale": 2}]})):
                     "the key 'scale'",
                 write("pose.json", json.dumps({"parts": [
                     {"file": "good.obj", "pose": [1, 2, 3]}]})): "four rows",
                 write("bent.json", json.dumps({"parts": [
                     {"name": "bent one", "file": "good.obj", "pose": [
                         2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]}]})): "bent one"}
        for bad, words in cases.items():
            with self.subTest(bad=bad):
                report = self.report(good, bad, write("over.obj", box(0.5)), code=2)
                self.assertEqual(len(report["errors"]), 1)
                self.assertIn(words, report["errors"][0])
                self.assertEqual(report["counts"]["overlap"], 1)
                self.assertIn(words, run(good, bad)[2])
        for arguments in (["--touch", "-1"], ["--touch", "nan"], ["--clearance", "inf"], [],
                          ["--touch", "0.2", "--clearance", "0.1"], ["--between", "a", "a"],
                          ["--html", path("no", "page.html")], ["--json", "--csv"]):
            status, out, err = run(*(arguments and [good]), *arguments)
            self.assertEqual((status, out), (2, ""), arguments)
            self.assertTrue(err, arguments)
        self.assertEqual(run("--version")[0], 0)

    def test_a_manifest_says_one_thing(self):
        entry = {"file": write("good.obj", box())}
        here = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
        flat = [x for row in here for x in row]
        for pose in (here, flat):
            manifest = write("m.json", json.dumps({"parts": [{**entry, "pose": pose}]}))
            self.assertEqual(run(manifest)[0], 0)
        for pose in ([flat], [flat[:8], flat[8:]], [here], here[:3], [*here, []], flat[:15],
                     [*here[:3], flat[:4]], [*here[:3], [0, 0, 0, True]], {"rows": here}, None, 1,
                     [[1, 0, 0], [0], *here[1:3]], [1e400, *flat[1:]]):
            text = json.dumps({"parts": [{**entry, "pose": pose}]}).replace("Infinity", "1e400")
            status, _, err = run(write("m.json", text))
            self.assertEqual(status, 2, pose)
            self.assertIn("a pose is four rows" if "1e400" not in text else "m.json", err, pose)
        for text, key in (('{"parts": [], "parts": [{"file": "good.obj"}]}', "parts"),
                          ('{"parts": [{"file": "good.obj", "name": "a", "name": "b"}]}', "name")):
            status, _, err = run(write("m.json", text))
            self.assertEqual(status, 2)
            self.assertIn("the key '%s' twice" % key, err)
        same = write("m.json", '{"parts": [{"file": "good.obj"}, {"file": "good.obj", "name": ""}]}')
        self.assertEqual([p["name"] for p in self.report(same, code=1)["parts"]], ["good", "good#2"])

    def test_names_of_any_bytes_are_printed_and_told_apart(self):
        names = [b"a\xff", b"a\xfe", b"a\0", b"a\x1b", "a\x85".encode(), "a\u2028".encode(),
                 b"a\xed\xa0\x80", b"a\xc0\x80", "\u00e4 \u4e2d \U0001f529".encode(), b'"q", #1',
                 b"=1+1", b"</script>", b"a\xf9\x80\x80\x80"]
        mesh = b"".join(box(10.0 * i, name="@", base=8 * i).encode().replace(b"@", name)
                        for i, name in enumerate(names))
        with open(path("names.obj"), "wb") as file:
            file.write(mesh + box(0.5, name="last", base=8 * len(names)).encode())
        found = [p["name"] for p in self.report(path("names.obj"), code=1)["parts"]]
        self.assertEqual(found[:6] + found[8:], [
            "a\ufffd", *("a\ufffd#%d" % i for i in range(2, 7)), "\u00e4 \u4e2d \U0001f529",
            '"q", #1', "=1+1", "</script>", found[12], "last"])
        self.assertTrue(found[12].startswith("a\ufffd"))
        self.assertEqual(len(set(found)), len(found))
        for arguments in ([], ["--csv"]):
            lines = run(path("names.obj"), "--clearance", "11", *arguments)[1]
            self.assertEqual(lines.count("\n"), 15)
            self.assertTrue(all(c == "\n" or c.isprintable() for c in lines))
        rows = csv.DictReader(io.StringIO(lines))
        self.assertEqual({row[k] for row in rows for k in "ab"}, set(found))
        done = subprocess.run([PROGRAM, path("names.obj"), "--ignore", b"last:a\xff"], check=False,
                              capture_output=True)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_names_stay_whatever_can_be_read(self):
        over = write("over.obj", box(0.5))
        manifest = write("bolts.json", json.dumps({"parts": [
            {"name": "bolt", "file": "gone.stl"}, {"name": "bolt", "file": "good.obj"},
            {"name": "nut", "file": "over.obj"}]}))
        write("good.obj", box())
        report = self.report(manifest, "--ignore", "bolt:nut", code=2)
        self.assertEqual([part["name"] for part in report["parts"]], ["bolt#2", "nut"])
        self.assertEqual(report["counts"]["overlap"], 1)
        self.assertEqual(self.report(manifest, "--ignore", "bolt#2:nut", code=2)["clashes"], [])
        report = self.report(path("good.obj"), over, path("gone.stl"), "--ignore", "gone:over",
                             code=2)
        self.assertEqual(report["counts"]["overlap"], 1)
        self.assertEqual(len(report["errors"]), 2)
        report = self.report(path("good.obj"), over, path("gone.stl"), "--between", "good", "gone",
                             code=2)
        self.assertEqual(report["clashes"], [])
        self.assertEqual(len(report["errors"]), 2)
        four = write("four.obj", "".join(
            box(0.1 * i, name=name, base=8 * i) for i, name in enumerate(["a", "b:c", "a:b", "c"])))
        status, out, err = run(four, "--ignore", "a:b:c")
        self.assertEqual((status, out), (2, ""))
        self.assertIn("two pairs", err)
        self.assertEqual(len(self.report(four, "--ignore", "c:a:b", code=1)["clashes"]), 5)

    def test_open_parts_are_surfaces_and_may_be_repaired(self):
        lid = box().replace("f 5 6 8 7\n", "")
        report = self.report(write("open.obj", lid), write("over.obj", box(0.5)), code=1)
        self.assertFalse(report["parts"][0]["solid"])
        self.assertIn("open", report["parts"][0])
        self.assertIsNone(report["clashes"][0]["depth"][1])
        self.assertIn("without an inside", run(path("open.obj"), path("over.obj"))[1])
        split = write("split.obj", box().replace("v 1.0 1.0 1.0", "v 1.0 1.0 1.000000001") +
                      "v 1 1 1\nf 5 6 9\n")
        mended = self.report(split, "--repair", code=0)
        self.assertTrue(mended["parts"][0]["repaired"])

    def test_parts_without_volume_are_named(self):
        sheet = "o sheet\nv 0.5 0.5 0.5\nv 2 0.5 0.5\nv 2 2 0.5\nf 1 2 3\nf 3 2 1\n"
        flat, block = write("flat.obj", sheet), write("block.obj", box())
        report = self.report(flat, block, code=1)
        self.assertEqual([(p["solid"], p.get("flat")) for p in report["parts"]],
                         [(True, True), (True, None)])
        self.assertEqual(report["counts"]["overlap"], 1)
        self.assertIn("1 of the parts have no volume", run(flat, block)[1])

    def test_a_table(self):
        first, second = write('a,"b.obj', box()), write("c.obj", box(0.5))
        status, out, _ = run(first, second, "--csv")
        self.assertEqual(status, 1)
        row, = csv.DictReader(io.StringIO(out))
        self.assertEqual((row["a"], row["b"], row["status"]), ('a,"b', "c", "overlap"))
        self.assertLessEqual(float(row["lower"]), float(row["upper"]))

    def test_nodes_of_gltf_are_parts(self):
        lines = box().split("\n")
        numbers = [float(x) for line in lines if line.startswith("v ") for x in line[2:].split()]
        corners = [[int(i) - 1 for i in line[2:].split()] for line in lines if line.startswith("f ")]
        indices = [k for a, b, c, d in corners for k in (a, b, c, a, c, d)]
        data = struct.pack("<24f36H", *numbers, *indices)
        gltf = write("scene.gltf", json.dumps({
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 2]}],
            "nodes": [{"name": name, "mesh": 0, "translation": [x, 0, 0]}
                      for name, x in (("left", 0), ("right", 1), ("far", 5))],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3",
                           "min": [0, 0, 0], "max": [1, 1, 1]},
                          {"bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR"}],
            "bufferViews": [{"buffer": 0, "byteLength": 96},
                            {"buffer": 0, "byteOffset": 96, "byteLength": 72}],
            "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," +
                         base64.b64encode(data).decode()}]}))
        if "need assimp" in run(gltf)[2]:
            self.skipTest("built without assimp")
        report = self.report(gltf, code=0)
        self.assertEqual([(p["name"], p["solid"]) for p in report["parts"]],
                         [("left", True), ("right", True), ("far", True)])
        self.assertEqual(self.statuses(report), {frozenset(("left", "right")): "touch"})


if __name__ == "__main__":
    os.makedirs(WORK, exist_ok=True)
    unittest.main(argv=sys.argv[:1])
