#include "python/errors.h"

#include <exception>

namespace rockyard::python {

namespace py = pybind11;

namespace {

py::object NamedInErrors(const char* name) {
  return py::module_::import("rockyard.errors").attr(name);
}

void Raise(const char* type, const core::UserError& error) {
  const py::object kind = NamedInErrors(type);
  PyErr_SetObject(kind.ptr(), kind(ProblemsToPython(error.problems())).ptr());
}

}  // namespace

py::list ProblemsToPython(const std::vector<core::Problem>& problems) {
  const py::object make = NamedInErrors("Problem");
  py::list list;
  for (const core::Problem& problem : problems) {
    list.append(make(problem.path, problem.reason, problem.suggestion));
  }
  return list;
}

std::string TextOf(const py::error_already_set& error) {
  const py::object trace = error.trace() ? py::object(error.trace()) : py::none();
  return NamedInErrors("told")(error.value(), trace).cast<std::string>();
}

void BindErrors(py::module_& /*module*/) {
  py::register_local_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const core::MachineError& error) {
      Raise("MachineError", error);
    } catch (const core::UserError& error) {
      Raise("InputError", error);
    }
  });
}

}  // namespace rockyard::python
