// Steps the FMU of -DFMI=2 or 3 under Windows and prints the bits of variables:
// windows TOKEN STEPS LENGTH REFERENCE... What FMI 3 hands over behind the
// arguments of FMI 2 is there unused.
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#if FMI == 2
#define F(name) fmi2##name
#define REALS fmi2GetReal
#define NEW(token) fmi2Instantiate("w", 1, token, "", callbacks, 0, 0)
static void *callbacks[5];
#else
#define F(name) fmi3##name
#define REALS fmi3GetFloat64
#define NEW(token)                                                           \
  fmi3InstantiateCoSimulation("w", token, NULL, 0, 0, 0, 0, NULL, (size_t)0, \
                              NULL, NULL, NULL)
#endif
void *fmi2Instantiate(), *fmi3InstantiateCoSimulation();
int F(EnterInitializationMode)(), F(ExitInitializationMode)(), F(DoStep)();
int REALS();

int main(int n, char *word[]) {
  uint64_t bits = 0;
  void *x = NEW(word[1]);
  int wrong = F(EnterInitializationMode)(x, 0, 0., 0., 0, 0.) |
              F(ExitInitializationMode)(x);
  for (int i = 0; i <= atoi(word[2]); i++) {
    if (i > 0)
      wrong |= F(DoStep)(x, (i - 1) * atof(word[3]), atof(word[3]), 1, &bits,
                         &bits, &bits, &bits);
    for (int k = 4; k < n; k++) {
      uint32_t reference = (uint32_t)atoi(word[k]);
      wrong |= REALS(x, &reference, (size_t)1, &bits, (size_t)1);
      printf("%llx%c", (unsigned long long)bits, k + 1 < n ? ' ' : '\n');
    }
  }
  return wrong;
}
