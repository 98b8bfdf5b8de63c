# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""The public headers: their docstrings, public names and defaults."""
import pathlib
import re

from figures.rows import table

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDERS = ("include", "addons/robot/include")


def headers():
    """Each public header as (its name in an #include, its text)."""
    for folder in FOLDERS:
        for path in sorted((ROOT / folder).rglob("*.h")):
            yield path.relative_to(ROOT / folder).as_posix(), path.read_text(encoding="utf-8")


def docstrings(text):
    """Each block of /// lines as (number of its first line, its text)."""
    block, first = [], 0
    for number, line in enumerate([*text.splitlines(), ""], 1):
        match = re.match(r"\s*///(?!<)\s?(.*)", line)
        if match:
            first = first if block else number
            block.append(match[1])
        elif block:
            yield first, " ".join(block)
            block = []


def headline(text):
    """The first sentence, or what of it stands before a colon."""
    return re.split(r"(?<!e\.g)(?<=[.!?:])\s", text)[0].rstrip(":")


def declarations(text):
    """What stands in namespaces, as (innermost namespace, declaration, its docstring).

    Declarations below each other, without an empty line, share one. As clang-format leaves them, they
    begin a line, and what a class holds doesn't."""
    scopes, declared, doc = [], "", ""
    for line in text.splitlines():
        opened = re.match(r"(?:inline )?namespace ?([\w:]*) \{", line)
        if opened:
            scopes.append(opened[1])
        elif line.startswith("}  // namespace"):
            scopes.pop()
        elif not line:
            doc = ""
        elif line.startswith("/// "):
            doc = f"{doc} {line[4:].strip()}".strip()
        elif declared or re.match(r"[\w\[]", line):
            declared += " " + re.sub(r"\s*//.*", "", line).strip()
            if declared[-1] in ";{}":
                yield scopes[-1] if scopes else "", declared.strip(" ;"), doc
                declared = ""


NAME = re.compile(r"(?:template <[^{}]*?> )?(?:class|struct|enum class|using) (\w+)|"
                  r"[^(]*?(\w+)\(")
# Instantiations, names for double and float, old names, declarations of what is defined elsewhere.
SKIPPED = re.compile(r"extern |.*\[\[deprecated|using \w+[df] = \w+<|template <typename S> (?:class|struct) \w+$")
# Headers whose names stand with those of the first header that includes them.
DETAIL = re.compile(r'#include "(fcl_kios/detail/\w+\.h)"')


def public_names():
    """The names in namespace kios as {header: {name: headline}}."""
    found, shown = {}, set()
    texts = dict(headers())
    for header, text in texts.items():
        if "/detail/" in header:
            continue
        text = "\n".join([text, *(texts.get(name, "") for name in DETAIL.findall(text)
                                  if name not in shown)])
        shown.update(DETAIL.findall(text))
        names = {}
        for namespace, declared, doc in declarations(text):
            match = NAME.match(declared)
            if namespace == "kios" and match and not SKIPPED.match(declared):
                name = match[1] or match[2]
                names[name] = names.get(name) or headline(doc)
        if names:
            found[header] = names
    return found


def names(_):
    """A line for each header with its public names; LookupError names those without a docstring."""
    found = public_names()
    nameless = [f"{header}: {name}" for header, names in found.items()
                for name, sentence in names.items() if not sentence]
    if nameless:
        raise LookupError("public names without a docstring: " + ", ".join(nameless))
    return table(["header", "names"], [
        [f"`{header}`", ", ".join(f"`{name}`" for name in names)]
        for header, names in found.items()]).replace("--:", "---")


def default(_, name):
    """The default of a member, `Struct::member`, as a page writes it."""
    struct, _, member = name.partition("::")
    for _, text in headers():
        body = re.search(rf"^struct {struct}\b[^;]*?\{{[^\n]*\n(.*?)^\}};", text, re.M | re.S)
        value = body and re.search(rf"\b{member} = ([^,;]+)[,;]", body[1])
        if value:
            power = re.fullmatch(r"0x1p(-?\d+)", value[1])
            if power:
                return f"2^{power[1]}"
            return f"{int(value[1]):,}" if value[1].isdigit() else value[1]
    raise LookupError(f"no public header gives {name} a default")


def wrong_keywords(page, stub):
    """What a page says of defaults, `mesh.bracket(other, rel_err=0.1)`, and the stub doesn't."""
    for name, arguments in re.findall(r"`mesh\.(\w+)\((.*?)\)`", page):
        declared = re.search(rf"def {name}\((.*?)\) ->", stub, re.S)
        values = dict(re.findall(r"(\w+): [^=,]*(?:\[[^]]*\])? = ([^,\s]+)",
                                 declared[1] if declared else ""))
        for keyword, value in re.findall(r"(\w+)=([^,\s]+)", arguments):
            there = values.get(keyword)
            same = there == value or there == "..." or (
                there and re.fullmatch(r"[\d.e-]+", value + there) and float(value) == float(there))
            if not same:
                yield f"mesh.{name}({keyword}={value}), where it is {there}"
