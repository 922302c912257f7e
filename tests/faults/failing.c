// SPDX-License-Identifier: GPL-3.0-or-later
/* Loaded before the C library (LD_PRELOAD): the FAIL_AT-th call of those that write fails, and all after it if FAIL_ON is set, with
 * the error FAIL_WITH; with CLOCK_JUMPS the wall clock goes to and fro by days. The number of calls is left in FAIL_COUNT. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <time.h>
#include <unistd.h>

static long calls = 0;

/* Where only files are meant: what is said on a terminal or to another process is not. */
static int is_file(int file) {
  char link[64], name[4096];
  snprintf(link, sizeof link, "/proc/self/fd/%d", file);
  ssize_t const n = readlink(link, name, sizeof name - 1);
  if (n <= 0) return 0;
  name[n] = 0;
  char const* const watched = getenv("FAIL_IN");
  return watched && strncmp(name, watched, strlen(watched)) == 0;
}

static int is_watched(char const* path) {
  char const* const watched = getenv("FAIL_IN");
  return watched && strncmp(path, watched, strlen(watched)) == 0;
}

static int fails(void) {
  char const* const at = getenv("FAIL_AT");
  if (!at) return 0;
  ++calls;
  char const* const count = getenv("FAIL_COUNT");
  if (count) {
    FILE* (*const real_open)(char const*, char const*) = (FILE * (*)(char const*, char const*)) dlsym(RTLD_NEXT, "fopen");
    FILE* const file = real_open(count, "w");
    if (file) {
      fprintf(file, "%ld\n", calls);
      fclose(file);
    }
  }
  long const number = atol(at);
  int const now = number > 0 && (calls == number || (calls > number && getenv("FAIL_ON")));
  if (now) errno = getenv("FAIL_WITH") ? atoi(getenv("FAIL_WITH")) : ENOSPC;
  return now;
}

ssize_t write(int file, void const* data, size_t size) {
  static ssize_t (*real)(int, void const*, size_t) = 0;
  if (!real) real = (ssize_t(*)(int, void const*, size_t))dlsym(RTLD_NEXT, "write");
  /* A disk fills up in the middle of what is written. */
  if (is_file(file) && fails()) {
    int const error = errno;
    if (size > 1) real(file, data, size / 2);
    errno = error;
    return -1;
  }
  return real(file, data, size);
}

int fsync(int file) {
  static int (*real)(int) = 0;
  if (!real) real = (int (*)(int))dlsym(RTLD_NEXT, "fsync");
  return is_file(file) && fails() ? -1 : real(file);
}

int ftruncate(int file, off_t size) {
  static int (*real)(int, off_t) = 0;
  if (!real) real = (int (*)(int, off_t))dlsym(RTLD_NEXT, "ftruncate");
  return is_file(file) && fails() ? -1 : real(file, size);
}

int rename(char const* from, char const* to) {
  static int (*real)(char const*, char const*) = 0;
  if (!real) real = (int (*)(char const*, char const*))dlsym(RTLD_NEXT, "rename");
  return is_watched(to) && fails() ? -1 : real(from, to);
}

int open(char const* path, int flags, ...) {
  static int (*real)(char const*, int, ...) = 0;
  if (!real) real = (int (*)(char const*, int, ...))dlsym(RTLD_NEXT, "open");
  mode_t mode = 0;
  if (flags & O_CREAT) {
    va_list rest;
    va_start(rest, flags);
    mode = va_arg(rest, mode_t);
    va_end(rest);
  }
  if ((flags & O_CREAT) && is_watched(path) && fails()) return -1;
  return real(path, flags, mode);
}

static long jump(void) {
  static unsigned seed = 1;
  if (!getenv("CLOCK_JUMPS")) return 0;
  seed = seed * 1103515245u + 12345u;
  return (long)(seed >> 8) % 2000000 - 1000000;
}

time_t time(time_t* out) {
  struct timespec now;
  clock_gettime(CLOCK_REALTIME, &now);
  if (out) *out = now.tv_sec;
  return now.tv_sec;
}

int clock_gettime(clockid_t clock, struct timespec* out) {
  static int (*real)(clockid_t, struct timespec*) = 0;
  if (!real) real = (int (*)(clockid_t, struct timespec*))dlsym(RTLD_NEXT, "clock_gettime");
  int const result = real(clock, out);
  if (result == 0 && clock == CLOCK_REALTIME) out->tv_sec += jump();
  return result;
}
