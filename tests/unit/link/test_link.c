/* Commands over a line: validated, applied at the boundary between two steps
 * and nowhere else, answered. Bytes that are none: fuzz target frame. */
#include "same_state.h"
#include "uplink.h"

/* A line that was opened with parameters which no machine has: a command that
 * does not correct them is refused and undone, one that does is taken. */
TEST(parameters_of_no_machine_are_refused_until_mended) {
  board_t board;
  power_up(&board, "chaos");
  tf_params_t params = board.scene->params;
  params.m = -1;
  board.link.params = params;
  const acting_t before = acting(&board);
  const uint8_t rule[5] = {TF_RULE_RANDOM, 1, 2, 3, 4};
  send_parameter(&board, 0, index_of("mu"), 2);
  send(&board, TF_UP_RULE, 0, rule, sizeof rule);
  CHECK_TOLD(&board, 0, TF_BAD_PARAMETER, TF_BAD_PARAMETER);
  CHECK(acts_alike(&board, &before) && board.simulation.state.seed == 5);
  send_parameter(&board, 0, index_of("m"), 1);
  send(&board, TF_UP_RULE, 0, rule, sizeof rule);
  CHECK(boundary(&board) == 2);
  CHECK(board.simulation.machine.contact.rule == TF_RULE_RANDOM);
}

TEST(set_parameter_takes_effect_only_at_the_boundary) {
  board_t board;
  power_up(&board, "chaos");
  const acting_t before = acting(&board);
  send_parameter(&board, 0, index_of("mu"), TF_R(1.25));
  CHECK(acts_alike(&board, &before));
  CHECK(answer_of(&board).length == 0); /* nothing to report yet */
  CHECK(boundary(&board) == 1);
  CHECK(board.simulation.machine.contact.tyre.mu == TF_R(1.25));
  tf_params_t params = board.scene->params;
  tf_machine_t machine;
  params.mu = TF_R(1.25);
  CHECK(tf_prepare(&machine, &params, NULL) == TF_OK);
  CHECK(board.simulation.machine.mu_sin_gamma == machine.mu_sin_gamma);
  CHECK(tf_params_hash(&params) == tf_params_hash(&board.link.params));
  CHECK(tf_params_hash(&params) != tf_params_hash(&board.scene->params));
  /* Dated ahead: not before its tick. */
  send_parameter(&board, 3, index_of("mu"), 1);
  for (int n = 0; n < 3; n++) {
    tick(&board);
    CHECK(board.simulation.machine.contact.tyre.mu == TF_R(1.25));
  }
  tick(&board);
  CHECK(board.simulation.machine.contact.tyre.mu == 1 &&
        board.simulation.state.tick == 4);
  CHECK(code_of(&board) == TF_ANSWER_DONE);
  const answer_t answer = answer_of(&board);
  CHECK(answer.code == TF_ANSWER_DONE && answer.tick == 3);
}

TEST(set_parameter_is_validated_and_answered) {
  const tf_real_t far = (tf_real_t)INFINITY;
  board_t board;
  power_up(&board, "chaos");
  /* Each of them, at both ends and beyond. */
  for (unsigned i = 0; i < TF_PARAMETERS; i++) {
    const tf_parameter_range_t *range = &tf_parameter_ranges[i];
    const tf_real_t tried[] = {
        range->high, range->low, range->high * 2 + 1, range->low * 2 - 1,
        far,         -far,       (tf_real_t)NAN};
    for (unsigned n = 0; n < 7; n++) {
      const acting_t before = acting(&board);
      send_parameter(&board, 0, i, tried[n]);
      CHECK(boundary(&board) == (n < 2));
      const answer_t answer = answer_of(&board);
      CHECK(answer.type == TF_UP_PARAMETER && answer.sequence == board.up - 1);
      CHECK(answer.code == (n < 2 ? TF_ANSWER_DONE : TF_BAD_PARAMETER));
      CHECK(n < 2 || acts_alike(&board, &before));
      /* What is in effect. */
      CHECK(answer.value == tried[n < 1 ? 0 : 1] && answer.index == i);
      CHECK(answer.low == range->low && answer.high == range->high);
    }
  }
  /* Of one that there is not, or that is not even looked at, nothing. */
  send_parameter(&board, 0, TF_PARAMETERS, 1);
  send_parameter(&board, 0, 255, 1);
  send_parameter(&board, TF_LINK_AHEAD + 1, 0, 1);
  CHECK(boundary(&board) == 0);
  for (unsigned n = 0; n < 3; n++) {
    const answer_t answer = answer_of(&board);
    CHECK(answer.code == (n < 2 ? (int)TF_BAD_PARAMETER : TF_ANSWER_FAR));
    CHECK(answer.length == 8 && answer.index == 255);
  }
}

