// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A shared object that takes static thread-local storage, of which a process has little to spare.
__attribute__((tls_model("initial-exec"))) __thread char taken[64];
char* taken_of_thread(void) { return taken; }
