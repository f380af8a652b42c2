// The images of the light stripe sensor by name.
#pragma once

#include <cstdint>

#include "rendering/image_readout.h"

namespace rockyard::sensing {

// Names an image of a trial.
struct StripeImageName {
  static constexpr std::int64_t kScans = std::int64_t{1} << 26;  // that have names of their own

  std::int64_t scan = 0;
  int camera = 0;
  int group = 0;
  bool lit = false;

  rendering::ImageNumber number() const {
    constexpr std::int64_t kGroups = 16;
    return static_cast<rendering::ImageNumber>(((scan * 2 + camera) * kGroups + group) * 2 +
                                               (lit ? 1 : 0));
  }
};

}  // namespace rockyard::sensing
