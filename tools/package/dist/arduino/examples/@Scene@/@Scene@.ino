// Scene `@scene@`, prepared beforehand. Fifty rows a second for the serial
// plotter; @scene@_code.c holds the code. dt is 1e-4 s; an Uno or a Mega takes
// longer for a step, so it runs in slow motion.
#include <twofold_@scene@.h>

static tf_state_t state;
static tf_report_t report;
static unsigned long due;

void setup() {
  Serial.begin(115200);
  tf_@scene@_begin(&state, &report);
}

void loop() {
  const tf_input_t input = tf_@scene@_input(&state);
  if (tf_@scene@_step(&state, &input, &report) < 0) {
    tf_@scene@_begin(&state, &report);
  }
  if (millis() - due < 20) return;
  due = millis();
  // In units of 1e-6: Print's floats would cost an Uno the room.
  Serial.print(F("r:"));
  Serial.print((long)(state.r * 1e6f));
  Serial.print(F(" omega:"));
  Serial.print((long)(state.w * 1e6f));
  Serial.print(F(" mode:"));
  Serial.println(report.mode);
}
