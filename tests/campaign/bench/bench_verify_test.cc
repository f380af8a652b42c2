// Runs of entries: what is kept of them, and that whatever somebody changes in one is found.
#include "campaign/bench/bench_verify.h"

#include <bit>
#include <cmath>

#include "batch/campaign_differences.h"
#include "bench_runs.h"
#include "core/error.h"

namespace rockyard::campaign {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class BenchVerify : public BenchRuns {
 protected:
  fs::path Driven() const {
    const WorkResult result = RunBench(Request("run"));
    EXPECT_EQ(result.outcome, Outcome::kDone);
    return Path("run");
  }

  BenchVerification Verify(const fs::path& run, std::int64_t sample = 100) const {
    return VerifyBench({.folder = run,
                        .suite = Path("suite.json").string(),
                        .sample = sample,
                        .seed = 5,
                        .threads = 1});
  }

  static void FlipLowestBit(double& value) {
    value = std::bit_cast<double>(std::bit_cast<std::uint64_t>(value) ^ 1);
  }
};

constexpr auto kUnchanged = [](std::size_t, std::vector<truth::Record>&) {};

TEST_F(BenchVerify, AnHonestRunHasNoFindings) {
  const fs::path run = Driven();
  const BenchVerification found = Verify(run);
  EXPECT_THAT(found.findings, IsEmpty());
  EXPECT_EQ(found.drives, 9);
  EXPECT_EQ(found.driven_again, 9);
  EXPECT_EQ(Verify(run, 4).driven_again, 4);
  EXPECT_EQ(found.run.name(), "mine");
  EXPECT_EQ(found.run.seed, 4);
  EXPECT_EQ(found.run.layouts, 3);
  const batch::ResultStore store = batch::ResultStore::Read(run);
  for (const batch::CellIdentity& cell : store.identity().cells) {
    EXPECT_THAT(cell.resolved, Not(HasSubstr("\"both\"")))
        << "entries of points get no map of the site";
  }
}

TEST_F(BenchVerify, TracksAreThoseOfSuitesAndNavigators) {
  const auto refused = [&](const std::string& track, const std::string& suite) {
    BenchRequest request = Request("refused");
    std::string text = Read(Path("suite.json"));
    text.replace(text.find("small"), 5, suite);
    Write(Path("suite.json"), text);
    Write(Path("entry.json"),
          R"({"name": "mine", "navigator": "pathfinder", "track": ")" + track + "\"}");
    const WorkResult result = RunBench(request);
    return result.problems.empty() ? "" : result.problems.front().reason;
  };
  EXPECT_EQ(refused("map", "points"), "is map, and the suite is of points");
  EXPECT_EQ(refused("images", "map"), "is images, and the suite is of map");
  EXPECT_EQ(refused("images", "images"),
            "is images, and the navigator pathfinder asks for no images");
  EXPECT_FALSE(fs::exists(Path("refused")));
}

TEST_F(BenchVerify, APluginsDrivesComeOutByItsActionsAlone) {
  BenchRequest request = Request("run");
  fs::create_directories(Path("plugin"));
  fs::copy_file(COUNTING_NAVIGATOR, Path("plugin/libcounting.so"));
  Write(Path("plugin/entry.json"),
        R"({"name": "counting", "navigator": "counter", "plugin": "libcounting.so"})");
  request.entry = Path("plugin");
  request.campaign.containment.supervisor = true;  // as a plugin needs
  const WorkResult result = RunBench(request);
  ASSERT_EQ(result.outcome, Outcome::kDone)
      << result.problems.front().path << ": " << result.problems.front().reason;
  const BenchVerification found = Verify(Path("run"));
  EXPECT_EQ(found.driven_again, 9);
  EXPECT_THAT(found.findings, IsEmpty());
}

TEST_F(BenchVerify, AnotherEntryThanTheOneThatDrove) {
  const fs::path run = Driven();
  BenchVerifyRequest request{.folder = run, .suite = Path("suite.json").string()};
  request.entry = Path("entry.json");
  request.sample = 0;
  EXPECT_THAT(VerifyBench(request).findings, IsEmpty());
  Write(Path("entry.json"), R"({"name": "mine", "navigator": "pathfinder"})");
  EXPECT_THAT(VerifyBench(request).findings, ElementsAre("the entry is not the one that drove"));
  core::JsonValue document = core::ParseJson(Read(run / kBenchFile), kBenchFile);
  document.Find("entry")->Set("name", core::JsonValue("another"));
  Write(run / kBenchFile, core::DumpJson(document));
  EXPECT_THAT(Verify(run, 0).findings, ElementsAre("bench.json is not what its chain begins with"));
}

