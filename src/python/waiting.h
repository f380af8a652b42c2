// Work that takes long, asked for by Python: it runs on a thread of its own while the caller's
// thread listens to signals and tells of progress, without the interpreter's lock in between.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <cstdint>
#include <functional>

namespace rockyard::python {

// What work and the thread that waits for it tell each other; in memory that a supervised worker,
// which is a fork, shares.
class Contact {
 public:
  // Throws core::MachineError where there is no memory.
  Contact();
  ~Contact();
  Contact(const Contact&) = delete;
  Contact& operator=(const Contact&) = delete;

  // Called by the work, in whatever process.
  bool stop_wanted() const { return shared_->stop; }
  void Stop() const { shared_->stop = true; }
  void SetProgress(std::int64_t finished, std::int64_t planned) const {
    shared_->finished = finished;
    shared_->planned = planned;
  }

 private:
  friend void Await(std::function<void(const Contact&)> work, const pybind11::object& progress);
  struct Shared {
    std::atomic<bool> stop = false;
    std::atomic<std::int64_t> finished = 0;
    std::atomic<std::int64_t> planned = 0;
  };
  Shared* shared_;
};

// As long as one lives, forks of this thread hold the interpreter's lock, and the new process may
// call Python: else another thread, which that process lacks, could have had the lock.
class ForksWithPython {
 public:
  ForksWithPython();
  ~ForksWithPython();
  ForksWithPython(const ForksWithPython&) = delete;
  ForksWithPython& operator=(const ForksWithPython&) = delete;
};

// Asks all work under way to end early and waits until it has: an interpreter that ends takes no
// thread back that waits in Await. Called as the program ends.
void EndWork();

// Calls `work` on a thread of its own and waits for it. `progress(finished, planned)` is called by
// the waiting thread; None: nobody. An exception that Python raises meanwhile (KeyboardInterrupt by
// Ctrl-C, `progress`) asks the work to end early, and is raised once it has: what was finished is
// stored then. What the work throws is thrown. The thread is new for each work, as OpenMP's threads
// belong to the thread that has started them, and a fork has none of both.
//
// The work must own all that it uses. A supervised worker is a fork of the work's thread, and the C
// library gives the stacks of threads that a fork lacks, the caller's among them, to its new ones.
void Await(std::function<void(const Contact&)> work, const pybind11::object& progress);

}  // namespace rockyard::python
