// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

// Pages that show meshes with a mouse and without a network: what the tools' pages share.

namespace kios::viewer {

/// Holds what is a page's own: its title, the HTML of its controls, its script.
struct PageText {
  const char *title, *controls, *script;
};
/// That of the program that is linked (kios_page in CMakeLists.txt).
extern const PageText kPageText;

/// Returns little-endian bytes in base64, as renderer.js reads them.
std::string base64(const std::vector<float>& values);
std::string base64(const std::vector<std::uint32_t>& values);

/// Returns a self-contained page: the text with the shared frame, style and scripts, and `content`,
/// which is JSON with a member `scene` as renderer.js draws it.
std::string page(const PageText& text, std::string content);

}  // namespace kios::viewer
