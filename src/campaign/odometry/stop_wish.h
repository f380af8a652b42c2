// Somebody's wish for an early end of work that is done here.
#pragma once

#include <atomic>
#include <memory>

#include "campaign/stop.h"

namespace rockyard::campaign {

// Listens while it lives. A second wish ends the process.
class StopWish {
 public:
  explicit StopWish(const Stop& stop) : stop_(stop), watch_(stop.Watch(flag_, SecondWish::kEnds)) {}
  StopWish(const StopWish&) = delete;
  StopWish& operator=(const StopWish&) = delete;

  bool IsThere() const { return flag_ || stop_.IsWanted(); }

 private:
  const Stop& stop_;
  std::atomic<bool> flag_ = false;
  std::shared_ptr<void> watch_;
};

}  // namespace rockyard::campaign
