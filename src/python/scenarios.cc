#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "campaign/run_source.h"
#include "campaign/scenario_names.h"
#include "python/parts.h"

namespace rockyard::python {

namespace py = pybind11;

py::class_<OpenScenario>& ScenarioClass(py::module_& module) {
  static py::class_<OpenScenario>& made = *new py::class_<OpenScenario>(module, "Scenario");
  return made;
}

py::list ColumnsOf(const truth::RecordSchema& schema) {
  py::list columns;
  for (const truth::ValueInfo& column : schema) {
    columns.append(py::make_tuple(column.name, column.unit, column.meaning));
  }
  return columns;
}

py::dict RecordOf(const truth::Record& record, std::size_t columns) {
  std::vector<double> values(record.values.begin(), record.values.end());
  values.resize(columns, std::numeric_limits<double>::quiet_NaN());
  py::dict dict;
  dict["trial"] = record.trial;
  dict["outcome"] = std::string(truth::Name(record.outcome));
  dict["detail"] = record.detail;
  dict["values"] = ArrayOf<double>(values, {static_cast<py::ssize_t>(columns)});
  return dict;
}

void BindScenarios(py::module_& module) {
  using campaign::Wanted;
  module.def("find", [](const std::string& word, const std::string& wanted) {
    const Wanted kind = wanted == "sweep"   ? Wanted::kSweep
                        : wanted == "rover" ? Wanted::kRover
                        : wanted == "any"   ? Wanted::kEither
                                            : Wanted::kScenario;
    return campaign::ScenarioFile(word, kind);
  });
  module.def("scenario_names", [] { return campaign::ScenarioNames(Wanted::kScenario); });
  module.def("sweep_names", [] { return campaign::ScenarioNames(Wanted::kSweep); });
  ScenarioClass(module)
      .def(py::init())
      .def_static(
          "load",
          [](const std::string& path, const std::vector<std::string>& overrides,
             const OpenScenario& defaults) {
            const py::gil_scoped_release released;
            return OpenScenario{api::Scenario::Load(path, overrides, defaults.values),
                                defaults.program};
          },
          py::arg("path"), py::arg("overrides"), py::arg("defaults"))
      .def_static(
          "parse",
          [](const std::string& text, const std::vector<std::string>& overrides,
             const std::string& folder, const OpenScenario& defaults) {
            const py::gil_scoped_release released;
            return OpenScenario{api::Scenario::Parse(text, overrides, folder, defaults.values),
                                defaults.program};
          },
          py::arg("text"), py::arg("overrides"), py::arg("folder"), py::arg("defaults"))
      .def("resolved",
           [](const OpenScenario& scenario) {
             const py::gil_scoped_release released;
             return scenario.values.ResolvedJson();
           })
      .def_property_readonly("name",
                             [](const OpenScenario& scenario) { return scenario.values.name(); })
      .def_property_readonly("trials",
                             [](const OpenScenario& scenario) { return scenario.values.trials(); })
      .def_property_readonly("seed",
                             [](const OpenScenario& scenario) { return scenario.values.seed(); })
      .def("columns",
           [](const OpenScenario& scenario) {
             return ColumnsOf([&] {
               const py::gil_scoped_release released;
               return campaign::ColumnsOf(scenario.values.values());
             }());
           })
      .def(
          "run_trial",
          [](const OpenScenario& scenario, std::uint64_t seed, std::uint64_t trial) {
            std::optional<truth::Record> record;
            std::size_t columns = 0;
            {
              const py::gil_scoped_release released;
              const auto experiment = scenario.values.MakeExperiment();
              record = experiment->Run(seed, trial);
              columns = experiment->schema().size();
            }
            return RecordOf(*record, columns);
          },
          py::arg("seed"), py::arg("trial"));
}

}  // namespace rockyard::python
