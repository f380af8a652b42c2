#include "batch/parallel_tasks.h"

#include <exception>
#include <mutex>

namespace rockyard::batch {

std::size_t RunTasks(std::size_t count, int threads, const std::atomic<bool>& stop,
                     const std::function<void(std::size_t)>& task) {
  std::atomic<std::size_t> next = 0;
  std::atomic<std::size_t> done = 0;
  std::atomic<bool> failed = false;
  std::exception_ptr error;
  std::mutex mutex;
#pragma omp parallel num_threads(threads)
  while (!stop && !failed) {
    const std::size_t index = next++;
    if (index >= count) break;
    // An exception must not leave a parallel region.
    try {
      task(index);
      ++done;
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!failed) error = std::current_exception();
      failed = true;
    }
  }
  if (error) std::rethrow_exception(error);
  return done;
}

}  // namespace rockyard::batch
