// Waiting for events, of this process and of others. No measure of speed: what may take any time on
// a busy machine is given ten minutes, so that a test ends which would wait for ever.
#pragma once

#include <sys/types.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <iterator>
#include <string>

namespace rockyard::core {

// Looks again and again until it is so; false where it never is.
template <typename Condition>
bool WaitUntil(const Condition& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(10);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    usleep(1000);
  }
  return true;
}

inline std::string ProcessFile(pid_t process, const std::string& name) {
  std::ifstream file("/proc/" + std::to_string(process) + "/" + name);
  return {std::istreambuf_iterator<char>(file), {}};
}

// A process that has ended, but whom nobody has waited for, is not alive. The state is read, not
// the command line: a process that is starting its program has none for a moment.
inline bool Alive(pid_t process) {
  const std::string stat = ProcessFile(process, "stat");
  const std::size_t name_end = stat.rfind(')');  // the state follows the name: "7 (sh) R ..."
  if (name_end == std::string::npos || name_end + 2 >= stat.size()) return false;
  const char state = stat[name_end + 2];
  return state != 'Z' && state != 'X';
}

inline bool WaitForEnd(pid_t process) {
  return WaitUntil([&] { return !Alive(process); });
}

// Until it has a handler for the signal; false, too, where the process ends before. Not for one
// that holds signals back and waits for them: while it waits, the kernel shows them as not held.
inline bool WaitForHandler(pid_t process, int signal) {
  bool handles = false;
  WaitUntil([&] {
    const std::string status = ProcessFile(process, "status");
    const std::size_t at = status.find("SigCgt:");
    handles = at != std::string::npos &&
              (std::stoull(status.substr(at + 7), nullptr, 16) >> (signal - 1) & 1U) != 0;
    return handles || !Alive(process);
  });
  return handles;
}

}  // namespace rockyard::core
