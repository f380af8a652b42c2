// Independent pieces of work on several threads.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>

namespace rockyard::batch {

// Calls task(0), task(1), ... task(count - 1), each once, on that many threads, which take them in
// ascending order. Once `stop` is true or a task has thrown no further one starts; those in flight
// end: what callers put first is done where `stop` comes early. Returns how many have ended well;
// throws what the first task threw.
std::size_t RunTasks(std::size_t count, int threads, const std::atomic<bool>& stop,
                     const std::function<void(std::size_t)>& task);

}  // namespace rockyard::batch
