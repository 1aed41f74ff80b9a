// Processes and not threads: a point of a sweep is followed by functions that
// keep the message of a refusal, and the lanes, in one place. What is started
// costs a millisecond, a piece of work some microseconds.

#define _GNU_SOURCE

#include "workers.h"

#include <errno.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#ifdef __linux__
#include <sched.h>
#include <sys/prctl.h>
#endif

#define LOOK_EVERY 200 // [ms], for a request to stop

unsigned cli_processors(void) {
#ifdef __linux__
  cpu_set_t allowed;
  if (sched_getaffinity(0, sizeof allowed, &allowed) == 0)
    return (unsigned)CPU_COUNT(&allowed);
#endif
  const long found = sysconf(_SC_NPROCESSORS_ONLN);
  return found > 1 ? (unsigned)found : 1;
}

int cli_workers_start(cli_workers_t *workers, unsigned count,
                      void (*work)(void *with, unsigned worker, int to),
                      void *with) {
  for (workers->count = 0; workers->count < count; workers->count++) {
    int ends[2] = {-1, -1};
    const int process = pipe(ends) == 0 ? (int)fork() : -1;
    if (process < 0) {
      const int error = errno;
      cli_workers_end(workers);
      return cli_stop("no process could be started: %s", strerror(error));
    }
    if (process == 0) {
#ifdef __linux__
      (void)prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
      // It holds no file of the program, nor another pipe.
      (void)close(STDOUT_FILENO);
      for (int i = STDERR_FILENO + 1; i < ends[1]; i++) (void)close(i);
      work(with, workers->count, ends[1]);
      _exit(0);
    }
    (void)close(ends[1]);
    workers->process[workers->count] = process;
    workers->from[workers->count] = ends[0];
  }
  return CLI_DONE;
}

bool cli_pipe_write(int to, const void *bytes, size_t length) {
  const char *from = bytes;
  while (length > 0) {
    const ssize_t put = write(to, from, length);
    if (put < 0 && errno != EINTR) return false;
    from += put > 0 ? put : 0;
    length -= put > 0 ? (size_t)put : 0;
  }
  return true;
}

bool cli_workers_read(const cli_workers_t *workers, unsigned worker, void *to,
                      size_t length) {
  struct pollfd ready = {workers->from[worker], POLLIN, 0};
  char *at = to;
  while (length > 0) {
    if (cli_stop_asked()) return false;
    if (poll(&ready, 1, LOOK_EVERY) <= 0) continue;
    const ssize_t got = read(ready.fd, at, length);
    if (got == 0 || (got < 0 && errno != EINTR)) return false;
    at += got > 0 ? got : 0;
    length -= got > 0 ? (size_t)got : 0;
  }
  return true;
}

void cli_workers_end(cli_workers_t *workers) {
  while (workers->count > 0) {
    const unsigned last = --workers->count;
    (void)close(workers->from[last]);
    (void)kill(workers->process[last], SIGKILL);
    while (waitpid(workers->process[last], NULL, 0) < 0 && errno == EINTR) {
    }
  }
}