/* The numbers of bytes are those of test_device.py and test_make.py. */
TEST(records_are_as_many_as_the_line_carries) {
  board_t board;
  power_up(&board, "chaos");
  uint8_t data[4] = {100, 0, 0, 0}, wire[TF_FRAME_SIZE(TF_ANSWER_BYTES)];
  send(&board, TF_UP_EVERY, 0, data, 4);
  CHECK_TOLD(&board, 0, TF_ANSWER_UNKNOWN); /* nobody has said how many */
  const struct {
    uint32_t rate, carries, every;
    int code;
    uint32_t asks;
  } cases[] = {{1000, 1050, 100, 0, 1050},       {1000, 1050, 99, -23, 1061},
               {1000, 1050, 0, -1, 0},           {1000, 0, 1, 0, 100050},
               {1000, 50, 100, -23, 1050},       {1000, 50, 0, -1, 0},
               {UINT32_MAX, 0, 1, 0, UINT32_MAX}};
  board.link.every = 7;
  for (unsigned i = 0; i < sizeof cases / sizeof *cases; i++) {
    const uint32_t before = board.link.every, asked = cases[i].every;
    board.link.line = (tf_line_t){cases[i].rate, 100, 50, cases[i].carries};
    tf_wire_put(data, asked, 4);
    send(&board, TF_UP_EVERY, 0, data, 4);
    CHECK(boundary(&board) == (cases[i].code == 0));
    CHECK(board.link.every == (cases[i].code == 0 ? asked : before));
    const tf_frame_t frame =
        frame_of(wire, tf_link_answer(&board.link, wire, &board.down));
    CHECK(frame.payload[5] == (uint8_t)cases[i].code);
    CHECK(frame.length == (asked > 0 ? 20 : 8));
    if (asked == 0) continue;
    const uint64_t asks = tf_line_asks(&board.link.line, asked);
    CHECK((asks < UINT32_MAX ? asks : UINT32_MAX) == cases[i].asks);
    CHECK(tf_wire_get(frame.payload + 8, 4) == board.link.every);
    CHECK(tf_wire_get(frame.payload + 12, 4) == cases[i].asks);
    CHECK(tf_wire_get(frame.payload + 16, 4) == cases[i].carries);
  }
  send(&board, TF_UP_EVERY, 0, data, 3);
  CHECK_TOLD(&board, 0, TF_ANSWER_LENGTH);
  char name[300] = {0};
  memset(name, 'a', sizeof name - 1);
  CHECK(tf_line_of_frames(1, 0, name, "", false, 0).beside ==
        tf_line_of_frames(1, 0, name + 61, "", false, 0).beside);
}

TEST(inputs_act_at_their_tick) {
  board_t board;
  power_up(&board, "driven");
  tf_simulation_t pure = board.simulation;
  for (int n = 0; n < 3000; n++) {
    const uint64_t now = board.simulation.state.tick;
    tf_input_t input = tf_simulation_input(&pure, board.scene);
    if (now >= 100) {
      /* The loop of a brake: it depends on the state. */
      input.torque = TF_R(-0.125) * pure.state.w;
      input.force = TF_R(0.0625);
      input.omega0 = -1;
      input.alpha = now < 200 ? TF_R(0.25) : 0; /* the table speeds up */
      send_input(&board, now, &input);
    }
    tick(&board);
    CHECK((now >= 100) == (board.simulation.source == TF_INPUT_SET));
    if (now >= 100) {
      CHECK(code_of(&board) == TF_ANSWER_DONE);
      CHECK(board.simulation.input.alpha == 0); /* the step has had it */
    }
    tf_step(&pure.machine, &pure.state, &input, &pure.report);
    CHECK(same_state(&pure.state, &board.simulation.state));
  }
  const tf_input_t held = board.simulation.input;
  tf_input_t bad = held;
  bad.force = (tf_real_t)NAN;
  send_input(&board, 0, &bad);
  bad.force = TF_R(1.1e9);
  send_input(&board, 0, &bad);
  CHECK_TOLD(&board, 0, TF_BAD_STATE, TF_BAD_STATE);
  CHECK(board.simulation.input.force == held.force);
  send_plain(&board, TF_UP_INPUT); /* back to the scene */
  CHECK(boundary(&board) == 1);
  CHECK(board.simulation.source == TF_INPUT_SCENE);
}

