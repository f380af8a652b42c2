#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "campaign/stereo/render_pair.h"
#include "python/parts.h"
#include "scenario/scenario.h"
#include "terrain/arena.h"
#include "terrain/field.h"
#include "trial/course/layout.h"

namespace rockyard::python {
namespace {

namespace py = pybind11;

// The terrain of a trial.
struct Place {
  terrain::Field field;
  terrain::Rectangle bounds;
};

std::unique_ptr<Place> MakePlace(const OpenScenario& open, std::uint64_t seed,
                                 std::uint32_t trial) {
  const trial::DriveParams& drive = open.values.values().drive;
  return std::make_unique<Place>(
      Place{terrain::BuildField(drive.terrain, trial::LayoutKey(drive, {seed, trial}),
                                trial::TerrainCourse(drive.course)),
            terrain::DrivableBounds(drive.terrain.arena)});
}

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

// Returns the heights above points, in the shape of their coordinates.
template <typename Height>
py::array_t<double> HeightsAt(const Numbers& x_m, const Numbers& y_m, const Height& height) {
  return py::vectorize([&](double x, double y) { return height(x, y); })(x_m, y_m);
}

// Returns x, y, z of the centre, semi-axes, yaw, diameter, height: a row each rock.
py::array_t<double> RocksOf(const Place& place) {
  constexpr std::size_t kColumns = 9;
  std::vector<double> rows;
  for (const terrain::Rock& rock : place.field.terrain.rocks()) {
    const math::Vector3& c = rock.center_W;
    const math::Vector3& a = rock.semi_axes_m;
    rows.insert(rows.end(), {c.x(), c.y(), c.z(), a.x(), a.y(), a.z(), rock.yaw_rad,
                             rock.diameter_m, rock.height_m});
  }
  return ArrayOf<double>(rows, {static_cast<py::ssize_t>(rows.size() / kColumns), kColumns});
}

template <typename Value>
py::array ImageArray(const vision::Image<Value>& image) {
  return ArrayOf<Value>(image.values(), {image.height(), image.width()});
}

// Returns left and right image (counts), the true disparity of the left one (px, NaN where the
// right eye does not see the point), and X_WR.
py::tuple TakeImages(const campaign::RenderRequest& request) {
  sensing::StereoImages images;
  vision::Image<float> disparity;
  Eigen::Matrix4d X_WR;
  {
    const py::gil_scoped_release released;
    campaign::RenderStage stage(request);
    const math::Transform& stands =
        stage.Stand(campaign::FirstPose(request, stage.scenario().drive.course.Start()));
    images = stage.imager().Expose(stage.terrain(), stands, 0, request.direction);
    disparity = stage.imager().TrueDisparities(stage.terrain(), stands, request.direction);
    X_WR = stands.matrix();
  }
  return py::make_tuple(ImageArray(images.left), ImageArray(images.right), ImageArray(disparity),
                        X_WR);
}

}  // namespace

void BindPlaces(py::module_& module) {
  py::class_<Place>(module, "Place")
      .def(py::init(&MakePlace), py::arg("scenario"), py::arg("seed"), py::arg("trial"))
      .def_property_readonly("bounds",
                             [](const Place& place) {
                               const terrain::Rectangle& area = place.bounds;
                               return py::make_tuple(area.x_min_m, area.x_max_m, area.y_min_m,
                                                     area.y_max_m);
                             })
      .def("height",
           [](const Place& place, const Numbers& x_m, const Numbers& y_m) {
             return HeightsAt(x_m, y_m,
                              [&](double x, double y) { return place.field.terrain.Height(x, y); });
           })
      .def("ground",
           [](const Place& place, const Numbers& x_m, const Numbers& y_m) {
             return HeightsAt(x_m, y_m, [&](double x, double y) {
               return place.field.terrain.ground().Height(x, y);
             });
           })
      .def("rocks", &RocksOf);
  module.def(
      "images",
      [](const std::string& scenario, std::optional<std::uint64_t> seed, std::uint32_t trial,
         std::optional<double> x_m, std::optional<double> y_m, std::optional<double> heading_rad,
         bool behind) {
        return TakeImages({.scenario = scenario,
                           .overrides = {},
                           .seed = seed,
                           .trial = trial,
                           .out = {},
                           .direction = behind ? messages::LookDirection::kBehind
                                               : messages::LookDirection::kAhead,
                           .x_m = x_m,
                           .y_m = y_m,
                           .heading_rad = heading_rad});
      },
      py::arg("scenario"), py::arg("seed"), py::arg("trial"), py::arg("x_m"), py::arg("y_m"),
      py::arg("heading_rad"), py::arg("behind"));
}

}  // namespace rockyard::python
