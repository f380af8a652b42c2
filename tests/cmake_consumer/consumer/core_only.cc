// Links one module only.
#include <cstdio>

#include "core/random.h"

int main() {
  rockyard::core::RandomStream stream({.seed = 1, .trial = 0}, rockyard::core::Purpose::kTest);
  std::printf("%.17g\n", stream.Uniform());
}
