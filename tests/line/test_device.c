/* `twofold monitor` on a device: a pseudo-terminal with a board behind it.
 * Rows arrive, commands are answered, and when the device goes away the program
 * says so or, under --follow, waits until it is back. The program is that of
 * the environment's TWOFOLD. Nothing here waits for a fixed time. */
#include "terminal.h"

typedef struct {
  int line; /* the board's end of the pseudo-terminal */
  int rows; /* what the program writes */
  int said; /* what it says on standard error */
  pid_t child;
  char heard[1 << 16]; /* standard error so far */
  char got[1 << 16];   /* standard output so far */
  size_t heard_used, got_used;
  tf_simulation_t simulation;
  tf_link_t link;
  uint32_t sequence;
  const uint8_t *key; /* or NULL */
} bench_t;

static bench_t bench;
static char place[] = P_tmpdir "/twofold-device.XXXXXX";
static char device[64];

/* A pseudo-terminal; `device` becomes a link to its other end. */
static int plug(void) {
  const int line = open_terminal(0);
  unlink(device);
  CHECK(symlink(ptsname(line), device) == 0);
  return line;
}

static void run_child(char *program, char *const options[], int out, int err) {
  char *arguments[16] = {program, NULL};
  static char command[] = "monitor";
  int n = 1;
  arguments[n++] = command;
  arguments[n++] = device;
  for (int i = 0; options[i] != NULL && n < 15; i++)
    arguments[n++] = options[i];
  arguments[n] = NULL;
  dup2(out, 1);
  dup2(err, 2);
  execv(program, arguments);
  _exit(127);
}

static void begin(bench_t *b, char *const options[]) {
  int out[2] = {-1, -1}, err[2] = {-1, -1};
  const tf_scene_t *scene = tf_scenes[0];
  static char program[512];
  const char *named = getenv("TWOFOLD");
  snprintf(program, sizeof program, "%s",
           named ? named : "build/double/twofold");
  memset(b, 0, sizeof *b);
  b->line = plug();
  CHECK(tf_simulation_open(&b->simulation, scene, &scene->params, 0) == TF_OK);
  tf_link_open(&b->link, scene, &scene->params);
  CHECK(pipe(out) == 0 && pipe(err) == 0);
  fflush(stdout);
  b->child = fork();
  if (b->child == 0) {
    close(b->line);
    run_child(program, options, out[1], err[1]);
  }
  close(out[1]);
  close(err[1]);
  b->rows = out[0];
  b->said = err[0];
}

static void collect(int from, char *text, size_t *used, size_t room) {
  const ssize_t got = read(from, text + *used, room - 1 - *used);
  if (got > 0) *used += (size_t)got;
  text[*used] = '\0';
}

/* A millisecond of the bench: what came is taken in. */
static void listen(bench_t *b) {
  struct pollfd ends[3] = {
      {b->line, POLLIN, 0}, {b->rows, POLLIN, 0}, {b->said, POLLIN, 0}};
  poll(ends, 3, 1);
  if (ends[0].revents & POLLIN) {
    uint8_t bytes[256];
    const ssize_t got = read(b->line, bytes, sizeof bytes);
    for (ssize_t i = 0; i < got; i++)
      if (b->key != NULL)
        tf_link_receive_tagged(&b->link, bytes[i], b->key);
      else
        tf_link_receive(&b->link, bytes[i]);
  }
  if (ends[1].revents & POLLIN)
    collect(b->rows, b->got, &b->got_used, sizeof b->got);
  if (ends[2].revents & POLLIN)
    collect(b->said, b->heard, &b->heard_used, sizeof b->heard);
}

static void tell(bench_t *b, const uint8_t *wire, size_t length) {
  if (length > 0) CHECK(write(b->line, wire, length) == (ssize_t)length);
}

/* A board that describes itself, when asked, and answers. */
static void serve(bench_t *b) {
  uint8_t wire[TF_FRAME_SIZE(TF_FRAME_PAYLOAD)];
  tf_link_boundary(&b->link, &b->simulation);
  if (b->link.describe) {
    const tf_schema_t schema = {.params = &b->link.params,
                                .scene = "chaos",
                                .build = "bench",
                                .takes_commands = true,
                                .wants_tag = b->key != NULL,
                                .session = b->link.session,
                                .sequence = b->link.next};
    tell(b, wire,
         tf_send_schema(wire, &b->sequence, b->simulation.state.tick, &schema));
    b->link.describe = false;
  }
  tell(b, wire, tf_link_answer(&b->link, wire, &b->sequence));
}

