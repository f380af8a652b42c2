#include "plugin/guarded_call.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <string_view>

#include "core/error.h"

namespace rockyard::plugin {
namespace {

constexpr rlim_t kMostCpu_s = 20;
constexpr std::chrono::seconds kLongest{60};
constexpr std::size_t kMostBytes = std::size_t{16} << 20;
// The first byte of what the child writes.
constexpr char kAnswer = 'a';
constexpr char kFailure = 'f';

void WriteAll(int fd, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = write(fd, text.data(), text.size());
    if (written < 0 && errno != EINTR) return;
    if (written > 0) text.remove_prefix(static_cast<std::size_t>(written));
  }
}

[[noreturn]] void BeChild(int to_parent, const std::function<std::string()>& work) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const rlimit cpu{kMostCpu_s, kMostCpu_s};
  setrlimit(RLIMIT_CPU, &cpu);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  dup2(STDERR_FILENO, STDOUT_FILENO);
  std::string told;
  try {
    told = kAnswer + work();
  } catch (const std::exception& error) {
    told = kFailure + std::string(error.what());
  } catch (...) {
    told = kFailure + std::string("it threw something that is no std::exception");
  }
  WriteAll(to_parent, told);
  _exit(0);
}

// A child that is waited for whatever happens.
class Child {
 public:
  Child(pid_t pid, int from) : pid_(pid), from_(from) {}
  ~Child() {
    close(from_);
    if (pid_ <= 0) return;
    kill(pid_, SIGKILL);
    Wait();
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  // Reads up to the end of the stream. Returns nothing where it takes too long or is too much.
  bool Read(std::string& text) const {
    const auto deadline = std::chrono::steady_clock::now() + kLongest;
    std::array<char, 65536> buffer{};
    for (;;) {
      pollfd ready{from_, POLLIN, 0};
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
          deadline - std::chrono::steady_clock::now());
      if (left.count() <= 0 || text.size() > kMostBytes) return false;
      if (poll(&ready, 1, static_cast<int>(left.count())) <= 0) continue;
      const ssize_t count = read(from_, buffer.data(), buffer.size());
      if (count == 0) return true;
      if (count < 0 && errno != EINTR) return true;
      if (count > 0) text.append(buffer.data(), static_cast<std::size_t>(count));
    }
  }

  int Wait() {
    int status = 0;
    while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
    pid_ = 0;
    return status;
  }

 private:
  pid_t pid_;
  int from_;
};

}  // namespace

std::string InChild(const std::string& source, const std::function<std::string()>& work) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw core::MachineError(source, std::strerror(errno), core::kMoreOpenFiles);
  }
  std::fflush(nullptr);  // or the child would write it a second time
  const pid_t pid = fork();
  if (pid < 0) {
    const int error = errno;
    close(ends[0]);
    close(ends[1]);
    throw core::MachineError(source, std::strerror(error), "end other programs, then run it again");
  }
  if (pid == 0) {
    close(ends[0]);
    BeChild(ends[1], work);
  }
  close(ends[1]);
  Child child(pid, ends[0]);
  std::string text;
  if (!child.Read(text)) {
    throw core::UserError(source, "gave no answer when it was asked what it is",
                          "it may hang as it is loaded: try it in a program of its own");
  }
  const int status = child.Wait();
  if (!text.empty() && text.front() == kAnswer) return text.substr(1);
  if (!text.empty()) {
    throw core::UserError(source, "failed when it was asked what it is: " + text.substr(1),
                          "mend it, or build it anew");
  }
  const std::string how =
      WIFSIGNALED(status) ? fmt::format("crashed (SIG{})", sigabbrev_np(WTERMSIG(status)))
                          : fmt::format("ended the process (exit code {})", WEXITSTATUS(status));
  throw core::UserError(source, how + " when it was loaded and asked what it is",
                        "mend it, or build it anew");
}

}  // namespace rockyard::plugin
