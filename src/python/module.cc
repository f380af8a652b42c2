#include "python/errors.h"
#include "python/parts.h"

// NOLINTNEXTLINE(readability-identifier-naming): the name of the file
PYBIND11_MODULE(_core, module) {
  namespace python = rockyard::python;
  module.doc() = "The compiled part of rockyard; the package is what is documented.";
  module.attr("version") = ROCKYARD_VERSION;
  python::BindErrors(module);
  python::BindScenarios(module);
  python::BindNavigators(module);
  python::BindEstimators(module);
  python::BindCampaigns(module);
  python::BindStores(module);
  python::BindPlaces(module);
  python::BindMobility(module);
  python::BindRates(module);
  python::BindWheels(module);
  python::BindElementary(module);
  python::BindEnvironment(module);
  // While there still is an interpreter for the threads that wait.
  pybind11::module_::import("atexit").attr("register")(module.attr("end_work"));
}
