// Every scene of the library in turn, ten seconds of each: for boards with 128
// KB of flash or more, as a Mega. Rows are for the serial plotter.
#include <twofold.h>

static tf_session_t session;
static uint8_t chosen;
static unsigned long due;

static void open_scene() {
  const tf_scene_t *scene = tf_scenes[chosen];
  tf_params_t params = scene->params;
  params.dt = 1e-3f;
  Serial.println(scene->name);
  if (tf_session_open(&session, scene, &params, 1) != TF_OK) {
    Serial.println(F("refused"));
  }
}

void setup() {
  Serial.begin(115200);
  open_scene();
}

void loop() {
  const tf_input_t input = tf_session_input(&session, tf_scenes[chosen]);
  const tf_status_t status =
      tf_step(&session.machine, &session.state, &input, &session.report);
  if (status < 0 || session.state.tick >= 10000) {
    chosen = (chosen + 1) % TF_SCENES;
    open_scene();
  }
  if (millis() - due < 20) return;
  due = millis();
  Serial.print(F("r:"));
  Serial.print((double)session.state.r, 6);
  Serial.print(F(" omega:"));
  Serial.print((double)session.state.w, 6);
  Serial.print(F(" mode:"));
  Serial.println(session.report.mode);
}
