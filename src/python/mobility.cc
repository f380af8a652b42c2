#include "campaign/mobility/mobility.h"

#include <pybind11/stl.h>

#include <memory>
#include <string>
#include <vector>

#include "campaign/mobility/mobility_charts.h"
#include "campaign/mobility/mobility_files.h"
#include "core/json_text.h"
#include "python/parts.h"
#include "python/waiting.h"

namespace rockyard::python {
namespace {

namespace py = pybind11;

// What a study gives Python: its outcome, its JSON and its charts.
struct Study {
  int outcome = 0;
  std::string json;
  std::string svg;
};

Study Studied(const campaign::MobilityRequest& request, const py::object& progress) {
  const auto study = std::make_shared<Study>();
  Await(
      [study, request](const Contact& contact) {
        const campaign::MobilityResult result = campaign::StudyMobility(
            request,
            [&contact](std::size_t done, std::size_t planned) {
              contact.SetProgress(static_cast<std::int64_t>(done),
                                  static_cast<std::int64_t>(planned));
            },
            {.wanted = [&contact] { return contact.stop_wanted(); }, .watch = {}});
        study->outcome = static_cast<int>(result.outcome);
        if (result.outcome != campaign::Outcome::kDone) return;
        study->json = core::DumpJson(campaign::MobilityJson(request, result, {}));
        study->svg = campaign::MobilitySvg(request, result);
      },
      progress);
  return *study;
}

}  // namespace

void BindMobility(py::module_& module) {
  module.def(
      "mobility",
      [](const std::string& rover, const std::vector<std::string>& overrides,
         const std::vector<std::string>& soils, const std::vector<double>& loads,
         const std::vector<double>& slopes_deg, double slip_limit, int draws, std::uint64_t seed,
         bool steps, bool multibody, const std::string& points, int threads,
         const py::object& progress) {
        const Study study = Studied(
            {.rover = rover,
             .overrides = overrides,
             .soils = soils,
             .loads = loads,
             .slopes_deg = slopes_deg,
             .slip_limit = slip_limit,
             .draws = draws,
             .seed = seed,
             .steps = steps,
             .fidelity = multibody ? rover::Fidelity::kMultibody : rover::Fidelity::kQuasiStatic,
             .points = points,
             .threads = threads},
            progress);
        return py::make_tuple(study.outcome, study.json, study.svg);
      },
      py::arg("rover"), py::arg("overrides"), py::arg("soils"), py::arg("loads"),
      py::arg("slopes_deg"), py::arg("slip_limit"), py::arg("draws"), py::arg("seed"),
      py::arg("steps"), py::arg("multibody"), py::arg("points"), py::arg("threads"),
      py::arg("progress"));
}

}  // namespace rockyard::python
