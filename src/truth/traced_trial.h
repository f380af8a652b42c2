// One trial with its course, as a drive that is driven again gives it.
#pragma once

#include <cstdint>
#include <string>

#include "messages/estimates.h"
#include "truth/record.h"
#include "truth/trace.h"

namespace rockyard::truth {

struct TracedTrial {
  std::string scenario;
  std::uint64_t seed = 1;
  messages::Goal goal;
  RecordSchema schema;
  Record record;
  Trace trace;
};

}  // namespace rockyard::truth
