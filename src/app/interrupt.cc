#include "app/interrupt.h"

#include <array>
#include <csignal>

namespace rockyard::app {
namespace {

// SIGUSR1: mpirun passes it on to every rank, where it would make an end of SIGTERM by itself.
constexpr std::array kPolite = {SIGINT, SIGTERM, SIGHUP, SIGUSR1};

// A signal handler can reach nothing but static storage.
std::atomic<std::atomic<bool>*> requested_flag = nullptr;
static_assert(std::atomic<bool>::is_always_lock_free, "the signal handler writes it");
static_assert(std::atomic<std::atomic<bool>*>::is_always_lock_free, "and reads where it is");

void SetFlag(int) {
  if (std::atomic<bool>* flag = requested_flag) *flag = true;
}

void SetFlagOnce(int signal) {
  SetFlag(signal);
  std::signal(signal, SIG_DFL);
}

}  // namespace

InterruptGuard::InterruptGuard(std::atomic<bool>& requested, campaign::SecondWish second) {
  requested_flag = &requested;
  const auto handler = second == campaign::SecondWish::kEnds ? SetFlagOnce : SetFlag;
  for (const int signal : kPolite) {
    // What the caller told to ignore (nohup, background jobs of a script) stays ignored.
    if (std::signal(signal, handler) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
}

InterruptGuard::~InterruptGuard() {
  for (const int signal : kPolite) {
    if (std::signal(signal, SIG_DFL) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
  requested_flag = nullptr;
}

}  // namespace rockyard::app
