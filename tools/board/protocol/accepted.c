// What the decoder of the core accepts of the bytes on standard input: a line
// for each frame, with type, sequence, tick and the payload in hexadecimal.
#include <inttypes.h>
#include <stdio.h>

#include "twofold/frame.h"

static void print_frame(const tf_frame_t *frame) {
  (void)printf("%u %" PRIu32 " %" PRIu64 " ", (unsigned)frame->type,
               frame->sequence, frame->tick);
  for (size_t i = 0; i < frame->length; i++) {
    (void)printf("%02x", (unsigned)frame->payload[i]);
  }
  (void)putchar('\n');
}

int main(void) {
  uint8_t buffer[TF_DECODER_SIZE(TF_FRAME_PAYLOAD)], block[4096];
  tf_decoder_t decoder;
  tf_frame_t frame;
  size_t length = 0, taken = 0;
  tf_decoder_init(&decoder, buffer, sizeof buffer);
  while ((length = fread(block, 1, sizeof block, stdin)) > 0) {
    const uint8_t *at = block;
    while (tf_decoder_block(&decoder, at, length, &taken, &frame)) {
      print_frame(&frame);
      at += taken;
      length -= taken;
    }
  }
  return ferror(stdin) || fflush(stdout) != 0;
}
