// Runs of entries for tests: driven ones, and ones that somebody forged.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "batch/result_store.h"
#include "campaign/bench/bench.h"
#include "campaign/bench/bench_chain.h"
#include "core/files.h"
#include "core/json_text.h"
#include "core/test_folder.h"

namespace rockyard::campaign {

namespace fs = std::filesystem;

class BenchRuns : public testing::Test {
 protected:
  fs::path Path(const std::string& name) const { return folder_.path() / name; }

  void Write(const fs::path& file, const std::string& text) const {
    fs::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
  }

  static std::string Read(const fs::path& file) {
    return core::ReadWholeFile(file, 1 << 24, "a file");
  }

  // The behaviour controller over three cells of two groups.
  BenchRequest Request(const std::string& out) const {
    const std::string nominal =
        std::string(ROCKYARD_SOURCE_DIR) + "/scenarios/pathfinder/nominal.json";
    Write(Path("suite.json"), R"({
      "name": "small", "trials": 3, "seed": 4, "common_random_numbers": true,
      "set": {"rover.fidelity": "quasi_static", "course.goal_x_m": 0.8, "course.site_map.kind": "both"},
      "design": {"kind": "list"},
      "cells": [
        {"name": "near/few", "scenario": ")" +
                                  nominal + R"("},
        {"name": "near/many", "scenario": ")" +
                                  nominal + R"(", "set": {"terrain.rocks.k_per_m2": 0.02}},
        {"name": "slow/few", "scenario": ")" +
                                  nominal + R"(", "set": {"rover.drive.speed_m_s": 0.1}}
      ]})");
    Write(Path("entry.json"), R"({"name": "mine", "navigator": "pathfinder",
                                  "set": {"navigation.pathfinder.wide_arc_radius_m": 2}})");
    BenchRequest request{.entry = Path("entry.json"), .suite = Path("suite.json").string()};
    request.campaign.folder = Path(out);
    request.campaign.containment.threads = 1;
    return request;
  }

  // Copies a run, with records as `edit` leaves them.
  using Edit = std::function<void(std::size_t cell, std::vector<truth::Record>& records)>;
  fs::path Forge(const fs::path& run, const std::string& name, const Edit& edit,
                 const std::function<void(batch::CampaignIdentity&)>& claim = {}) const {
    const fs::path forged = Path(name);
    fs::copy(run, forged, fs::copy_options::recursive);
    fs::remove(forged / "results.sqlite");
    const batch::ResultStore store = batch::ResultStore::Read(run);
    batch::CampaignIdentity identity = store.identity();
    if (claim) claim(identity);
    batch::ResultStore made = batch::ResultStore::Create(forged, identity, store.planned());
    for (int cell = 0; cell < store.cells(); ++cell) {
      std::vector<truth::Record> records = store.Load(cell);
      edit(static_cast<std::size_t>(cell), records);
      std::vector<batch::CellRecord> rows;
      for (truth::Record& record : records) rows.push_back({cell, std::move(record)});
      made.Append(rows);
    }
    return forged;
  }

  // Makes the chain of what lies in the folder, as somebody who has the program can.
  static void LinkAnew(const fs::path& run) {
    core::JsonValue document = core::ParseJson(Read(run / kBenchFile), kBenchFile);
    const std::vector<ChainLink> chain =
        MakeChain(run, batch::ResultStore::Read(run), document.Find("start")->text());
    document.Set("head", core::JsonValue(chain.back().digest));
    std::ofstream(run / kChainFile, std::ios::binary) << ChainCsv(chain);
    std::ofstream(run / kBenchFile, std::ios::binary) << core::DumpJson(document);
  }

 private:
  core::TestFolder folder_;
};

}  // namespace rockyard::campaign
