#include "batch/child_process.h"

#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <optional>

#include "core/error.h"

namespace rockyard::batch {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::array kPolite = {SIGINT, SIGTERM, SIGHUP, SIGUSR1};

// One wish to end can arrive as several signals: timeout(1) sends to a process and to its group.
constexpr std::chrono::milliseconds kSameWish{500};

bool Ignored(int signal) {
  struct sigaction action {};
  sigaction(signal, nullptr, &action);
  return action.sa_handler == SIG_IGN;
}

std::optional<ProcessEnd> EndOf(pid_t child) {
  int status = 0;
  if (waitpid(child, &status, WNOHANG) != child) return std::nullopt;
  if (WIFSIGNALED(status)) return ProcessEnd{.signal = WTERMSIG(status)};
  return ProcessEnd{.code = WEXITSTATUS(status)};
}

[[noreturn]] void BeChild(pid_t parent, const sigset_t& mask, const std::function<int()>& work) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);  // it died before the line above
  sigprocmask(SIG_SETMASK, &mask, nullptr);
  const int code = work();
  std::fflush(nullptr);
  // Not exit(): what the parent registered for its own end is not the child's to do.
  _exit(code);
}

}  // namespace

std::string SignalText(int signal) {
  const char* name = sigabbrev_np(signal);
  const char* text = sigdescr_np(signal);
  return fmt::format("SIG{} ({})", name == nullptr ? std::to_string(signal) : name,
                     text == nullptr ? "unknown" : text);
}

SignalsHeld::SignalsHeld() {
  sigemptyset(&held_);
  sigaddset(&held_, SIGCHLD);
  for (const int signal : kPolite) {
    // The kernel keeps a blocked signal even where it would be ignored.
    if (!Ignored(signal)) sigaddset(&held_, signal);
  }
  // Where the caller of the program ignores it, ends of children would be forgotten.
  struct sigaction action {};
  action.sa_handler = SIG_DFL;
  sigaction(SIGCHLD, &action, &former_child_action_);
  sigprocmask(SIG_BLOCK, &held_, &former_);
}

SignalsHeld::~SignalsHeld() {
  sigprocmask(SIG_SETMASK, &former_, nullptr);
  sigaction(SIGCHLD, &former_child_action_, nullptr);
}

ProcessEnd SignalsHeld::Run(const std::function<int()>& work) const {
  std::fflush(nullptr);  // or the child would write it a second time
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child < 0) {
    throw core::UserError("processes", std::strerror(errno),
                          "end other programs, or run with --no-supervisor");
  }
  if (child == 0) BeChild(parent, former_, work);
  return Wait(child);
}

ProcessEnd SignalsHeld::Wait(pid_t child) const {
  std::optional<Clock::time_point> asked;
  for (;;) {
    if (std::optional<ProcessEnd> end = EndOf(child)) {
      end->interrupted = asked.has_value();
      return *end;
    }
    const int signal = sigwaitinfo(&held_, nullptr);
    if (signal <= 0 || signal == SIGCHLD) continue;
    const Clock::time_point now = Clock::now();
    if (!asked) {
      asked = now;
      kill(child, SIGTERM);
    } else if (now - *asked > kSameWish) {
      kill(child, SIGKILL);
    }
  }
}

}  // namespace rockyard::batch
