// Text from outside may hold any byte, and JSON is UTF-8: a byte that is none
// is replaced, as Unicode proposes.

#include "summary.h"

#include <stdarg.h>

#include "twofold.h"

void cli_say(const char *format, ...) {
  va_list arguments;
  if (cli_is_quiet()) return;
  va_start(arguments, format);
  (void)vfprintf(stderr, format, arguments);
  va_end(arguments);
}

// The length of the character that begins here; 0: it is not UTF-8.
static size_t utf8_length(const char *text) {
  static const uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
  const unsigned char lead = (unsigned char)*text;
  const size_t length = lead < 0x80                   ? 1
                        : lead >= 0xC0 && lead < 0xE0 ? 2
                        : lead >= 0xE0 && lead < 0xF0 ? 3
                        : lead >= 0xF0 && lead < 0xF8 ? 4
                                                      : 0;
  uint32_t code = length > 1 ? lead & (0xFFu >> (length + 1)) : lead;
  for (size_t i = 1; i < length; i++) {
    const unsigned char byte = (unsigned char)text[i]; // 0 at the end
    if ((byte & 0xC0u) != 0x80) return 0;
    code = code << 6 | (byte & 0x3Fu);
  }
  const bool surrogate = code >= 0xD800 && code < 0xE000;
  return code >= least[length] && code <= 0x10FFFF && !surrogate ? length : 0;
}

static void add_word(cli_buffer_t *text, const char *word) {
  cli_add(text, "\"");
  for (size_t length; *word != '\0'; word += length > 0 ? length : 1) {
    const unsigned char byte = (unsigned char)*word;
    char out[8] = "\\ufffd";
    length = utf8_length(word);
    if (byte == '"' || byte == '\\')
      (void)snprintf(out, sizeof out, "\\%c", byte);
    else if (length > 0 && (byte < ' ' || byte == 0x7F))
      (void)snprintf(out, sizeof out, "\\u%04x", (unsigned)byte);
    else if (length > 0)
      (void)snprintf(out, sizeof out, "%.*s", (int)length, word);
    cli_add(text, out);
  }
  cli_add(text, "\"");
}

static void add_json(cli_buffer_t *text, const char *form, va_list given) {
  for (; *form != '\0'; form++) {
    const char plain[] = {(char)(*form == '\'' ? '"' : *form), '\0'};
    const char *word = NULL, size = form[1];
    if (*form != '%') {
      cli_add(text, plain);
      continue;
    }
    form += 1 + strspn(form + 1, "lz");
    if (*form == 's' && (word = va_arg(given, const char *)) != NULL) {
      add_word(text, word);
    } else if (*form == 's') {
      cli_add(text, "null");
    } else if (*form == 'x') {
      cli_add_form(text, "\"%08x\"", va_arg(given, uint32_t));
    } else if (*form == 'u') {
      cli_add_count(text, size == 'l'   ? va_arg(given, uint64_t)
                          : size == 'z' ? va_arg(given, size_t)
                                        : va_arg(given, uint32_t));
    } else {
      const double value = va_arg(given, double);
      const bool is_float = *form == 'g' && sizeof(tf_real_t) == sizeof(float);
      if (isfinite(value))
        cli_add_number(text, value, is_float);
      else
        cli_add(text, "null");
    }
  }
}

void cli_add_json(cli_buffer_t *text, const char *form, ...) {
  va_list given;
  va_start(given, form);
  add_json(text, form, given);
  va_end(given);
}

void cli_put(const char *form, ...) {
  static char room[65536];
  cli_buffer_t text = {room, 0, sizeof room, false};
  va_list given;
  va_start(given, form);
  add_json(&text, form, given);
  va_end(given);
  cli_say("%s", room);
}

void cli_put_begin(const char *command) {
  cli_be_quiet(false);
  cli_put("{'version': %s, 'commit': %s, 'number': %s, 'command': %s, ",
          TF_VERSION, cli_commit, CLI_NUMBER_TYPE, command);
}

static bool ended;

void cli_put_exit(int code) {
  cli_say("\"exit\": %d}\n", code);
  (void)fflush(stderr);
  ended = true;
}

void cli_put_end(double done, double seconds, int code) {
  cli_say("\"seconds\": %.9g, \"per_second\": %.6g, ", seconds,
          seconds > 0 ? done / seconds : 0.0);
  cli_put_exit(code);
}

bool cli_put_ended(void) { return ended; }

// The steps that were not TF_OK, in words and as an exit code. A step that fell
// back on another scheme keeps its promise, so it is reported and does not
// change the exit code.

uint64_t cli_tally_reserved(const tf_tally_t *tally) {
  return tally->degraded + tally->coarse + tally->stalled + tally->fell_back;
}

void cli_tally_put(const tf_tally_t *tally) {
  cli_put("'degraded': %" PRIu64 ", 'coarse': %" PRIu64 ", 'stalled': %" PRIu64
          ", 'fell_back': %" PRIu64 ", ",
          tally->degraded, tally->coarse, tally->stalled, tally->fell_back);
}

void cli_tally_print(const tf_tally_t *tally, const char *since, double t) {
  const uint64_t reserved = cli_tally_reserved(tally);
  cli_say("degraded   %" PRIu64 " steps", tally->degraded);
  if (reserved > tally->degraded) {
    cli_say("; %" PRIu64 " coarse, %" PRIu64 " stalled, %" PRIu64
            " fell back on moreau",
            tally->coarse, tally->stalled, tally->fell_back);
  }
  if (reserved > 0 && !isnan(t)) cli_say(", %s at t = %g s", since, t);
  cli_say("\n");
}

int cli_tally_code(const tf_tally_t *tally) {
  return cli_tally_reserved(tally) > tally->fell_back ? CLI_FLAGGED : CLI_DONE;
}
