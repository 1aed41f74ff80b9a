// Ends a program at its own call number ENDS_AT on a file that it writes, of
// write, fsync, ftruncate, rename, unlink, remove and close. A write that ends
// it takes half of its bytes. Nothing waits for a disk, since no power is lost.
// But with a board (ENDS_LINE), each reading of the clock is a second later
// than the one before, so that rows are flushed one by one. Preloaded by
// test_endings.py.

#define _GNU_SOURCE
#include <dlfcn.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#define ENDED 99

static bool is_last(void) {
  static long calls;
  const char *at = getenv("ENDS_AT");
  return at != NULL && ++calls == atol(at);
}

static bool is_last_of(int file) {
  struct stat status;
  const int flags = fcntl(file, F_GETFL);
  return flags >= 0 && (flags & O_ACCMODE) != O_RDONLY &&
         fstat(file, &status) == 0 && S_ISREG(status.st_mode) && is_last();
}

// The function that one of these stands before.
#define REAL(name) ((__typeof__(&(name)))dlsym(RTLD_NEXT, #name))

ssize_t write(int file, const void *bytes, size_t count) {
  if (is_last_of(file)) {
    (void)!REAL(write)(file, bytes, count / 2);
    _exit(ENDED);
  }
  return REAL(write)(file, bytes, count);
}

int fsync(int file) {
  if (is_last_of(file)) _exit(ENDED);
  return 0;
}

int ftruncate(int file, off_t length) {
  if (is_last_of(file)) _exit(ENDED);
  return REAL(ftruncate)(file, length);
}

int close(int file) {
  if (is_last_of(file)) _exit(ENDED);
  return REAL(close)(file);
}

int rename(const char *from, const char *to) {
  if (is_last()) _exit(ENDED);
  return REAL(rename)(from, to);
}

int unlink(const char *path) {
  if (is_last()) _exit(ENDED);
  return REAL(unlink)(path);
}

int remove(const char *path) { return unlink(path); }

int clock_gettime(clockid_t clock, struct timespec *time) {
  static long seconds;
  if (getenv("ENDS_LINE") != NULL) return REAL(clock_gettime)(clock, time);
  *time = (struct timespec){++seconds, 0};
  return 0;
}
