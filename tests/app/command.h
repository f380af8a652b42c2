// Runs the command and keeps what it says.
#pragma once

#include <fcntl.h>
#include <sys/wait.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

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

namespace fs = std::filesystem;
using core::Alive;
using core::Says;
using core::WaitForEnd;
using core::WaitUntil;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using Words = std::vector<std::string>;

// A test with a folder of its own, in which the command runs: in a process forked from this one,
// which spares the loading of libraries, many times what most commands take. The program itself is
// started by StartProgram.
class CommandTest : public testing::Test {
 protected:
  CommandTest() { fs::create_directories(folder_ / "work"); }

  // `out`: its standard output, kClosed for none, kKept for what Wait gives back.
  static constexpr int kKept = -1;
  static constexpr int kClosed = -2;
  pid_t Start(const Words& words, int out = kKept) const {
    return Fork(With({"rockyard"}, words), out, [](const std::vector<char*>& arguments) {
      return RunCommandLine(static_cast<int>(arguments.size()) - 1, arguments.data());
    });
  }

  pid_t StartProgram(const Words& words) const {
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

  CommandResult Run(const Words& words) const { return Wait(Start(words)); }

  // The same, where it ends with this exit code.
  CommandResult WaitTo(int exit_code, pid_t process) const {
    const CommandResult result = Wait(process);
    EXPECT_EQ(result.exit_code, exit_code) << result.out << result.err;
    return result;
  }
  CommandResult RunTo(int exit_code, const Words& words) const {
    SCOPED_TRACE(testing::PrintToString(words));
    return WaitTo(exit_code, Start(words));
  }

  CommandResult RunInto(int out, const Words& words) const { return Wait(Start(words, out)); }
  CommandResult RunProgram(const Words& words) const {
    return Wait(StartProgram(With({ROCKYARD_COMMAND}, words)));
  }

  json Summary(const std::string& run) const {
    return json::parse(ReadFile(work() / run / "summary.json"));
  }
  std::string Hash(const std::string& run) const { return Summary(run)["trial_hash"]; }

  fs::path work() const { return folder_ / "work"; }
  bool NothingWritten() const { return fs::is_empty(work()); }

  // A file of the source tree.
  static std::string Source(const std::string& path) {
    return std::string(ROCKYARD_SOURCE_DIR) + "/" + path;
  }
  static std::string Scenario(const std::string& name) {
    return Source("scenarios/pathfinder/" + name + ".json");
  }

  // Trials that end after a second of simulated time: the command is under test, not the rover.
  static Words QuickRun(const std::string& out, int trials) {
    return {"run",   Scenario("nominal"),      "--out",    out,
            "--set", "referee.time_limit_s=1", "--trials", std::to_string(trials)};
  }

  static Words With(Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

 private:
  // `run` gets the words and a null pointer behind them.
  template <typename Function>
  pid_t Fork(Words words, int out, const Function& run) const {
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

  static void Redirect(const fs::path& path, int descriptor) {
    const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(file, descriptor);
  }

  core::TestFolder own_;
  const fs::path& folder_ = own_.path();
};

}  // namespace rockyard::app
