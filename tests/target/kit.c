// On the target: what port.h asks of a board, one function after the other, in
// lines that tests/target/port.py judges. Each part says at its beginning which
// it is, so that the last line names the one that does not come back. Ends with
// KIT_CODE.
#include <stdbool.h>
#include <stdint.h>

#include "../../port/port.h"
#include "../../port/text.h"
#include "../../src/num/kernel.h"

#ifndef RATE
#define RATE 1000
#endif
#define KIT_CODE 7
#define TICKS 16u       // that are timed
#define SPINS 5000000ul // readings of a count that stands: more than any tick
#define LINES 48u       // of the flood
#define HEARD 32u       // bytes, which port.h wants kept
#define CASES 200       // of each operation

#ifdef TF_REAL_FLOAT
typedef uint32_t bits_t;
#define FRACTION 23
#define BIAS 127
#else
typedef uint64_t bits_t;
#define FRACTION 52
#define BIAS 1023
#endif

typedef union {
  bits_t bits;
  tf_real_t real;
} number_t;

static volatile uint32_t initialised = 0x600DDA7Au;
static volatile uint32_t cleared;
static uint32_t random_state = 2463534242u;
static uint8_t room[96];
static text_t text;

static void begin(const char *part) {
  text.end = room;
  text_string(&text, part);
}

// Takes port_room at its word.
static void say(void) {
  text_string(&text, "\r\n");
  for (const uint8_t *from = room; from < text.end;)
    for (unsigned n = port_room(); n > 0 && from < text.end; n--)
      port_put(*from++);
}

static uint32_t next_random(void) {
  random_state ^= random_state << 13;
  random_state ^= random_state >> 17;
  random_state ^= random_state << 5;
  return random_state;
}

// A normal number between 2^-exponents and 2^exponents, of either sign.
static tf_real_t any_number(unsigned exponents) {
  const uint32_t high = next_random(), low = next_random();
  const unsigned exponent = BIAS - exponents + low % (2 * exponents);
  const bits_t fraction = ((bits_t)high << (FRACTION > 32 ? 20 : 0) ^ low) &
                          (((bits_t)1 << FRACTION) - 1);
  const number_t number = {(bits_t)(low >> 31) << (sizeof(bits_t) * 8 - 1) |
                           (bits_t)exponent << FRACTION | fraction};
  return number.real;
}

// A number next below a power of two, as the sum of that and a small one of the
// other sign. libgcc's addition of doubles for Arm without an FPU, and for
// Thumb-2, rounds some of these sums wrongly (docs/PORTS.md).
static tf_real_t sum_below_power(tf_real_t of) {
  number_t power = {0}, little = {0};
  power.real = of;
  power.bits = power.bits >> FRACTION << FRACTION; // no fraction
  little.real = of;
  little.bits =
      (little.bits ^ (bits_t)1 << (sizeof(bits_t) * 8 - 1)) -
      ((FRACTION / 2 + (bits_t)(next_random() % (FRACTION / 2))) << FRACTION);
  return power.real + little.real;
}

static tf_real_t operate(unsigned operation, tf_real_t a, tf_real_t b) {
  volatile tf_real_t product;
  switch (operation) {
    case 0:
      return a + b;
    case 1:
      return a - b;
    case 2:
      return a * b;
    case 3:
      return a / b;
    case 4:
      return square_root(magnitude(a));
    case 5: // twice rounded: a fused multiply-add leaves what the first dropped
      product = a * b;
      return a * b - product;
    case 6:
      return a * TF_REAL_MIN / 64; // subnormal
    case 7:
      return a < b ? a : b;
    case 8:
      return sum_below_power(a);
    default:
      return (tf_real_t)(int32_t)(a * 1024);
  }
}

