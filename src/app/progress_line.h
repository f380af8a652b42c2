// The progress of a run while it runs; a sign of life of work that cannot tell how far it is.
#pragma once

#include <cstdio>
#include <string>
#include <thread>

#include "batch/executor.h"

namespace rockyard::app {

// "  120/300 done, 4.1/s, ETA 0:44, declared success 91.7 % (95 %: 84.9 .. 95.6 of 118), faults 0".
// Of several cells how many have ended; with a stopping rule the widest half-width at the last
// look, and the one that is wanted. Success is over the contiguous prefix of finished trials,
// without simulator faults.
std::string ProgressText(const batch::Progress& progress);

// One line that is rewritten on a terminal, and plain lines every few seconds elsewhere.
class ProgressLine {
 public:
  explicit ProgressLine(std::FILE* stream);

  void Show(const batch::Progress& progress);
  // Shows the end, whatever the time, and ends the line.
  void Finish(const batch::Progress& progress);

  // The same for progress of another kind, as text; on a terminal alone but for the end.
  void ShowText(std::string text);
  void FinishText(std::string text);

 private:
  void Write(const std::string& text);

  std::FILE* stream_;
  bool terminal_;
  double next_at_s_ = 0.0;  // when the next plain line is due
};

// While it lives and once the work takes long, standard error is told what is done and for how many
// seconds: on a terminal one line that is rewritten every second, elsewhere a line every five.
// Short work stays silent.
class BusyLine {
 public:
  explicit BusyLine(std::string what);
  ~BusyLine();
  BusyLine(const BusyLine&) = delete;
  BusyLine& operator=(const BusyLine&) = delete;

 private:
  std::jthread teller_;  // its end is waited for
};

}  // namespace rockyard::app
