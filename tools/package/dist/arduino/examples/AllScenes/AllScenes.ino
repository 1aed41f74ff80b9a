// Every scene of the library in turn, ten seconds of each: for boards with 128
// KB of flash or more, as a Mega. Rows are for the serial plotter.
#include <twofold.h>

static tf_simulation_t simulation;
static uint8_t chosen;
static unsigned long due;

static void open_scene() {
  const tf_scene_t *scene = tf_scenes[chosen];
  tf_params_t params = scene->params;
  params.dt = 1e-3f;
  Serial.println(scene->name);
  if (tf_simulation_open(&simulation, scene, &params, 1) != TF_OK) {
    Serial.println(F("refused"));
  }
}

void setup() {
  Serial.begin(115200);
  open_scene();
}

void loop() {
  const tf_input_t input = tf_simulation_input(&simulation, tf_scenes[chosen]);
  const tf_status_t status =
      tf_step(&simulation.machine, &simulation.state, &input, &simulation.report);
  if (status < 0 || simulation.state.tick >= 10000) {
    chosen = (chosen + 1) % TF_SCENES;
    open_scene();
  }
  if (millis() - due < 20) return;
  due = millis();
  Serial.print(F("r:"));
  Serial.print((double)simulation.state.r, 6);
  Serial.print(F(" omega:"));
  Serial.print((double)simulation.state.w, 6);
  Serial.print(F(" mode:"));
  Serial.println(simulation.report.mode);
}
