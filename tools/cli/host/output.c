// Rows on their way to a file. Every finished row reaches the file, whatever
// ends the run, and no file ends in half a row: rows enter the buffer whole,
// leave it in order, and where the system takes only part of them (a full disk)
// the incomplete row is removed again from a regular file. stdio is not used,
// because after a failed flush it does not tell how much has been written.
//
// `open` with O_TRUNC destroys what was there, and a program that is killed
// leaves half of the new rows under the name of all. So rows go to a file
// beside it: only within a file system does a rename happen at once.
//
// What is not a regular file has no rows to keep and no name to get, and is
// written as it is. Nor has what a symbolic link of /proc names, as /dev/stdout
// does: it belongs to whoever opened it, even where it is a regular file.

#define _DEFAULT_SOURCE

#include "output.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

#include "../text/text.h"
#include "host.h"

#define MAX_LINKS 40 // as many as Linux follows
#define MAX_TRIES 100

bool cli_is_regular(int descriptor) {
  struct stat status;
  return fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
}

static bool same_file(const struct stat *a, const struct stat *b) {
  return a->st_dev == b->st_dev && a->st_ino == b->st_ino;
}

// Whether a path still names the file that is open.
static bool names(const char *path, int descriptor) {
  struct stat by_name, opened;
  return lstat(path, &by_name) == 0 && fstat(descriptor, &opened) == 0 &&
         same_file(&by_name, &opened);
}

#define FOLDER_ROOM (CLI_PATH_ROOM + 2)

