// Numbers of the moments at which aids of a drive take their data.
#pragma once

#include "messages/aids.h"

namespace rockyard::trial {

// All aids of one drive draw from one counter: an estimator tells their moments apart by number.
class CaptureCounter {
 public:
  messages::CaptureNumber Next() { return next_++; }

 private:
  messages::CaptureNumber next_ = 0;
};

}  // namespace rockyard::trial