static void send_row(bench_t *b) {
  uint8_t wire[TF_FRAME_SIZE(TF_FRAME_PAYLOAD)];
  const tf_input_t input = tf_simulation_input(&b->simulation, tf_scenes[0]);
  tell(b, wire, tf_send_state(wire, &b->sequence, &b->simulation.state));
  tell(b, wire,
       tf_send_report(wire, &b->sequence, b->simulation.state.tick,
                      &b->simulation.report, b->simulation.stepped));
  tf_step(&b->simulation.machine, &b->simulation.state, &input,
          &b->simulation.report);
}

/* Serves the program until something holds, within the patience. */
#define WAIT_FOR(b, holds)                         \
  for (int i = 0; i < PATIENCE && !(holds); i++) { \
    serve(b);                                      \
    listen(b);                                     \
  }

/* Whether the program has said or written a text, within the patience. */
static int comes(bench_t *b, const char *text) {
  WAIT_FOR(b, strstr(b->heard, text) || strstr(b->got, text));
  if (strstr(b->heard, text) || strstr(b->got, text)) return 1;
  printf("# never said: %s; but: %s\n", text, b->heard);
  return 0;
}

static int lines_of(const bench_t *b) {
  int lines = 0;
  for (size_t k = 0; k < b->got_used; k++) lines += b->got[k] == '\n';
  return lines;
}

/* Whether so many lines are written, the header among them. */
static int lines_come(bench_t *b, int wanted) {
  WAIT_FOR(b, lines_of(b) >= wanted);
  return lines_of(b) == wanted;
}

