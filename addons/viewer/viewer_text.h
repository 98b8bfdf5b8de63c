// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace kios::viewer {

// The files beside this one. The frame has @TITLE@, @STYLE@, @CONTROLS@, @SCENE@ and @SCRIPT@ to be
// filled in.
extern const char* const kFrame;
extern const char* const kStyle;
extern const char* const kRenderer;
extern const char* const kViewer;

}  // namespace kios::viewer
