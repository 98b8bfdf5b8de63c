// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer.h"

#include <algorithm>
#include <cstring>

#include "viewer_text.h"

namespace kios::viewer {
namespace {

template <typename T>
std::string encode(const std::vector<T>& values) {
  static_assert(sizeof(T) == 4);
  static const char* const digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<std::uint8_t> bytes;
  bytes.reserve(4 * values.size() + 2);
  for (const T& value : values) {
    std::uint32_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<std::uint8_t>(bits >> (8 * i)));
  }
  const std::size_t length = bytes.size();
  bytes.resize((length + 2) / 3 * 3);
  std::string text;
  text.reserve(bytes.size() / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const unsigned three = bytes[i] << 16 | bytes[i + 1] << 8 | bytes[i + 2];
    for (int digit = 3; digit >= 0; --digit) text += digits[three >> (6 * digit) & 63];
  }
  std::fill(text.end() - static_cast<std::ptrdiff_t>(bytes.size() - length), text.end(), '=');
  return text;
}

void replace(std::string& text, const std::string& mark, const std::string& by) {
  text.replace(text.find(mark), mark.size(), by);
}

}  // namespace

std::string base64(const std::vector<float>& values) { return encode(values); }
std::string base64(const std::vector<std::uint32_t>& values) { return encode(values); }

std::string page(const PageText& text, std::string content) {
  // A file may be called </script>.
  for (std::size_t at = 0; (at = content.find('<', at)) != std::string::npos;) {
    content.replace(at, 1, "\\u003c");
  }
  std::string html = kFrame;
  replace(html, "@TITLE@", text.title);
  replace(html, "@STYLE@", kStyle);
  replace(html, "@CONTROLS@", text.controls);
  replace(html, "@SCRIPT@", std::string(kRenderer) + kViewer + text.script);
  replace(html, "@SCENE@", content);
  return html;
}

}  // namespace kios::viewer