// The folder of a path, as the caller may open it. Returns: whether it fits;
// opening a longer one reports what is wrong.
static bool folder_of(const char *path, char folder[FOLDER_ROOM]) {
  const char *slash = strrchr(path, '/');
  const size_t length = slash == NULL ? 0 : (size_t)(slash - path) + 1;
  if (length + 2 > FOLDER_ROOM) {
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
  char folder[2][FOLDER_ROOM];
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

// Whether a path is an entry of /proc, such as a descriptor of this process.
static bool in_proc(const char *path) {
  char folder[FOLDER_ROOM];
  char real[PATH_MAX];
  return folder_of(path, folder) && realpath(folder, real) != NULL &&
         strncmp(real, "/proc/", 6) == 0;
}

// Replaces a symbolic link by what it names, so that the link survives; the
// last one may name a file that is not there yet. Returns: 0 or an errno.
static int follow_links(char path[CLI_PATH_ROOM]) {
  for (int i = 0; i < MAX_LINKS; i++) {
    char link[CLI_PATH_ROOM];
    if (in_proc(path)) {
      return 0;
    }
    const ssize_t length = readlink(path, link, sizeof link);
    if (length < 0) {
      return 0; // no link: opening it reports what else is wrong
    }
    const char *slash = strrchr(path, '/');
    const size_t kept =
        link[0] == '/' || slash == NULL ? 0 : (size_t)(slash - path) + 1;
    if (kept + (size_t)length >= CLI_PATH_ROOM) {
      return ENAMETOOLONG;
    }
    memcpy(path + kept, link, (size_t)length);
    path[kept + (size_t)length] = '\0';
  }
  return ELOOP;
}

// Opens the part. Whoever had it locked may have renamed it in between: then
// the name is another file's, or nobody's, and it is tried again.
static int open_part(cli_destination_t *to, const struct stat *before,
                     bool keep) {
  for (int i = 0; i < MAX_TRIES; i++) {
    const int opened =
        open(to->part, O_WRONLY | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC,
             0666);
    if (opened < 0) {
      return errno;
    }
    struct stat found;
    int error = cli_is_regular(opened) ? 0 : EEXIST;
    // Under another name it is somebody's file.
    if (error == 0 && fstat(opened, &found) == 0 && found.st_nlink > 1) {
      error = EMLINK;
    }
    if (error == 0 && flock(opened, LOCK_EX | LOCK_NB) != 0) {
      error = errno == EWOULDBLOCK ? EBUSY : errno;
    }
    if (error == 0 && !names(to->part, opened)) {
      (void)close(opened);
      continue;
    }
    if (error == 0 && !keep && ftruncate(opened, 0) != 0) {
      error = errno;
    }
    // What replaces a file is as private as the file was.
    if (error == 0 && before != NULL &&
        fchmod(opened, before->st_mode & 0777) != 0) {
      error = errno;
    }
    if (error != 0) {
      (void)close(opened);
      return error;
    }
    to->descriptor = opened;
    to->beside = true;
    return 0;
  }
  return EBUSY;
}

static int open_as_it_is(cli_destination_t *to, const char *path, int flags) {
  to->descriptor = open(path, O_WRONLY | O_NOCTTY | flags);
  return to->descriptor < 0 ? errno : 0;
}

// A descriptor by its name. Standard output is written through its own
// descriptor, whose position it shares with all that write there; of another
// one nothing is cut off.
static int open_descriptor(cli_destination_t *to, const char *path) {
  struct stat named, standard;
  if (stat(path, &named) == 0 && fstat(STDOUT_FILENO, &standard) == 0 &&
      same_file(&named, &standard)) {
    to->descriptor = STDOUT_FILENO;
    return 0;
  }
  return open_as_it_is(to, path, O_APPEND);
}

// A path of NULL or "-" is standard output. keep: what is in the part stays.
// Returns: 0 or an errno; EBUSY: another program writes this file.
static int destination_open(cli_destination_t *to, const char *path,
                            bool keep) {
  to->descriptor = STDOUT_FILENO;
  to->beside = to->left = false;
  if (path == NULL || strcmp(path, "-") == 0) {
    return 0;
  }
  to->descriptor = -1;
  if (strlen(path) >= CLI_PATH_ROOM) {
    return ENAMETOOLONG;
  }
  memcpy(to->path, path, strlen(path) + 1);
  const int error = follow_links(to->path);
  if (error != 0) {
    return error;
  }
  if (in_proc(to->path)) {
    return open_descriptor(to, to->path);
  }
  struct stat before;
  const bool exists = stat(to->path, &before) == 0;
  if (exists && !S_ISREG(before.st_mode)) {
    return open_as_it_is(to, to->path, 0);
  }
  if (exists && access(to->path, W_OK) != 0) {
    return errno;
  }
  const int length = snprintf(to->part, sizeof to->part, "%s.part", to->path);
  if (length < 0 || (size_t)length >= sizeof to->part) {
    return ENAMETOOLONG;
  }
  return open_part(to, exists ? &before : NULL, keep);
}

// The new name is on disk once the folder is. A file system that cannot sync a
// folder has done what it can.
static void sync_folder(const char *path) {
  char folder[FOLDER_ROOM];
  const int opened =
      folder_of(path, folder) ? open(folder, O_RDONLY | O_CLOEXEC) : -1;
  if (opened >= 0) {
    (void)fsync(opened);
    (void)close(opened);
  }
}

static int name_it(cli_destination_t *to) {
  if (!names(to->part, to->descriptor)) {
    return EBUSY;
  }
  if (rename(to->part, to->path) != 0) {
    return errno;
  }
  sync_folder(to->path);
  return 0;
}

// A part without a row is of no use.
static void leave_part(cli_destination_t *to) {
  struct stat status;
  to->left = names(to->part, to->descriptor);
  if (to->left && fstat(to->descriptor, &status) == 0 && status.st_size == 0) {
    to->left = unlink(to->part) != 0;
  }
}

// Closes it, on disk; standard output stays open. whole: all rows are there.
// Returns: 0 or an errno; EBUSY: `part` is not the file that was opened.
static int destination_close(cli_destination_t *to, bool whole) {
  int error = 0;
  if (to->descriptor < 0) {
    return 0;
  }
  if (cli_is_regular(to->descriptor) && fsync(to->descriptor) != 0 &&
      errno != EINVAL && errno != EROFS) {
    error = errno;
  }
  if (to->beside && whole && error == 0) {
    error = name_it(to);
  }
  if (to->beside && (!whole || error != 0)) {
    leave_part(to);
  }
  if (to->descriptor != STDOUT_FILENO && close(to->descriptor) != 0 &&
      error == 0) {
    error = errno;
  }
  to->descriptor = -1;
  return error;
}

bool cli_output_open(cli_output_t *output, const char *path, bool keep) {
  output->used = 0;
  output->last = '\n';
  output->flushed = cli_now();
  output->name =
      path == NULL || strcmp(path, "-") == 0 ? "standard output" : path;
  output->error = destination_open(&output->to, path, keep);
  return output->error == 0;
}

static void drop_incomplete_row(const cli_output_t *output, size_t written) {
  size_t whole = written;
  while (whole > 0 && output->buffer[whole - 1] != output->last) {
    whole--;
  }
  if (whole == written || !cli_is_regular(output->to.descriptor)) {
    return;
  }
  const off_t end = lseek(output->to.descriptor, 0, SEEK_CUR);
  if (end >= (off_t)(written - whole)) {
    // If this fails too, the first error is the one that is reported.
    if (ftruncate(output->to.descriptor, end - (off_t)(written - whole)) != 0) {
      return;
    }
  }
}

bool cli_output_flush(cli_output_t *output) {
  size_t written = 0;
  while (output->error == 0 && written < output->used) {
    const ssize_t taken = write(output->to.descriptor, output->buffer + written,
                                output->used - written);
    if (taken > 0) {
      written += (size_t)taken;
    } else if (taken == 0) {
      output->error = EIO;
    } else if (errno == EAGAIN) {
      // The reader made the pipe non-blocking: wait until it can take more.
      struct pollfd ready = {output->to.descriptor, POLLOUT, 0};
      (void)poll(&ready, 1, -1);
    } else if (errno != EINTR) {
      output->error = errno;
    }
  }
  if (output->error != 0 && output->used > 0) {
    drop_incomplete_row(output, written);
  }
  output->used = 0;
  output->flushed = cli_now();
  return output->error == 0;
}

bool cli_output_lines(cli_output_t *output, const void *lines, size_t length) {
  const char *from = lines;
  for (size_t next; length > 0 && output->error == 0; length -= next) {
    next = length < CLI_OUTPUT_ROOM ? length : CLI_OUTPUT_ROOM;
    if (next > CLI_OUTPUT_ROOM - output->used && !cli_output_flush(output)) {
      break;
    }
    memcpy(output->buffer + output->used, from, next);
    output->used += next;
    from += next;
  }
  return output->error == 0;
}

bool cli_output_close(cli_output_t *output, bool whole) {
  (void)cli_output_flush(output);
  const int error = destination_close(&output->to, whole && output->error == 0);
  if (output->error == 0) {
    output->error = error;
  }
  return output->error == 0;
}

const char *cli_output_reason(const cli_output_t *output) {
  switch (output->error) {
    case EPIPE:
      return "closed by its reader";
    case EBUSY:
      return "another program writes this file";
    case EMLINK:
      return "its .part is a hard link to another file; remove it";
    default:
      return strerror(output->error);
  }
}

void cli_output_tell_part(const cli_output_t *output) {
  if (output->to.left) {
    (void)cli_message(CLI_STOPPED, "%s: not whole; its rows so far are in %s",
                      output->name, output->to.part);
  }
}

int cli_output_begin(cli_output_t *output, const char *option, const char *path,
                     bool keep) {
  cli_catch_signals();
  if (cli_output_open(output, path, keep)) {
    return CLI_DONE;
  }
  return cli_message(CLI_STOPPED, "%s %s: %s", option, path,
                     cli_output_reason(output));
}

void cli_output_go_on(cli_output_t *output, size_t kept) {
  if (output->to.beside && output->error == 0 &&
      (ftruncate(output->to.descriptor, (off_t)kept) != 0 ||
       lseek(output->to.descriptor, (off_t)kept, SEEK_SET) < 0)) {
    output->error = errno;
  }
}

int cli_output_refuse_other(const char *path, const char *what) {
  return cli_message(CLI_REFUSED,
                     "--resume: %s is of another %s, or of another build of "
                     "twofold; remove it, or give another file",
                     path, what);
}

int cli_output_end(cli_output_t *output, int code) {
  const bool closed = cli_output_close(output, code == CLI_DONE);
  if (!closed) {
    (void)cli_message(CLI_STOPPED, "%s: %s", output->name,
                      cli_output_reason(output));
  }
  cli_output_tell_part(output);
  return code != CLI_DONE || closed ? code : CLI_STOPPED;
}

int cli_output_write(cli_output_t *output, const char *option, const char *path,
                     const char *text, size_t length) {
  CLI_TRY(cli_output_begin(output, option, path, false));
  (void)cli_output_lines(output, text, length);
  return cli_output_end(output, CLI_DONE);
}
