/* The examples of docs/PROTOCOL.md: each is a frame, says what the text around
 * it says, and is what the library makes of that. Also what the frames that go
 * down carry. Runs from the root of the project. */
#include <ctype.h>

#include "frame_in.h"
#include "same_state.h"
#include "tap.h"
#include "twofold.h"

#define R TF_REAL_BYTES
#define LONGEST TF_FRAME_SIZE(TF_FRAME_PAYLOAD)
/* Of the board in the examples. */
#define SESSION 0x1A2B3C4Du
#define RUN 0xC0FFEE42u
#define IS_FLOAT (sizeof(tf_real_t) == 4)

typedef struct {
  uint8_t wire[LONGEST];
  size_t size;
} example_t;

/* The block "```hex NAME" of the document. */
static example_t example(const char *name) {
  example_t found = {{0}, 0};
  char line[400], want[40];
  FILE *file = fopen("docs/PROTOCOL.md", "r");
  snprintf(want, sizeof want, "```hex %s\n", name);
  CHECK(file != NULL);
  if (file == NULL) return found;
  bool inside = false;
  while (!inside && fgets(line, sizeof line, file))
    inside = !strcmp(line, want);
  while (fgets(line, sizeof line, file) && line[0] != '`')
    for (const char *at = line; isxdigit((unsigned char)at[0]);) {
      const char byte[3] = {at[0], at[1], '\0'};
      if (found.size < LONGEST)
        found.wire[found.size++] = (uint8_t)strtoul(byte, NULL, 16);
      at += at[2] == ' ' ? 3 : 2;
    }
  fclose(file);
  return found;
}

/* Decodes an example; in the build of its real type compares it with what was
 * made, and prints that where it differs. */
static void judge(const char *name, uint8_t type, uint32_t sequence,
                  uint64_t tick, const uint8_t *made, size_t size) {
  const example_t shown = example(name);
  const tf_frame_t frame = frame_of(shown.wire, shown.size);
  CHECK(frame.type == type && frame.tick == tick);
  CHECK(frame.sequence == sequence);
  if (size == 0) return; /* of the other real type */
  if (CHECK(shown.size == size && !memcmp(shown.wire, made, size))) return;
  printf("# %s:", name);
  for (size_t i = 0; i < size; i++) printf(" %02X", (unsigned)made[i]);
  printf("\n");
}

static const tf_state_t state_shown = {TF_R(0.18), TF_R(-0.5), TF_R(-1.037),  0,
                                       1000,       7,          TF_STICK_MINUS};
static const tf_report_t report_shown = {
    TF_STICK_MINUS,   0x18, 2, {TF_R(0.75), TF_R(-0.2)},
    {0, TF_R(-0.25)}, 2,    0, TF_OK};
/* Its chain is that of the examples in float before it. */
static tf_heartbeat_t heartbeat_shown(void) {
  static const char *const before[] = {"schema", "layout", "state", "report"};
  tf_heartbeat_t beat = {1000, 0, 2, 3, 1,  0, 5200, 5400, 9100, 1000000, 4,
                         0,    1, 3, 2, 93, 6, 5,    7,    8,    RUN,     0};
  for (unsigned i = 0; i < 4; i++) {
    const example_t frame = example(before[i]);
    const uint8_t *crc = frame.wire + frame.size - 1 - TF_FRAME_CRC;
    beat.chain = tf_frame_chain(beat.chain, crc);
  }
  return beat;
}
static tf_schema_t schema_shown(void) {
  return (tf_schema_t){.params = &tf_scenes[0]->params,
                       .scene = tf_scenes[0]->name,
                       .build = "demo",
                       .seed = 7,
                       .takes_commands = true,
                       .session = SESSION,
                       .sequence = 1,
                       .deadman = 500,
                       .run = RUN};
}

static size_t set_mu(uint8_t *wire) {
  uint32_t number = 1;
  wire[TF_COMMAND_AT] = 8;
  tf_wire_put_real(wire + TF_COMMAND_AT + 1, TF_R(1.25));
  return tf_command_seal(wire, TF_UP_PARAMETER, 1 + R, SESSION, &number, 0,
                         NULL);
}

static size_t plain(uint8_t *wire, uint8_t type, uint32_t number,
                    const uint8_t *key) {
  return tf_command_seal(wire, type, 0, SESSION, &number, 0, key);
}

