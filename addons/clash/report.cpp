// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>
#include <sstream>
#include <tuple>

#include "fcl_kios/version.h"

namespace kios::clash_tool {
namespace {

constexpr ClashStatus kStatuses[] = {ClashStatus::kOverlap, ClashStatus::kInside,
                                     ClashStatus::kDuplicate, ClashStatus::kClearance,
                                     ClashStatus::kTouch};  // by severity

std::size_t countOf(const Report& report, ClashStatus status) {
  return static_cast<std::size_t>(
      std::count_if(report.clashes.begin(), report.clashes.end(),
                    [&](const ClashResult& clash) { return clash.status == status; }));
}

Json boundOf(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json listOf(const double (&p)[3]) { return {p[0], p[1], p[2]}; }

bool isZero(const double (&p)[3]) { return p[0] == 0 && p[1] == 0 && p[2] == 0; }

std::string quoted(const std::string& cell) {
  if (cell.find_first_of("\", ") == std::string::npos) return cell;
  std::string text = "\"";
  for (const char c : cell) text.append(c == '"' ? 2 : 1, c);
  return text + '"';
}

/// "1 overlap, 3 touches".
std::string countsOf(const Report& report) {
  std::string text;
  for (const ClashStatus status : kStatuses) {
    const std::size_t n = countOf(report, status);
    if (n == 0) continue;
    const bool touch = status == ClashStatus::kTouch;
    const bool plain =
        n == 1 || status == ClashStatus::kInside || status == ClashStatus::kClearance;
    text += (text.empty() ? "" : ", ") + std::to_string(n) + " " + nameOf(status) +
            (plain   ? ""
             : touch ? "es"
                     : "s");
  }
  return text.empty() ? "no clash" : text;
}

/// Says of how many parts there is something to say, and what of the first.
template <typename Say>
void listSome(std::ostream& text, const std::vector<Part>& parts, const char* head,
              const Say& say) {
  constexpr std::ptrdiff_t kMost = 5;
  const auto all = std::count_if(parts.begin(), parts.end(),
                                 [&](const Part& part) { return !say(part).empty(); });
  if (all > 0) text << all << head;
  std::ptrdiff_t said = 0;
  for (const Part& part : parts) {
    if (said == kMost || say(part).empty()) continue;
    text << "  " << part.name << ": " << say(part) << '\n';
    ++said;
  }
  if (all > kMost) text << "  and " << all - kMost << " more\n";
}

}  // namespace

const char* nameOf(ClashStatus status) {
  switch (status) {
    case ClashStatus::kOverlap:
      return "overlap";
    case ClashStatus::kInside:
      return "inside";
    case ClashStatus::kDuplicate:
      return "duplicate";
    case ClashStatus::kTouch:
      return "touch";
    default:
      return "clearance";
  }
}

std::vector<std::size_t> Report::bySeverity() const {
  std::vector<std::size_t> order(clashes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [this](std::size_t i) {
    const ClashResult& clash = clashes[i];
    const auto* const rank = std::find(std::begin(kStatuses), std::end(kStatuses), clash.status);
    return std::make_tuple(rank, clash.deep ? -clash.lower : clash.lower, i);
  };
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  return order;
}

bool Report::clashing() const { return countOf(*this, ClashStatus::kTouch) < clashes.size(); }

Json toJson(const Report& report) {
  Json parts = Json::array(), clashes = Json::array(), counts;
  for (const Part& part : report.assembly.parts) {
    Json entry = {{"name", part.name},
                  {"file", part.file},
                  {"group", part.group},
                  {"triangles", part.model->num_tris},
                  {"solid", part.open.empty()}};
    if (!part.open.empty()) entry["open"] = part.open;
    if (part.flat) entry["flat"] = true;
    if (!part.repaired.empty()) entry["repaired"] = part.repaired;
    parts.push_back(std::move(entry));
  }
  for (const ClashResult& clash : report.clashes) {
    Json entry = {{"a", report.assembly.parts[clash.a].name},
                  {"b", report.assembly.parts[clash.b].name},
                  {"status", nameOf(clash.status)},
                  {"decided", clash.decided}};
    entry[clash.deep ? "depth" : "distance"] = {boundOf(clash.lower), boundOf(clash.upper)};
    entry["point_a"] = listOf(clash.point_a);
    entry["point_b"] = listOf(clash.point_b);
    if (!isZero(clash.way_out)) entry["way_out"] = listOf(clash.way_out);
    clashes.push_back(std::move(entry));
  }
  for (const ClashStatus status : kStatuses) counts[nameOf(status)] = countOf(report, status);
  return {{"version", FCL_KIOS_VERSION_STRING},
          {"touch", report.touch},
          {"clearance", report.clearance},
          {"counts", counts},
          {"clashes", clashes},
          {"parts", parts},
          {"warnings", report.assembly.warnings},
          {"errors", report.assembly.errors}};
}

std::string toCsv(const Report& report) {
  std::string text =
      "a,b,status,decided,measure,lower,upper,point_a_x,point_a_y,point_a_z,point_b_x,point_b_y,"
      "point_b_z,way_out_x,way_out_y,way_out_z\n";
  for (const ClashResult& clash : report.clashes) {
    text += quoted(report.assembly.parts[clash.a].name) + ',' +
            quoted(report.assembly.parts[clash.b].name) + ',' + nameOf(clash.status) +
            (clash.decided ? ",true," : ",false,") + (clash.deep ? "depth" : "distance");
    for (const double x : {clash.lower, clash.upper}) {
      text += ',' + (std::isfinite(x) ? Json(x).dump() : std::string());
    }
    for (const double(*v)[3] : {&clash.point_a, &clash.point_b, &clash.way_out}) {
      for (const double x : *v) text += ',' + Json(x).dump();
    }
    text += '\n';
  }
  return text;
}

std::string toText(const Report& report) {
  std::ostringstream text;
  text.precision(6);
  const auto& parts = report.assembly.parts;
  text << parts.size() << (parts.size() == 1 ? " part: " : " parts: ") << countsOf(report) << '\n';
  for (const std::size_t i : report.bySeverity()) {
    const ClashResult& clash = report.clashes[i];
    if (clash.status == ClashStatus::kTouch) break;
    text << nameOf(clash.status) << (clash.decided ? "" : " (undecided)") << ": "
         << parts[clash.a].name << " and " << parts[clash.b].name
         << (clash.deep ? ", depth " : ", distance ") << clash.lower;
    if (!std::isfinite(clash.upper)) {
      text << " or more";
    } else if (clash.upper > clash.lower) {
      text << " to " << clash.upper;
    }
    const auto& p = clash.point_a;
    text << ", at " << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
  }
  listSome(text, parts, " of the parts are surfaces without an inside:\n",
           [](const Part& part) { return part.open; });
  listSome(text, parts, " of the parts have no volume, and so no depth but in others:\n",
           [](const Part& part) { return std::string(part.flat ? "its two sides are one" : ""); });
  return text.str();
}

}  // namespace kios::clash_tool
