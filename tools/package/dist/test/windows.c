// Steps the FMU of -DFMI=2 or 3 under Windows and prints r every 10 ms:
// windows TOKEN REFERENCE. What FMI 3 has behind the arguments of FMI 2 is
// there unused.
#define __USE_MINGW_ANSI_STDIO 1
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#if FMI == 2
#define F(name) fmi2##name
#define REALS fmi2GetReal
void *fmi2Instantiate();
#define NEW(token) fmi2Instantiate("", 1, token, "", (void *[5]){0}, 0, 0)
#else
#define F(name) fmi3##name
#define REALS fmi3GetFloat64
void *fmi3InstantiateCoSimulation();
#define NEW(token)                                                        \
  fmi3InstantiateCoSimulation("", token, "", 0, 0, 0, 0, NULL, (size_t)0, \
                              NULL, NULL, NULL)
#endif
int F(EnterInitializationMode)(), F(ExitInitializationMode)(), F(DoStep)(),
    REALS();

int main(int n, char *word[]) {
  void *x = NEW(word[1]);
  double r = 0;
  F(EnterInitializationMode)(x, 0, 0., 0., 0, 0.);
  F(ExitInitializationMode)(x);
  for (int i = 0; i < 300; i++) {
    F(DoStep)(x, i * 0.01, 0.01, 1, &r, &r, &r, &r);
    REALS(x, &(uint32_t){(uint32_t)atoi(word[2])}, (size_t)1, &r, (size_t)1);
    printf("%a\n", r);
  }
  return n - 3;
}
