// The real MPI, all ranks on this machine.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>

namespace rockyard::batch {
namespace {

int ExitOf(int ranks, long bytes, int messages) {
  // Tests run as root in containers, with more ranks than cores.
  setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
  setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
  setenv("OMPI_MCA_rmaps_base_oversubscribe", "1", 1);
  setenv("OMPI_MCA_btl_vader_single_copy_mechanism", "none", 1);
  // What MPI keeps until a process ends is no leak of ours, and its libraries are gone by then.
  setenv("LSAN_OPTIONS", "detect_leaks=0", 1);
  const std::string command =
      fmt::format("'{}' -n {} '{}' {} {} 2>/dev/null", MPIRUN, ranks, MPI_CHILD, bytes, messages);
  return WEXITSTATUS(std::system(command.c_str()));
}

// Messages up to about 4 kB are buffered by MPI and cross even where Send would block.
TEST(MpiCommunicator, LargeMessagesCross) {
  for (const long bytes : {100L, 5000L, 1'000'000L}) EXPECT_EQ(ExitOf(2, bytes, 4), 0) << bytes;
}

TEST(MpiCommunicator, LargeMessagesOfThreeRanksCross) { EXPECT_EQ(ExitOf(3, 20'000, 20), 0); }

}  // namespace
}  // namespace rockyard::batch
