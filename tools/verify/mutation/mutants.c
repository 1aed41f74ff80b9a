// Small wrong changes of C source files, for tests to notice.
//
//   mutants list SEED FILE...   every change, one a line, in fields of blanks:
//                               order file number line column, then the text
//   mutants make FILE NUMBER    the file with that change, on standard output
//
// The text is the line of the source with the change in braces, as in
// `if (a {< -> <=} b)`. The order is a hash of file, text and seed: a sample
// of the first few stays the same when other lines change.
//
// Changed are comparisons, arithmetic and logical operators, signs, literals,
// truth values and strings, where the layout of clang-format shows which
// operator is binary (blanks around it), unary or a pointer. Comments,
// characters, directives, case labels, assertions and sizes of arrays are left.
#include <ctype.h>
#include <inttypes.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LARGEST = 1 << 20, WORD = 64, TEXT = 512 };

static char source[LARGEST];
static size_t length;

typedef struct {
  size_t at, old;
  char text[WORD]; // instead of `old` characters at `at`
} mutant_t;

typedef struct {
  const char *file;
  uint64_t seed;
  int number; // of the change that is visited
  int wanted;
} job_t;

typedef void visit_t(const mutant_t *mutant, job_t *job);

// Operators that stand between blanks, and what each may become.
static const char *const binary[][3] = {
    {"<=", "<", ">"},   {">=", ">", "<"},   {"==", "!=", NULL},
    {"!=", "==", NULL}, {"&&", "||", NULL}, {"||", "&&", NULL},
    {"+=", "-=", NULL}, {"-=", "+=", NULL}, {"*=", "/=", NULL},
    {"/=", "*=", NULL}, {"|=", "&=", NULL}, {"&=", "|=", NULL},
    {"<<", ">>", NULL}, {">>", "<<", NULL}, {"<", "<=", ">="},
    {">", ">=", "<="},  {"+", "-", NULL},   {"-", "+", NULL},
    {"*", "/", NULL},   {"/", "*", NULL},   {"|", "&", NULL},
    {"&", "|", NULL},   {"^", "|", NULL},   {"%", "*", NULL},
};
static const char *const words[][2] = {{"true", "false"}, {"false", "true"}};

static bool is_word(char c) { return isalnum((unsigned char)c) || c == '_'; }
static bool is_blank(char c) { return c == ' ' || c == '\n'; }
static bool begins(size_t at, const char *text) {
  return strncmp(source + at, text, strlen(text)) == 0;
}

static void tell(size_t at, size_t old, const char *text, visit_t *visit,
                 job_t *job) {
  mutant_t mutant = {.at = at, .old = old};
  snprintf(mutant.text, sizeof mutant.text, "%s", text);
  job->number++;
  visit(&mutant, job);
}

// Past a comment, a string or a character that begins here; `at` where none
// does.
static size_t past_text(size_t at) {
  if (begins(at, "//")) return at + strcspn(source + at, "\n");
  if (begins(at, "/*")) {
    const char *end = strstr(source + at, "*/");
    return end == NULL ? length : (size_t)(end - source) + 2;
  }
  const char quote = source[at];
  if (quote != '"' && quote != '\'') return at;
  for (at++; at < length && source[at] != quote; at++)
    if (source[at] == '\\') at++;
  return at + 1;
}

// Lines in which nothing is changed: directives but the value of a macro,
// labels, and what only declares.
static bool is_left(size_t at) {
  at += strspn(source + at, " ");
  if (source[at] == '#') return !begins(at, "#define ");
  return begins(at, "case ") || begins(at, "_Static_assert");
}

// A whole literal becomes the next one, another twice as large; 0.0 becomes 1.
static size_t literal(size_t at, visit_t *visit, job_t *job) {
  const bool hex = begins(at, "0x");
  size_t end = at;
  while (is_word(source[end]) || source[end] == '.' ||
         ((source[end] == '-' || source[end] == '+') &&
          strchr(hex ? "pP" : "eE", source[end - 1]) != NULL))
    end++;
  char text[WORD], number[WORD];
  if (end - at >= sizeof number) return end;
  memcpy(number, source + at, end - at);
  number[end - at] = '\0';
  char *rest;
  if (strpbrk(number, hex ? ".pP" : ".eE") == NULL) {
    const unsigned long long value = strtoull(number, &rest, 0);
    snprintf(text, sizeof text, "%llu%s", value + 1, rest);
  } else {
    const double value = strtod(number, &rest);
    char digits[WORD / 2];
    snprintf(digits, sizeof digits, "%.17g", value > 0 ? 2 * value : 1);
    snprintf(text, sizeof text, "%s%s%s", digits,
             strpbrk(digits, ".e") == NULL ? ".0" : "", rest);
  }
  tell(at, end - at, text, visit, job);
  return end;
}

