// The process of a navigator: started, asked, and ended with all that it started. POSIX; Linux.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "navigation/navigator_set_params.h"
#include "plugin/answerer.h"

namespace rockyard::plugin {

// Returns the words that start `command`, for /bin/sh, in a folder: by bubblewrap where it is there
// and works (no network, files read-only but in a TMPDIR of its own), else as it is. `confined` is
// set to which.
std::vector<std::string> StartWords(const std::string& command, const std::string& folder,
                                    bool& confined);

// One process. It is asked by one thread at a time. Messages are a length, 4 bytes little endian,
// and that many bytes, on its descriptors 3 (to it) and 4 (from it). What it writes to stdout and
// stderr is read, and the last of it kept. A small process of its own, its keeper, starts it and
// ends all that it has started, also where this process is killed.
class ChildProcess final : public Answerer {
 public:
  // Starts it. Throws core::MachineError where no process can be made.
  ChildProcess(const std::vector<std::string>& words, const std::string& folder);
  // Kills it and what it has started.
  ~ChildProcess() override;
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  // Throws where the process ended, exceeded a limit, or sent what is no message.
  std::string Ask(std::string_view message, const navigation::LimitParams& limits,
                  double left_cpu_s) override;

  std::int64_t asked() const override { return asked_; }
  // Of answers which took less than 20 ms by the clock on the wall it is in that of a later one.
  double used_s() const override { return used_s_; }
  // It lives, and is no fork's.
  bool usable() const override;
  // Returns the last that it wrote to stdout and stderr.
  const std::string& said() const { return said_; }

 private:
  class Question;
  using Clock = std::chrono::steady_clock;

  // Sends what is left of a message and reads what is there of the answer.
  void Exchange(Question& question);
  void ReadLog();
  // Throws where what it used since `began_cpu_s` is more than the limits.
  void CheckUse(double began_cpu_s, const navigation::LimitParams& limits, double left_cpu_s) const;
  // Returns whether the last reading of its use is too old.
  bool IsStale(Clock::time_point now) const;
  // Returns the CPU time of it and what it started; of what has ended, as last looked.
  double Cpu_s() const;
  [[noreturn]] void FailEnded();
  std::string WithWords(std::string text) const;

  pid_t starter_;
  mutable pid_t pid_ = -1;  // of its keeper; -1: both have ended and are waited for
  int to_ = -1;
  int from_ = -1;
  int log_ = -1;
  int life_ = -1;              // closed: its keeper ends it
  std::vector<pid_t> family_;  // it and what descends from it, as last looked
  double ended_cpu_s_ = 0.0;
  std::int64_t asked_ = 0;
  double used_s_ = 0.0;
  double cpu_s_ = 0.0;           // as last read, between two answers
  Clock::time_point read_at_{};  // when
  std::string said_;
};

}  // namespace rockyard::plugin
