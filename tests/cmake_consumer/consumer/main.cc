// Drives one trial of the default scenario through an installed rockyard, twice: the same record.
// Then runs, repeats and compares a campaign of two trials in the folder that it is given.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "api/campaign.h"
#include "api/scenario.h"
#include "campaign/replay.h"
#include "truth/record.h"

namespace {

using namespace rockyard;

bool SameTwice() {
  const auto experiment = api::Scenario().MakeExperiment();
  const truth::Record first = experiment->Run(1, 0);
  const truth::Record again = experiment->Run(1, 0);
  const auto equal = [](double a, double b) { return a == b || (a != a && b != b); };
  return first.values.size() == experiment->schema().size() &&
         std::equal(first.values.begin(), first.values.end(), again.values.begin(),
                    again.values.end(), equal) &&
         first.outcome == again.outcome && !truth::IsFault(first);
}

bool ReadsBack() {
  api::Scenario scenario;
  scenario.Set("terrain.rocks.kind=none");
  return api::Scenario::Parse(scenario.ResolvedJson()).ResolvedJson() == scenario.ResolvedJson() &&
         scenario.ResolvedJson() != api::Scenario().ResolvedJson();
}

bool RefusesWhatIsWrong() {
  try {
    api::Scenario().Set("no.such.path=1");
  } catch (const core::UserError& error) {
    return error.problems().size() == 1;
  }
  return false;
}

// Two trials, gone on with to three, against themselves, and one of them again.
bool Campaigns(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "scenario.json";
  std::ofstream(file)
      << R"({"rover": {"fidelity": "quasi_static"}, "terrain": {"rocks": {"kind": "none"}},
                             "course": {"start_x_m": 1.0, "goal_x_m": 2.0}, "trials": 2})";
  std::int64_t finished = 0;
  api::RunRequest request{.source = file, .folder = folder / "run"};
  request.progress = [&](std::int64_t now, std::int64_t) { finished = now; };
  const bool ran = api::Run(request).outcome == campaign::Outcome::kDone && finished == 2;
  const bool refused = api::Run(request).outcome == campaign::Outcome::kBadInput;
  request.trials = 3;
  request.existing = campaign::ExistingRun::kResume;
  const bool extended = api::Run(request).trials.finished == 3;
  const api::Finding found = api::Compare({.first = request.folder, .second = request.folder});
  const bool compared = found.outcome == campaign::Outcome::kDone && found.json.front() == '{';
  const campaign::ReplayResult shown =
      campaign::Replay({.trial = {.source = request.folder.string(), .trial = 1},
                        .page = (folder / "page.html").string()});
  return ran && refused && extended && compared && shown.repeats_stored.value_or(false);
}

}  // namespace

int main(int, char** arguments) {
  const bool ok = SameTwice() && ReadsBack() && RefusesWhatIsWrong() && Campaigns(arguments[1]);
  std::puts(ok ? "consumer: ok" : "consumer: failed");
  return ok ? 0 : 1;
}
