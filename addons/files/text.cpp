// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <system_error>

#include "input.h"

namespace kios::files {

std::string quoted(std::string_view part) {
  std::string result = "'" + std::string(part.substr(0, 40)) + (part.size() > 40 ? "...'" : "'");
  std::replace_if(
      result.begin(), result.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return result;
}

std::string counted(std::size_t n, const std::string& one, const std::string& more) {
  return std::to_string(n) + " " + (n == 1 ? one : more);
}

std::string Input::sentence(const char* at, const std::string& what) const {
  if (!at) return name + ": " + what;
  std::size_t line = 1;
  for (const char* c = content.data(); c != at; ++c)
    line += *c == '\n' || (*c == '\r' && c[1] != '\n');
  return name + ":" + std::to_string(line) + ": " + what;
}

void Input::refuse(const char* at, const std::string& what) const {
  throw std::invalid_argument(sentence(at, what));
}

Text::Text(const Input& input, char comment, bool continued)
    : input_(input), at_(input.content.data()), comment_(comment) {
  kinds_[' '] = kinds_['\t'] = kinds_['\v'] = kinds_['\f'] = kBlank;
  kinds_['\n'] = kinds_['\r'] = kBreak;
  if (continued) kinds_['\\'] = kContinued;
  if (comment != 0) kinds_[static_cast<unsigned char>(comment)] = kComment;
  if (input.content.substr(0, 3) == "\xEF\xBB\xBF") at_ += 3;  // a BOM
}

// The line break behind the content ends all loops.
const char* Text::at() {
  for (;;) {
    while (kind(*at_) == kBlank) ++at_;
    if (kind(*at_) != kContinued) return at_;
    const char* next = at_ + 1;
    while (kind(*next) == kBlank) ++next;
    if (next == input_.end() || kind(*next) != kBreak) return at_;
    at_ = next + (next[0] == '\r' && next[1] == '\n' ? 2 : 1);
    at_ = std::min(at_, input_.end());
  }
}

bool Text::ended() {
  while (lineEnded()) {
    if (at_ == input_.end()) return true;
    nextLine();
  }
  return false;
}

void Text::nextLine() {
  while (!lineEnded()) word();
  while (kind(*at_) != kBreak) ++at_;
  if (at_ == input_.end()) return;
  at_ += at_[0] == '\r' && at_[1] == '\n' ? 2 : 1;
  at_ = std::min(at_, input_.end());
}

std::string_view Text::word() {
  const char* const begin = at();
  if (kind(*begin) >= kBreak) return {};
  do ++at_;
  while (kind(*at_) == kWord);
  return {begin, static_cast<std::size_t>(at_ - begin)};
}

std::string Text::name() {
  Kind& kind_of_comment = kinds_[static_cast<unsigned char>(comment_)];
  const Kind kept = std::exchange(kind_of_comment, kWord);
  std::string name;
  while (!lineEnded()) name.append(name.empty() ? "" : " ").append(word());
  kind_of_comment = kept;
  return name;
}

int lengthOfCharacter(std::string_view text) {
  const auto byte = [&](int i) {
    return static_cast<unsigned char>(text[static_cast<std::size_t>(i)]);
  };
  if (byte(0) < 0x80) return byte(0) < ' ' || byte(0) == 0x7f ? -1 : 1;
  const int length = byte(0) >= 0xf0 ? 4 : byte(0) >= 0xe0 ? 3 : 2;
  if (byte(0) < 0xc2 || byte(0) > 0xf4 || text.size() < static_cast<std::size_t>(length)) return 0;
  int code = byte(0) & (0x7f >> length);
  for (int i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
    code = code << 6 | (byte(i) & 0x3f);
  }
  constexpr int kLeast[] = {0x80, 0x800, 0x10000};
  if (code < kLeast[length - 2] || code > 0x10ffff || (code >= 0xd800 && code < 0xe000)) return 0;
  const bool control = code < 0xa0 || code == 0x2028 || code == 0x2029;  // two break lines
  return control ? -length : length;
}

const char* parseNumber(const char* at, const char* end, double& x) {
  at += end - at > 1 && at[0] == '+' && at[1] != '-';
  auto [next, error] = std::from_chars(at, end, x);
  if (error == std::errc::result_out_of_range) {
    long double wide = HUGE_VALL;
    std::from_chars(at, end, wide);
    x = static_cast<double>(wide);
    error = std::errc();
  }
  return error == std::errc() && std::isfinite(x) ? next : nullptr;
}

const char* parseNumber(const char* at, const char* end, long long& x) {
  const auto [next, error] = std::from_chars(at, end, x);
  return error == std::errc() ? next : nullptr;
}

template <typename Number>
Number Text::parse(const char* what) {
  if (lineEnded()) {
    refuse(at_ == input_.end() ? "the file is cut off: it ends where a number is missing."
                               : "a number is missing.");
  }
  Number x = 0;
  const char* const next = parseNumber(at_, input_.end(), x);
  if (!next || kind(*next) == kWord) refuse(quoted(word()) + " is no " + what + ".");
  at_ = next;
  return x;
}

double Text::number() { return parse<double>("finite number"); }

long long Text::integer() { return parse<long long>("integer"); }

std::size_t Text::count() {
  const char* const place = at();
  const long long n = integer();
  if (n < 0) input_.refuse(place, "a count is negative.");
  return static_cast<std::size_t>(n);
}

void Text::warnOfOpenLine(Mesh& mesh) const {
  if (kind(input_.content.back()) == kBreak) return;
  mesh.warnings.push_back(
      input_.sentence(input_.end(), "the last line isn't ended; is the file cut off?"));
}

}  // namespace kios::files
