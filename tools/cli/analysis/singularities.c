// The command `singularities`: all two-folds of a machine as JSON, or why there
// are none.

#include "../text/buffer.h"
#include "../text/message.h"
#include "analysis.h"
#include "commands.h"
#include "two_fold.h"

#define ROOM 32768 // bytes; eight two-folds take less than half of it

static int describe(const cli_analysis_t *a, cli_buffer_t *text) {
  tf_surface_point_t points[TF_TWO_FOLDS];
  tf_absence_t absence = TF_ABSENCE_NONE;
  int count = 0;
  const cli_setup_t *setup = &a->setup;
  tf_status_t status =
      tf_two_folds(&setup->machine, &setup->input, points, &count, &absence);
  cli_analysis_begin_json(a, CLI_TWO_FOLD_UNITS, text);
  cli_add(text, "  \"count\": ");
  cli_add_real(text, (tf_real_t)count);
  cli_add(text, ",\n  \"reason\": ");
  if (absence != TF_ABSENCE_NONE) {
    cli_add(text, "\"");
    cli_add(text, tf_absence_name(absence));
    cli_add(text, "\"");
  } else {
    cli_add(text, "null");
  }
  cli_add(text, ",\n  \"two_folds\": [");
  for (int i = 0; i < count && status == TF_OK; i++) {
    tf_two_fold_t at;
    status = tf_normal_form(&setup->machine, &setup->input, &points[i], &at);
    if (status == TF_OK) {
      cli_add(text, i > 0 ? ",\n" : "\n");
      cli_add_two_fold(text, &at, "    ");
    }
  }
  cli_add(text, count > 0 ? "\n  ]\n}\n" : "]\n}\n");
  if (status != TF_OK || text->truncated) {
    return cli_message(
        CLI_STOPPED, "scene %s: singularities: %s", a->scene->name,
        text->truncated ? "out of room" : tf_status_name(status));
  }
  return CLI_DONE;
}

int cli_singularities(int argc, char *const argv[]) {
  cli_analysis_t a;
  char room[ROOM];
  cli_buffer_t text = {room, 0, sizeof room, false};
  int code = cli_analysis_read(&a, "singularities", CLI_TAKES_NOTHING, false,
                               argc, argv);
  if (code == CLI_DONE) {
    code = describe(&a, &text);
  }
  return code == CLI_DONE ? cli_analysis_write(&a, room, text.used) : code;
}
