# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: ask.py PLUGIN. The plug-in as a Python module would use it, from several threads.
import ctypes
import sys
import threading

wrong = []


def ask():
    plugin = ctypes.CDLL(sys.argv[1])
    plugin.plugin_distance.argtypes = [ctypes.c_double]
    plugin.plugin_distance.restype = ctypes.c_double
    answers = [plugin.plugin_distance(5), plugin.plugin_distance(1), plugin.plugin_refuses()]
    if answers != [3, 0, 1]:
        wrong.append(answers)


ask()
threads = [threading.Thread(target=ask) for _ in range(4)]
for thread in threads:
    thread.start()
for thread in threads:
    thread.join()
if wrong:
    sys.exit(f"wrong: {wrong}")
print("asked from Python")
