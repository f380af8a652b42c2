#include "experiments/stereo_sensing/stereo_sensing_params.h"

#include <algorithm>

#include "core/archive.h"
#include "core/check.h"
#include "core/error.h"
#include "navigation/navigator_traits_params.h"

namespace rockyard::experiments {
namespace {

using core::Assumed;
using core::Published;
using core::Setting;

void VisitFactors(StereoSensingParams& p, core::FieldVisitor& v) {
  v.Reals("soil_graininess", p.soil_graininess,
          Setting("values of sensors.look.soil_graininess, which acts on images only; empty: the "
                  "scenario's own",
                  {0.0, 1.0}));
  v.Reals("sun_elevations_deg", p.sun_elevations_deg,
          Setting("elevations of the sun; empty: the scenario's own", {0.0, 90.0}));
  v.Reals("baselines_m", p.baselines_m,
          Setting("values of sensors.stereo.baseline_m; empty: the scenario's own", {1e-3, 2.0}));
  v.Reals("distances_m", p.distances_m,
          Setting("edges of the bins of distance from the left camera: a cell holds what lies from "
                  "one edge to the next",
                  {0.0, 20.0}));
  v.Require("distances_m", p.distances_m.size() >= 2, "names fewer than two edges of bins",
            "list at least a nearest and a farthest distance");
  v.Require("distances_m",
            std::adjacent_find(p.distances_m.begin(), p.distances_m.end(),
                               [](double a, double b) { return a >= b; }) == p.distances_m.end(),
            "does not ascend", "list every edge once, from the nearest to the farthest");
}

// Returns whether the cameras can be built with that baseline.
bool HoldsStereoBaseline(sensing::StereoParams cameras, double baseline_m) {
  cameras.baseline_m = baseline_m;
  try {
    core::ReadParams(core::WriteParams(cameras), cameras);
  } catch (const core::UserError&) {
    return false;
  }
  return true;
}

void RequireScene(const trial::DriveParams& drive, core::FieldVisitor& v) {
  v.Require("terrain.ground.slope_deg", drive.terrain.ground.IsLevel(),
            "or roughness_rms_m is not 0, or there are ditches or pits, where the experiment puts "
            "the rover on level ground",
            "leave the ground flat");
  const terrain::RockFieldParams& rocks = drive.terrain.rocks;
  v.Require("terrain.rocks.pointedness",
            rocks.kind == terrain::RockFieldKind::kNone || rocks.pointedness == 0.0,
            "is above 0, where the experiment knows the true outlines of ellipsoids only", "use 0");
}

}  // namespace

std::vector<CellFactor> StereoSensingParams::Factors() const {
  std::vector<CellFactor> factors;
  if (!soil_graininess.empty()) factors.push_back({"soil_graininess", soil_graininess});
  if (!sun_elevations_deg.empty()) factors.push_back({"sun_elevation_deg", sun_elevations_deg});
  if (!baselines_m.empty()) factors.push_back({"baseline_m", baselines_m});
  std::vector<double> nearest_m = distances_m;
  if (!nearest_m.empty()) nearest_m.pop_back();
  factors.push_back({"nearest_m", nearest_m});
  return factors;
}

double StereoSensingParams::FarthestOf(double nearest_m) const {
  const auto edge = std::find(distances_m.begin(), distances_m.end(), nearest_m);
  EXPECT(edge != distances_m.end() && edge + 1 != distances_m.end());
  return *(edge + 1);
}

void StereoSensingParams::Visit(core::FieldVisitor& v) {
  v.Integer("looks_per_run", looks_per_run,
            Setting("looks of one pair of cameras in one run, each at a random pose on a terrain "
                    "of its own; run i belongs to cell i modulo their number",
                    {1, 100000}));
  VisitFactors(*this, v);
  v.Real("hazard_height_m", hazard_height_m,
         Published("rocks are counted by their height in halves of this, from one half on",
                   "Goldberg 2002 table 1: rover-obst-height 0.20 m", {0.01, 10.0}));
  v.Real("hazard_goodness", hazard_goodness,
         Assumed("cells of the navigator's map of this goodness or less count as hazards",
                 "Goldberg 2002 sec. 4 step 3: 127 (1 - e/h) is 42 for a step of two thirds of h",
                 {0.0, 254.0}, {0.0, 84.0}));
  v.Integer("min_rock_pixels", min_rock_pixels,
            Setting("a rock is in view where both cameras see it in at least as many pixels",
                    {1, 10000}));
  v.Require("distances_m", Cells() <= kMaxCells, "and the other lists span more than 2000 cells",
            "shorten the lists");
}

void RequireStereoMeasurable(const StereoSensingParams& study, const trial::DriveParams& drive,
                             core::FieldVisitor& v) {
  v.Require("sensors.terrain_sensor", drive.sensors.terrain_sensors.chosen().name() == "stereo",
            "is not stereo, the sensor that the experiment stereo_sensing measures", "use stereo");
  v.Require("perception.reader", drive.perception.readers.chosen().is_own(),
            "is not rockyard's own, whose disparities the experiment measures", "use stereo");
  const sensing::StereoParams& cameras = drive.sensors.stereo;
  v.Require("sensors.stereo.fidelity", cameras.fidelity != sensing::StereoFidelity::kIdeal,
            "is ideal, which has one eye and no errors to measure", "use image or error_model");
  v.Require("sensors.stereo.field_of_view",
            cameras.field_of_view == sensing::StereoFieldOfView::kFull,
            "is stripe, where the experiment counts every pixel", "use full");
  v.Require(
      "navigation.navigator",
      drive.navigation.navigators.chosen().traits().reads == navigation::LookReading::kPoints,
      "does not read points, where the experiment asks what the navigator's map makes of them",
      "use gestalt");
  v.Require("navigation.navigator", !drive.navigation.navigators.chosen().traits().images,
            "asks for images, where the experiment hands it points alone", "use gestalt");
  RequireScene(drive, v);
  v.Require(
      "stereo_sensing.distances_m",
      study.distances_m.empty() || study.distances_m.back() <= cameras.max_range_m,
      "reaches beyond sensors.stereo.max_range_m, so that its last cells miss what is farther",
      "end the bins at max_range_m, or raise it");
  v.Require(
      "stereo_sensing.baselines_m",
      std::all_of(study.baselines_m.begin(), study.baselines_m.end(),
                  [&](double baseline_m) { return HoldsStereoBaseline(cameras, baseline_m); }),
      "has a baseline with which sensors.stereo cannot work",
      "use shorter baselines, or search larger disparities (max_disparity_px)");
}

}  // namespace rockyard::experiments
