// Binds the elementary functions of trials (math/functions.h), element by element.
#include <pybind11/numpy.h>

#include "math/functions.h"
#include "python/parts.h"

namespace rockyard::python {

namespace py = pybind11;

void BindElementary(py::module_& module) {
  module.def("sin", py::vectorize([](double x) { return math::Sin(x); }));
  module.def("cos", py::vectorize([](double x) { return math::Cos(x); }));
  module.def("tan", py::vectorize([](double x) { return math::Tan(x); }));
  module.def("atan2", py::vectorize([](double y, double x) { return math::Atan2(y, x); }));
  module.def("exp", py::vectorize([](double x) { return math::Exp(x); }));
  module.def("expm1", py::vectorize([](double x) { return math::Expm1(x); }));
  module.def("log", py::vectorize([](double x) { return math::Log(x); }));
  module.def("hypot", py::vectorize([](double x, double y) { return math::Hypot(x, y); }));
}

}  // namespace rockyard::python