TEST(snapshot_and_restore_continue_bit_for_bit) {
  board_t board;
  power_up(&board, "chaos");
  send_plain(&board, TF_UP_RESTORE);
  CHECK_TOLD(&board, 0, TF_ANSWER_EMPTY);
  const uint8_t random[5] = {TF_RULE_RANDOM, 77, 0, 0, 0};
  send(&board, TF_UP_RULE, 0, random, 5);
  ticks(&board, 15000);
  CHECK(code_of(&board) == TF_ANSWER_DONE);
  send_plain(&board, TF_UP_SNAPSHOT);
  boundary(&board);
  uint8_t kept[KEPT_BYTES];
  keep(&board, kept);
  tf_state_t trail[2000];
  for (int n = 0; n < 20000; n++) {
    tick(&board);
    if (n % 10 == 0) trail[n / 10] = board.simulation.state;
  }
  uint32_t answered = 0;
  for (int from = 0; from < 2; from++) {
    answered += drain(&board);
    if (from == 0)
      send_plain(&board, TF_UP_RESTORE);
    else
      send(&board, TF_UP_RESTORE, 0, kept, sizeof kept);
    for (int n = 0; n < 20000; n++) {
      tick(&board);
      if (n % 10 == 0)
        CHECK(same_state(&trail[n / 10], &board.simulation.state));
    }
    CHECK(code_of(&board) == TF_ANSWER_DONE);
  }
  CHECK(answered == 1);
  /* A state that is not valid, or at a tick that would pass 2^64. */
  const tf_state_t before = board.simulation.state;
  for (int i = 0; i < 4; i++) {
    uint8_t bad[KEPT_BYTES];
    memcpy(bad, kept, sizeof bad);
    if (i == 0) bad[KEPT_BYTES - 1] = TF_NO_MODE;
    if (i == 1) memset(bad + 8, 0xff, R);         /* r is NaN */
    if (i == 2) memset(bad + 8 + 3 * R, 0xff, R); /* phi is NaN */
    if (i == 3) tf_wire_put(bad, TF_LINK_TICKS, 8);
    send(&board, TF_UP_RESTORE, 0, bad, sizeof bad);
    CHECK_TOLD(&board, 0, TF_BAD_STATE);
  }
  CHECK(same_state(&before, &board.simulation.state));
}

TEST(start_stop_reset_and_rule) {
  board_t board;
  power_up(&board, "chaos");
  const tf_state_t start = board.simulation.state;
  ticks(&board, 50);
  send_plain(&board, TF_UP_STOP);
  ticks(&board, 50);
  CHECK(board.simulation.state.tick == 50 && !board.simulation.running);
  send_plain(&board, TF_UP_START);
  tick(&board);
  CHECK(board.simulation.state.tick == 51);
  send_plain(&board, TF_UP_RESET);
  CHECK(boundary(&board) == 1);
  CHECK(same_state(&start, &board.simulation.state) &&
        board.simulation.running);
  CHECK(code_of(&board) == 0 && code_of(&board) == 0 && code_of(&board) == 0);
  /* A start that the parameters make impossible is refused. */
  send_parameter(&board, 0, index_of("gamma"), 0);
  send_plain(&board, TF_UP_RESET);
  const tf_state_t before = board.simulation.state;
  CHECK_TOLD(&board, 1, TF_ANSWER_DONE, TF_BAD_STATE);
  CHECK(same_state(&before, &board.simulation.state));
  const uint8_t rule[5] = {TF_RULE_RANDOM, 1, 2, 3, 4};
  const uint8_t none[5] = {TF_RULES, 1, 2, 3, 4};
  send(&board, TF_UP_RULE, 0, rule, 5);
  send(&board, TF_UP_RULE, 0, none, 5);
  board.link.describe = false;
  CHECK_TOLD(&board, 1, TF_ANSWER_DONE, TF_BAD_PARAMETER);
  CHECK(board.simulation.machine.contact.rule == TF_RULE_RANDOM);
  CHECK(board.simulation.state.seed == 0x04030201u && board.link.describe);
  board.link.describe = false;
  send_plain(&board, TF_UP_DESCRIBE);
  CHECK(board.link.describe);
  tick(&board);
  CHECK(code_of(&board) == 0);
  uint8_t wire[TF_FRAME_SIZE(1)];
  const uint8_t type[2] = {TF_UP_DESCRIBE, TF_UP_STOP};
  for (unsigned i = 0; i < 2; i++) { /* too long, too short for a session */
    wire[TF_FRAME_AT] = 0;
    board.link.describe = false;
    hear(&board, wire, tf_frame_seal(wire, type[i], 1, &board.down, 0));
    CHECK(answer_of(&board).length == 0); /* before the boundary */
    tick(&board);
    CHECK(code_of(&board) == TF_ANSWER_LENGTH && !board.link.describe);
  }
}

