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

void cli_put_begin(const char *command) {
  cli_be_quiet(false);
  cli_say("{");
  cli_put_word("version", TF_VERSION);
  cli_put_word("commit", cli_commit);
  cli_put_word("number", CLI_NUMBER_TYPE);
  cli_put_word("command", command);
}

void cli_put_number(const char *key, double value, bool is_float) {
  char text[CLI_REAL_ROOM] = "null";
  if (isfinite(value)) (void)decimal_write(text, value, is_float);
  cli_say("\"%s\": %s", key, text);
}

void cli_put_real(const char *key, tf_real_t value) {
  cli_put_number(key, (double)value, sizeof value == sizeof(float));
  cli_say(", ");
}

void cli_put_double(const char *key, double value) {
  cli_put_number(key, value, false);
  cli_say(", ");
}

void cli_put_count(const char *key, uint64_t value) {
  cli_say("\"%s\": %" PRIu64 ", ", key, value);
}

void cli_put_hash(const char *key, uint32_t value) {
  cli_say("\"%s\": \"%08" PRIx32 "\", ", key, value);
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

void cli_put_word(const char *key, const char *text) {
  cli_say("\"%s\": \"", key);
  while (*text != '\0') {
    const unsigned char byte = (unsigned char)*text;
    const size_t length = utf8_length(text);
    if (length == 0)
      cli_say("\\ufffd");
    else if (byte == '"' || byte == '\\')
      cli_say("\\%c", byte);
    else if (byte < ' ' || byte == 0x7F)
      cli_say("\\u%04x", (unsigned)byte);
    else
      (void)fwrite(text, 1, length, stderr);
    text += length > 0 ? length : 1;
  }
  cli_say("\", ");
}

// The steps that were not TF_OK, in words and as an exit code. A step that fell
// back on another scheme keeps its promise, so it is reported and does not
// change the exit code.

uint64_t cli_tally_reserved(const tf_tally_t *tally) {
  return tally->degraded + tally->coarse + tally->stalled + tally->fell_back;
}

void cli_tally_put(const tf_tally_t *tally) {
  cli_put_count("degraded", tally->degraded);
  cli_put_count("coarse", tally->coarse);
  cli_put_count("stalled", tally->stalled);
  cli_put_count("fell_back", tally->fell_back);
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
