// Numbers by chance for property tests of the rover.
#pragma once

#include <cstdint>

#include "core/random.h"

namespace rockyard::rover {

// Numbers for the test with one index, uniform on (-1, 1).
class Numbers {
 public:
  explicit Numbers(std::uint32_t index)
      : stream_({.seed = 11, .trial = index}, core::Purpose::kExperiment) {}
  double Next() { return 2.0 * stream_.Uniform() - 1.0; }

 private:
  core::RandomStream stream_;
};

}  // namespace rockyard::rover
