// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace kios::inspect {

// The files in page/.
extern const char* const kPageHtml;  ///< with @STYLE@, @SCENE@ and @SCRIPT@ to be filled in
extern const char* const kPageStyle;
extern const char* const kPageRenderer;
extern const char* const kPageScript;

}  // namespace kios::inspect
