// Instructions of calls of public functions whose cost depends on their input:
//
//   cost            reads lines "tf_NAME UNITS GENES", prints a count for each
//   cost constants  the steps among them, as board.c takes them
//
// GENES are "index:hex,..." of those that are not 0, or "-". A count is 0 where
// they spell no valid machine, or no call of those units.
#include <inttypes.h>
#include <stdio.h>

#include "../../../src/moreau/scheme.h"
#include "board/constants/constants.h"
#include "verify/cost/subject.h"

// A window in which instructions are counted: those of code that went through
// count.py, and no others.
#ifndef __x86_64__
#error "instructions are counted on x86-64"
#endif

static inline void count_open(void) {
  __asm__ volatile("pxor %%mm7, %%mm7" ::: "mm7", "memory");
}

static inline uint32_t count_close(void) {
  uint64_t n;
  __asm__ volatile("movq %%mm7, %0\n\temms" : "=r"(n)::"mm7", "memory");
  return (uint32_t)n;
}

// The instructions of a call. Its value is dropped.
#define COUNT(call) (count_open(), (void)(call), count_close())

#define GENE(n) (s->gene[OWN_GENES + (n)])
#define REAL(n) real_of(GENE(n))
#define K (&s->machine.machine)

#define CALL(function) static uint32_t count_##function(const subject_t *s)

CALL(tyre_force) {
  const tf_real_t side = GENE(2) & 1u ? 1 : -1;
  return COUNT(tf_tyre_force(&K->contact.tyre, side, REAL(0), REAL(1)));
}
CALL(contact_leave) {
  const tf_form_t form[2] = {{REAL(0), REAL(1), REAL(2), 0, 0, 0},
                             {REAL(3), REAL(4), REAL(5), 0, 0, 0}};
  tf_contact_modes_t modes;
  tf_force_t force;
  return COUNT(tf_contact_leave(&K->contact, form, form + 1, s->state.mode,
                                GENE(6) & 1u, GENE(7), 1, &modes, &force));
}

CALL(prepare) {
  tf_machine_t machine;
  return COUNT(tf_prepare(&machine, &s->params, NULL));
}
CALL(prepare_compensated) {
  tf_compensated_t machine;
  return COUNT(tf_prepare_compensated(&machine, &s->params, NULL));
}
CALL(begin) {
  tf_state_t state = s->state;
  tf_report_t report;
  state.mode = (uint8_t)(GENE(0) % (TF_MODES + 1));
  return COUNT(tf_begin(K, &state, &s->input, &report));
}
// Classes of a step, by what it does (docs/VERIFICATION.md, Cost and stack).
enum { ONE_SIGN, EITHER_SIGN, NEAR_CODIM2, REST };

static unsigned class_of_step(const subject_t *s) {
  if (!may_step(&s->state, &s->input)) return REST;
  const start_t start = start_of(K, &s->state, &s->input);
  step_end_t to;
  const end_kind_t kind = end_of_step(K, &s->state, &s->input, start, &to);
  if (kind != END_COMMON) return kind == END_CODIM2 ? NEAR_CODIM2 : REST;
  const end_state_t at = to.end.at;
  const tf_slip_t slip = slip_speeds(K, at.r, at.v, at.w - s->input.omega0);
  if (at.r == s->state.r || !plainly_has_signs(K, to.outcome.mode, slip, at))
    return REST;
  const free_motion_t c = free_motion(K, &s->state, &s->input, start);
  const inclusion_t in = inclusion(&c);
  return signs_of(&in.g) == BOTH_SIGNS ? EITHER_SIGN : ONE_SIGN;
}

// The units are the class.
CALL(step) {
  tf_state_t state = s->state;
  tf_report_t report;
  if (class_of_step(s) != s->units) return 0;
  return COUNT(tf_step(K, &state, &s->input, &report));
}
// The units are the budget.
CALL(step_located) {
  tf_machine_t machine = *K;
  tf_state_t state = s->state;
  tf_report_t report;
  machine.segments = (uint16_t)s->units;
  return COUNT(tf_step_located(&machine, &state, &s->input, &report));
}
CALL(step_compensated) {
  tf_state_t state = s->state;
  tf_compensation_t compensation = {0};
  tf_report_t report;
  return COUNT(tf_step_compensated(&s->machine, &state, &compensation,
                                   &s->input, &report));
}

