// Runs the fake experiment as a process of its own, to be killed or starved of disk space.
//
// batch_child FOLDER TRIALS THREADS MILLISECONDS HANG_AT FILE_LIMIT
//   MILLISECONDS  each trial takes
//   HANG_AT       trial that never ends; -1: none
//   FILE_LIMIT    largest size of any file in bytes; 0: none
// Exit code 0: done; 3: StoreError, described on standard output.
#include <sys/resource.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "batch/executor.h"
#include "batch/run_folder.h"
#include "batch/sqlite_database.h"
#include "fake_experiment.h"

namespace {

using namespace rockyard::batch;

ResultStore OpenStore(const std::filesystem::path& folder, std::int64_t trials) {
  return HoldsStore(folder) ? ResultStore::Resume(folder, FakeIdentity())
                            : ResultStore::Create(folder, FakeIdentity(), trials);
}

void LimitFiles(long bytes) {
  if (bytes == 0) return;
  std::signal(SIGXFSZ, SIG_IGN);
  const rlimit limit{static_cast<rlim_t>(bytes), static_cast<rlim_t>(bytes)};
  setrlimit(RLIMIT_FSIZE, &limit);
}

int RunChild(const std::vector<const char*>& arguments) {
  const std::filesystem::path folder = arguments.at(1);
  const long milliseconds = std::atol(arguments.at(4));
  const long hang_at = std::atol(arguments.at(5));
  const FolderClaim claim(folder);
  BatchOptions options;
  options.threads = std::atoi(arguments.at(3));
  options.interval = std::chrono::milliseconds(20);
  ResultStore store = OpenStore(folder, std::atol(arguments.at(2)));
  LimitFiles(std::atol(arguments.at(6)));
  const FakeExperiment experiment([&](std::uint64_t index) {
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
    if (static_cast<long>(index) == hang_at) std::this_thread::sleep_for(std::chrono::hours(1));
  });
  const std::atomic<bool> never_stop = false;
  RunBatch(experiment, store, options, never_stop);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return RunChild(std::vector<const char*>(argv, argv + argc));
  } catch (const StoreError& error) {
    std::printf("%d %s\n", static_cast<int>(error.problem()), error.what());
    return 3;
  }
}
