#include <pybind11/numpy.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/archive.h"
#include "core/error.h"
#include "core/json_text.h"
#include "python/parts.h"
#include "rover/steady_wheel.h"

namespace rockyard::python {
namespace {

namespace py = pybind11;

// A wheel of one kind on one soil, up to a load.
struct Wheel {
  rover::WheelOnSoil soil;
  double radius_m;
  double largest_load_N;
};

void RequireAbove(const char* name, double value, double bound) {
  if (std::isfinite(value) && value > bound) return;
  throw core::UserError(name, "is not above " + std::to_string(static_cast<int>(bound)), "");
}

Wheel MakeWheel(const std::string& soil_json, const rover::RimShape& shape, double gravity_m_s2,
                double largest_load_N) {
  terrain::SoilParams soil;
  core::ReadParams(core::ParseJson(soil_json, "soil"), soil);
  RequireAbove("radius_m", shape.radius_m, 0.0);
  RequireAbove("width_m", shape.width_m, 0.0);
  if (!(shape.lug_height_m >= 0.0 && shape.lug_height_m < shape.radius_m)) {
    throw core::UserError("lug_height_m", "is not from 0 to below the radius", "");
  }
  RequireAbove("gravity_m_s2", gravity_m_s2, 0.0);
  RequireAbove("largest_load_N", largest_load_N, 0.0);
  return {rover::WheelOnSoil(soil, shape, gravity_m_s2, largest_load_N), shape.radius_m,
          largest_load_N};
}

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

// Returns pull, side, torque, sinkage and resistance as rows, of lists of one length.
py::array_t<double> Steady(const Wheel& wheel, const Numbers& load_N, const Numbers& slip,
                           const Numbers& slip_angle_rad) {
  const py::ssize_t count = load_N.size();
  std::vector<double> rows(static_cast<std::size_t>(5 * count));
  for (py::ssize_t i = 0; i < count; ++i) {
    const double load = load_N.at(i);
    if (load > wheel.largest_load_N) {
      throw core::UserError("load_N", "is above the largest load of this wheel",
                            "make it with a larger largest_load_N");
    }
    const rover::SteadyForces forces =
        rover::SteadyWheel(wheel.soil, wheel.radius_m, load, slip.at(i), slip_angle_rad.at(i));
    const double values[] = {forces.pull_N, forces.side_N, forces.torque_Nm, forces.sinkage_m,
                             forces.resistance_N};
    for (py::ssize_t row = 0; row < 5; ++row) {
      rows[static_cast<std::size_t>(row * count + i)] = values[row];
    }
  }
  return ArrayOf<double>(rows, {5, count});
}

}  // namespace

void BindWheels(py::module_& module) {
  py::class_<Wheel>(module, "Wheel")
      .def(
          py::init([](const std::string& soil, double radius_m, double width_m, double lug_height_m,
                      int lug_count, double gravity_m_s2, double largest_load_N) {
            return MakeWheel(soil, {radius_m, width_m, lug_height_m, lug_count}, gravity_m_s2,
                             largest_load_N);
          }),
          py::arg("soil"), py::arg("radius_m"), py::arg("width_m"), py::arg("lug_height_m"),
          py::arg("lug_count"), py::arg("gravity_m_s2"), py::arg("largest_load_N"))
      .def("steady", &Steady, py::arg("load_N"), py::arg("slip"), py::arg("slip_angle_rad"));
}

}  // namespace rockyard::python