CALL(step_estimated) {
  tf_state_t state = s->state;
  tf_report_t report;
  tf_real_t error;
  return COUNT(
      tf_step_estimated(K, &state, &s->input, REAL(0), &report, &error));
}
// As many equal states as there are units.
#define MAX_STATES (4 * TF_LANES)
CALL(ensemble_step) {
  static tf_state_block_t blocks[TF_BLOCKS(MAX_STATES)];
  static tf_report_block_t reports[TF_BLOCKS(MAX_STATES)];
  for (unsigned i = 0; i < s->units; i++) tf_ensemble_put(blocks, i, &s->state);
  return COUNT(tf_ensemble_step(K, blocks, s->units, &s->input, reports));
}

// A scene of these parameters, with a profile.
static tf_scene_t scene_of(const subject_t *s) {
  tf_scene_t scene = *tf_scenes[0];
  scene.params = s->params;
  scene.r = s->state.r;
  scene.omega = s->state.w;
  scene.v = s->state.v;
  scene.h = sized_of(GENE(0), -40, 4);
  scene.v_is_given = (GENE(1) & 1u) != 0;
  scene.knots = (uint8_t)(GENE(1) >> 4 & 8u);
  for (unsigned i = 0; i < TF_SCENE_KNOTS; i++)
    scene.profile[i] =
        (tf_knot_t){(tf_real_t)i / 8, s->params.omega0 * (tf_real_t)(i % 3)};
  return scene;
}

CALL(scene_input) {
  const tf_scene_t scene = scene_of(s);
  return COUNT(tf_scene_input(&scene, K, GENE(2) >> (GENE(3) % 32)));
}
static tf_simulation_t simulation_of(const subject_t *s) {
  tf_simulation_t simulation;
  memset(&simulation, 0, sizeof simulation);
  simulation.machine = *K;
  simulation.state = s->state;
  return simulation;
}

CALL(simulation_input) {
  const tf_scene_t scene = scene_of(s);
  tf_simulation_t simulation = simulation_of(s);
  simulation.state.tick = GENE(2) >> (GENE(3) % 32);
  return COUNT(tf_simulation_input(&simulation, &scene));
}
CALL(two_folds) {
  tf_surface_point_t places[TF_TWO_FOLDS];
  tf_absence_t absence;
  int count;
  return COUNT(tf_two_folds(K, &s->input, places, &count, &absence));
}
CALL(normal_form) {
  tf_surface_point_t places[TF_TWO_FOLDS];
  tf_two_fold_t out;
  int count = 0;
  if (tf_two_folds(K, &s->input, places, &count, NULL) != TF_OK || count == 0)
    return 0;
  return COUNT(
      tf_normal_form(K, &s->input, &places[GENE(0) % (unsigned)count], &out));
}
CALL(surface_at) {
  tf_surface_t out;
  return COUNT(
      tf_surface_at(K, &s->input, s->state.r, s->state.v, s->state.w, &out));
}

// The line: of zeros, which COBS must replace, of none, and of every other one.
#define WIRE TF_FRAME_SIZE(TF_FRAME_PAYLOAD)
#define FILLS 3

static void fill(uint8_t *at, size_t length, unsigned kind) {
  for (size_t i = 0; i < length; i++)
    at[i] = (uint8_t)(kind == 0 ? 0 : kind == 1 ? 0xff : i % 2);
}

static void keep_most(uint32_t *most, uint32_t count) {
  if (count > *most) *most = count;
}

