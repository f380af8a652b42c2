// How errors of the library come to Python: rockyard.InputError, rockyard.MachineError.
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "core/error.h"

namespace rockyard::python {

// Raises what the errors of core stand for, wherever a function of the module throws them.
void BindErrors(pybind11::module_& module);

// Returns the problems as a list of rockyard.Problem.
pybind11::list ProblemsToPython(const std::vector<core::Problem>& problems);

// Returns what Python raised in one line, with the place where: "ValueError: lost (mine.py:12)".
// Needs the interpreter's lock.
std::string TextOf(const pybind11::error_already_set& error);

}  // namespace rockyard::python
