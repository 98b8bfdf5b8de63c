// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "summary.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "least.h"

namespace kios::bench {
namespace {

template <typename... Values>
std::string text(const char* format, Values... values) {
  char line[256];
  std::snprintf(line, sizeof line, format, values...);
  return line;
}

// "distance: 20 times as fast as ..."; empty without a row.
std::string speed(const std::vector<Row>& rows, const std::string& query, const char* words) {
  double logarithms = 0;
  int count = 0;
  const Standing* least = nullptr;
  const std::vector<Standing> standings = byRatio(rows);
  for (const Standing& standing : standings) {
    if (standing.ours.query != query) continue;
    if (!least) least = &standing;
    logarithms += std::log(standing.ratio);
    ++count;
  }
  if (!least) return {};
  return text(
      "%s: %.1f times as fast as FCL's fastest volume in the mean of %d scenes, %.1f at least (%s)",
      words, std::exp(logarithms / count), count, least->ratio, least->ours.scenario.c_str());
}

std::string correctness(const std::vector<Row>& rows) {
  std::size_t judged = 0, wrong = 0;
  double error = 0;
  for (const Row& row : rows) {
    if (row.bv != "kios" || !row.errors.wrong) continue;
    ++judged;
    wrong += *row.errors.wrong;
    if (row.extent > 0) error = std::max(error, row.errors.max_abs.value_or(0) / row.extent);
  }
  if (judged == 0) return {};
  return text(
      "Answers: %zu wrong in %zu rows that an oracle judged; largest error of a distance %.1e of "
      "the mesh's size",
      wrong, judged, error);
}

// The mean over the rows of `bv` that build models; nothing without one.
Maybe meanOf(const std::vector<Row>& rows, const std::string& bv, Maybe Volumes::*value) {
  double sum = 0;
  int count = 0;
  for (const Row& row : rows) {
    if (row.query != "build" || row.bv != bv || !(row.volumes.*value)) continue;
    sum += *(row.volumes.*value);
    ++count;
  }
  if (count == 0) return std::nullopt;
  return sum / count;
}

std::string besideObbrss(const std::vector<Row>& rows, Maybe Volumes::*value, const char* format) {
  const Maybe ours = meanOf(rows, "kios", value), theirs = meanOf(rows, "fcl_obbrss", value);
  return ours && theirs ? text(format, *ours, *theirs) : std::string();
}

std::string escaped(const std::string& words) {
  std::string html;
  for (const char c : words) {
    switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      default:
        html += c;
    }
  }
  return html;
}

std::string heading(const Row& row) {
  std::string words = row.scenario + ", " + row.query;
  if (row.asked.threshold) words += text(" %g", *row.asked.threshold);
  return words;
}

}  // namespace

std::vector<std::string> inWords(const std::vector<Row>& rows) {
  std::vector<std::string> sentences = {
      speed(rows, "distance", "Exact distance"),
      speed(rows, "collide", "First contact"),
      correctness(rows),
      besideObbrss(rows, &Volumes::bytes_per_triangle,
                   "Memory: %.0f bytes a triangle, OBBRSS %.0f"),
      besideObbrss(rows, &Volumes::build_us_per_triangle,
                   "Building: %.2f us a triangle, OBBRSS %.2f"),
  };
  sentences.erase(std::remove(sentences.begin(), sentences.end(), ""), sentences.end());
  return sentences;
}

void writePage(const std::vector<Row>& rows, const std::filesystem::path& file) {
  std::ofstream page(file);
  page << "<!DOCTYPE html>\n<html lang=\"en\"><meta charset=\"utf-8\"><title>fcl_kios "
          "measured</title>\n"
          "<style>body{font:16px/1.5 sans-serif;max-width:60em;margin:2em auto;padding:0 1em}"
          "h2{font-size:1em;margin:1.2em 0 .2em}div{display:flex;align-items:center;gap:.6em}"
          "span{width:11em;text-align:right}i{height:.8em;background:#9ab}"
          ".kios i{background:#d60}</style>\n"
          "<h1>k-IOS beside FCL's volumes</h1>\n<ul>\n";
  for (const std::string& sentence : inWords(rows)) page << "<li>" << escaped(sentence) << "\n";
  page << "</ul>\n<p>Bars are medians of the time of a frame, each question on a scale of its "
          "own.\n";
  for (auto row = rows.begin(); row != rows.end();) {
    const auto end = std::find_if(
        row, rows.end(), [&row](const Row& other) { return heading(other) != heading(*row); });
    const double longest = std::max_element(row, end, [](const Row& a, const Row& b) {
                             return a.times.median_us < b.times.median_us;
                           })->times.median_us;
    page << "<h2>" << escaped(heading(*row)) << "</h2>\n";
    for (; row != end; ++row) {
      page << "<div" << (row->bv == "kios" ? " class=\"kios\"" : "") << "><span>"
           << escaped(row->bv)
           << "</span><i style=\"width:" << text("%.2fem", 30 * row->times.median_us / longest)
           << "\"></i>" << timeText(row->times.median_us) << "</div>\n";
    }
  }
  page.close();
  if (!page) throw std::runtime_error(file.string() + ": cannot be written");
}

}  // namespace kios::bench
