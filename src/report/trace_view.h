// What story, CSV and drawing of a trial look up in its trace, and in what way two records differ.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "truth/record.h"
#include "truth/trace.h"

namespace rockyard::report {

// The last sample at or before `time_s`: what the rover believed when an event happened. Null where
// there is none. Samples are in the order of time.
const truth::TraceSample* SampleAt(std::span<const truth::TraceSample> samples, double time_s);

// The columns that differ, as "name: stored 1.5, now 1.25"; empty where outcome, detail and the
// bits of every value are equal (undefined values count as equal).
std::vector<std::string> RecordDifferences(const truth::RecordSchema& schema,
                                           const truth::Record& stored, const truth::Record& now);

}  // namespace rockyard::report