CALL(frame_seal) {
  uint8_t wire[WIRE];
  uint32_t most = 0, sequence = UINT32_MAX;
  for (unsigned kind = 0; kind < FILLS; kind++) {
    fill(wire + TF_FRAME_AT, s->units, kind);
    keep_most(&most, COUNT(tf_frame_seal(wire, 1, s->units, &sequence, 0)));
  }
  return most;
}

// Bytes for a decoder that has had a frame of another sequence.
typedef struct {
  uint8_t wire[WIRE], buffer[TF_DECODER_SIZE(TF_FRAME_PAYLOAD)];
  size_t size;
  tf_decoder_t decoder;
  tf_frame_t frame;
} line_t;

// A frame with a payload of some length; is_raw: only bytes, as many.
static void make_line(line_t *line, size_t payload, unsigned kind,
                      bool is_raw) {
  uint32_t sequence = 1;
  memset(line, 0, sizeof *line);
  fill(line->wire + TF_FRAME_AT, payload, kind);
  line->size = tf_frame_seal(line->wire, 1, payload, &sequence, 0);
  if (is_raw) fill(line->wire, line->size, kind);
  tf_decoder_init(&line->decoder, line->buffer, sizeof line->buffer);
  line->decoder.started = true;
  line->decoder.sequence = UINT32_MAX / 2;
}

// Whichever of its bytes costs most.
CALL(decoder_push) {
  uint32_t most = 0;
  line_t line;
  for (unsigned kind = 0; kind < FILLS; kind++) {
    make_line(&line, s->units, kind, false);
    for (size_t i = 0; i < line.size; i++)
      keep_most(&most, COUNT(tf_decoder_push(&line.decoder, line.wire[i],
                                             &line.frame)));
  }
  return most;
}
// The bytes of a whole frame are what is left of the units.
CALL(decoder_block) {
  uint32_t most = 0;
  line_t line;
  size_t taken;
  for (unsigned n = 0; n < 2 * FILLS; n++) {
    make_line(&line, s->units - TF_FRAME_SIZE(0), n % FILLS, n >= FILLS);
    keep_most(&most, COUNT(tf_decoder_block(&line.decoder, line.wire, line.size,
                                            &taken, &line.frame)));
  }
  return most;
}

static const uint8_t zero_key[TF_KEY_BYTES] = {0};

CALL(command_seal) {
  uint8_t wire[WIRE];
  uint32_t most = 0, number = 1;
  for (unsigned kind = 0; kind < FILLS; kind++) {
    fill(wire + TF_COMMAND_AT, s->units, kind);
    keep_most(&most, COUNT(tf_command_seal(wire, TF_UP_INPUT, s->units, 1,
                                           &number, 0, zero_key)));
  }
  return most;
}

CALL(frame_vouch) {
  uint32_t most = 0;
  line_t line;
  for (unsigned kind = 0; kind < FILLS; kind++) {
    make_line(&line, s->units, kind, false);
    keep_most(&most, COUNT(tf_frame_vouch(line.wire, line.size, zero_key, 0)));
  }
  return most;
}
CALL(frame_is_vouched) {
  line_t line;
  size_t taken;
  make_line(&line, s->units, 0, false);
  line.size = tf_frame_vouch(line.wire, line.size, zero_key, 0);
  (void)tf_decoder_block(&line.decoder, line.wire, line.size, &taken,
                         &line.frame);
  return COUNT(tf_frame_is_vouched(&line.frame, zero_key, 0));
}

// Commands: each parameter, each type up to one that is none with its data, and
// each with data that are too long.
#define TYPES (TF_UP_SETPOINT + 2 - TF_UP_INPUT)
#define COMMANDS (TF_PARAMETERS + 2 * TYPES)

