// The parts of the module, each in the file of its name; module.cc puts them together. What they
// bind is private to the package: rockyard/*.py is what users see, and _core.pyi says the types.
// Paths come as texts: pybind11's reader of paths calls Python, and takes an interrupt there for a
// wrong type.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <span>
#include <string>
#include <vector>

#include "api/scenario.h"
#include "truth/record.h"

namespace rockyard::python {

// Each adds its functions and classes.
void BindScenarios(pybind11::module_& module);    // Scenario, names of files
void BindNavigators(pybind11::module_& module);   // Scenario.add_navigator
void BindEstimators(pybind11::module_& module);   // Scenario.add_estimator
void BindCampaigns(pybind11::module_& module);    // run, sweep, merge, report, check, compare
void BindStores(pybind11::module_& module);       // records, traces
void BindPlaces(pybind11::module_& module);       // terrain, images
void BindMobility(pybind11::module_& module);     // slopes and steps of a rover
void BindRates(pybind11::module_& module);        // rates, intervals, tests
void BindWheels(pybind11::module_& module);       // one wheel on soil
void BindElementary(pybind11::module_& module);   // elementary functions of trials
void BindEnvironment(pybind11::module_& module);  // drives whose navigator is the caller

// A scenario with the navigators and estimators that Python has added.
struct OpenScenario {
  api::Scenario values;
  std::string program = {};  // what those are known by (api::RunRequest::program); "": none

  // Takes note of one more that decides: "mine 1.0 <hash>".
  void AddProgram(const std::string& identity) {
    program += (program.empty() ? "" : ", ") + identity;
  }
};

// Returns the class `Scenario`, to which several parts add.
pybind11::class_<OpenScenario>& ScenarioClass(pybind11::module_& module);

// Returns a copy of the values as an array of that shape.
template <typename Value>
pybind11::array_t<Value> ArrayOf(std::span<const Value> values,
                                 std::vector<pybind11::ssize_t> shape) {
  return pybind11::array_t<Value>(std::move(shape), values.data());
}

// Returns the columns as a list of (name, unit, meaning).
pybind11::list ColumnsOf(const truth::RecordSchema& schema);

// Returns a record as a dict: trial, outcome, detail, values (a NaN for each column where there are
// none).
pybind11::dict RecordOf(const truth::Record& record, std::size_t columns);

}  // namespace rockyard::python
