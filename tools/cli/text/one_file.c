// Two names of a file that is there have one inode; of one that is not there
// yet the folders are compared.

#ifndef _DEFAULT_SOURCE
#define _DEFAULT_SOURCE
#endif

#include "one_file.h"

#include <string.h>
#include <sys/stat.h>

#define ROOM 4096

static bool same_file(const struct stat *a, const struct stat *b) {
  return a->st_dev == b->st_dev && a->st_ino == b->st_ino;
}

// The folder of a path, as the caller may open it. Returns: whether it fits;
// opening a longer one reports what is wrong.
static bool folder_of(const char *path, char folder[ROOM]) {
  const char *slash = strrchr(path, '/');
  const size_t length = slash == NULL ? 0 : (size_t)(slash - path) + 1;
  if (length + 2 > ROOM) {
    return false;
  }
  memcpy(folder, path, length);
  memcpy(folder + length, ".", 2);
  return true;
}

static const char *name_of(const char *path) {
  const char *slash = strrchr(path, '/');
  return slash == NULL ? path : slash + 1;
}

static bool in_one_folder(const char *one, const char *other) {
  char folder[2][ROOM];
  struct stat a, b;
  return folder_of(one, folder[0]) && folder_of(other, folder[1]) &&
         stat(folder[0], &a) == 0 && stat(folder[1], &b) == 0 &&
         same_file(&a, &b);
}

bool cli_one_file(const char *one, const char *other) {
  struct stat a, b;
  if (one == NULL || other == NULL || strcmp(one, "-") == 0 ||
      strcmp(other, "-") == 0) {
    return false;
  }
  const bool there = stat(one, &a) == 0;
  if (there != (stat(other, &b) == 0)) {
    return false;
  }
  if (there) {
    return S_ISREG(a.st_mode) && same_file(&a, &b);
  }
  return strcmp(name_of(one), name_of(other)) == 0 && in_one_folder(one, other);
}