static void send_setpoint(board_t *board, uint64_t at, tf_real_t force) {
  const tf_input_t input = {-1, 0, force, 0, 0};
  send_inputs(board, TF_UP_SETPOINT, at, &input);
}

/* The force in the step from a tick on, and what the heartbeat counts. */
#define CHECK_FORCE(board, at, wanted)                  \
  do {                                                  \
    CHECK((board)->simulation.state.tick == (at));      \
    boundary(board);                                    \
    CHECK((board)->simulation.input.force == (wanted)); \
    tick(board);                                        \
    CHECK(answer_of(board).length == 0);                \
  } while (0)

/* One a tick, two ticks ahead: each acts at its tick, none is answered. */
TEST(setpoints_act_at_their_ticks_without_an_answer) {
  board_t board;
  power_up(&board, "driven");
  for (unsigned n = 0; n < 40; n++) {
    send_setpoint(&board, n + 2, (tf_real_t)n);
    CHECK_FORCE(&board, n, (tf_real_t)(n > 2 ? n - 2 : 0));
  }
  CHECK(board.link.superseded == 0 && board.link.late == 0);
  CHECK(board.link.lost == 0 && board.link.ignored == 0);
}

TEST(the_newest_setpoint_wins) {
  board_t board;
  power_up(&board, "driven");
  send_setpoint(&board, 0, 1); /* at once, and again: the second */
  send_setpoint(&board, 0, 2);
  CHECK_FORCE(&board, 0, 2);
  CHECK(board.link.superseded == 1);
  send_setpoint(&board, 5, 3); /* dated later than a newer one: gone */
  send_setpoint(&board, 3, 4);
  CHECK_FORCE(&board, 1, 2);
  CHECK_FORCE(&board, 2, 2);
  CHECK_FORCE(&board, 3, 4);
  CHECK(board.link.superseded == 2 && board.link.late == 0);
  send_setpoint(&board, 1, 5); /* too late, but for the last of them */
  send_setpoint(&board, 2, 6);
  CHECK_FORCE(&board, 4, 6);
  CHECK(board.link.superseded == 3 && board.link.late == 1);
  for (unsigned n = 0; n <= TF_LINK_SETPOINTS; n++) /* one too many */
    send_setpoint(&board, 10 + n, (tf_real_t)n);
  CHECK(board.link.superseded == 4);
  send_setpoint(&board, 0, 7); /* at once: nothing dated is left */
  CHECK_FORCE(&board, 5, 7);
  CHECK(board.link.superseded == 4 + TF_LINK_SETPOINTS);
  ticks(&board, 20);
  CHECK(board.simulation.input.force == 7);
}

/* With commands it acts in the order in which they came. */
TEST(setpoints_keep_their_place_among_commands) {
  board_t board;
  power_up(&board, "driven");
  send_setpoint(&board, 0, 1);
  send_plain(&board, TF_UP_INPUT); /* those of the scene */
  CHECK(boundary(&board) == 2 && code_of(&board) == TF_ANSWER_DONE);
  CHECK(board.simulation.source == TF_INPUT_SCENE);
  send_plain(&board, TF_UP_RESET);
  send_setpoint(&board, 0, 2);
  CHECK(boundary(&board) == 2 && code_of(&board) == TF_ANSWER_DONE);
  CHECK(board.simulation.source == TF_INPUT_SET);
  send_setpoint(&board, 9, 3);
  send_plain(&board, TF_UP_CLEAR);
  CHECK(board.link.dated == 0 && board.link.ignored == 1);
}

/* What is refused is answered, and changes nothing. */
TEST(wrong_setpoints_are_answered) {
  board_t board;
  power_up(&board, "driven");
  ticks(&board, 10);
  const acting_t before = acting(&board);
  send_setpoint(&board, 0, (tf_real_t)NAN);
  CHECK_TOLD(&board, 0, TF_BAD_STATE);
  send_setpoint(&board, board.link.now + TF_LINK_AHEAD + 1, 1);
  CHECK_TOLD(&board, 0, TF_ANSWER_FAR);
  send_plain(&board, TF_UP_SETPOINT);
  CHECK_TOLD(&board, 0, TF_ANSWER_LENGTH);
  board.up--;
  send_setpoint(&board, 0, 1);
  CHECK_TOLD(&board, 0, TF_ANSWER_OLD);
  CHECK(acts_alike(&board, &before) && board.link.dated == 0);
}
