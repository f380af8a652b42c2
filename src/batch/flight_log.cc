#include "batch/flight_log.h"

#include <pthread.h>
#include <sys/mman.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <new>
#include <utility>

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
  std::uint64_t word = shared_->slots[0].word;
  while (StateOf(word) != kFree ||
         !shared_->slots[number].word.compare_exchange_strong(word, word + kClaimed)) {
    ++number;
    EXPECT(number < kSlots);
    word = shared_->slots[number].word;
  }
  Slot& slot = shared_->slots[number];
  slot.cell = id.cell;
  slot.trial = id.trial;
  slot.clock = CpuClockOfThisThread();
  slot.began_ns = Nanoseconds(CLOCK_THREAD_CPUTIME_ID);
  slot.word = word + kFlying;
  return number;
}

void FlightLog::End(int slot) {
  std::atomic<std::uint64_t>& word = shared_->slots[slot].word;
  // The flight may become overdue in this moment; nobody but this thread frees the slot.
  word = word - StateOf(word) + kStates;
}

std::vector<Flight> FlightLog::Flights() const {
  std::vector<Flight> flights;
  for (const Slot& slot : shared_->slots) {
    const std::uint64_t word = slot.word;
    const Flight flight{{slot.cell, slot.trial}, StateOf(word) == kOverdue};
    const bool flies = StateOf(word) == kFlying || StateOf(word) == kOverdue;
    // Where the number has changed, that flight has ended meanwhile, and what was read belongs to
    // none.
    if (flies && slot.word / kStates == word / kStates) flights.push_back(flight);
  }
  return flights;
}

std::int64_t FlightLog::ReadCpuClock(clockid_t clock) { return Nanoseconds(clock); }

bool FlightLog::MarkOverdue(double limit_s, const CpuClock& now_ns) {
  bool any = false;
  for (Slot& slot : shared_->slots) {
    std::uint64_t word = slot.word;
    if (StateOf(word) == kFlying) {
      const auto used_ns = static_cast<double>(now_ns(slot.clock) - slot.began_ns);
      // A trial that ends in this moment is not overdue, nor is the one that follows it.
      if (used_ns > 1e9 * limit_s) {
        slot.word.compare_exchange_strong(word, word - kFlying + kOverdue);
      }
    }
    any = any || StateOf(slot.word) == kOverdue;
  }
  return any;
}

void FlightLog::Clear() {
  for (Slot& slot : shared_->slots) slot.word = slot.word - StateOf(slot.word) + kStates;
  shared_->stored = 0;
  shared_->stop = false;
  shared_->returned = false;
}

namespace {

bool AllOverdue(const std::vector<Flight>& flights) {
  return std::all_of(flights.begin(), flights.end(), [](const Flight& f) { return f.overdue; });
}

}  // namespace

std::vector<TrialId> TrialsOf(const std::vector<Flight>& flights) {
  std::vector<TrialId> trials;
  trials.reserve(flights.size());
  for (const Flight& flight : flights) trials.push_back(flight.id);
  return trials;
}

Watchdog::Watchdog(FlightLog& log, const WatchdogOptions& options, GiveUp give_up)
    : log_(log), options_(options), give_up_(std::move(give_up)) {
  if (options_.cpu_limit_s > 0.0) thread_ = std::thread([this] { Loop(); });
}

Watchdog::~Watchdog() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  wake_.notify_all();
  if (thread_.joinable()) thread_.join();
}

bool Watchdog::Sleep(std::chrono::milliseconds time) {
  std::unique_lock lock(mutex_);
  return !wake_.wait_for(lock, time, [this] { return over_; });
}

void Watchdog::Loop() {
  while (Sleep(options_.look_every)) {
    if (!log_.MarkOverdue(options_.cpu_limit_s)) continue;
    bit_ = true;
    log_.stop() = true;
    WaitForTheRest();
    return;
  }
}

void Watchdog::WaitForTheRest() {
  while (!AllOverdue(log_.Flights())) {
    if (!Sleep(options_.look_every)) return;
    log_.MarkOverdue(options_.cpu_limit_s);
  }
  if (!Sleep(options_.grace)) return;
  give_up_(log_.Flights());
}

}  // namespace rockyard::batch
