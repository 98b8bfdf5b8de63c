// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "fcl_kios/version.h"
#include "inspect/output.h"
#include "page.h"
#include "report.h"

namespace kios::clash_tool {
namespace {

// Exit codes, as docs/clash.md and --help list them.
constexpr int kFine = 0, kClashes = 1, kFailed = 2;

const char* const kFooter = R"(
Each pair of parts within the clearance has a status: overlap (deeper than --touch), inside (one is
in the other), duplicate (equal meshes at one place), touch, or clearance (nearer than --clearance).
Lengths are in the files' units. docs/clash.md says more, docs/clash.schema.json what --json prints.

exit codes: 0 nothing but touches; 1 an overlap, inside, duplicate or clearance; 2 wrong command
line, or a file or part can't be read or written: what could be read is reported all the same)";

struct Options {
  std::vector<std::filesystem::path> files;
  double touch = ClashRequest().touch, clearance = 0, html_limit = 40;
  std::vector<std::string> ignored, between;
  std::filesystem::path html;
  int threads = 0;
  bool repair = false, json = false, csv = false, quiet = false;
};

struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

void declare(CLI::App& app, Options& options) {
  const CLI::Range lengths(0.0, std::numeric_limits<double>::max());
  app.add_option("PART", options.files,
                 "STL, OBJ, OFF, PLY, DAE and what else assimp reads, glTF and 3MF among them, a "
                 "part for each object or node; or a manifest, {\"parts\": [{\"name\", \"file\", "
                 "\"pose\", \"group\"}, ...]} in a .json file")
      ->required();
  app.add_option("--touch", options.touch, "what is nearer than that, or no deeper, touches")
      ->check(lengths)
      ->capture_default_str();
  app.add_option("--clearance", options.clearance, "what is nearer than that lacks clearance")
      ->check(lengths)
      ->capture_default_str();
  app.add_option("--ignore", options.ignored, "A:B, two names of parts; may be repeated")
      ->allow_extra_args(false);
  app.add_option("--between", options.between, "look at pairs of a part of each group alone")
      ->expected(2);
  app.add_flag("--repair", options.repair, "repair each mesh first, as kios_inspect does");
  CLI::Option* const json = app.add_flag("--json", options.json, "print JSON instead of text");
  app.add_flag("--csv", options.csv, "print a table instead of text")->excludes(json);
  app.add_option("--html", options.html, "write one self-contained page that shows the clashes");
  app.add_option("--html-limit", options.html_limit, "size of its meshes in MB")
      ->check(CLI::Range(1e-6, 1e6))
      ->capture_default_str();
  app.add_option("--threads", options.threads, "0: one a core")->check(CLI::Range(0, 1024));
  app.add_flag("--quiet", options.quiet, "no progress on stderr");
  app.footer(kFooter);
  app.set_version_flag("--version", std::string("kios_clash ") + FCL_KIOS_VERSION_STRING);
}

/// "A:B" as two names; names may have colons, if only one colon parts two names.
std::pair<std::string, std::string> pairOf(const std::string& typed, const Assembly& assembly) {
  const std::string text = printable(typed);
  const auto known = [&](const std::string& name) {
    return std::find(assembly.taken.begin(), assembly.taken.end(), name) != assembly.taken.end();
  };
  std::pair<std::string, std::string> found;
  for (std::size_t at = text.find(':'); at != std::string::npos; at = text.find(':', at + 1)) {
    std::string a = text.substr(0, at), b = text.substr(at + 1);
    if (!known(a) || !known(b)) continue;
    if (!found.first.empty()) {
      throw UsageError("--ignore " + text + ": that is two pairs of parts; name one as B:A.");
    }
    found = {std::move(a), std::move(b)};
  }
  if (!found.first.empty()) return found;
  throw UsageError("--ignore " + text + ": these aren't two names of parts, A:B.");
}

int run(const Options& options) {
  inspect::requireDirectory(options.html);
  inspect::Progress progress(options.quiet);
  Report report;
  report.touch = options.touch;
  report.clearance = options.clearance;
  report.assembly = readParts(options.files, options.repair, progress);
  for (const auto* said : {&report.assembly.warnings, &report.assembly.errors}) {
    for (const std::string& what : *said) std::fprintf(stderr, "kios_clash: %s\n", what.c_str());
  }
  std::vector<Part>& parts = report.assembly.parts;

  ClashRequest request;
  request.touch = options.touch;
  request.clearance = options.clearance;
  request.threads = options.threads;
  request.between_groups = !options.between.empty();
  // Names and groups may be of what couldn't be read: then the rest is looked at all the same.
  const auto checked = [&errors = report.assembly.errors](const auto& check) {
    try {
      check();
    } catch (const UsageError& error) {
      if (errors.empty()) throw;
      std::fprintf(stderr, "kios_clash: %s\n", error.what());
      errors.emplace_back(error.what());
    }
  };
  for (const std::string& text : options.ignored) {
    checked([&] { request.ignored.push_back(pairOf(text, report.assembly)); });
  }
  for (const std::string& group : options.between) {
    checked([&] {
      if (std::none_of(parts.begin(), parts.end(),
                       [&](const Part& p) { return p.group == group; })) {
        throw UsageError("--between: no part is of the group '" + group + "'.");
      }
    });
  }
  if (request.between_groups) {
    const auto& between = options.between;
    parts.erase(std::remove_if(
                    parts.begin(), parts.end(),
                    [&](const Part& p) { return p.group != between[0] && p.group != between[1]; }),
                parts.end());
  }
  std::vector<ClashPart> placed;
  for (const Part& part : parts) {
    const bool second = request.between_groups && part.group == options.between[1];
    placed.push_back(part.toClashPart(second ? 1 : 0));
  }
  // The library refuses names that it doesn't know.
  const auto missing = [&](const std::string& name) {
    return std::none_of(parts.begin(), parts.end(), [&](const Part& p) { return p.name == name; });
  };
  auto& ignored = request.ignored;
  ignored.erase(
      std::remove_if(ignored.begin(), ignored.end(),
                     [&](const auto& pair) { return missing(pair.first) || missing(pair.second); }),
      ignored.end());
  progress.step("looking for clashes of " + std::to_string(parts.size()) + " parts");
  try {
    report.clashes = findClashes(placed, request);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
  progress.done();

  const std::string text =
      options.json  ? toJson(report).dump(2, ' ', false, Json::error_handler_t::replace) + '\n'
      : options.csv ? toCsv(report)
                    : toText(report);
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
    throw inspect::OutputError("the report can't be written.");
  }
  if (!options.html.empty()) inspect::writeFile(options.html, page(report, options.html_limit));
  if (!report.assembly.errors.empty()) return kFailed;
  return report.clashing() ? kClashes : kFine;
}

}  // namespace
}  // namespace kios::clash_tool

int main(int argc, char** argv) {
  using namespace kios::clash_tool;
  Options options;
  CLI::App app{"Which parts of an assembly overlap, touch or lack clearance.", "kios_clash"};
  try {
    declare(app, options);
    app.parse(argc, argv);
    if (options.clearance > 0 && options.touch > options.clearance) {
      throw CLI::ValidationError("--touch", "exceeds --clearance");
    }
    if (!options.between.empty() && options.between[0] == options.between[1]) {
      throw CLI::ValidationError("--between", "needs two groups");
    }
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kFine : kFailed;
  }
  try {
    return run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "kios_clash: %s\n", error.what());
    return kFailed;
  }
}
