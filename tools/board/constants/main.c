// The program `constants`:
//   constants SCENE [RATE]     for a firmware; dt is the scene's, or 1/RATE
//   constants --scene SCENE    only the scene itself
//   constants --number SCENE   its number in tf_scenes
//   constants --line SCENE FORMAT RATE EVERY BAUD [yes [KEY]]
//                              whether its line carries a firmware's records;
//                              yes: it has an uplink, and a key
//   constants --key FILE       the bytes of a key
// SCENE is a name or, but for its number, a file ('twofold help scene').
#include <stdlib.h>
#include <string.h>

#include "../../cli/host/host.h"
#include "../../cli/setup/scene_file.h"
#include "constants.h"

// words: FORMAT RATE EVERY BAUD. Texts have the longest lines of port/, the CSV
// its header every ten seconds. Returns: 0; 3 after a message.
static int judge_line(const tf_scene_t *scene, char **words, bool commands,
                      bool tagged) {
  uint32_t n[4] = {0};
  for (int i = 1; i < 4; i++) n[i] = (uint32_t)strtoul(words[i], NULL, 10);
  const bool csv = !strcmp(words[0], "csv");
  const tf_line_t line =
      !strcmp(words[0], "frames")
          ? tf_line_of_frames(n[1], n[3], scene->name, "twofold", commands,
                              tagged ? TF_TAG_BYTES : 0)
          : (tf_line_t){n[1], csv ? 121 : 114, csv ? 4 : 157, n[3] / 10};
  const unsigned long long asks = tf_line_asks(&line, n[2]),
                           records = (unsigned long long)line.record * n[1];
  if (asks <= line.carries) return 0;
  fprintf(stderr,
          "constants: FORMAT=%s%s sends %lu bytes with a record and %lu each "
          "second: %llu bytes/s at RATE=%s EVERY=%s, but BAUD=%s carries %lu",
          words[0], commands ? " UPLINK=yes" : "", (unsigned long)line.record,
          (unsigned long)line.beside, asks, words[1], words[2], words[3],
          (unsigned long)line.carries);
  const uint32_t left =
      line.carries > line.beside ? line.carries - line.beside : 0;
  if (left > 0)
    fprintf(stderr, "; EVERY=%llu would do", (records + left - 1) / left);
  fputc('\n', stderr);
  return 3;
}

// Writes what a firmware includes. Returns: 0; after a message 3, or 4.
static int write_key(const char *path) {
  uint8_t key[TF_KEY_BYTES];
  const char *wrong = cli_read_key(path, key);
  if (wrong != NULL) {
    fprintf(stderr, "constants: KEY=%s: %s\n", path, wrong);
    return 3;
  }
  for (unsigned i = 0; i < TF_KEY_BYTES; i++)
    printf("0x%02x,", (unsigned)key[i]);
  return putchar('\n') == EOF || fflush(stdout) ? 4 : 0;
}

int main(int argc, char **argv) {
  const tf_scene_t *scene = NULL;
  int i = 0;
  const bool number = argc == 3 && !strcmp(argv[1], "--number");
  const bool alone = argc == 3 && !strcmp(argv[1], "--scene");
  const bool line = argc >= 7 && argc <= 9 && !strcmp(argv[1], "--line");
  if (argc < 2 || (argc > 3 && !line)) {
    fprintf(stderr, "usage: constants [--scene|--number] SCENE [RATE]\n");
    return 2;
  }
  if (argc == 3 && !strcmp(argv[1], "--key")) return write_key(argv[2]);
  const int code =
      cli_take_scene(&scene, argv[number || alone || line ? 2 : 1]);
  if (code != 0) return code;
  if (line) return judge_line(scene, argv + 3, argc > 7, argc > 8);
  if (!number && !alone)
    return constants_of_firmware(stdout, scene, argc > 2 ? argv[2] : NULL);
  while (i < TF_SCENES && tf_scenes[i] != scene) i++;
  if (alone) {
    constants_of_scene(stdout, scene, &scene->params);
  } else if (i < TF_SCENES) {
    printf("%d\n", i);
  } else {
    fprintf(stderr, "constants: a file has no number: %s\n", argv[2]);
    return 2;
  }
  return ferror(stdout) || fflush(stdout) ? 4 : 0;
}
