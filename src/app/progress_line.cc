#include "app/progress_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <stop_token>
#include <string_view>
#include <utility>

#include "app/console.h"
#include "statistics/proportions.h"

namespace rockyard::app {
namespace {

using Clock = std::chrono::steady_clock;

// Between two lines elsewhere than on a terminal; Tell waits as long.
constexpr double kPlainInterval_s = 5.0;

std::string Duration(double seconds) {
  const auto total = static_cast<std::int64_t>(std::llround(std::min(seconds, 1e9)));
  if (total >= 3600) {
    return fmt::format("{}:{:02}:{:02}", total / 3600, total / 60 % 60, total % 60);
  }
  return fmt::format("{}:{:02}", total / 60, total % 60);
}

std::string Pace(const batch::Progress& progress) {
  const auto done = static_cast<double>(progress.finished - progress.finished_before);
  if (done < 1.0 || progress.elapsed_s <= 0.0) return "";
  const double rate = done / progress.elapsed_s;
  const std::int64_t left = std::max<std::int64_t>(progress.planned - progress.finished, 0);
  return fmt::format(", {:.3g}/s, ETA {}", rate, Duration(static_cast<double>(left) / rate));
}

// Returns "<=" where a stopping rule may end cells before the planned number of trials.
std::string_view AtMost(const batch::Progress& progress) {
  const bool open = progress.target_half_width > 0.0 && progress.finished < progress.planned;
  return open ? "<=" : "";
}

// The thread of a BusyLine.
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

std::string ProgressText(const batch::Progress& progress) {
  const batch::PrefixCounts& prefix = progress.prefix;
  const std::int64_t trials = prefix.trials - prefix.faults - prefix.measured;
  std::string text = fmt::format("  {}/{}{} done{}", progress.finished, AtMost(progress),
                                 progress.planned, Pace(progress));
  if (trials > 0) {
    const auto rate = statistics::MakeProportion(prefix.declared_successes, trials);
    text +=
        fmt::format(", declared success {:.1f} % (95 %: {:.1f} .. {:.1f} of {})", 100.0 * rate.rate,
                    100.0 * rate.interval.low, 100.0 * rate.interval.high, trials);
  }
  if (progress.cells > 1) {
    text += fmt::format(", {}/{} cells ended", progress.cells_ended, progress.cells);
  }
  if (progress.target_half_width > 0.0) {
    text += fmt::format(", half-width {:.2f} % for {:.2f} %", 100.0 * progress.widest_half_width,
                        100.0 * progress.target_half_width);
  }
  return text + fmt::format(", faults {}", progress.faults);
}

ProgressLine::ProgressLine(std::FILE* stream) : stream_(stream), terminal_(IsTerminal(stream)) {}

void ProgressLine::Show(const batch::Progress& progress) {
  if (terminal_) {
    ShowText(ProgressText(progress));
  } else if (progress.elapsed_s >= next_at_s_) {
    Write(ProgressText(progress) + "\n");
    next_at_s_ = progress.elapsed_s + kPlainInterval_s;
  }
}

void ProgressLine::Finish(const batch::Progress& progress) {
  next_at_s_ = 0.0;
  Show(progress);
  if (terminal_) Write("\n");
}

void ProgressLine::ShowText(std::string text) {
  if (!terminal_) return;
  const auto width = static_cast<std::size_t>(std::max(TerminalWidth(stream_) - 1, 20));
  text.resize(std::min(text.size(), width));
  Write("\r" + text + "\x1b[K");
  std::fflush(stream_);
}

void ProgressLine::FinishText(std::string text) {
  if (!terminal_) return Write(text + "\n");
  ShowText(std::move(text));
  Write("\n");
}

// Progress that nobody can read (a closed pipe, a full disk) must not end the run: no check here.
void ProgressLine::Write(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stream_);
}

BusyLine::BusyLine(std::string what)
    : teller_([what = std::move(what)](const std::stop_token& stop) { Tell(stop, what); }) {}

BusyLine::~BusyLine() = default;

}  // namespace rockyard::app