// Returns: the length of the data.
static size_t command_of(const subject_t *s, unsigned n, uint8_t *type,
                         uint8_t *data) {
  const tf_input_t *u = &s->input;
  uint8_t *at = data;
  *type = TF_UP_PARAMETER;
  if (n < TF_PARAMETERS) {
    tf_real_t value;
    memcpy(&value, (const char *)&s->params + tf_parameter_ranges[n].offset,
           sizeof value);
    *at++ = (uint8_t)n;
    return (size_t)(tf_wire_put_real(at, value) - data);
  }
  *type = (uint8_t)(TF_UP_INPUT + (n - TF_PARAMETERS) % TYPES);
  memset(data, 0, TF_COMMAND_DATA);
  if (n >= TF_PARAMETERS + TYPES) return TF_COMMAND_DATA;
  switch (*type) {
    case TF_UP_INPUT:
    case TF_UP_SETPOINT:
      for (unsigned i = 0; i < 5; i++)
        at =
            tf_wire_put_real(at, (const tf_real_t[]){u->omega0, u->r0, u->force,
                                                     u->torque, u->alpha}[i]);
      break;
    case TF_UP_RULE:
      *at++ = (uint8_t)s->params.rule;
      at = tf_wire_put(at, s->state.seed, 4);
      break;
    case TF_UP_RESTORE:
      at = tf_wire_put(at, s->state.tick, 8);
      for (unsigned i = 0; i < 4; i++)
        at = tf_wire_put_real(
            at, (const tf_real_t[]){s->state.r, s->state.v, s->state.w,
                                    s->state.phi}[i]);
      at = tf_wire_put(at, s->state.seed, 4);
      *at++ = s->state.mode;
      break;
    default:
      break;
  }
  return (size_t)(at - data);
}

// The most that a byte, the boundary and an answer take, whichever command it
// is of which a link has its queue full, and gets one more.
typedef struct {
  uint32_t receive, boundary, answer;
} link_cost_t;

static link_cost_t cost_of_link(const subject_t *s, const uint8_t *key) {
  link_cost_t most = {0, 0, 0};
  const tf_scene_t scene = scene_of(s);
  uint8_t wire[WIRE], type;
  for (unsigned n = 0; n < COMMANDS; n++) {
    tf_simulation_t simulation = simulation_of(s);
    tf_link_t link;
    tf_link_open(&link, &scene, &s->params);
    link.session = 1;
    link.has_saved = true;
    link.saved = s->state;
    for (uint32_t i = 0; i <= TF_LINK_QUEUE; i++) {
      uint32_t number = i * 0x101u;
      const size_t length = command_of(s, n, &type, wire + TF_COMMAND_AT);
      const size_t size =
          tf_command_seal(wire, type, length, 1, &number, 0, key);
      for (size_t at = 0; at < size; at++)
        keep_most(&most.receive,
                  key ? COUNT(tf_link_receive_tagged(&link, wire[at], key))
                      : COUNT(tf_link_receive(&link, wire[at])));
    }
    uint32_t sequence = 0;
    keep_most(&most.boundary, COUNT(tf_link_boundary(&link, &simulation)));
    keep_most(&most.answer, COUNT(tf_link_answer(&link, wire, &sequence)));
  }
  return most;
}

CALL(link_receive) { return cost_of_link(s, NULL).receive; }
CALL(link_receive_tagged) {
  static const uint8_t key[TF_KEY_BYTES] = {1};
  return cost_of_link(s, key).receive;
}
CALL(link_boundary) { return cost_of_link(s, NULL).boundary; }
CALL(link_answer) { return cost_of_link(s, NULL).answer; }

static tf_report_t report_of(const subject_t *s) {
  return (tf_report_t){.force = {real_of(GENE(0)), real_of(GENE(1))},
                       .slip = {real_of(GENE(2)), real_of(GENE(3))},
                       .delassus = real_of(GENE(4)),
                       .residual = real_of(GENE(5)),
                       .mode = (uint8_t)(GENE(6) % TF_MODES),
                       .set = (uint8_t)(GENE(6) >> 8),
                       .choices = (uint8_t)(GENE(6) >> 16)};
}

// Numbers as text: long ones, and those that take many powers of ten.
CALL(text_row) {
  char out[TF_TEXT_ROW_ROOM];
  tf_report_t report = report_of(s);
  const tf_state_t state = {
      .r = real_of(GENE(7)), .v = real_of(GENE(8)), .w = real_of(GENE(9))};
  return COUNT(tf_text_row(out, &state, &report));
}

