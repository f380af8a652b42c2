// Runs the command and keeps what it says.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/command_line.h"
#include "core/says.h"
#include "core/test_folder.h"
#include "core/wait_until.h"

namespace rockyard::app {

struct CommandResult {
  int exit_code = -1;  // negative: the signal that ended it
  std::string out;
  std::string err;
};

inline std::string ReadFile(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline void WriteFile(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

using core::Alive;
using core::Says;
using core::WaitForEnd;
using core::WaitUntil;

// A test with a folder of its own, in which the command runs: in a process forked from this one,
// which spares the loading of libraries, many times what most commands take. The program itself is
// started by StartProgram.
class CommandTest : public testing::Test {
 protected:
  CommandTest() { std::filesystem::create_directories(folder_ / "work"); }

  // `out`: its standard output, kClosed for none, kKept for what Wait gives back.
  static constexpr int kKept = -1;
  static constexpr int kClosed = -2;
  pid_t Start(const std::vector<std::string>& words, int out = kKept) const {
    return Fork(With({"rockyard"}, words), out, [](const std::vector<char*>& arguments) {
      return RunCommandLine(static_cast<int>(arguments.size()) - 1, arguments.data());
    });
  }

  pid_t StartProgram(const std::vector<std::string>& words) const {
    return Fork(words, kKept, [](const std::vector<char*>& arguments) {
      execv(arguments[0], arguments.data());
      return 127;
    });
  }

  CommandResult Wait(pid_t process) const {
    int status = 0;
    waitpid(process, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), ReadFile(folder_ / "out"),
            ReadFile(folder_ / "err")};
  }

  CommandResult Run(const std::vector<std::string>& words) const { return Wait(Start(words)); }

  // The same, where it ends with this exit code.
  CommandResult WaitTo(int exit_code, pid_t process) const {
    const CommandResult result = Wait(process);
    EXPECT_EQ(result.exit_code, exit_code) << result.out << result.err;
    return result;
  }
  CommandResult RunTo(int exit_code, const std::vector<std::string>& words) const {
    SCOPED_TRACE(testing::PrintToString(words));
    return WaitTo(exit_code, Start(words));
  }

  CommandResult RunInto(int out, const std::vector<std::string>& words) const {
    return Wait(Start(words, out));
  }
  CommandResult RunProgram(const std::vector<std::string>& words) const {
    return Wait(StartProgram(With({ROCKYARD_COMMAND}, words)));
  }

  nlohmann::json Summary(const std::string& run) const {
    return nlohmann::json::parse(ReadFile(work() / run / "summary.json"));
  }
  std::string Hash(const std::string& run) const { return Summary(run)["trial_hash"]; }

  std::filesystem::path work() const { return folder_ / "work"; }
  bool NothingWritten() const { return std::filesystem::is_empty(work()); }

  static std::string Scenario(const std::string& name) {
    return std::string(ROCKYARD_SOURCE_DIR) + "/scenarios/pathfinder/" + name + ".json";
  }

  // Trials that end after a second of simulated time: the command is under test, not the rover.
  static std::vector<std::string> QuickRun(const std::string& out, int trials) {
    return {"run",   Scenario("nominal"),      "--out",    out,
            "--set", "referee.time_limit_s=1", "--trials", std::to_string(trials)};
  }

  static std::vector<std::string> With(std::vector<std::string> words,
                                       const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

 private:
  // `run` gets the words and a null pointer behind them.
  template <typename Function>
  pid_t Fork(std::vector<std::string> words, int out, const Function& run) const {
    std::fflush(nullptr);  // or both processes would write what waits
    const pid_t process = fork();
    if (process != 0) return process;
    Redirect(folder_ / "out", STDOUT_FILENO);
    Redirect(folder_ / "err", STDERR_FILENO);
    if (out >= 0) dup2(out, STDOUT_FILENO);
    if (out == kClosed) close(STDOUT_FILENO);
    if (chdir(work().c_str()) != 0) _exit(126);
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    std::exit(run(arguments));
  }

  static void Redirect(const std::filesystem::path& path, int descriptor) {
    const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(file, descriptor);
  }

  core::TestFolder own_;
  const std::filesystem::path& folder_ = own_.path();
};

}  // namespace rockyard::app
