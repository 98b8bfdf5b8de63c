// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// usage: host LIBRARY PLUGIN [TLS_USER...]
// A program of C without the C++ runtime. It loads and unloads the library; then it opens, asks and
// closes the plug-in in every way, from many threads, after the TLS users have taken all static
// thread-local storage.

#include <dlfcn.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>

enum { kThreads = 4, kRounds = 3 };
static const char* plugin;
static pthread_barrier_t asked, closed;

static void require(int holds, const char* what) {
  if (holds) return;
  printf("wrong: %s\n", what);
  exit(1);
}

static void* open_plugin(int flags) {
  void* handle = dlopen(plugin, flags);
  if (!handle) printf("%s\n", dlerror());
  require(handle != NULL, "dlopen");
  return handle;
}

static void ask(void* handle) {
  double (*distance)(double);
  int (*refuses)(void);
  *(void**)&distance = dlsym(handle, "plugin_distance");
  *(void**)&refuses = dlsym(handle, "plugin_refuses");
  require(distance && refuses, "dlsym");
  require(distance(5) == 3, "distance of 3");
  require(distance(1) == 0, "distance of 0");
  require(refuses() == 1, "exception");
}

static void open_and_ask(int flags) {
  void* handle = open_plugin(flags);
  ask(handle);
  require(dlclose(handle) == 0, "dlclose");
}

static void* by_itself(void* flags) {
  for (int i = 0; i < kRounds; ++i) open_and_ask(*(const int*)flags);
  return NULL;
}

/// Uses the plug-in, and ends after it was closed.
static void* outlives(void* handle) {
  ask(handle);
  pthread_barrier_wait(&asked);
  pthread_barrier_wait(&closed);
  return NULL;
}

static void let_threads_outlive(int flags) {
  pthread_t threads[kThreads];
  void* handle = open_plugin(flags);
  pthread_barrier_init(&asked, NULL, kThreads + 1);
  pthread_barrier_init(&closed, NULL, kThreads + 1);
  for (int i = 0; i < kThreads; ++i) pthread_create(&threads[i], NULL, outlives, handle);
  pthread_barrier_wait(&asked);
  require(dlclose(handle) == 0, "dlclose while threads live");
  pthread_barrier_wait(&closed);
  for (int i = 0; i < kThreads; ++i) pthread_join(threads[i], NULL);
  pthread_barrier_destroy(&asked);
  pthread_barrier_destroy(&closed);
}

static void load_and_unload(const char* library) {
  void* handle = dlopen(library, RTLD_NOW);
  if (!handle) printf("%s\n", dlerror());
  require(handle != NULL && dlclose(handle) == 0, "dlopen and dlclose of the library");
  require(dlopen(library, RTLD_NOW | RTLD_NOLOAD) == NULL, "dlclose unloads the library");
}

int main(int argc, char** argv) {
  static const int ways[] = {RTLD_LOCAL | RTLD_NOW, RTLD_LOCAL | RTLD_LAZY, RTLD_GLOBAL | RTLD_NOW,
                             RTLD_GLOBAL | RTLD_LAZY};
  int users = 0;
  pthread_t threads[kThreads];
  require(argc > 2, "usage");
  load_and_unload(argv[1]);
  plugin = argv[2];
  for (int i = 3; i < argc && dlopen(argv[i], RTLD_NOW); ++i) ++users;
  require(argc == 3 || users + 3 < argc, "TLS users leave static storage");
  for (int w = 0; w < 4; ++w) {
    let_threads_outlive(ways[w]);
    for (int i = 0; i < kRounds; ++i) open_and_ask(ways[w]);
    for (int i = 0; i < kThreads; ++i) {
      pthread_create(&threads[i], NULL, by_itself, (void*)&ways[w]);
    }
    for (int i = 0; i < kThreads; ++i) pthread_join(threads[i], NULL);
  }
  printf("asked from C, after %d users of static thread-local storage\n", users);
  return 0;
}