typedef struct {
  const char *name; // without the suffix of the real type
  uint32_t (*count)(const subject_t *);
} call_t;

#define ENTRY(function) \
  { #function, count_##function }
static const call_t calls[] = {
    ENTRY(step),
    ENTRY(step_compensated),
    ENTRY(step_located),
    ENTRY(ensemble_step),
    ENTRY(begin),
    ENTRY(prepare),
    ENTRY(prepare_compensated),
    ENTRY(tyre_force),
    ENTRY(contact_leave),
    ENTRY(step_estimated),
    ENTRY(scene_input),
    ENTRY(simulation_input),
    ENTRY(two_folds),
    ENTRY(normal_form),
    ENTRY(surface_at),
    ENTRY(frame_seal),
    ENTRY(decoder_push),
    ENTRY(decoder_block),
    ENTRY(command_seal),
    ENTRY(frame_vouch),
    ENTRY(frame_is_vouched),
    ENTRY(link_receive),
    ENTRY(link_receive_tagged),
    ENTRY(link_boundary),
    ENTRY(link_answer),
    ENTRY(text_row),
};

static const call_t *call_named(const char *name) {
  for (size_t i = 0; i < sizeof calls / sizeof calls[0]; i++)
    if (strcmp(calls[i].name, name) == 0) return &calls[i];
  return NULL;
}

static bool read_genes(const char *at, subject_t *s) {
  unsigned i;
  uint32_t gene;
  int used;
  for (; sscanf(at, "%u:%" SCNx32 "%n", &i, &gene, &used) == 2; at += used) {
    if (i >= GENES) return false;
    s->gene[i] = gene;
    if (at[used] == ',') used++;
  }
  return *at == '\0' || strcmp(at, "-") == 0;
}

static void print_state(const char *name, const tf_state_t *x) {
  printf("  .%s = {.r = %a, .v = %a, .w = %a, .seed = %" PRIu32
         "u, .tick = %" PRIu64 "u, .mode = %d},\n",
         name, (double)x->r, (double)x->v, (double)x->w, x->seed, x->tick,
         x->mode);
}

// A step and what it ends with.
static void print_constants(const char *name, subject_t *s) {
  const bool located = strcmp(name, "step_located") == 0;
  tf_machine_t *k = &s->machine.machine;
  const tf_input_t *u = &s->input;
  tf_report_t report = {0};
  if (located) k->segments = (uint16_t)s->units;
  printf("{ // tf_%s %u\n  .step = tf_%s,\n  .machine = {\n", name, s->units,
         name);
  constants_of_machine(stdout, k);
  printf("},\n  .input = {%a, %a, %a, %a, %a},\n", (double)u->omega0,
         (double)u->r0, (double)u->force, (double)u->torque, (double)u->alpha);
  print_state("state", &s->state);
  (void)(located ? tf_step_located : tf_step)(k, &s->state, u, &report);
  print_state("end", &s->state);
  puts("},");
}

int main(int argc, char **argv) {
  const bool constants = argc == 2 && strcmp(argv[1], "constants") == 0;
  char name[32], genes[1024];
  subject_t s;
  memset(&s, 0, sizeof s);
  setvbuf(stdout, NULL, _IOLBF, BUFSIZ);
  while (scanf(" tf_%31s %u %1023s", name, &s.units, genes) == 3) {
    const call_t *call = call_named(name);
    if (call == NULL || !read_genes(genes, &s)) {
      fprintf(stderr, "cost: not understood: %s %s\n", name, genes);
      return 1;
    }
    make_subject(&s);
    const uint32_t count = s.valid ? call->count(&s) : 0;
    if (!constants)
      printf("%" PRIu32 "\n", count);
    else if (count > 0)
      print_constants(name, &s);
    const subject_t none = {.units = 0};
    s = none;
  }
  return 0;
}
