// How often the rover believed in a hazard.
#pragma once

#include <cstdint>

namespace rockyard::trial {

// A rover that turns away from a hazard scans it again and again. A hazard begins where one is
// believed and the scan before saw none, which is once for each time that the rover avoids.
class HazardCounter {
 public:
  // Once a look; `believed`: its report names a hazard.
  void Observe(bool believed) {
    if (believed) {
      ++believed_;
      if (!avoiding_) ++begun_;
    }
    avoiding_ = believed;
  }

  std::int64_t believed() const { return believed_; }
  std::int64_t begun() const { return begun_; }

 private:
  bool avoiding_ = false;
  std::int64_t believed_ = 0;
  std::int64_t begun_ = 0;
};

}  // namespace rockyard::trial
