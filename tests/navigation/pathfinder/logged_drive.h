// What drives of fake rovers share: a log of ticks, and stepping until something happens.
#pragma once

#include <functional>
#include <vector>

#include "navigation/navigator.h"

namespace rockyard::navigation {

// Ticks hold a `decision`.
template <typename Tick>
class LoggedDrive {
 public:
  virtual ~LoggedDrive() = default;

  virtual const Tick& Step() = 0;

  // Steps until a tick satisfies `stop` or the limit is reached; true when it did.
  bool StepUntil(const std::function<bool(const Tick&)>& stop, int max_ticks = 20000) {
    for (int i = 0; i < max_ticks; ++i) {
      if (stop(Step())) return true;
    }
    return false;
  }

  // Steps until the navigator arrives or gives up; kDriving when it does neither.
  NavigatorStatus Run(int max_ticks = 200000) {
    StepUntil([](const Tick& t) { return t.decision.status != NavigatorStatus::kDriving; },
              max_ticks);
    return log_.back().decision.status;
  }

  const std::vector<Tick>& log() const { return log_; }

 protected:
  std::vector<Tick> log_;
};

}  // namespace rockyard::navigation