// The operations by name, which port.py compares with those of this computer.
static void compute(void) {
  static const char name[][12] = {
      "addition", "subtraction", "product",    "quotient", "root",
      "rounding", "subnormal",   "comparison", "borrow",   "conversion"};
  for (unsigned i = 0; i < sizeof name / sizeof *name; i++) {
    uint64_t hash = 0xCBF29CE484222325u;
    random_state = 2463534242u;
    for (int n = 0; n < CASES; n++) {
      const volatile tf_real_t a = any_number(20), b = any_number(20);
      number_t result = {0};
      result.real = operate(i, a, b) + 0; // no -0
      hash = (hash ^ (uint32_t)result.bits) * 0x100000001B3u;
      hash = (hash ^ (uint32_t)((uint64_t)result.bits >> 32)) * 0x100000001B3u;
    }
    begin("bits ");
    text_string(&text, name[i]);
    text_byte(&text, ' ');
    text_hex(&text, hash);
    say();
  }
}

// Waits for the next tick. Returns: whether it came.
static bool tick_comes(void) {
  const uint32_t tick = port_ticks();
  for (uint32_t i = 0; i < SPINS; i++)
    if (port_ticks() != tick) return true;
  return false;
}

// How long each of some ticks lasts by the clock, and whether that goes back.
static bool time_ticks(void) {
  uint32_t back = 0, lasted[TICKS];
  if (!tick_comes()) return false;
  uint32_t last = port_clock(), begun = last;
  for (unsigned i = 0; i < TICKS; i++) {
    const uint32_t tick = port_ticks();
    while (port_ticks() == tick) {
      const uint32_t now = port_clock();
      if (now - last > UINT32_MAX / 2) back++;
      last = now;
    }
    last = port_clock();
    lasted[i] = last - begun;
    begun = last;
  }
  for (unsigned i = 0; i < TICKS; i++) {
    begin("tick ");
    text_whole(&text, lasted[i], 1);
    say();
  }
  begin("time rate:");
  text_whole(&text, port_clock_rate(), 1);
  text_pair(&text, " back:", back);
  say();
  return true;
}

// Waiting ends with the tick, and does not begin if that has come.
static void idle(void) {
  uint32_t missed = 0;
  for (unsigned i = 0; i < TICKS; i++) {
    const uint32_t tick = port_ticks();
    while (port_ticks() == tick) port_idle(tick);
    const uint32_t next = port_ticks();
    port_idle(next - 1);
    port_idle(next - 1);
    if (port_ticks() - next > 1) missed++;
  }
  begin("idle missed:");
  text_whole(&text, missed, 1);
  say();
}

// Bytes come while the program is busy for a second; then it reads them.
static void hear(void) {
  const uint32_t tick = port_ticks();
  uint32_t count = 0, wrong = 0;
  while (port_ticks() - tick < RATE) continue;
  for (int byte; count < 2 * HEARD && (byte = port_get()) >= 0; count++)
    if (byte != (int)('A' + count % HEARD)) wrong++;
  begin("heard count:");
  text_whole(&text, count, 1);
  text_pair(&text, " wrong:", wrong);
  say();
}

static void part(const char *name) {
  begin("part ");
  text_string(&text, name);
  say();
}

static void flood(void) {
  for (uint32_t i = 0; i < LINES; i++) {
    begin("flood ");
    text_whole(&text, i, 4);
    text_string(&text, " ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz");
    say();
  }
}

// Lets the line catch up.
static void rest(void) {
  for (unsigned i = 0; i < TICKS; i++) port_idle(port_ticks());
}

int main(void) {
  port_init();
  begin("memory initialised:");
  text_whole(&text, initialised == 0x600DDA7Au, 1);
  text_pair(&text, " cleared:", cleared == 0);
  say();
  part("arithmetic");
  compute();
  part("port_tick_start");
  const bool started = port_tick_start(RATE);
  begin("started ");
  text_whole(&text, started, 1);
  say();
  part("port_ticks, port_clock");
  if (started && time_ticks()) {
    part("port_idle");
    idle();
    part("port_get");
    rest();
    hear();
    part("port_put");
    flood();
  }
  part("port_halt");
  port_halt(KIT_CODE);
}
