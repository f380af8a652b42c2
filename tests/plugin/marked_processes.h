// The processes that a test starts, with all that they start: by a mark in their environment,
// looked for in /proc. What is left in the end is killed, so that a test that fails leaves none
// behind.
#pragma once

#include <dirent.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/test_folder.h"
#include "core/wait_until.h"

namespace rockyard::plugin {

// The numbers of all processes of the machine.
inline std::vector<pid_t> AllProcesses() {
  std::vector<pid_t> all;
  std::error_code error;
  for (std::filesystem::directory_iterator entry("/proc", error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename();
    if (name.find_first_not_of("0123456789") == std::string::npos) all.push_back(std::stoi(name));
  }
  return all;
}

// Children of this process that have ended and that nobody has waited for.
inline int Zombies() {
  const std::string own = "PPid:\t" + std::to_string(getpid()) + "\n";
  const auto all = AllProcesses();
  return static_cast<int>(std::ranges::count_if(all, [&](pid_t process) {
    const std::string status = core::ProcessFile(process, "status");
    return status.find(own) != std::string::npos && status.find("State:\tZ") != std::string::npos;
  }));
}

class MarkedProcesses : public testing::Test {
 protected:
  MarkedProcesses() {
    setenv("ROCKYARD_TEST_MARK", folder_.path().c_str(), 1);  // a name that is there once
  }
  ~MarkedProcesses() override {
    for (const pid_t process : Marked()) kill(process, SIGKILL);
    unsetenv("ROCKYARD_TEST_MARK");
  }

  // Those that live. This process is none of them: its mark was set later than it began.
  std::vector<pid_t> Marked() const {
    const std::string mark = "ROCKYARD_TEST_MARK=" + folder_.path().string() + '\0';
    std::vector<pid_t> marked;
    for (const pid_t process : AllProcesses()) {
      const bool has = core::ProcessFile(process, "environ").find(mark) != std::string::npos;
      if (has && core::Alive(process)) marked.push_back(process);
    }
    return marked;
  }

  // What is killed ends a little later. A process that nobody has killed is given 10 s, in which it
  // does not end by itself.
  void ExpectNoneIsLeft() const {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    while (!Marked().empty() && std::chrono::steady_clock::now() < end) usleep(2000);
    EXPECT_THAT(Marked(), testing::IsEmpty());
    EXPECT_EQ(Zombies(), 0);
  }

  // A file in the folder of the test.
  std::filesystem::path Write(const std::string& name, const std::string& text) const {
    const std::filesystem::path file = folder_.path() / name;
    std::ofstream(file) << text;
    return file;
  }
  const core::TestFolder& folder() const { return folder_; }

 private:
  core::TestFolder folder_;
};

}  // namespace rockyard::plugin
