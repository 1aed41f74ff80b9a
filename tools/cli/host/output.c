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
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

#include "host.h"

#define MAX_LINKS 40 // as many as Linux follows

bool cli_is_regular(int descriptor) {
  struct stat status;
  return fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
}

static bool same_file(const struct stat *a, const struct stat *b) {
  return a->st_dev == b->st_dev && a->st_ino == b->st_ino;
}

static bool is_standard(const char *path) {
  return path == NULL || strcmp(path, "-") == 0;
}

// The length of the folder in a path, with its slash.
static size_t folder_length(const char *path) {
  const char *slash = strrchr(path, '/');
  return slash == NULL ? 0 : (size_t)(slash - path) + 1;
}

// The one name of the folder of a path. Returns: whether it has one.
static bool folder_of(const char *path, char folder[PATH_MAX]) {
  char named[CLI_PATH_ROOM];
  const int length =
      snprintf(named, sizeof named, "%.*s.", (int)folder_length(path), path);
  return length < CLI_PATH_ROOM && realpath(named, folder) != NULL;
}

bool cli_one_file(const char *one, const char *other) {
  struct stat a, b;
  char folder[2][PATH_MAX];
  if (is_standard(one) || is_standard(other)) return false;
  const bool there = stat(one, &a) == 0;
  if (there || stat(other, &b) == 0) {
    return there && stat(other, &b) == 0 && S_ISREG(a.st_mode) &&
           same_file(&a, &b);
  }
  return strcmp(one + folder_length(one), other + folder_length(other)) == 0 &&
         folder_of(one, folder[0]) && folder_of(other, folder[1]) &&
         strcmp(folder[0], folder[1]) == 0;
}

// Whether a path is an entry of /proc, such as a descriptor of this process.
static bool in_proc(const char *path) {
  char folder[PATH_MAX];
  return folder_of(path, folder) && strncmp(folder, "/proc/", 6) == 0;
}

// Replaces a symbolic link by what it names, so that the link survives; the
// last one may name a file that is not there yet. Returns: 0 or an errno.
static int follow_links(char path[CLI_PATH_ROOM]) {
  for (int i = 0; i < MAX_LINKS; i++) {
    char link[CLI_PATH_ROOM];
    const ssize_t length =
        in_proc(path) ? -1 : readlink(path, link, sizeof link);
    if (length < 0) return 0; // no link: opening it reports what else is wrong
    const size_t kept = link[0] == '/' ? 0 : folder_length(path);
    if (kept + (size_t)length >= CLI_PATH_ROOM) return ENAMETOOLONG;
    memcpy(path + kept, link, (size_t)length);
    path[kept + (size_t)length] = '\0';
  }
  return ELOOP;
}

// Whether the part still has its name, and no other one.
static bool has_its_name(const cli_output_t *to) {
  struct stat by_name, opened;
  return lstat(to->part, &by_name) == 0 &&
         fstat(to->descriptor, &opened) == 0 && same_file(&by_name, &opened);
}

// Makes the part ready that is open. Whoever had it locked may have renamed it
// in between: then the name is another file's, or nobody's.
// mode: in, that of the file that it replaces, which is as private; < 0: none.
// Returns: 0 or an errno.
static int take_part(cli_output_t *to, int mode, bool keep) {
  struct stat found;
  if (fstat(to->descriptor, &found) != 0 || !S_ISREG(found.st_mode))
    return EEXIST;
  if (found.st_nlink > 1)
    return EMLINK; // under another name it is somebody's file
  if (flock(to->descriptor, LOCK_EX | LOCK_NB) != 0)
    return errno == EWOULDBLOCK ? EBUSY : errno;
  if (!has_its_name(to)) return EBUSY;
  to->there = (size_t)found.st_size;
  return (!keep && ftruncate(to->descriptor, 0) != 0) ||
                 (mode >= 0 && fchmod(to->descriptor, (mode_t)mode) != 0)
             ? errno
             : 0;
}

// Opens a path that is not "-". keep: what is in the part stays.
// Returns: 0 or an errno; EBUSY: another program writes this file.
static int open_path(cli_output_t *to, const char *path, bool keep) {
  struct stat before, standard;
  to->descriptor = -1;
  if (strlen(path) >= CLI_PATH_ROOM) return ENAMETOOLONG;
  memcpy(to->path, path, strlen(path) + 1);
  const int error = follow_links(to->path);
  if (error != 0) return error;
  const bool exists = stat(to->path, &before) == 0;
  const bool is_descriptor = in_proc(to->path);
  // Standard output is written through its own descriptor, whose position it
  // shares with all that write there; of another one nothing is cut off.
  if (is_descriptor && exists && fstat(STDOUT_FILENO, &standard) == 0 &&
      same_file(&before, &standard)) {
    to->descriptor = STDOUT_FILENO;
    return 0;
  }
  if (is_descriptor || (exists && !S_ISREG(before.st_mode))) {
    to->descriptor =
        open(to->path, O_WRONLY | O_NOCTTY | (is_descriptor ? O_APPEND : 0));
    return to->descriptor < 0 ? errno : 0;
  }
  if (exists && access(to->path, W_OK) != 0) return errno;
  if (snprintf(to->part, sizeof to->part, "%s.part", to->path) >= CLI_PATH_ROOM)
    return ENAMETOOLONG;
  to->descriptor = open(
      to->part, O_WRONLY | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666);
  if (to->descriptor < 0) return errno;
  const int taken =
      take_part(to, exists ? (int)(before.st_mode & 0777) : -1, keep);
  to->beside = taken == 0;
  if (!to->beside) {
    (void)close(to->descriptor);
    to->descriptor = -1;
  }
  return taken;
}

