// A sign of life of work that cannot tell how far it is.
#pragma once

#include <cstdio>
#include <string>
#include <thread>

namespace rockyard::app {

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
