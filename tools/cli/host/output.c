// Rows on their way to a file. Every finished row reaches the file, whatever
// ends the run, and no file ends in half a row: rows enter the buffer whole,
// leave it in order, and where the system takes only part of them (a full disk)
// the incomplete row is removed again from a regular file. stdio is not used,
// because after a failed flush it does not tell how much has been written.

#ifndef _POSIX_C_SOURCE
#define _POSIX_C_SOURCE 200809L
#endif

#include "output.h"

#include <errno.h>
#include <poll.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

#include "../text/message.h"
#include "host.h"

bool cli_output_open(cli_output_t *output, const char *path, bool keep) {
  output->used = 0;
  output->last = '\n';
  output->flushed = cli_now();
  output->name =
      path == NULL || strcmp(path, "-") == 0 ? "standard output" : path;
  output->error = cli_destination_open(&output->to, path, keep);
  return output->error == 0;
}

// Removes the bytes after the last whole line of what was written.
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

bool cli_output_lines(cli_output_t *output, const char *lines, size_t length) {
  if (length > CLI_OUTPUT_ROOM - output->used) {
    (void)cli_output_flush(output);
  }
  if (output->error != 0) {
    return false;
  }
  memcpy(output->buffer + output->used, lines, length);
  output->used += length;
  return true;
}

bool cli_output_close(cli_output_t *output, bool whole) {
  (void)cli_output_flush(output);
  const int error =
      cli_destination_close(&output->to, whole && output->error == 0);
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
  const int code = cli_output_begin(output, option, path, false);
  if (code != CLI_DONE) {
    return code;
  }
  (void)cli_output_lines(output, text, length);
  return cli_output_end(output, CLI_DONE);
}
