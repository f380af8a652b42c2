#include "batch/flight_log.h"

#include <pthread.h>
#include <sys/mman.h>

#include <cerrno>
#include <cstring>
#include <ctime>
#include <new>

#include "core/check.h"
#include "core/error.h"

namespace rockyard::batch {
namespace {

std::int64_t Nanoseconds(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return std::int64_t{1'000'000'000} * now.tv_sec + now.tv_nsec;
}

clockid_t CpuClockOfThisThread() {
  clockid_t clock = CLOCK_THREAD_CPUTIME_ID;
  pthread_getcpuclockid(pthread_self(), &clock);
  return clock;
}

}  // namespace

FlightLog::FlightLog() {
  void* memory =
      mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) {
    throw core::UserError("memory", std::strerror(errno), "ask for fewer trials or threads");
  }
  shared_ = new (memory) Shared;
}

FlightLog::~FlightLog() { munmap(shared_, sizeof(Shared)); }

int FlightLog::Begin(TrialId id) {
  int number = 0;
  std::int32_t expected = kFree;
  while (number < kSlots &&
         !shared_->slots[number].state.compare_exchange_strong(expected, kClaimed)) {
    expected = kFree;
    ++number;
  }
  EXPECT(number < kSlots);
  Slot& slot = shared_->slots[number];
  slot.cell = id.cell;
  slot.trial = id.trial;
  slot.clock = CpuClockOfThisThread();
  slot.began_ns = Nanoseconds(CLOCK_THREAD_CPUTIME_ID);
  slot.state = kFlying;
  return number;
}

void FlightLog::End(int slot) {
  shared_->slots[slot].state = kFree;
  ++shared_->finished;
}

std::vector<Flight> FlightLog::Flights() const {
  std::vector<Flight> flights;
  for (const Slot& slot : shared_->slots) {
    const std::int32_t state = slot.state;
    if (state == kFlying || state == kOverdue) {
      flights.push_back({{slot.cell, slot.trial}, state == kOverdue});
    }
  }
  return flights;
}

bool FlightLog::MarkOverdue(double limit_s) {
  bool any = false;
  for (Slot& slot : shared_->slots) {
    std::int32_t state = slot.state;
    if (state == kFlying) {
      const auto used_ns = static_cast<double>(Nanoseconds(slot.clock) - slot.began_ns);
      // A trial that ends in this moment is not overdue.
      if (used_ns > 1e9 * limit_s) slot.state.compare_exchange_strong(state, kOverdue);
    }
    any = any || slot.state == kOverdue;
  }
  return any;
}

void FlightLog::Clear() {
  for (Slot& slot : shared_->slots) slot.state = kFree;
  shared_->finished = 0;
  shared_->stop = false;
}

}  // namespace rockyard::batch
