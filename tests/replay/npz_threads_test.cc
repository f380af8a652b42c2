// NumPy files that threads make at the same time.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

#include "replay/npz_file.h"

namespace rockyard::replay {
namespace {

// Two threads of a new process make its first archives, one `delay` turns of a loop after the
// other. True if both can.
bool FirstArchivesOfAProcess(const NpzFile& file, int delay) {
  const pid_t child = fork();
  if (child == 0) {
    std::atomic<int> waiting = 2;
    std::atomic<bool> good = true;
    const auto make = [&](int turns) {
      --waiting;
      while (waiting > 0) {
      }
      for (std::atomic<int> turn{0}; turn < turns; ++turn) {
      }
      try {
        (void)file.Bytes();
      } catch (const std::runtime_error&) {
        good = false;
      }
    };
    std::thread first(make, 0);
    make(delay);
    first.join();
    _exit(good ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

// libzip 1.7 refused an archive now and then; without the lock of npz_file.cc this test fails two
// times in three.
TEST(NpzFile, ThreadsMakeTheFirstArchivesTogether) {
  NpzFile file;
  file.AddReals("a", std::vector{1.0}, {1});
  int refused = 0;
  for (int process = 0; process < 1000; ++process) {
    if (!FirstArchivesOfAProcess(file, process % 30)) ++refused;
  }
  EXPECT_EQ(refused, 0);
}

}  // namespace
}  // namespace rockyard::replay