static size_t answer_to(uint8_t *wire, const uint8_t *command, size_t size) {
  static tf_link_t link;
  static tf_simulation_t simulation;
  const tf_scene_t *scene = tf_scenes[0];
  uint32_t sequence = 7;
  CHECK(tf_simulation_open(&simulation, scene, &scene->params, 7) == TF_OK);
  simulation.state.tick = 1000;
  tf_link_open(&link, scene, &scene->params);
  link.session = SESSION;
  for (size_t i = 0; i < size; i++) tf_link_receive(&link, command[i]);
  CHECK(tf_link_boundary(&link, &simulation) == 1);
  return tf_link_answer(&link, wire, &sequence);
}

static void judge_commands(void) {
  uint8_t wire[LONGEST], command[LONGEST], key[TF_KEY_BYTES];
  const size_t own = IS_FLOAT;
  for (unsigned i = 0; i < sizeof key; i++) key[i] = (uint8_t)i;
  judge("describe", 0x4A, 0, 0, wire, plain(wire, TF_UP_DESCRIBE, 0, NULL));
  judge("start", 0x44, 2, 0, wire, plain(wire, TF_UP_START, 2, NULL));
  judge("start-tagged", 0x44, 2, 0, wire, plain(wire, TF_UP_START, 2, key));
  size_t size = set_mu(command);
  judge("set-mu", 0x42, 1, 0, command, own * size);
  size = answer_to(wire, command, size);
  judge("answer", 0x08, 7, 1000, wire, own * size);
}

TEST(documented_frames_decode) {
  uint8_t wire[LONGEST];
  /* Those of the other real type are decoded only. */
  const size_t own = IS_FLOAT;
  const tf_schema_t schema = schema_shown();
  uint32_t sequence = 0;
  size_t size = tf_send_schema(wire, &sequence, 0, &schema);
  judge("schema", 0x01, 0, 0, wire, own * size);
  size = tf_send_layout(wire, &sequence, 0, TF_DOWN_STATE, tf_layout_state);
  judge("layout", 0x02, 1, 0, wire, size);
  size = tf_send_state(wire, &sequence, &state_shown);
  judge("state", 0x03, 2, 1000, wire, own * size);
  judge("state-double", 0x03, 2, 1000, wire, (1 - own) * size);
  const tf_frame_t sent = frame_of(wire, size);
  tf_state_t state;
  tf_read_state(sent.payload, sent.tick, &state);
  CHECK(same_state(&state, &state_shown));
  size = tf_send_report(wire, &sequence, 1000, &report_shown, TF_INPUT_SET);
  judge("report", 0x04, 3, 1000, wire, own * size);
  const tf_heartbeat_t beat = heartbeat_shown();
  size = tf_send_heartbeat(wire, &sequence, 1000, &beat);
  judge("heartbeat", 0x06, 4, 1000, wire, size);
  tf_wire_put(wire + TF_FRAME_AT, 2, TF_EXPIRED_BYTES);
  size =
      tf_frame_seal(wire, TF_DOWN_EXPIRED, TF_EXPIRED_BYTES, &sequence, 1000);
  judge("expired", 0x09, 5, 1000, wire, size);
  judge_commands();
}

/* Section 3: each law, by its number. */
TEST(documented_laws_are_those_of_the_core) {
  char want[200], line[400];
  int size = snprintf(want, sizeof want, "    1       u8        law:");
  for (unsigned i = 0; i < TF_TYRE_LAWS; i++)
    size += snprintf(want + size, sizeof want - (size_t)size, "%s %u %s",
                     i ? "," : "", i, tf_tyre_law_name(i));
  snprintf(want + size, sizeof want - (size_t)size, "\n");
  bool found = false;
  FILE *file = fopen("docs/PROTOCOL.md", "r");
  CHECK(file != NULL);
  if (file == NULL) return;
  while (!found && fgets(line, sizeof line, file)) found = !strcmp(line, want);
  fclose(file);
  if (!CHECK(found)) printf("# no line %s", want);
}

TEST(report_has_any_status) {
  uint8_t wire[LONGEST];
  uint32_t sequence = 0;
  for (int status = TF_STEP_TOO_LONG; status <= TF_STALLED; status++) {
    tf_report_t report = report_shown;
    report.status = (tf_status_t)status;
    const tf_frame_t frame = frame_of(
        wire, tf_send_report(wire, &sequence, 0, &report, TF_INPUT_SET));
    CHECK(frame.payload[6 * R + 3] == (uint8_t)(int8_t)status);
  }
}

