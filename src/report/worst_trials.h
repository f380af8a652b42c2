// Which trials of a run to look at first, and one that stands for each way in which they ended.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "truth/record.h"

namespace rockyard::report {

// Trials that ended other than goal_reached, simulator faults left out: the failures of the rover.
// By trial number.
std::vector<std::uint64_t> FailedTrials(std::span<const truth::Record> records);

// true_goal_distance_m of the record, whose schema has it in that column; infinity where it is not
// finite or not there: unknown is as far as can be.
double GoalDistanceOrInfinity(const truth::Record& record, std::optional<std::size_t> column);

// At most `most` failed trials, those that ended furthest from the goal (true_goal_distance_m)
// first (where that is unknown, before all others), ties by trial number. By trial number alone
// where the schema has no such column.
std::vector<std::uint64_t> WorstTrials(const truth::RecordSchema& schema,
                                       std::span<const truth::Record> records, std::size_t most);

// Of each outcome that occurs, but for simulator faults and measurements, the trial whose true
// distance is the median of that outcome's (the lower of two, and of equals the one with the lowest
// number): neither the best of them nor the worst. Commonest outcome first. Without a column of
// distances, the trial in the middle of their numbers. Cost: n log n.
std::vector<std::uint64_t> ExampleTrials(const truth::RecordSchema& schema,
                                         std::span<const truth::Record> records);

}  // namespace rockyard::report
