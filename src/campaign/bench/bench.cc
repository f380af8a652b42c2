#include "campaign/bench/bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <system_error>
#include <utility>

#include "batch/run_folder.h"
#include "campaign/bench/bench_chain.h"
#include "campaign/run_source.h"
#include "campaign/scenario_names.h"
#include "core/archive.h"
#include "core/digest.h"
#include "core/error.h"
#include "core/files.h"
#include "core/json_text.h"
#include "navigation/action_log.h"
#include "report/atomic_file.h"
#include "report/result_table.h"
#include "scenario/sweep.h"

namespace rockyard::campaign {
namespace {

namespace fs = std::filesystem;
using core::JsonValue;

std::string_view NameOf(BenchTrack track) {
  return core::EnumNames<BenchTrack>::kNames.at(static_cast<std::size_t>(track));
}

// Writes a log where a run keeps it. A log that cannot be written is missing when the run is
// closed, which says so: nothing can be thrown where a navigator ends.
void WriteActions(const fs::path& file, const std::string& log) {
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  std::ofstream stream(file, std::ios::binary | std::ios::trunc);
  stream.write(log.data(), static_cast<std::streamsize>(log.size()));
  stream.close();
  if (!stream) fs::remove(file, error);
}

// Renames what the benchmark has of a run whose store was set aside: NAME.old-1, ...
void SetAside(const fs::path& folder) {
  for (const char* name : {kBenchFile, kChainFile, "actions"}) {
    std::error_code error;
    if (!fs::exists(folder / name, error)) continue;
    int number = 1;
    while (fs::exists(folder / fmt::format("{}.old-{}", name, number), error)) ++number;
    fs::rename(folder / name, folder / fmt::format("{}.old-{}", name, number), error);
    if (error) core::FailOnDisk(folder / name, "cannot be renamed", error);
  }
}

// Throws where the navigator reads images and its entry says that it does not, or the other way.
void CheckReading(BenchTrack track, const navigation::NavigatorKind& kind) {
  const bool images = kind.traits().images;
  if (images == (track == BenchTrack::kImages)) return;
  throw core::UserError("track",
                        fmt::format("is {}, and the navigator {} {}", NameOf(track), kind.name(),
                                    images ? "asks for images" : "asks for no images"),
                        images ? "give the entry the track images, and drive on bench/images"
                               : "give the entry the track points, which drives on every suite");
}

// Throws where a suite does not show what the entry says that it reads.
void CheckTrack(BenchTrack track, const std::string& suite) {
  const auto& tracks = core::EnumNames<BenchTrack>::kNames;
  if (track == BenchTrack::kPoints || NameOf(track) == suite) return;
  if (std::ranges::find(tracks, suite) == tracks.end()) return;
  throw core::UserError(
      "track", fmt::format("is {}, and the suite is of {}", NameOf(track), suite),
      fmt::format("drive on bench/{}; entries of points drive on every suite", NameOf(track)));
}

// Returns the campaign of a request, whose navigators are recorded below `folder`.
CampaignRequest Recording(const BenchRequest& request, const BenchEntry& entry,
                          const fs::path& folder, std::optional<std::int64_t> seed) {
  CampaignRequest campaign = request.campaign;
  campaign.folder = folder;
  campaign.overrides = entry.settings;
  campaign.seed = seed;
  campaign.opened = [](const fs::path& opened, bool anew) {
    if (anew) SetAside(opened);
  };
  campaign.prepare = [folder = fs::absolute(folder), track = entry.manifest.track](
                         std::size_t index, CampaignCell& cell) {
    const auto write = [folder, index, name = cell.name](std::uint64_t random_seed,
                                                         const std::string& log) {
      WriteActions(folder / ActionFile(index, name, random_seed), log);
    };
    LeaveOut(track, cell.scenario);
    cell.scenario.drive.navigation.navigators.WrapChosen(
        [&](std::unique_ptr<navigation::NavigatorKind> kind) {
          CheckReading(track, *kind);
          return navigation::Recorded(std::move(kind), write);
        });
  };
  return campaign;
}

// Returns the problems of a suite with the settings of an entry as the entry's: without them the
// suite was sound.
std::vector<core::Problem> AsOfEntry(std::vector<core::Problem> problems, const fs::path& suite,
                                     const fs::path& manifest) {
  for (core::Problem& problem : problems) {
    const std::string before = suite.string() + ": ";
    if (!problem.path.starts_with(before)) continue;
    std::string path = problem.path.substr(before.size());
    constexpr std::string_view kCell = "cell ";
    const std::size_t end = path.find(": ");
    if (path.starts_with(kCell) && end != std::string::npos) path.erase(0, end + 2);
    problem.path = manifest.string() + ": " + path;
  }
  return problems;
}

// Throws where the run in the folder was begun with another seed, by another entry or program: what
// a store would say of it speaks of cells.
void CheckBegun(const BenchRequest& request, const BenchEntry& entry, const fs::path& folder,
                std::int64_t seed) {
  if (request.campaign.existing != ExistingRun::kResume || !batch::ResultStore::HasBegun(folder)) {
    return;
  }
  const batch::ResultStore store = batch::ResultStore::Read(folder);
  const batch::CampaignIdentity& begun = store.identity();
  constexpr const char* kElse =
      "choose another folder with --out, or start anew with --force and without --resume";
  const auto require = [&](bool same, const std::string& what, const std::string& reason) {
    if (!same) throw core::UserError(what, reason + " " + folder.string(), kElse);
  };
  require(begun.cells.front().seed == static_cast<std::uint64_t>(seed), "--beacon",
          "gives another seed than that of the run in");
  require(begun.settings == entry.settings, entry.file.string(),
          "is not the entry that began the run in");
  for (const std::string& build : store.Builds()) {
    require(build == BuildName(request.campaign.program), "this program",
            fmt::format("is {}, and another build, {}, began the run in",
                        BuildName(request.campaign.program), build));
  }
}

// Throws where the actions of a drive are not there that its navigator did not break off.
void RequireActions(const fs::path& folder, const batch::ResultStore& store) {
  for (std::size_t cell = 0; cell < store.identity().cells.size(); ++cell) {
    const batch::CellIdentity& identity = store.identity().cells[cell];
    for (const truth::Record& record : store.Load(static_cast<int>(cell))) {
      if (IsFault(record) || IsNavigatorCrash(record)) continue;
      if (!ReadActions(folder, cell, identity, record.trial).empty()) continue;
      throw core::MachineError(
          folder.string(),
          fmt::format("the actions of trial {} of {} were not written", record.trial,
                      identity.name),
          "check the free space and the rights of the folder, then run it again with --force");
    }
  }
}

void WriteBenchFiles(const BenchEntry& entry, const std::string& suite_digest,
                     const std::string& beacon, const fs::path& folder) {
  const batch::ResultStore store = batch::ResultStore::Read(folder);
  RequireActions(folder, store);
  JsonValue document = report::ObjectTree(
      "bench_version", kBenchVersion, "entry", entry.document, "entry_digest", entry.digest,
      "suite", store.identity().name, "suite_digest", suite_digest, "beacon", beacon, "seed",
      static_cast<std::int64_t>(store.identity().cells.front().seed), "layouts", store.planned());
  const std::string start = ChainStart(document, store);
  const std::vector<ChainLink> chain = MakeChain(folder, store, start);
  document.Set("start", JsonValue(start));
  document.Set("head", JsonValue(chain.back().digest));
  report::WriteFileAtomically(folder / kChainFile, ChainCsv(chain));
  report::WriteFileAtomically(folder / kBenchFile, core::DumpJson(document));
}

const std::string& TextIn(const JsonValue& document, const char* key, const std::string& file) {
  const JsonValue* found = document.Find(key);
  if (found == nullptr || !found->Is(JsonValue::Type::kText)) {
    throw core::UserError(file, fmt::format("has no text \"{}\"", key),
                          "take the file as `rockyard bench run` wrote it");
  }
  return found->text();
}

std::int64_t IntegerIn(const JsonValue& document, const char* key, const std::string& file) {
  const JsonValue* found = document.Find(key);
  if (found == nullptr || !found->Is(JsonValue::Type::kInteger)) {
    throw core::UserError(file, fmt::format("has no integer \"{}\"", key),
                          "take the file as `rockyard bench run` wrote it");
  }
  return found->integer();
}

}  // namespace

void LeaveOut(BenchTrack track, scenario::Scenario& cell) {
  if (track != BenchTrack::kMap) cell.drive.course.site_map.kind = trial::SiteMapKind::kNone;
}

std::string ChainStart(const JsonValue& document, const batch::ResultStore& store) {
  std::string text;
  for (const core::JsonMember& member : document.members()) {
    if (member.key == "start" || member.key == "head") continue;
    text += fmt::format("{}={}\n", member.key, core::CompactJson(member.value));
  }
  return core::Sha256(text + fmt::format("{}", fmt::join(store.Builds(), "\n")));
}

std::int64_t BeaconSeed(std::string_view suite_digest, std::string_view beacon) {
  const std::string digest =
      core::Sha256(fmt::format("rockyard bench {}\n{}\n{}\n", kBenchVersion, suite_digest, beacon));
  return static_cast<std::int64_t>(std::stoull(digest.substr(0, 16), nullptr, 16) >> 2);
}

WorkResult RunBench(const BenchRequest& request, const RunObserver& observer, const Stop& stop) {
  std::optional<BenchEntry> entry;
  SweepRequest sweep;
  std::string suite_digest;
  WorkResult result = Recorded(observer, [&](Journal&) {
    entry = ReadEntry(request.entry);
    sweep.file = ScenarioFile(request.suite, Wanted::kSweep);
    const scenario::Sweep suite = scenario::LoadSweep(sweep.file, {.sealed = true});
    suite_digest = core::Sha256(suite.document);
    if (!suite.common_random_numbers) {
      throw core::UserError(sweep.file.string(), "has no common_random_numbers",
                            "take a suite of the benchmark, such as bench/points");
    }
    CheckTrack(entry->manifest.track, suite.name);
    std::optional<std::int64_t> seed;
    if (!request.beacon.empty()) seed = BeaconSeed(suite_digest, request.beacon);
    const fs::path folder =
        !request.campaign.folder.empty()
            ? request.campaign.folder
            : DefaultFolder(fmt::format("bench-{}-{}", suite.name, entry->manifest.name),
                            seed.value_or(static_cast<std::int64_t>(suite.seed)));
    CheckBegun(request, *entry, folder, seed.value_or(static_cast<std::int64_t>(suite.seed)));
    sweep.campaign = Recording(request, *entry, folder, seed);
    return Outcome::kDone;
  });
  if (result.outcome != Outcome::kDone) return result;
  RunObserver told = observer;
  if (told.problems) {
    told.problems = [&](const std::vector<core::Problem>& problems) {
      observer.problems(AsOfEntry(problems, sweep.file, entry->file));
    };
  }
  result = RunSweep(sweep, told, stop);
  result.problems = AsOfEntry(std::move(result.problems), sweep.file, entry->file);
  if (result.outcome != Outcome::kDone || !IsFirstRank()) return result;
  const WorkResult closed = Recorded(observer, [&](Journal&) {
    WriteBenchFiles(*entry, suite_digest, request.beacon, sweep.campaign.folder);
    return Outcome::kDone;
  });
  result.outcome = closed.outcome;
  result.problems.insert(result.problems.end(), closed.problems.begin(), closed.problems.end());
  return result;
}

BenchRun ReadBenchRun(const fs::path& folder) {
  const std::string file = (folder / kBenchFile).string();
  constexpr std::size_t kMaxBytes = 1 << 24;
  BenchRun run;
  run.folder = folder;
  std::error_code error;
  if (!fs::exists(file, error)) {
    throw core::UserError(folder.string(), "holds no finished run of an entry",
                          batch::HoldsStore(folder)
                              ? "go on with `rockyard bench run ENTRY --out FOLDER --resume`"
                              : "name the folder that `rockyard bench run` wrote");
  }
  run.document = core::ParseJson(
      core::ReadTextFile(file, kMaxBytes, "bench.json of a finished bench run"), file);
  const std::int64_t version = IntegerIn(run.document, "bench_version", file);
  if (version != kBenchVersion) {
    throw core::UserError(file, fmt::format("is of version {} of the benchmark", version),
                          fmt::format("this program knows version {}", kBenchVersion));
  }
  const JsonValue* entry = run.document.Find("entry");
  if (entry == nullptr) {
    throw core::UserError(file, "has no \"entry\"",
                          "take the file as `rockyard bench run` wrote it");
  }
  core::ReadParams(*entry, run.manifest, {"set"});
  run.entry_digest = TextIn(run.document, "entry_digest", file);
  run.suite = TextIn(run.document, "suite", file);
  run.suite_digest = TextIn(run.document, "suite_digest", file);
  run.beacon = TextIn(run.document, "beacon", file);
  run.start = TextIn(run.document, "start", file);
  run.head = TextIn(run.document, "head", file);
  run.seed = IntegerIn(run.document, "seed", file);
  run.layouts = IntegerIn(run.document, "layouts", file);
  return run;
}

}  // namespace rockyard::campaign
