// Functions of machines, states, friction and two-folds; of bytes, frames,
// commands and text.
#include <string.h>

#include "../../../src/moreau/scheme.h"
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

#define GENE(n) (s->genes->gene[OWN_GENES + (n)])
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
CALL(begin_with_slip) {
  tf_state_t state = s->state;
  tf_report_t report;
  return COUNT(tf_begin_with_slip(K, &state, &s->input, REAL(0), &report));
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
  tf_compensation_t compensation = s->compensation;
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
CALL(scene_start) {
  const tf_scene_t scene = scene_of(s);
  tf_state_t state;
  tf_report_t report;
  return COUNT(tf_scene_start(&scene, K, GENE(2), &state, &report));
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
  simulation.source = (tf_input_source_t)(GENE(3) >> 5 & 1u);
  simulation.deadman = simulation.left = GENE(3) >> 6 & 1u;
  return COUNT(tf_simulation_input(&simulation, &scene));
}
CALL(simulation_open) {
  const tf_scene_t scene = scene_of(s);
  tf_simulation_t simulation = simulation_of(s);
  return COUNT(tf_simulation_open(&simulation, &scene, &s->params, GENE(2)));
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

// The line.
#define WIRE TF_FRAME_SIZE(TF_FRAME_PAYLOAD)

// Bytes of one kind: 0, which COBS must replace, others, or a mixture.
static void fill(uint8_t *at, size_t length, uint32_t gene) {
  for (size_t i = 0; i < length; i++) switch (gene & 3u) {
      case 0:
        at[i] = 0;
        break;
      case 1:
        at[i] = 0xff;
        break;
      default:
        gene = gene * 1664525u + 1013904223u;
        at[i] = gene >> 28 & 1u ? 0 : (uint8_t)(gene >> 16);
        gene |= 2u;
    }
}

CALL(frame_seal) {
  uint8_t wire[WIRE];
  uint32_t sequence = GENE(1);
  const uint64_t tick = GENE(2) & 1u ? 0 : UINT64_MAX;
  fill(wire + TF_FRAME_AT, s->units, GENE(0));
  return COUNT(
      tf_frame_seal(wire, (uint8_t)GENE(3), s->units, &sequence, tick));
}

// A frame with a payload of some length, and a decoder that knows a sequence.
typedef struct {
  uint8_t wire[WIRE], buffer[TF_DECODER_SIZE(TF_FRAME_PAYLOAD)];
  size_t size;
  tf_decoder_t decoder;
} line_t;

static void line_of(const subject_t *s, unsigned payload, line_t *line) {
  memset(line, 0, sizeof *line);
  uint32_t sequence = GENE(1);
  const uint64_t tick = GENE(2) & 1u ? 0 : UINT64_MAX;
  fill(line->wire + TF_FRAME_AT, payload, GENE(0));
  line->size =
      tf_frame_seal(line->wire, (uint8_t)GENE(3), payload, &sequence, tick);
  if (GENE(4) & 16u) line->wire[GENE(5) % line->size] ^= 1u;
  const uint16_t room = (uint16_t)(GENE(4) & 32u ? 8 : sizeof line->buffer);
  tf_decoder_init(&line->decoder, line->buffer, room);
  line->decoder.started = (GENE(4) & 64u) != 0;
  line->decoder.sequence = GENE(6) >> 4;
  line->decoder.tick = GENE(7);
}

// Whichever of its bytes costs most.
CALL(decoder_push) {
  uint32_t worst = 0;
  line_t line;
  tf_frame_t frame;
  line_of(s, s->units, &line);
  for (size_t i = 0; i < line.size; i++) {
    const uint32_t n =
        COUNT(tf_decoder_push(&line.decoder, line.wire[i], &frame));
    if (n > worst) worst = n;
  }
  return worst;
}
CALL(decoder_block) {
  line_t line;
  tf_frame_t frame;
  size_t taken;
  // The bytes of a whole frame are what is left of the units.
  const unsigned around = TF_FRAME_SIZE(0);
  line_of(s, s->units > around ? s->units - around : 0, &line);
  if (s->units < line.size) line.size = s->units;
  // Or bytes between zeros that are not frames.
  if (GENE(8) & 1u) {
    line.size = s->units;
    fill(line.wire, line.size, GENE(9));
    for (size_t i = GENE(8) >> 4; GENE(8) & 2u && i < line.size; i += 2)
      line.wire[i] = 1;
  }
  return COUNT(
      tf_decoder_block(&line.decoder, line.wire, line.size, &taken, &frame));
}

// A link with a queue of commands of one kind that all take effect.
typedef struct {
  tf_scene_t scene;
  tf_simulation_t simulation;
  tf_link_t link;
  uint8_t key[TF_KEY_BYTES];
  bool wants_tag;
} uplink_t;

static size_t command_of(const subject_t *s, unsigned kind, uint8_t *payload,
                         uint8_t *type) {
  static const uint8_t plain[] = {
      TF_UP_RESET,    TF_UP_START, TF_UP_STOP,  TF_UP_SNAPSHOT, TF_UP_RESTORE,
      TF_UP_DESCRIBE, TF_UP_CLEAR, TF_UP_INPUT, TF_UP_DEADMAN,  0x7f};
  uint8_t *at = payload;
  switch (kind % 6) {
    case 0: {
      const unsigned index = (GENE(8) >> 4) % TF_PARAMETERS;
      tf_real_t value;
      memcpy(&value,
             (const char *)&s->params + tf_parameter_ranges[index].offset,
             sizeof value);
      *type = TF_UP_PARAMETER;
      *at++ = (uint8_t)index;
      at = tf_wire_put_real(at, value);
      break;
    }
    case 1:
      *type = TF_UP_RULE;
      *at++ = (uint8_t)(GENE(8) % TF_RULES);
      at = tf_wire_put(at, GENE(9), 4);
      break;
    case 2:
      *type = TF_UP_RESTORE;
      at = tf_wire_put(at, GENE(9), 8);
      at = tf_wire_put_real(at, s->state.r);
      at = tf_wire_put_real(at, s->state.v);
      at = tf_wire_put_real(at, s->state.w);
      at = tf_wire_put_real(at, s->state.phi);
      at = tf_wire_put(at, s->state.seed, 4);
      *at++ = s->state.mode;
      break;
    case 3:
      *type = TF_UP_INPUT;
      at = tf_wire_put_real(at, s->input.omega0);
      at = tf_wire_put_real(at, s->input.r0);
      at = tf_wire_put_real(at, s->input.force);
      at = tf_wire_put_real(at, s->input.torque);
      at = tf_wire_put_real(at, s->input.alpha);
      break;
    case 4: // too long for its kind
      *type = (uint8_t)(TF_UP_INPUT + GENE(8) % 12);
      fill(payload, TF_COMMAND_DATA, GENE(9));
      at += TF_COMMAND_DATA;
      break;
    default:
      *type = plain[GENE(8) % sizeof plain];
  }
  return (size_t)(at - payload);
}

static void start_uplink(const subject_t *s, uplink_t *u) {
  u->scene = *tf_scenes[0];
  u->scene.params = s->params;
  u->scene.r = s->state.r;
  u->scene.omega = s->state.w;
  u->scene.h = sized_of(GENE(10), -40, 4);
  fill(u->key, sizeof u->key, GENE(10));
  u->simulation = simulation_of(s);
  u->simulation.state.tick = GENE(11);
  tf_link_open(&u->link, &u->scene, &s->params);
  u->link.session = 1;
  u->wants_tag = (GENE(12) & 2u) != 0;
  u->link.has_saved = (GENE(12) & 1u) != 0;
  u->link.saved = s->state;
}

// Sends n commands. Returns: what the most expensive byte of the last one took.
static uint32_t send_commands(const subject_t *s, uplink_t *u, unsigned n) {
  uint32_t worst = 0;
  for (unsigned i = 0; i < n; i++) {
    uint8_t wire[WIRE], type;
    uint32_t number = i + (GENE(13) & 1u ? i << 8 : 0);
    const unsigned kind =
        GENE(14) & 1u ? GENE(14) >> 1 : GENE(14) >> (1 + 3 * i);
    const size_t length = command_of(s, kind, wire + TF_COMMAND_AT, &type);
    const size_t size = tf_command_seal(
        wire, type, length, GENE(13) & 2u ? 2u : 1u, &number, GENE(15) & 1u,
        !u->wants_tag || GENE(13) & 4u ? NULL : u->key);
    for (size_t j = 0; j < size; j++) {
      const uint32_t cost =
          u->wants_tag
              ? COUNT(tf_link_receive_tagged(&u->link, wire[j], u->key))
              : COUNT(tf_link_receive(&u->link, wire[j]));
      if (i + 1 == n && cost > worst) worst = cost;
    }
  }
  return worst;
}

CALL(command_seal) {
  uint8_t wire[WIRE], key[TF_KEY_BYTES];
  uint32_t number = GENE(1);
  fill(wire + TF_COMMAND_AT, s->units, GENE(0));
  fill(key, sizeof key, GENE(3));
  return COUNT(tf_command_seal(wire, TF_UP_INPUT, s->units, GENE(4), &number,
                               GENE(2) & 1u ? 0 : UINT64_MAX,
                               GENE(6) & 1u ? NULL : key));
}
static uint32_t receive(const subject_t *s, bool tagged) {
  uplink_t u;
  start_uplink(s, &u);
  u.wants_tag = tagged;
  return send_commands(s, &u, 1 + GENE(16) % (TF_LINK_QUEUE + 1));
}
CALL(link_receive) { return receive(s, false); }
CALL(link_receive_tagged) { return receive(s, true); }
CALL(link_boundary) {
  uplink_t u;
  start_uplink(s, &u);
  (void)send_commands(s, &u, TF_LINK_QUEUE);
  return COUNT(tf_link_boundary(&u.link, &u.simulation));
}
CALL(link_answer) {
  uplink_t u;
  uint8_t wire[WIRE];
  uint32_t sequence = GENE(17);
  start_uplink(s, &u);
  (void)send_commands(s, &u, TF_LINK_QUEUE);
  (void)tf_link_boundary(&u.link, &u.simulation);
  return COUNT(tf_link_answer(&u.link, wire, &sequence));
}

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

#define UNITS(function, weight, ...) \
  { #function, count_##function, weight, __VA_ARGS__ }
#define ENTRY(function) UNITS(function, 1, 1, {0})
#define MOST(function, most) UNITS(function, 1, 1, {most})
const call_t calls[] = {
    UNITS(step, 8, 4, {ONE_SIGN, EITHER_SIGN, NEAR_CODIM2, REST}),
    UNITS(step_compensated, 4, 1, {0}),
    UNITS(step_located, 4, 4, {1, 2, 4, 8}),
    MOST(ensemble_step, MAX_STATES),
    ENTRY(begin),
    ENTRY(begin_with_slip),
    ENTRY(prepare),
    ENTRY(prepare_compensated),
    ENTRY(tyre_force),
    ENTRY(contact_leave),
    ENTRY(step_estimated),
    ENTRY(scene_input),
    ENTRY(scene_start),
    ENTRY(simulation_input),
    ENTRY(simulation_open),
    ENTRY(two_folds),
    ENTRY(normal_form),
    ENTRY(surface_at),
    MOST(frame_seal, TF_FRAME_PAYLOAD),
    MOST(decoder_push, TF_FRAME_PAYLOAD),
    MOST(decoder_block, TF_FRAME_SIZE(TF_FRAME_PAYLOAD)),
    ENTRY(link_receive_tagged),
    MOST(command_seal, TF_COMMAND_MOST),
    ENTRY(link_receive),
    ENTRY(link_boundary),
    ENTRY(link_answer),
    ENTRY(text_row),
};
const unsigned call_count = sizeof calls / sizeof calls[0];
