// A flag of this process and of those that it forks.
#pragma once

#include <atomic>

namespace rockyard::app {

// Lies in memory that a fork shares, so that the supervisor of a campaign learns what its workers
// set, however they end. The constructor throws core::UserError where there is no memory.
class SharedFlag {
 public:
  SharedFlag();
  ~SharedFlag();
  SharedFlag(const SharedFlag&) = delete;
  SharedFlag& operator=(const SharedFlag&) = delete;

  void Set() { *set_ = true; }
  bool IsSet() const { return *set_; }

 private:
  std::atomic<bool>* set_;
};

}  // namespace rockyard::app
