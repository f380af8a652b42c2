// Progress on a terminal or in a log: of campaigns and of sequences of images, which tell how far
// they are (ProgressLine), and a sign of life of other work (BusyLine).
#pragma once

#include <cstdio>
#include <string>
#include <thread>

#include "batch/executor.h"

namespace rockyard::app {

// Returns the line of a campaign: "  120/300 done, 4.1/s, ETA 0:44, declared success 91.7 % (95 %:
// 84.9 .. 95.6 of 118), faults 0". The rate of success is that of the contiguous prefix of finished
// trials, without simulator faults. Where there are several cells, the line tells how many have
// ended; with a stopping rule also the widest half-width at the last look, and the wanted one.
std::string ProgressText(const batch::Progress& progress);

// Shows progress on `stream`: on a terminal as one line that is rewritten, elsewhere as a line
// every five seconds.
class ProgressLine {
 public:
  explicit ProgressLine(std::FILE* stream);

  void Show(const batch::Progress& progress);
  // Shows the end, however soon after the last line, and ends the line.
  void Finish(const batch::Progress& progress);

  // Show and end progress that the caller words. Elsewhere than on a terminal only the end is
  // shown.
  void ShowText(std::string text);
  void FinishText(std::string text);

 private:
  void Write(const std::string& text);

  std::FILE* stream_;
  bool terminal_;
  double next_at_s_ = 0.0;  // when the next plain line is due
};

// While it lives, tells on standard error `what` is done and for how many seconds: on a terminal in
// one line that is rewritten every second, elsewhere in a line every five. Work that ends before
// the first line is due stays silent.
class BusyLine {
 public:
  explicit BusyLine(std::string what);
  ~BusyLine();
  BusyLine(const BusyLine&) = delete;
  BusyLine& operator=(const BusyLine&) = delete;

 private:
  std::jthread teller_;  // the destructor stops it and waits for its end
};

}  // namespace rockyard::app