/* Its exit code, or -1. */
static int exit_of(bench_t *b) {
  int status = 0;
  for (int i = 0; i < PATIENCE; i++) {
    const pid_t ended = waitpid(b->child, &status, WNOHANG);
    if (ended == b->child) {
      for (int k = 0; k < 3; k++) listen(b);
      close(b->rows);
      close(b->said);
      if (b->line >= 0) close(b->line);
      if (!WIFEXITED(status) || WEXITSTATUS(status) == 1)
        printf("# it ended with %x and said: %s\n", (unsigned)status, b->heard);
      return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    listen(b);
    poll(NULL, 0, 1); /* pipes that hung up make no pause */
  }
  kill(b->child, SIGKILL);
  waitpid(b->child, &status, 0);
  return -1;
}

TEST(rows_arrive_and_a_device_that_leaves_is_told) {
  static char csv[] = "--csv";
  char *const options[] = {csv, NULL};
  begin(&bench, options);
  CHECK(comes(&bench, "t,r,v,omega"));
  for (int i = 0; i < 100; i++) {
    send_row(&bench);
    serve(&bench);
    listen(&bench);
  }
  CHECK(lines_come(&bench, 101));
  close(bench.line);
  bench.line = -1;
  CHECK(exit_of(&bench) == 4);
  CHECK(strstr(bench.heard, "the device went away") != NULL);
  CHECK(strstr(bench.heard, "100 rows") != NULL);
  CHECK(strstr(bench.heard, "0 lost, 0 broken") != NULL);
}

TEST(followed_device_comes_back) {
  static char csv[] = "--csv", follow[] = "--follow";
  char *const options[] = {csv, follow, NULL};
  begin(&bench, options);
  CHECK(comes(&bench, "t,r,v,omega"));
  for (int i = 0; i < 10; i++) send_row(&bench);
  CHECK(lines_come(&bench, 11));
  unlink(device);
  close(bench.line);
  bench.line = -1;
  CHECK(comes(&bench, "waiting"));
  bench.line = plug();
  CHECK(comes(&bench, "back"));
  for (int i = 0; i < 10; i++) send_row(&bench);
  CHECK(lines_come(&bench, 21));
  kill(bench.child, SIGTERM);
  CHECK(exit_of(&bench) == 0);
  CHECK(strstr(bench.heard, "20 rows") != NULL);
}

TEST(commands_are_sent_and_answered) {
  static char flag[] = "--send", set[] = "set:mu=1.25", bad[] = "set:mu=-1",
              rule[] = "select:random:9", stop[] = "stop",
              dead[] = "deadman:123", input[] = "input:-1.5,0.1,0.25,-0.125";
  char *const options[] = {flag,  set,  flag, rule, flag, stop, flag,
                           input, flag, dead, flag, bad,  NULL};
  begin(&bench, options);
  CHECK(
      comes(&bench, "set:mu=1.25: took effect at step 0; mu = 1.25, in [0, "));
  CHECK(bench.simulation.machine.tyre.mu == TF_R(1.25));
  CHECK(comes(&bench, "select:random:9: took effect"));
  CHECK(bench.simulation.machine.rule == TF_RULE_RANDOM);
  CHECK(bench.simulation.state.seed == 9);
  CHECK(comes(&bench, "stop: took effect") && !bench.simulation.running);
  CHECK(comes(&bench, "input:-1.5,0.1,0.25,-0.125: took effect"));
  CHECK(bench.simulation.source == TF_INPUT_SET &&
        bench.simulation.input.omega0 == TF_R(-1.5));
  CHECK(bench.simulation.input.r0 == TF_R(0.1) &&
        bench.simulation.input.force == TF_R(0.25) &&
        bench.simulation.input.torque == TF_R(-0.125) &&
        bench.simulation.input.alpha == 0);
  CHECK(comes(&bench, "deadman:123: took effect"));
  CHECK(bench.simulation.deadman == 123);
  CHECK(comes(&bench, "set:mu=-1: refused, parameter out of its range"));
  CHECK(strstr(bench.heard, "mu = 1.25") != NULL);
  CHECK(exit_of(&bench) == 3);
}

/* An answer as some board might send it. */
static void forge(bench_t *b, uint32_t sequence, uint8_t type) {
  uint8_t wire[TF_FRAME_SIZE(TF_ANSWER_BYTES)];
  uint8_t *at = tf_wire_put(wire + TF_FRAME_AT, sequence, 4);
  *at++ = type;
  *at++ = TF_ANSWER_DONE;
  *at++ = 0;
  *at = 0xff;
  tell(b, wire, tf_frame_seal(wire, TF_DOWN_ANSWER, 8, &b->sequence, 12345));
}

/* Answers to commands of another number or type, on the same line, are not
 * taken for one's own: the first that fits is. */
TEST(answers_to_others_are_not_its_own) {
  static char flag[] = "--send", stop[] = "stop";
  char *const options[] = {flag, stop, NULL};
  begin(&bench, options);
  WAIT_FOR(&bench, bench.link.waiting > 0);
  const uint32_t number = bench.link.queue[0].sequence;
  CHECK(bench.link.waiting == 1 && bench.link.queue[0].type == TF_UP_STOP);
  for (uint32_t i = 1; i < 200; i++) {
    forge(&bench, number + i, TF_UP_STOP);
    forge(&bench, number - i, TF_UP_STOP);
    forge(&bench, number + 65536u * i, TF_UP_STOP);
  }
  for (int type = TF_UP_INPUT; type <= TF_UP_DEADMAN; type++)
    if (type != TF_UP_STOP) forge(&bench, number, (uint8_t)type);
  CHECK(comes(&bench, "stop: took effect at step 0"));
  CHECK(exit_of(&bench) == 0);
  CHECK(strstr(bench.heard, "12345") == NULL);
}

static int write_key(const char *path, const uint8_t *key) {
  FILE *file = fopen(path, "w");
  if (file == NULL) return 0;
  for (unsigned i = 0; i < TF_KEY_BYTES; i++)
    fprintf(file, "%02X", (unsigned)key[i]);
  fprintf(file, "\n");
  return fclose(file) == 0;
}

/* A board that takes only tagged commands is commanded with its key only. */
TEST(keyed_board_takes_keyed_commands) {
  static char flag[] = "--send", stop[] = "stop", with[] = "--key";
  static char path[sizeof place + 8];
  uint8_t key[TF_KEY_BYTES];
  snprintf(path, sizeof path, "%s/key", place);
  for (unsigned i = 0; i < sizeof key; i++) key[i] = (uint8_t)(0x1f * i);
  if (!CHECK(write_key(path, key))) return;
  char *const without[] = {flag, stop, NULL};
  begin(&bench, without);
  bench.key = key;
  CHECK(comes(&bench, "stop: refused, its tag is not that"));
  CHECK(exit_of(&bench) == 3 && bench.simulation.running);
  char *const options[] = {flag, stop, with, path, NULL};
  begin(&bench, options);
  bench.key = key;
  CHECK(comes(&bench, "stop: took effect"));
  CHECK(exit_of(&bench) == 0 && !bench.simulation.running);
  begin(&bench, options);
  key[15] ^= 1;
  bench.key = key;
  CHECK(comes(&bench, "stop: refused, its tag is not that"));
  CHECK(exit_of(&bench) == 3);
  unlink(path);
  begin(&bench, options);
  CHECK(exit_of(&bench) == 2);
}

int main(int argc, char **argv) {
  signal(SIGPIPE, SIG_IGN);
  if (!mkdtemp(place)) return 1;
  snprintf(device, sizeof device, "%s/device", place);
  const int result = tap_main(argc, argv);
  unlink(device);
  rmdir(place);
  return result;
}
