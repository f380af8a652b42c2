// What tests of whole campaigns share: cheap requests in a folder of their own.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "batch/fake_experiment.h"
#include "batch/result_store.h"
#include "batch/trial_hash.h"
#include "campaign/run.h"
#include "core/test_folder.h"

namespace rockyard::campaign {

class SmallRuns : public testing::Test {
 protected:
  std::filesystem::path Path(const std::string& name) const { return folder_.path() / name; }

  // Trials of a rover without dynamics that end after a simulated second. On one thread, so that
  // the process stays fit to fork.
  RunRequest Request(const std::string& folder, int trials) const {
    RunRequest request{.source =
                           std::string(ROCKYARD_SOURCE_DIR) + "/scenarios/pathfinder/nominal.json"};
    request.campaign.trials = trials;
    request.campaign.overrides = {"rover.fidelity=quasi_static", "referee.time_limit_s=1"};
    request.campaign.folder = Path(folder);
    request.campaign.containment.threads = 1;
    return request;
  }

  RunRequest Part(const std::string& folder, int trials, const std::string& shard) const {
    RunRequest request = Request(folder, trials);
    request.campaign.shard = shard;
    return request;
  }

  // Two speeds.
  SweepRequest SweepOfTwo(const std::string& folder) const {
    std::ofstream(Path("two.json")) << R"({
      "name": "two", "trials": 3, "seed": 4,
      "set": {"rover.fidelity": "quasi_static", "referee.time_limit_s": 1},
      "axes": [{"path": "rover.drive.speed_m_s", "values": [0.05, 0.1]}]
    })";
    SweepRequest request{.file = Path("two.json")};
    request.campaign.folder = Path(folder);
    request.campaign.containment.threads = 1;
    return request;
  }

  // Over all cells.
  std::string Hash(const std::string& folder) const {
    const batch::ResultStore store = batch::ResultStore::Read(Path(folder));
    std::string hashes;
    for (int cell = 0; cell < store.cells(); ++cell) hashes += batch::TrialHash(store.Load(cell));
    return hashes;
  }

 private:
  core::TestFolder folder_;
};

}  // namespace rockyard::campaign