// Gives the part the name of the file. The name is on disk once the folder is;
// a file system that cannot sync a folder has done what it can.
// Returns: 0 or an errno; EBUSY: the part is not the file that was opened.
static int name_part(const cli_output_t *to) {
  char folder[PATH_MAX];
  if (!has_its_name(to)) return EBUSY;
  if (rename(to->part, to->path) != 0) return errno;
  const int opened =
      folder_of(to->path, folder) ? open(folder, O_RDONLY | O_CLOEXEC) : -1;
  if (opened >= 0) {
    (void)fsync(opened);
    (void)close(opened);
  }
  return 0;
}

bool cli_output_open(cli_output_t *output, const char *path, bool keep) {
  const bool standard = is_standard(path);
  output->used = 0;
  output->last = '\n';
  output->flushed = cli_now();
  output->name = standard ? "standard output" : path;
  output->descriptor = STDOUT_FILENO;
  output->beside = output->left = false;
  output->there = 0;
  output->error = standard ? 0 : open_path(output, path, keep);
  return output->error == 0;
}

bool cli_output_close(cli_output_t *output, bool whole) {
  (void)cli_output_flush(output);
  if (output->descriptor < 0) return output->error == 0;
  int error = output->error;
  struct stat status;
  if (cli_is_regular(output->descriptor) && fsync(output->descriptor) != 0 &&
      errno != EINVAL && errno != EROFS && error == 0)
    error = errno;
  if (output->beside && whole && error == 0) error = name_part(output);
  // A part without a row is of no use.
  output->left = output->beside && (!whole || error != 0) &&
                 has_its_name(output) &&
                 (fstat(output->descriptor, &status) != 0 ||
                  status.st_size > 0 || unlink(output->part) != 0);
  if (output->descriptor != STDOUT_FILENO && close(output->descriptor) != 0 &&
      error == 0)
    error = errno;
  output->descriptor = -1;
  output->error = error;
  return error == 0;
}

static void drop_incomplete_row(const cli_output_t *output, size_t written) {
  off_t surplus = 0;
  for (size_t i = written; i > 0 && output->buffer[i - 1] != output->last; i--)
    surplus++;
  const off_t end = lseek(output->descriptor, 0, SEEK_CUR);
  if (surplus > 0 && end >= surplus && cli_is_regular(output->descriptor) &&
      ftruncate(output->descriptor, end - surplus) != 0)
    return; // the first error is the one that is reported
}

bool cli_output_flush(cli_output_t *output) {
  size_t written = 0;
  while (output->error == 0 && written < output->used) {
    const ssize_t taken = write(output->descriptor, output->buffer + written,
                                output->used - written);
    if (taken > 0) {
      written += (size_t)taken;
    } else if (taken == 0) {
      output->error = EIO;
    } else if (errno == EAGAIN) {
      // The reader made the pipe non-blocking: wait until it can take more.
      struct pollfd ready = {output->descriptor, POLLOUT, 0};
      (void)poll(&ready, 1, -1);
    } else if (errno != EINTR) {
      output->error = errno;
    }
  }
  if (output->error != 0 && output->used > 0)
    drop_incomplete_row(output, written);
  output->used = 0;
  output->flushed = cli_now();
  return output->error == 0;
}

bool cli_output_lines(cli_output_t *output, const void *lines, size_t length) {
  const char *from = lines;
  for (size_t next; length > 0 && output->error == 0; length -= next) {
    next = length < CLI_OUTPUT_ROOM ? length : CLI_OUTPUT_ROOM;
    if (next > CLI_OUTPUT_ROOM - output->used && !cli_output_flush(output))
      break;
    memcpy(output->buffer + output->used, from, next);
    output->used += next;
    from += next;
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
  if (output->left) {
    (void)cli_stop("%s: incomplete; its rows are in %s", output->name,
                   output->part);
  }
}

int cli_output_note_over(const cli_output_t *output) {
  return cli_message(CLI_DONE,
                     "note: %s: overwrites %zu bytes of rows of a command that "
                     "was stopped",
                     output->part, output->there);
}

int cli_output_begin(cli_output_t *output, const char *option, const char *path,
                     cli_begin_t how) {
  cli_catch_signals();
  if (!cli_output_open(output, path, how != CLI_WRITE_OVER))
    return cli_stop("%s %s: %s", option, path, cli_output_reason(output));
  if (output->there == 0 || how == CLI_GO_ON) return CLI_DONE;
  if (how == CLI_WRITE_OVER) return cli_output_note_over(output);
  (void)cli_output_close(output, false);
  return cli_refuse(
      "%s %s: %s has the rows of a command that was stopped: give them another "
      "name, or remove them",
      option, path, output->part);
}

void cli_output_go_on(cli_output_t *output, size_t kept) {
  if (output->beside && output->error == 0 &&
      (ftruncate(output->descriptor, (off_t)kept) != 0 ||
       lseek(output->descriptor, (off_t)kept, SEEK_SET) < 0))
    output->error = errno;
}

int cli_output_end(cli_output_t *output, int code) {
  const bool closed = cli_output_close(output, code == CLI_DONE);
  if (!closed)
    (void)cli_stop("%s: %s", output->name, cli_output_reason(output));
  cli_output_tell_part(output);
  return code != CLI_DONE || closed ? code : CLI_STOPPED;
}

int cli_output_write(cli_output_t *output, const char *option, const char *path,
                     const char *text, size_t length) {
  CLI_TRY(cli_output_begin(output, option, path, CLI_WRITE_OVER));
  (void)cli_output_lines(output, text, length);
  return cli_output_end(output, CLI_DONE);
}
