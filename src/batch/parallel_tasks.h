// Independent pieces of work on several threads: traces, and the replays and tracks of a report.
// Trials of a campaign do not run by it, and no record depends on it.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>

namespace rockyard::batch {

// Calls task(0), task(1), ... task(count - 1), each once, on that many threads, which take them in
// ascending order: what callers put first is done where `stop` comes early. Once `stop` is true or
// a task has thrown, no further task starts; those in flight end. Returns how many have ended well;
// throws what the first task that failed threw.
std::size_t RunTasks(std::size_t count, int threads, const std::atomic<bool>& stop,
                     const std::function<void(std::size_t)>& task);

}  // namespace rockyard::batch
