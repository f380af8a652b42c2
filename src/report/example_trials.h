// One trial that stands for each way in which the trials of a run ended.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "truth/record.h"

namespace rockyard::report {

// Of each outcome that occurs, but for simulator faults and measurements, the trial whose true
// distance is the median of that outcome's (the lower of two, and of equals the one with the lowest
// number): neither the best of them nor the worst. Commonest outcome first. Without a column of
// distances, the trial in the middle of their numbers. Cost: n log n.
std::vector<std::uint64_t> ExampleTrials(const truth::RecordSchema& schema,
                                         std::span<const truth::Record> records);

}  // namespace rockyard::report
