// A forked process and how it ended.
#pragma once

#include <sys/types.h>

#include <csignal>
#include <functional>
#include <string>

namespace rockyard::batch {

struct ProcessEnd {
  int code = 0;              // exit code, where it ended by itself
  int signal = 0;            // that ended it; 0: none
  bool interrupted = false;  // this process was asked to end meanwhile
};

// e.g. "SIGSEGV (Segmentation fault)"
std::string SignalText(int signal);

// While this lives, polite signals (SIGINT, SIGTERM, SIGHUP, SIGUSR1; those that the caller of the
// program told to ignore stay ignored) wait until a child is waited for. One at a time, in a
// process with one thread.
class SignalsHeld {
 public:
  SignalsHeld();
  ~SignalsHeld();
  SignalsHeld(const SignalsHeld&) = delete;
  SignalsHeld& operator=(const SignalsHeld&) = delete;

  // Forks; the child runs `work` with the former signal mask, ends with what it returns, and dies
  // with this process. Waits for its end; the first polite signal is passed on as SIGTERM, one that
  // comes later than a moment after it becomes SIGKILL. Throws core::UserError where no process
  // can be made.
  ProcessEnd Run(const std::function<int()>& work) const;

 private:
  ProcessEnd Wait(pid_t child) const;

  sigset_t held_{};
  sigset_t former_{};
  struct sigaction former_child_action_ {};
};

}  // namespace rockyard::batch
