// Throughput of the codec on this machine, in MB of the line a second:
//   NAME MEDIAN LOW HIGH
// for blocks, for single bytes and for making frames. The stream is what
// `twofold run` writes: a state and a report a step. Reports only.
#define _POSIX_C_SOURCE 200809L

#include <stdio.h>

#include "own.h"
#include "timing.h"

#define STEPS 20000
#define ROUNDS 21
#define PAIR (TF_FRAME_SIZE(TF_STATE_BYTES) + TF_FRAME_SIZE(TF_REPORT_BYTES))
#define BLOCK 65536

static uint8_t line[STEPS * PAIR];

// A motion with a mantissa full of digits. Returns: bytes made.
static size_t make_stream(const tf_simulation_t *start,
                          const tf_scene_t *scene) {
  tf_simulation_t simulation = *start;
  uint32_t sequence = 0;
  size_t at = 0;
  for (int i = 0; i < STEPS; i++) {
    const tf_input_t input = tf_simulation_input(&simulation, scene);
    tf_step(&simulation.machine, &simulation.state, &input, &simulation.report);
    at += tf_send_state(line + at, &sequence, &simulation.state);
    at += tf_send_report(line + at, &sequence, simulation.state.tick,
                         &simulation.report, simulation.stepped);
  }
  return at;
}

static uint32_t decode_blocks(tf_decoder_t *decoder, size_t length) {
  const uint8_t *at = line;
  tf_frame_t frame;
  size_t taken = 0;
  while (length > 0) {
    size_t block = length < BLOCK ? length : BLOCK;
    length -= block;
    while (tf_decoder_block(decoder, at, block, &taken, &frame)) {
      at += taken;
      block -= taken;
    }
    at += taken;
  }
  return decoder->frames;
}

static uint32_t decode_bytes(tf_decoder_t *decoder, size_t length) {
  tf_frame_t frame;
  for (size_t i = 0; i < length; i++) tf_decoder_push(decoder, line[i], &frame);
  return decoder->frames;
}

static uint32_t seal_frames(tf_decoder_t *decoder, size_t length) {
  static uint8_t wire[TF_FRAME_SIZE(TF_REPORT_BYTES)];
  uint32_t sequence = 0;
  (void)decoder;
  for (size_t i = 0; i + sizeof wire <= length; i += sizeof wire) {
    for (unsigned k = 0; k < TF_REPORT_BYTES; k++)
      wire[TF_FRAME_AT + k] = line[i + k];
    tf_frame_seal(wire, TF_DOWN_REPORT, TF_REPORT_BYTES, &sequence, i);
  }
  return 2 * STEPS;
}

static int race(const char *name, size_t length,
                uint32_t (*way)(tf_decoder_t *, size_t)) {
  static uint8_t buffer[TF_DECODER_SIZE(TF_FRAME_PAYLOAD)];
  double rate[ROUNDS];
  for (int i = 0; i < ROUNDS; i++) {
    tf_decoder_t decoder;
    tf_decoder_init(&decoder, buffer, sizeof buffer);
    const double started = timing_process();
    if (way(&decoder, length) != 2 * STEPS) return 1;
    rate[i] = 1e-6 * (double)length / (timing_process() - started);
  }
  timing_sort(rate, ROUNDS);
  printf("%-8s %6.0f %6.0f %6.0f MB/s\n", name, rate[ROUNDS / 2], rate[0],
         rate[ROUNDS - 1]);
  return 0;
}

int frame_main(int argc, char **argv) {
  (void)argc;
  (void)argv;
  const tf_scene_t *scene = tf_scenes[0];
  tf_simulation_t simulation;
  if (tf_simulation_open(&simulation, scene, &scene->params, 0) != TF_OK)
    return 1;
  const size_t length = make_stream(&simulation, scene);
  printf("%d frames, %zu bytes; median, least and most of %d rounds\n",
         2 * STEPS, length, ROUNDS);
  return race("blocks", length, decode_blocks) +
         race("bytes", length, decode_bytes) +
         race("seal", length, seal_frames);
}
