#include "app/busy_line.h"

#include <fmt/format.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stop_token>
#include <utility>

#include "app/console.h"

namespace rockyard::app {
namespace {

using Clock = std::chrono::steady_clock;

void Tell(const std::stop_token& stop, const std::string& what) {
  const bool terminal = IsTerminal(stderr);
  const std::chrono::seconds interval(terminal ? 1 : 5);
  const Clock::time_point begin = Clock::now();
  std::mutex mutex;
  std::condition_variable_any ended;
  std::unique_lock lock(mutex);
  bool told = false;
  while (!ended.wait_for(lock, stop, interval, [] { return false; }) && !stop.stop_requested()) {
    const auto seconds =
        std::chrono::duration_cast<std::chrono::seconds>(Clock::now() - begin).count();
    const std::string text = report::Printable(fmt::format("  {}: {} s", what, seconds));
    const std::string line = terminal ? "\r" + text + "\x1b[K" : text + "\n";
    std::fwrite(line.data(), 1, line.size(), stderr);
    told = true;
  }
  if (terminal && told) std::fputs("\r\x1b[K", stderr);
}

}  // namespace

BusyLine::BusyLine(std::string what)
    : teller_([what = std::move(what)](const std::stop_token& stop) { Tell(stop, what); }) {}

BusyLine::~BusyLine() = default;

}  // namespace rockyard::app
