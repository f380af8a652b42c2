#include <pybind11/stl.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "api/campaign.h"
#include "campaign/plugin_settings.h"
#include "campaign/replay.h"
#include "campaign/run.h"
#include "core/error.h"
#include "python/errors.h"
#include "python/parts.h"
#include "python/waiting.h"

namespace rockyard::python {
namespace {

namespace py = pybind11;
using campaign::CampaignRequest;
using campaign::WorkResult;

// What running a scenario and running a sweep take alike.
struct RunOptions {
  std::string source;
  std::vector<std::string> overrides;
  std::vector<std::string> ablations;
  std::optional<std::int64_t> trials;
  std::optional<std::int64_t> seed;
  std::string folder;
  std::string existing;
  std::string shard;
  int threads = 0;
  double max_fault_fraction = 0.01;
  std::vector<std::string> traces;
  std::optional<double> half_width;
  // In a worker process, and again after a crash: where libraries of plugins decide.
  bool supervised = false;
};

campaign::ExistingRun ExistingOf(const std::string& existing) {
  if (existing == "refuse") return campaign::ExistingRun::kRefuse;
  if (existing == "resume") return campaign::ExistingRun::kResume;
  if (existing == "set_aside") return campaign::ExistingRun::kSetAside;
  if (existing == "resume_or_set_aside") return campaign::ExistingRun::kResumeOrSetAside;
  throw core::UserError("existing", "is \"" + existing + "\"",
                        "use refuse, resume, set_aside or resume_or_set_aside");
}

CampaignRequest RequestOf(const RunOptions& options, const OpenScenario& defaults) {
  CampaignRequest request{.trials = options.trials,
                          .seed = options.seed,
                          .overrides = options.overrides,
                          .folder = options.folder,
                          .existing = ExistingOf(options.existing),
                          .shard = options.shard,
                          .max_fault_fraction = options.max_fault_fraction,
                          .defaults = defaults.values.values(),
                          .program = defaults.program};
  if (options.half_width) request.rule = {.half_width = *options.half_width};
  if (options.supervised) request.containment = {};
  request.containment.threads = options.threads;
  request.traces.rules = options.traces;
  return request;
}

// Returns what came of work as (outcome, folder, notes, problems, (planned, finished, faults)).
py::tuple Told(const WorkResult& result) {
  py::list notes;
  for (const campaign::Note& note : result.notes) {
    notes.append(py::make_tuple(note.kind == campaign::NoteKind::kWarning, note.text));
  }
  return py::make_tuple(
      static_cast<int>(result.outcome), result.folder.string(), notes,
      ProblemsToPython(result.problems),
      py::make_tuple(result.trials.planned, result.trials.finished, result.trials.faults));
}

// Does the work of a request, which it owns, while Python listens.
WorkResult Awaited(
    const CampaignRequest& request,
    const std::function<WorkResult(const campaign::RunObserver&, const campaign::Stop&)>& work,
    const py::object& progress) {
  const auto result = std::make_shared<WorkResult>();
  const bool decides = !request.program.empty();  // Python, in workers too
  const bool forks = decides && request.containment.supervisor;
  Await(
      [result, forks, work](const Contact& contact) {
        std::optional<ForksWithPython> with_python;
        if (forks) with_python.emplace();
        campaign::RunObserver observer;
        observer.trials = [&contact](const batch::Progress& told, campaign::Moment) {
          contact.SetProgress(told.finished, told.planned);
        };
        *result = work(observer, {.wanted = [&contact] { return contact.stop_wanted(); }});
      },
      progress);
  return std::move(*result);
}

// Returns what a function without progress gives, without the interpreter's lock meanwhile.
template <typename Work>
auto WithoutLock(const Work& work) {
  const py::gil_scoped_release released;
  return work();
}

void BindRuns(py::module_& module) {
  py::class_<RunOptions>(module, "RunOptions")
      .def(py::init())
      .def_readwrite("source", &RunOptions::source)
      .def_readwrite("overrides", &RunOptions::overrides)
      .def_readwrite("ablations", &RunOptions::ablations)
      .def_readwrite("trials", &RunOptions::trials)
      .def_readwrite("seed", &RunOptions::seed)
      .def_readwrite("folder", &RunOptions::folder)
      .def_readwrite("existing", &RunOptions::existing)
      .def_readwrite("shard", &RunOptions::shard)
      .def_readwrite("threads", &RunOptions::threads)
      .def_readwrite("max_fault_fraction", &RunOptions::max_fault_fraction)
      .def_readwrite("traces", &RunOptions::traces)
      .def_readwrite("half_width", &RunOptions::half_width)
      .def_readwrite("supervised", &RunOptions::supervised);
  module.def("run", [](const RunOptions& options, const OpenScenario& defaults,
                       const py::object& progress) {
    const campaign::RunRequest request{.source = options.source,
                                       .ablations = options.ablations,
                                       .campaign = RequestOf(options, defaults)};
    return Told(Awaited(
        request.campaign,
        [request](const auto& observer, const auto& stop) {
          return campaign::Run(request, observer, stop);
        },
        progress));
  });
  module.def("sweep", [](const RunOptions& options, const OpenScenario& defaults,
                         const py::object& progress) {
    const campaign::SweepRequest request{.file = options.source,
                                         .campaign = RequestOf(options, defaults)};
    return Told(Awaited(
        request.campaign,
        [request](const auto& observer, const auto& stop) {
          return campaign::RunSweep(request, observer, stop);
        },
        progress));
  });
  module.def("end_work", &EndWork);
  module.def("plugin_settings", [](const std::vector<std::string>& libraries,
                                   const std::vector<std::string>& processes) {
    return WithoutLock(
        [&] { return campaign::SettingsOf({.libraries = libraries, .processes = processes}); });
  });
  module.def("merge",
             [](const std::vector<std::string>& shards, const std::string& folder, bool partial) {
               return Told(WithoutLock([&] {
                 return api::Merge({.shards = {shards.begin(), shards.end()},
                                    .folder = folder,
                                    .partial = partial,
                                    .observer = {}});
               }));
             });
}

}  // namespace

void BindCampaigns(py::module_& module) {
  BindRuns(module);
  module.def(
      "report",
      [](const std::vector<std::string>& runs, const std::string& cell, const std::string& page,
         const std::string& title, std::size_t replays, std::size_t tracks) {
        api::ReportRequest request{.runs = runs,
                                   .cell = cell,
                                   .page = page,
                                   .title = title,
                                   .replays = replays,
                                   .tracks = tracks};
        const auto result = std::make_shared<WorkResult>();
        Await(
            [result, request](const Contact& contact) mutable {
              request.stop = [&contact] { return contact.stop_wanted(); };
              *result = api::Report(request);
            },
            py::none());
        return Told(*result);
      },
      py::arg("runs"), py::arg("cell"), py::arg("page"), py::arg("title"), py::arg("replays"),
      py::arg("tracks"));
  const auto found = [](const api::Finding& finding) {
    return py::make_tuple(static_cast<int>(finding.outcome), finding.json);
  };
  module.def("check", [found](const std::vector<std::string>& runs, const std::string& reference,
                              const std::string& cell) {
    return found(WithoutLock(
        [&] { return api::Check({.runs = runs, .reference = reference, .cell = cell}); }));
  });
  module.def("compare", [found](const std::string& first, const std::string& second,
                                const std::string& cell, const std::string& second_cell) {
    return found(WithoutLock([&] {
      return api::Compare(
          {.first = first, .second = second, .cell = cell, .second_cell = second_cell});
    }));
  });
  module.def("write_baseline", [](const std::vector<std::string>& runs, const std::string& file,
                                  const std::string& name, const std::string& reason) {
    WithoutLock([&] {
      api::WriteBaseline({.runs = runs, .file = file, .name = name, .reason = reason});
      return 0;
    });
  });
  module.def("replay", [](const std::string& source, const std::string& cell, std::uint32_t trial,
                          const std::string& page, const std::string& plan) {
    campaign::ReplayRequest request{
        .trial = {.source = source, .cell = cell, .trial = trial}, .page = page, .plan = plan};
    const campaign::ReplayResult result = WithoutLock([&] { return campaign::Replay(request); });
    return Told(result);
  });
}

}  // namespace rockyard::python
