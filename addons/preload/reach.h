// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "preload/calls.h"

namespace kios::preload {

/// The definition of a symbol that this library stands before: the next in the order of the global
/// scope, else that which the caller's own library would have found, else libfcl.so.0.7's wherever
/// it was loaded; nullptr if there is none.
void* findDefinition(const char* name, const void* caller);
/// Finds it likewise; ends the program if there is none, which the loader rules out for what is
/// called.
void* nextDefinition(const char* name, const void* caller);
/// Whether the definition is one for all callers, in the global scope.
bool isGlobal(const char* name);

/// Whether a definition of nextDefinition() is libfcl.so.0.7's, or that of a copy which a package
/// brings along: by the names of its file and itself, libfcl-<hash>.so.0.7*.
bool isOfLibfcl(const void* definition);
/// Whether all four are so, and in one library.
bool isOfLibfcl(const Calls& calls);

/// Says in one line on stderr if the queries of this program can't be answered; where the mode asks
/// for reports, also if they can't be yet.
void reportReach(Mode mode);

/// Writes "fcl_kios_preload: " and the words on a line of stderr.
void say(const char* words, const char* more = "", const char* end = "", const char* last = "");

/// Returns what FCL_KIOS_PRELOAD asks for. Says so, and is kOff, if it is none of the five words.
Mode modeOfEnvironment();

/// Returns the count of this process.
const Fits& fits();

/// From now on calls of FCL's fitting functions are counted; before, they are only handed on.
void countFits();

/// Opens the implementation; no calls, and says why, if it can't.
Opened openImplementation(const Start& start);

}  // namespace kios::preload
