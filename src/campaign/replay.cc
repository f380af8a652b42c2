#include "campaign/replay.h"

#include <fmt/format.h>

#include <functional>
#include <optional>

#include "campaign/open_run.h"
#include "campaign/output_folder.h"
#include "campaign/replay_page.h"
#include "core/error.h"
#include "report/atomic_file.h"
#include "web/page.h"

namespace rockyard::campaign {
namespace {

namespace fs = std::filesystem;

// What was driven: the trial, and the one beside it where that is asked for.
struct Replayed {
  ReplayedTrial trial;
  std::optional<ReplayedTrial> beside = {};

  const ReplayedTrial* second() const { return beside ? &*beside : nullptr; }
  std::string title() const {
    return beside ? fmt::format("{}, and {}", trial.data.title, beside->data.title)
                  : trial.data.title;
  }
  std::string payload() const { return ReplayPayload(trial, second()); }
};

// One file that is asked for.
struct AskedFile {
  std::string option;  // that names it
  std::string what;
  fs::path path;
  std::function<std::string(const Replayed&)> text;
};

std::string DefaultStem(const TrialSource& source, std::uint32_t trial) {
  const std::string cell = source.cell.empty() ? "" : fmt::format("-{}", source.cell);
  const fs::path folder =
      DefaultFolder(source.scenario.name + cell, static_cast<std::int64_t>(source.seed));
  return fmt::format("{}-trial{}", folder.string(), trial);
}

std::vector<AskedFile> OutputsOf(const ReplayRequest& request, const TrialSource& source) {
  const std::string stem = request.page.empty()
                               ? DefaultStem(source, request.trial.trial)
                               : fs::path(request.page).replace_extension().string();
  const auto path = [&](const std::string& asked, const char* extension) {
    return asked.empty() ? fs::path(stem + extension) : fs::path(asked);
  };
  std::vector<AskedFile> outputs;
  outputs.push_back(
      {"--out", "3-D replay", path(request.page, ".html"), [](const Replayed& replayed) {
         return web::MakePage(web::Page::kReplay, replayed.title(), replayed.payload());
       }});
  outputs.push_back({"--svg", "plan view", path(request.plan, ".svg"),
                     [](const Replayed& replayed) { return replayed.trial.plan_svg; }});
  if (!request.data.empty()) {
    outputs.push_back({"--data", "data of the page", path(request.data, ".json"),
                       [](const Replayed& replayed) { return replayed.payload(); }});
  }
  return outputs;
}

// Found before the drive rather than after it.
void CheckOutputs(const ReplayRequest& request, const std::vector<AskedFile>& outputs) {
  CheckOutputFile("--out", request.page);
  CheckExtension("--out", request.page, ".html");
  CheckOutputFile("--svg", request.plan);
  CheckOutputFile("--data", request.data);
  std::vector<NamedFile> files;
  files.reserve(outputs.size());
  for (const AskedFile& output : outputs) files.push_back({output.option, output.path.string()});
  CheckDistinct(files);
}

// False where one cannot be written.
bool WriteOutputs(const std::vector<AskedFile>& outputs, const Replayed& replayed, Journal& journal,
                  std::vector<ReplayFile>& files) {
  try {
    for (const AskedFile& output : outputs) {
      if (output.path.has_parent_path()) fs::create_directories(output.path.parent_path());
      report::WriteFileAtomically(output.path, output.text(replayed));
      files.push_back({output.what, output.path});
    }
    return true;
  } catch (const core::UserError& failure) {
    journal.Fail(failure.problems());
  } catch (const fs::filesystem_error& failure) {
    journal.Fail(
        {{failure.path1().string(), failure.code().message(), "name another file with --out"}});
  }
  return false;
}

// Drives it again; the differences from its stored record, where it has one, are told.
ReplayedTrial DriveAgain(const TrialRequest& request, const TrialSource& source, Journal& journal,
                         std::optional<bool>& repeats_stored) {
  ReplayedTrial replayed = ReplayTrial(source, request.trial);
  if (!source.stored) return replayed;
  const auto differences =
      CompareWithStore(request, source, replayed.data.schema, replayed.data.record);
  repeats_stored = repeats_stored.value_or(true) && differences.empty();
  journal.Fail(differences);
  return replayed;
}

Outcome DriveAndWrite(const ReplayRequest& request, Journal& journal, ReplayResult& result) {
  const TrialSource source = FindTrial(request.trial);
  const std::optional<TrialSource> beside =
      request.beside ? std::optional(FindTrial(*request.beside)) : std::nullopt;
  const std::vector<AskedFile> outputs = OutputsOf(request, source);
  CheckOutputs(request, outputs);
  Replayed replayed{.trial = DriveAgain(request.trial, source, journal, result.repeats_stored)};
  if (beside) {
    replayed.beside = DriveAgain(*request.beside, *beside, journal, result.repeats_stored);
  }
  result.title = replayed.title();
  result.record = replayed.trial.data.record;
  if (!WriteOutputs(outputs, replayed, journal, result.files)) return Outcome::kFailed;
  return result.repeats_stored.value_or(true) ? Outcome::kDone : Outcome::kDiffers;
}

}  // namespace

ReplayResult Replay(const ReplayRequest& request, const Observer& observer) {
  ReplayResult result;
  static_cast<WorkResult&>(result) =
      Recorded(observer, [&](Journal& journal) { return DriveAndWrite(request, journal, result); });
  return result;
}

}  // namespace rockyard::campaign