// The operator or sign that begins here; returns how long it is.
static size_t operator_at(size_t at, visit_t *visit, job_t *job) {
  const bool after_blank = at > 0 && is_blank(source[at - 1]);
  for (size_t i = 0; i < sizeof binary / sizeof *binary; i++) {
    const size_t size = strlen(binary[i][0]);
    if (!after_blank || !begins(at, binary[i][0]) ||
        !is_blank(source[at + size]))
      continue;
    for (int k = 1; k < 3 && binary[i][k] != NULL; k++)
      tell(at, size, binary[i][k], visit, job);
    return size;
  }
  const bool first =
      after_blank || (at > 0 && strchr("([-!", source[at - 1]) != NULL);
  if (first && (source[at] == '-' || source[at] == '!' || source[at] == '~') &&
      (is_word(source[at + 1]) || source[at + 1] == '('))
    tell(at, 1, "", visit, job);
  if (begins(at, "++")) tell(at, 2, "--", visit, job);
  if (begins(at, "--")) tell(at, 2, "++", visit, job);
  return begins(at, "++") || begins(at, "--") || begins(at, "->") ? 2 : 1;
}

// A name, or a word that has an opposite.
static size_t word(size_t at, visit_t *visit, job_t *job) {
  size_t end = at;
  while (is_word(source[end])) end++;
  for (size_t i = 0; i < sizeof words / sizeof *words; i++)
    if (end - at == strlen(words[i][0]) && begins(at, words[i][0]))
      tell(at, end - at, words[i][1], visit, job);
  return end;
}

// How long the size of an array is that is declared here: the name before it
// follows a type. 0 where none is.
static size_t array_size(size_t at) {
  if (source[at] != '[' || !isdigit((unsigned char)source[at + 1])) return 0;
  size_t name = at;
  while (name > 0 && is_word(source[name - 1])) name--;
  if (name < 8 || name == at || source[name - 1] != ' ' ||
      !is_word(source[name - 2]) || begins(name - 7, "return"))
    return 0;
  return 1 + strcspn(source + at + 1, "]\n") + 1;
}

static void each(visit_t *visit, job_t *job) {
  size_t at = 0;
  bool fresh = true; // at the begin of a line
  while (at < length) {
    if (fresh && is_left(at)) at += strcspn(source + at, "\n");
    // The name that a macro gives is not its value.
    if (fresh && begins(at, "#define ")) {
      at += 8;
      while (is_word(source[at])) at++;
    }
    fresh = source[at] == '\n';
    const size_t past = past_text(at);
    if (source[at] == '"' && past > at + 2)
      tell(at, past - at, "\"\"", visit, job);
    if (past != at)
      at = past;
    else if (isdigit((unsigned char)source[at]))
      at = literal(at, visit, job);
    else if (is_word(source[at]))
      at = word(at, visit, job);
    else if (array_size(at) > 0)
      at += array_size(at);
    else
      at += operator_at(at, visit, job);
  }
}

// FNV-1a, and a last mixing for its high bits.
static uint64_t hash(uint64_t h, const char *text) {
  for (; *text != '\0'; text++) h = (h ^ (uint8_t)*text) * 0x100000001b3u;
  h = (h ^ (h >> 32)) * 0x9e3779b97f4a7c15u;
  return h ^ (h >> 29);
}

static void list(const mutant_t *mutant, job_t *job) {
  size_t begin = mutant->at, line = 1;
  while (begin > 0 && source[begin - 1] != '\n') begin--;
  for (size_t i = 0; i < begin; i++) line += source[i] == '\n';
  const char *const old = source + mutant->at, *const rest = old + mutant->old;
  const size_t blanks = strspn(source + begin, " ");
  char text[TEXT];
  snprintf(text, sizeof text, "%.*s{%.*s -> %s}%.*s",
           (int)(mutant->at - begin - blanks), source + begin + blanks,
           (int)mutant->old, old, mutant->text, (int)strcspn(rest, "\n"), rest);
  const uint64_t order =
      hash(hash(0xcbf29ce484222325u ^ job->seed, job->file), text);
  printf("%016" PRIx64 " %s %d %zu %zu %s\n", order, job->file, job->number,
         line, mutant->at - begin + 1, text);
}

static void make(const mutant_t *mutant, job_t *job) {
  if (job->number != job->wanted) return;
  const size_t rest = mutant->at + mutant->old;
  fwrite(source, 1, mutant->at, stdout);
  fputs(mutant->text, stdout);
  fwrite(source + rest, 1, length - rest, stdout);
}

static bool load(const char *path) {
  FILE *file = fopen(path, "r");
  if (file == NULL) {
    perror(path);
    return false;
  }
  length = fread(source, 1, sizeof source - 1, file);
  fclose(file);
  source[length] = '\0';
  return true;
}

int main(int argc, char **argv) {
  if (argc == 4 && strcmp(argv[1], "make") == 0) {
    job_t job = {.file = argv[2], .wanted = atoi(argv[3])};
    if (!load(job.file)) return 1;
    each(make, &job);
    if (job.wanted >= 1 && job.wanted <= job.number) return 0;
    fprintf(stderr, "mutants: %s has no change %s\n", argv[2], argv[3]);
    return 1;
  }
  if (argc < 4 || strcmp(argv[1], "list") != 0) {
    fputs("usage: mutants list SEED FILE... | make FILE NUMBER\n", stderr);
    return 2;
  }
  for (int i = 3; i < argc; i++) {
    job_t job = {.file = argv[i], .seed = strtoull(argv[2], NULL, 0)};
    if (!load(job.file)) return 1;
    each(list, &job);
  }
  return 0;
}
