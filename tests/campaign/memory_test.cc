// How many bytes a trial costs those who read all of a run. Counted at operator new, which decides
// as well on a busy machine as on an idle one; SQLite's own few megabytes are not in it.
#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <optional>
#include <random>

#include "batch/fake_experiment.h"
#include "batch/result_store.h"
#include "campaign/folder_report.h"
#include "campaign/report.h"
#include "campaign/run_source.h"
#include "core/hash.h"
#include "core/test_folder.h"
#include "report/paired_comparison.h"
#include "scenario/load.h"
#include "scenario/shipped.h"
#include "truth/drive_record.h"

namespace {

std::atomic<std::int64_t> held = 0;
std::atomic<std::int64_t> most = 0;

void Count(std::int64_t bytes) {
  const std::int64_t now = held += bytes;
  std::int64_t before = most;
  while (now > before && !most.compare_exchange_weak(before, now)) {
  }
}

}  // namespace

void* operator new(std::size_t size) {
  void* const memory = std::malloc(size);
  if (memory == nullptr) throw std::bad_alloc();
  Count(static_cast<std::int64_t>(malloc_usable_size(memory)));
  return memory;
}
void operator delete(void* memory) noexcept {
  if (memory != nullptr) Count(-static_cast<std::int64_t>(malloc_usable_size(memory)));
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept { operator delete(memory); }

namespace rockyard::campaign {
namespace {

// A run of 10^6 trials is to stay below 1 GB: these leave some of it for what does not grow.
constexpr double kMostBytesATrial = 900.0;
constexpr double kMostBytesAPair = 700.0;
// Just below powers of two, to which vectors grow: what they reserve beyond is not touched.
constexpr std::int64_t kFew = 16000;
constexpr std::int64_t kMany = 32000;
// Of the columns of a drive so many differ from trial to trial, as in the Pathfinder scenarios.
constexpr std::size_t kVaried = 45;

truth::RecordSchema DriveSchema() {
  truth::RecordSchema schema;
  for (const truth::DriveColumn& column : truth::kDriveColumns) {
    schema.push_back({std::string(column.name), std::string(column.unit), ""});
  }
  return schema;
}

// A store as a campaign of that many drives leaves it, with made-up values.
void MakeStore(const std::filesystem::path& folder, std::int64_t trials) {
  const scenario::Scenario scenario = scenario::Shipped("pathfinder/nominal");
  batch::CellIdentity cell{.name = "",
                           .scenario = scenario.name,
                           .fingerprint = core::Hex(scenario::Fingerprint(scenario)),
                           .resolved = scenario::ResolvedJson(scenario)};
  batch::ResultStore store = batch::ResultStore::Create(
      folder,
      {.name = "made up", .design = "", .build = "none", .schema = DriveSchema(), .cells = {cell}},
      trials);
  std::mt19937_64 random(1);
  constexpr std::int64_t kPiece = 10000;
  for (std::int64_t begin = 0; begin < trials; begin += kPiece) {
    std::vector<batch::CellRecord> piece;
    for (std::int64_t i = begin; i < std::min(trials, begin + kPiece); ++i) {
      std::vector<double> values(truth::kDriveColumns.size(), 1.0);
      for (std::size_t j = 0; j < kVaried; ++j) values[j] = 1.0 + std::ldexp(random(), -64);
      const bool arrived = values[0] < 1.9;
      piece.push_back({0,
                       {static_cast<std::uint64_t>(i),
                        arrived ? truth::TrialOutcome::kGoalReached : truth::TrialOutcome::kNoPath,
                        "a sentence of thirty characters", std::move(values)}});
    }
    store.Append(piece);
  }
}

template <typename Work>
double MostBytes(const Work& work) {
  const std::int64_t before = held;
  most = before;
  work();
  return static_cast<double>(most - before);
}

class Memory : public testing::Test {
 protected:
  // Stores that all tests read.
  static void SetUpTestSuite() {
    folder_.emplace();
    for (const std::int64_t trials : {kFew, kMany, 2 * kMany}) {
      std::filesystem::create_directory(Folder(trials));
      MakeStore(Folder(trials), trials);
    }
  }
  static void TearDownTestSuite() { folder_.reset(); }

  // How much more it takes for each more trial.
  template <typename Work>
  static double BytesATrial(std::int64_t few, std::int64_t many, const Work& work) {
    const double least = MostBytes([&] { work(Folder(few)); });
    const double bytes =
        (MostBytes([&] { work(Folder(many)); }) - least) / static_cast<double>(many - few);
    RecordProperty("bytes_a_trial", std::to_string(bytes));
    return bytes;
  }

 private:
  static std::filesystem::path Folder(std::int64_t trials) {
    return folder_->path() / std::to_string(trials);
  }

  static inline std::optional<core::TestFolder> folder_;
};

TEST_F(Memory, TheFilesOfARun) {
  const double bytes = BytesATrial(kFew, kMany, [](const auto& folder) { ReportRun(folder, {}); });
  EXPECT_LT(bytes, kMostBytesATrial) << bytes;
  EXPECT_GT(bytes, 8.0 * kVaried) << "these values differ: less than that is not counted rightly";
}

// With more trials than a page holds.
TEST_F(Memory, ThePageOfARun) {
  const auto build = [](const std::filesystem::path& folder) {
    const Observer observer;
    Journal journal(observer);
    const Stop stop;
    ReportInput input;
    input.folder = folder;
    input.label = "a";
    const PageRequest request{.inputs = {input},
                              .title = {},
                              .command = {},
                              .against = {},
                              .replays = 0,
                              .page = folder / "report.html",
                              .progress = {}};
    EXPECT_LT(BuildReport(request, {journal, stop}).json.size(), 20'000'000u);
  };
  EXPECT_LT(BytesATrial(kMany, 2 * kMany, build), kMostBytesATrial);
}

TEST_F(Memory, TwoRunsCompared) {
  const auto compare = [](const std::filesystem::path& folder) {
    const StoredRun run = ReadRun(folder, "", StoredValues::kNone);
    CompareDrives(run, ReadRun(folder, "", StoredValues::kNone), std::size_t{1} << 20);
  };
  EXPECT_LT(BytesATrial(kFew, kMany, compare), kMostBytesAPair);
}

}  // namespace
}  // namespace rockyard::campaign