TEST_F(BenchVerify, WhatIsSetAsideStays) {
  const std::string head = ReadBenchRun(Driven()).head;
  BenchRequest request = Request("run");
  request.campaign.trials = 2;
  request.campaign.existing = ExistingRun::kSetAside;
  ASSERT_EQ(RunBench(request).outcome, Outcome::kDone);
  EXPECT_THAT(Read(Path("run/bench.json.old-1")), HasSubstr(head));
  EXPECT_TRUE(fs::exists(Path("run/actions.old-1")));
  EXPECT_THAT(Verify(Path("run")).findings, IsEmpty());
}

TEST_F(BenchVerify, ResumingGivesTheSameHead) {
  const std::string head = ReadBenchRun(Driven()).head;
  BenchRequest request = Request("again");
  request.campaign.trials = 2;
  ASSERT_EQ(RunBench(request).outcome, Outcome::kDone);
  EXPECT_NE(ReadBenchRun(Path("again")).head, head);
  request.campaign.trials = 3;
  request.campaign.existing = ExistingRun::kResume;
  ASSERT_EQ(RunBench(request).outcome, Outcome::kDone);
  EXPECT_EQ(ReadBenchRun(Path("again")).head, head);
}

TEST_F(BenchVerify, OneBitOfOneRecord) {
  const fs::path forged =
      Forge(Driven(), "forged", [](std::size_t cell, std::vector<truth::Record>& records) {
        if (cell == 1) FlipLowestBit(records[2].values[0]);
      });
  EXPECT_THAT(Verify(forged, 0).findings,
              ElementsAre("trial 2 of near/many is not the drive that the chain holds"));
  LinkAnew(forged);
  EXPECT_THAT(Verify(forged, 0).findings, IsEmpty()) << "a chain alone holds nobody who makes it";
  EXPECT_THAT(Verify(forged).findings,
              ElementsAre(HasSubstr("trial 2 of near/many is another one")));
}

TEST_F(BenchVerify, OneBitOfOneAction) {
  const fs::path run = Driven();
  const batch::CellIdentity& cell = batch::ResultStore::Read(run).identity().cells.at(2);
  const fs::path file = run / ActionFile(2, cell.name, NavigatorSeed(4, 1));
  std::string log = Read(file);
  log.at(log.size() / 2) ^= 1;
  Write(file, log);
  EXPECT_THAT(Verify(run, 0).findings,
              ElementsAre("trial 1 of slow/few is not the drive that the chain holds"));
}

TEST_F(BenchVerify, DrivesOfOtherLayoutsInTheirPlace) {
  // The best drive of a cell for all of its layouts.
  const fs::path run = Driven();
  const fs::path forged =
      Forge(run, "forged", [](std::size_t cell, std::vector<truth::Record>& records) {
        if (cell != 0) return;
        records[1].outcome = records[0].outcome;
        records[1].values = records[0].values;
      });
  fs::copy_file(forged / ActionFile(0, "near/few", NavigatorSeed(4, 0)),
                forged / ActionFile(0, "near/few", NavigatorSeed(4, 1)),
                fs::copy_options::overwrite_existing);
  LinkAnew(forged);
  EXPECT_THAT(Verify(forged).findings, Contains(HasSubstr("trial 1 of near/few is another one")));
}

TEST_F(BenchVerify, AnEasierSuite) {
  const fs::path forged =
      Forge(Driven(), "forged", kUnchanged, [](batch::CampaignIdentity& identity) {
        std::string& resolved = identity.cells.at(1).resolved;
        const std::string rocks = "\"k_per_m2\": 0.02";
        resolved.replace(resolved.find(rocks), rocks.size(), "\"k_per_m2\": 0.01");
        identity.cells.at(1).fingerprint =
            batch::ResolvedFingerprint(core::ParseJson(resolved, "resolved"));
      });
  LinkAnew(forged);
  EXPECT_THAT(Verify(forged, 0).findings,
              Contains(HasSubstr("terrain.rocks.k_per_m2 is 0.01, and 0.02 in the suite")));
}

TEST_F(BenchVerify, AnotherSeedThanTheBeacons) {
  BenchRequest request = Request("run");
  request.beacon = "round 1";
  ASSERT_EQ(RunBench(request).outcome, Outcome::kDone);
  EXPECT_THAT(Verify(Path("run"), 0).findings, IsEmpty());
  core::JsonValue document = core::ParseJson(Read(Path("run") / kBenchFile), kBenchFile);
  document.Set("beacon", core::JsonValue("round 2"));
  Write(Path("run") / kBenchFile, core::DumpJson(document));
  EXPECT_THAT(Verify(Path("run"), 0).findings, Contains("the seed is not that of the beacon"));
}

