/// What the program needs of POSIX: a monotonic clock, signals that ask for a
/// stop, standard descriptors that are safe to use, and sources of frames. And
/// the progress of long work: where standard error is a terminal, a line that
/// is overwritten, none in the first seconds.
#pragma once

#include "../text/text.h"
#include "twofold.h"

double cli_now(void); ///< monotonic [s]

/// Waits; a signal ends the wait early.
void cli_sleep(int milliseconds);

/// Waits until cli_now() has reached a time; a request to stop ends it early.
void cli_wait_until(double time);

/// From now on the program goes before all others that are not of real time
/// (SCHED_FIFO at its lowest priority), and its memory is not paged out.
/// Returns: NULL, or why it may not.
const char *cli_take_priority(void);

bool cli_is_terminal(int descriptor);

/// Occupies closed standard descriptors, so that no opened file takes their
/// number and receives messages; writing to them still fails.
void cli_guard_descriptors(void);

/// From now on SIGINT, SIGTERM and, unless it is ignored, SIGHUP ask for a stop
/// (the second one kills), and a closed pipe or a full file quota is an error
/// of write, not a signal.
void cli_catch_signals(void);

/// From now on a terminal at standard input hands over keys as they are
/// pressed; nothing changes where standard input is no terminal, or that of
/// another job. A signal that asks for a stop, for a second one kills, first
/// ends that and writes these bytes, kept, to standard output.
void cli_screen_begin(const char *give_back);
void cli_screen_end(void);

/// Asks for a stop, as Ctrl-C does, if a key was pressed since the last call;
/// what else was is dropped.
void cli_stop_on_key(char key);

/// Size of the terminal at standard output, as it is now; 80 by 24 where it
/// does not tell.
void cli_terminal_size(int *columns, int *rows);

bool cli_stop_asked(void);

typedef struct {
  bool silent;    ///< nobody looks, or something else shows how far it is
  bool shown;     ///< the line is on the screen
  double started; ///< cli_now()
  double next;    ///< cli_now() of the next message
} cli_progress_t;

/// output: in, descriptor that the rows go to: on a terminal they show the
/// progress themselves. -1: none.
cli_progress_t cli_progress_start(double now, int output);

/// Prints what is done if it is time, and the time left at the mean speed so
/// far. share: in, of the work that is done, 0: no time left is told.
void cli_progress_say(cli_progress_t *progress, double now, double share,
                      const char *format, ...) CLI_PRINTF(4, 5);

/// Removes the line from the screen.
void cli_progress_clear(cli_progress_t *progress);

/// A source of frames: a file, a pipe, a terminal or a serial device.
typedef struct {
  const char *name;
  int descriptor;
  bool is_device; ///< a terminal: its end means that it was unplugged
  int error;      ///< errno of the failure, or 0
  bool broke;     ///< the board has said that it broke
  size_t heard;   ///< characters of the line that says so, of which
  char said[128]; ///< so many may come
} cli_source_t;

typedef enum {
  CLI_SOURCE_BYTES, ///< at least one byte
  CLI_SOURCE_QUIET, ///< no byte within the time allowed
  CLI_SOURCE_END,   ///< end of a file or a pipe
  CLI_SOURCE_GONE   ///< the device was unplugged, or an error
} cli_source_found_t;

/// Opens a path, or standard input for "-". A terminal is put into raw mode.
/// baud: 0 leaves the speed as it is. both_ways: commands will be sent, too.
/// Returns: whether it is open; otherwise error is set (EINVAL: unknown speed).
bool cli_source_open(cli_source_t *source, const char *path, uint64_t baud,
                     bool both_ways);

/// Waits for bytes, at most the given number of milliseconds. Prints the line
/// of port_fault, which is no frame.
/// count: out, number of bytes read.
cli_source_found_t cli_source_read(cli_source_t *source, uint8_t *bytes,
                                   size_t room, int milliseconds,
                                   size_t *count);

/// Sends bytes; waits up to a second for room in the line's buffer.
/// Returns: whether all were sent.
bool cli_source_write(cli_source_t *source, const uint8_t *bytes,
                      size_t length);

void cli_source_close(cli_source_t *source);

/// Reads a key from a file, for an argument would stand in the list of
/// processes: 32 hexadecimal digits, with nothing behind them but white space.
/// The file's owner alone may read it.
/// Returns: NULL; or what is wrong with the file.
const char *cli_read_key(const char *path, uint8_t key[TF_KEY_BYTES]);

/// What a host with a key takes of a board: frames of this board, made for this
/// host. Before the first of them it takes nothing, for old ones may be on the
/// line.
typedef struct {
  const uint8_t *key;            ///< TF_KEY_BYTES; NULL: it takes all
  uint8_t nonce[TF_NONCE_BYTES]; ///< the data of TF_UP_DESCRIBE
  bool vouched;                  ///< a frame with the right tag has come
  bool forged;                   ///< ... and then one without
  bool mute;     ///< no heartbeat with the right tag yet: rows are not trusted
  double silent; ///< for how long [s], since one or the first right frame
} cli_guard_t;

/// Draws a nonce. Returns: whether the system has random numbers.
bool cli_guard_begin(cli_guard_t *guard, const uint8_t *key);

/// Returns: whether the frame is to be taken. One that is has no tag any more
/// to be read: its bytes are `tag` behind the payload.
bool cli_guard_takes(cli_guard_t *guard, const tf_frame_t *frame);

#define CLI_NOT_VOUCHED                                                      \
  "no frame with the tag of --key: the board has another key or none, or a " \
  "recording is played"
#define CLI_SILENT "no heartbeat with the tag of --key for 5 s"
#define CLI_FORGED                                                           \
  "a frame without the tag of --key: somebody else sends, or the board was " \
  "restarted"
