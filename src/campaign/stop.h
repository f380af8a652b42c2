// How a caller asks for an early end of work that takes long. The command line turns signals into
// it; campaigns, reports and sequences of images heed it.
#pragma once

#include <atomic>
#include <functional>
#include <memory>

namespace rockyard::campaign {

// What the second wish to stop does.
enum class SecondWish {
  kEnds,      // the process at once, which loses no stored trial
  kIsTheSame  // nothing more: somebody else (a supervisor, mpirun) decides when patience ends
};

// A wish for an early end: what is in flight ends and is stored; nothing more begins.
struct Stop {
  // Asked before the first and after every trial (or pair), by several threads at once; true: stop.
  // For a supervised campaign it is called in the worker process, which has a copy of the caller's
  // memory.
  std::function<bool()> wanted = {};
  // For a program that turns signals into wishes: called where work begins, in the process that
  // does it. From then on a wish must set `flag`. What is returned is released when the work ends.
  std::function<std::shared_ptr<void>(std::atomic<bool>& flag, SecondWish second)> watch = {};

  bool IsWanted() const { return wanted && wanted(); }
  std::shared_ptr<void> Watch(std::atomic<bool>& flag, SecondWish second) const {
    return watch ? watch(flag, second) : nullptr;
  }
};

// A wish that is listened for as long as the object lives. A second wish ends the process.
class StopWish {
 public:
  explicit StopWish(const Stop& stop) : stop_(stop), watch_(stop.Watch(flag_, SecondWish::kEnds)) {}
  StopWish(const StopWish&) = delete;
  StopWish& operator=(const StopWish&) = delete;

  bool IsThere() const { return flag_ || stop_.IsWanted(); }

 private:
  const Stop& stop_;
  std::atomic<bool> flag_ = false;
  std::shared_ptr<void> watch_;  // last: released before flag_ goes, which it sets
};

}  // namespace rockyard::campaign
