// An allocation that fails at each of many points.
#include "app/memory_runs.h"

namespace rockyard::app {
namespace {

using CliMemoryLong = MemoryRuns;

TEST_F(CliMemoryLong, OneAllocationThatFailsIsNoFault) { ExpectOfExperiments(200); }

}  // namespace
}  // namespace rockyard::app
