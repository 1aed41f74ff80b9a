/* The arithmetic that the core tries: what a thread can set is found, by its
 * name. What a compiler does to it is for `make check CHECKS=contraction`. */
#include <fenv.h>

#include "tap.h"
#include "twofold.h"

TEST(usual_arithmetic_holds) { CHECK(tf_arithmetic() == TF_ARITHMETIC_OK); }

TEST(other_rounding_modes_are_found) {
  const int modes[] = {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
  for (size_t i = 0; i < sizeof modes / sizeof modes[0]; i++) {
    CHECK(fesetround(modes[i]) == 0);
    const tf_arithmetic_t found = tf_arithmetic();
    CHECK(fesetround(FE_TONEAREST) == 0);
    CHECK(found == TF_ARITHMETIC_ROUNDING);
  }
  CHECK(tf_arithmetic() == TF_ARITHMETIC_OK);
}

/* FTZ, DAZ, both. */
TEST(flushed_subnormals_are_found) {
#ifdef __SSE__
  const unsigned flush[] = {0x8000, 0x0040, 0x8040};
  const unsigned usual = __builtin_ia32_stmxcsr();
  for (size_t i = 0; i < sizeof flush / sizeof flush[0]; i++) {
    __builtin_ia32_ldmxcsr(usual | flush[i]);
    const tf_arithmetic_t found = tf_arithmetic();
    __builtin_ia32_ldmxcsr(usual);
    CHECK(found == TF_ARITHMETIC_SUBNORMAL);
  }
#else
  SKIP("only x86 is known here");
#endif
}

TEST(faults_of_arithmetic_have_names) {
  static const char *const words[TF_ARITHMETICS] = {"ok",
                                                    "fesetround(FE_TONEAREST)",
                                                    "FTZ and DAZ",
                                                    "-ffp-contract=fast",
                                                    "-fassociative-math",
                                                    "-freciprocal-math",
                                                    "sqrt",
                                                    "-fno-signed-zeros"};
  for (int i = 0; i < TF_ARITHMETICS; i++)
    CHECK(strstr(tf_arithmetic_name((tf_arithmetic_t)i), words[i]));
  CHECK(strstr(tf_arithmetic_name(TF_ARITHMETICS), "unknown"));
}