TEST(schema_says_what_runs) {
  uint8_t wire[LONGEST];
  uint32_t sequence = 0;
  tf_schema_t schema = schema_shown();
  tf_frame_t frame =
      frame_of(wire, tf_send_schema(wire, &sequence, 0, &schema));
  /* Beside the example: the bytes that depend on the real type. */
  const uint8_t *dt = frame.payload + 29;
  const tf_params_t *params = schema.params;
  CHECK(frame.payload[0] == R && tf_wire_get_real(dt) == params->dt);
  CHECK(!strcmp((const char *)dt + R, "chaos"));
  CHECK(!strcmp((const char *)dt + R + 6, "demo"));
  /* Each flag has a bit of its own. */
  for (unsigned flags = 0; flags < 64; flags++) {
    if ((flags >> 2 & 3u) >= TF_REST_LAWS) continue;
    tf_params_t flagged = *params;
    flagged.rest = (tf_rest_law_t)(flags >> 2 & 3u);
    tf_schema_t variant = schema;
    flagged.with_angle = flags & 1u;
    variant.takes_commands = flags & 2u;
    variant.wants_tag = flags & 16u;
    variant.ends = flags & 32u;
    variant.params = &flagged;
    frame = frame_of(wire, tf_send_schema(wire, &sequence, 0, &variant));
    CHECK(frame.payload[4] == flags);
  }
  /* Names that do not fit are cut off, and both still end. */
  char name[400];
  memset(name, 'x', sizeof name);
  name[399] = '\0';
  schema.scene = schema.build = name;
  frame = frame_of(wire, tf_send_schema(wire, &sequence, 0, &schema));
  CHECK(frame.length == TF_SCHEMA_BYTES);
  CHECK(frame.payload[TF_SCHEMA_BYTES - 2] == 0);
  CHECK(frame.payload[TF_SCHEMA_BYTES - 1] == 0);
  schema.scene = "short"; /* the whole rest is the other's */
  frame = frame_of(wire, tf_send_schema(wire, &sequence, 0, &schema));
  CHECK(frame.length == TF_SCHEMA_BYTES);
  CHECK(frame.payload[TF_SCHEMA_BYTES - 2] == 'x');
  CHECK(frame.payload[TF_SCHEMA_BYTES - 1] == 0);
  /* The hash sees every parameter. */
  const uint32_t hash = tf_params_hash(params);
  for (unsigned i = 0; i < TF_PARAMETERS; i++) {
    tf_params_t other = *params;
    tf_real_t value;
    char *member = (char *)&other + tf_parameter_ranges[i].offset;
    memcpy(&value, member, sizeof value);
    value += TF_R(0.5);
    memcpy(member, &value, sizeof value);
    CHECK(tf_params_hash(&other) != hash);
  }
  tf_params_t other = *params;
  other.rule = TF_RULE_RANDOM;
  CHECK(tf_params_hash(&other) != hash);
  other = *params;
  other.with_angle = !other.with_angle;
  CHECK(tf_params_hash(&other) != hash);
  /* That of a run sees these, its start and its names. */
  schema.build = "demo";
  const tf_state_t start = {.r = 1}, later = {.r = 1, .tick = 1};
  const uint32_t run = tf_run_hash(0, &schema, &start);
  CHECK(tf_run_hash(0, &schema, &start) == run);
  CHECK(tf_run_hash(1, &schema, &start) != run);
  CHECK(tf_run_hash(0, &schema, &later) != run);
  CHECK(tf_run_hash(0, &schema, &(tf_state_t){.r = 2}) != run);
  tf_schema_t of = schema;
  of.params = &other;
  CHECK(tf_run_hash(0, &of, &start) != run);
  of = schema;
  of.build = "other";
  CHECK(tf_run_hash(0, &of, &start) != run);
}

TEST(long_layout_fills_its_frame) {
  char text[2 * TF_FRAME_PAYLOAD];
  uint8_t wire[2 * LONGEST];
  uint32_t sequence = 0;
  memset(text, 'x', sizeof text);
  text[sizeof text - 1] = '\0';
  const tf_frame_t frame =
      frame_of(wire, tf_send_layout(wire, &sequence, 0, TF_DOWN_STATE, text));
  CHECK(frame.length == TF_FRAME_PAYLOAD);
  CHECK(frame.payload[0] == TF_DOWN_STATE);
  CHECK(!memcmp(frame.payload + 1, text, TF_FRAME_PAYLOAD - 1));
}
