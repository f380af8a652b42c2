#include "app/interrupt.h"

#include <array>
#include <csignal>

namespace rockyard::app {
namespace {

constexpr std::array kPolite = {SIGINT, SIGTERM, SIGHUP};
constexpr std::array kBecomeErrors = {SIGPIPE, SIGXFSZ};

// A signal handler can reach nothing but static storage.
std::atomic<bool> requested_flag = false;
static_assert(std::atomic<bool>::is_always_lock_free, "the signal handler writes it");

void OnSignal(int signal) {
  requested_flag = true;
  std::signal(signal, SIG_DFL);
}

}  // namespace

InterruptGuard::InterruptGuard() {
  requested_flag = false;
  for (const int signal : kPolite) {
    // What the caller told to ignore (nohup, background jobs of a script) stays ignored.
    if (std::signal(signal, OnSignal) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
  for (const int signal : kBecomeErrors) std::signal(signal, SIG_IGN);
}

InterruptGuard::~InterruptGuard() {
  for (const int signal : kPolite) {
    if (std::signal(signal, SIG_DFL) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
  for (const int signal : kBecomeErrors) std::signal(signal, SIG_DFL);
}

const std::atomic<bool>& InterruptGuard::requested() const { return requested_flag; }

}  // namespace rockyard::app