TEST_F(BenchVerify, AChainThatIsCutOff) {
  const fs::path run = Driven();
  std::string chain = Read(run / kChainFile);
  chain.resize(chain.rfind('\n', chain.size() - 2) + 1);
  Write(run / kChainFile, chain);
  EXPECT_THAT(Verify(run, 0).findings,
              ElementsAre(HasSubstr("does not end with the head"), HasSubstr("has 8 links")));
}

TEST_F(BenchVerify, ActionsThatAreMissingEndTheRun) {
  const fs::path run = Driven();
  fs::remove(run / ActionFile(0, "near/few", NavigatorSeed(4, 1)));
  BenchRequest request = Request("run");
  request.campaign.existing = ExistingRun::kResume;
  const WorkResult result = RunBench(request);
  EXPECT_EQ(result.outcome, Outcome::kFailed);
  ASSERT_EQ(result.problems.size(), 1u);
  EXPECT_THAT(result.problems[0].reason, HasSubstr("trial 1 of near/few were not written"));
}

TEST_F(BenchVerify, BadInputSetsNothingAside) {
  const std::string head = ReadBenchRun(Driven()).head;
  BenchRequest request = Request("run");
  Write(Path("entry.json"), R"({"name": "mine", "navigator": "pathfinder",
                                "set": {"navigation.pathfinder.no_such_key": 2}})");
  request.campaign.existing = ExistingRun::kSetAside;
  const WorkResult result = RunBench(request);
  EXPECT_EQ(result.outcome, Outcome::kBadInput);
  EXPECT_EQ(result.problems.at(0).path,
            Path("entry.json").string() + ": navigation.pathfinder.no_such_key");
  EXPECT_EQ(ReadBenchRun(Path("run")).head, head);
}

TEST_F(BenchVerify, WhatDiffersFromTheRunThatIsResumedIsNamed) {
  Driven();
  BenchRequest request = Request("run");
  request.campaign.existing = ExistingRun::kResume;
  const auto named = [](const BenchRequest& wanted) {
    const WorkResult result = RunBench(wanted);
    EXPECT_EQ(result.outcome, Outcome::kBadInput);
    return result.problems.empty() ? std::string() : result.problems[0].path;
  };
  request.beacon = "round 1";
  EXPECT_EQ(named(request), "--beacon");
  request.beacon.clear();
  request.campaign.program = "another";
  EXPECT_EQ(named(request), "this program");
  request.campaign.program.clear();
  EXPECT_EQ(RunBench(request).outcome, Outcome::kDone);
  Write(Path("entry.json"), R"({"name": "mine", "navigator": "pathfinder"})");
  EXPECT_EQ(named(request), Path("entry.json").string());
}

TEST_F(BenchVerify, ASeedThatWasLookedForByTheSuitesDigest) {
  BenchRequest request = Request("run");
  request.beacon = "round 1";
  ASSERT_EQ(RunBench(request).outcome, Outcome::kDone);
  core::JsonValue document = core::ParseJson(Read(Path("run") / kBenchFile), kBenchFile);
  document.Set("suite_digest", core::JsonValue("any other"));
  Write(Path("run") / kBenchFile, core::DumpJson(document));
  EXPECT_THAT(Verify(Path("run"), 0).findings, Contains("the digest of the suite is another one"));
}

// P(no invented drive among n of N) by factorials.
TEST(BenchChance, IsThatOfDrawingWithoutReplacement) {
  BenchVerification found;
  found.drives = 2000;
  found.driven_again = 300;
  const auto log_choose = [](double n, double k) {
    return std::lgamma(n + 1) - std::lgamma(k + 1) - std::lgamma(n - k + 1);
  };
  EXPECT_NEAR(found.ChanceToMiss(0.01), std::exp(log_choose(1980, 300) - log_choose(2000, 300)),
              1e-9);
  EXPECT_LT(found.ChanceToMiss(0.01), 0.05);
}

// By hashlib of Python.
TEST(BeaconSeed, IsTheHeadOfADigest) {
  EXPECT_EQ(BeaconSeed("suite", "round 1"), 1102378535974949734);
  EXPECT_NE(BeaconSeed("suite", "round 2"), BeaconSeed("suite", "round 1"));
  EXPECT_NE(BeaconSeed("other", "round 1"), BeaconSeed("suite", "round 1"));
}

}  // namespace
}  // namespace rockyard::campaign
