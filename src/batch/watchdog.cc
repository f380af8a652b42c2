#include "batch/watchdog.h"

#include <algorithm>
#include <utility>

namespace rockyard::batch {
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
