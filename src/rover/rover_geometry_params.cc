#include "rover/rover_geometry_params.h"

#include <cmath>

namespace rockyard::rover {
namespace {

using core::Assumed;
using core::Published;

constexpr std::string_view kRocky32 = "Matthies 1995 sec. 2 (MFEX; Rocky 3.2 has the same size)";
constexpr std::string_view kRocky7 =
    "Rocky 7, Tarokh and McDermott 2005: the same wheels on a rover of the same size";

// Overall dimensions.
void VisitExtent(RoverGeometryParams& p, core::FieldVisitor& v) {
  v.Real("length_m", p.length_m,
         Published("overall length, which is that of the solar panel", kRocky32, {0.2, 5.0}));
  v.Real("width_m", p.width_m,
         Published("overall width; the outer faces of the wheels", kRocky32, {0.2, 5.0}));
  v.Real("height_m", p.height_m,
         Published("height of the top of the solar panel", kRocky32, {0.1, 3.0}));
  v.Real("belly_clearance_m", p.belly_clearance_m,
         Published("height of the underside of the chassis", "Matthies 1995 sec. 6", {0.02, 2.0}));
}

// Size and place of the wheels, and which of them steer.
void VisitWheels(RoverGeometryParams& p, core::FieldVisitor& v) {
  v.Real("wheel_radius_m", p.wheel_radius_m,
         Published("wheel radius, cleats included", kRocky32, {0.02, 0.5}));
  v.Real("wheel_width_m", p.wheel_width_m,
         Assumed("wheel width", kRocky7, {0.01, 0.5}, {0.06, 0.08}));
  v.Real("lug_height_m", p.lug_height_m,
         Assumed("height of the cleats, for laws of stresses over the rim; 0: a smooth rim",
                 "no drawing of Rocky 3.2 shows it; wheels of MFEX had cleats of about 1 cm",
                 {0.0, 0.1}, {0.003, 0.01}));
  v.Integer("lug_count", p.lug_count,
            Assumed("cleats around a wheel",
                    "closer than five heights, they hold the soil between "
                    "them: more do not matter",
                    {0, 1000}, {9, 30}));
  v.Real("wheelbase_m", p.wheelbase_m,
         Assumed("distance from the front to the rear axle, centred",
                 "the outer wheels end at the overall length", {0.1, 5.0}, {0.46, 0.52}));
  v.Real("middle_wheel_x_m", p.middle_wheel_x_m,
         Assumed("position of the middle wheels, which do not steer: at 0 they do not scrub while "
                 "the rover turns in place",
                 "four wheels are steered for turns about the chassis centre", {-1.0, 1.0},
                 {-0.02, 0.02}));
  v.Choice("steered_wheels", p.steered_wheels,
           Published("corners: the four outer wheels steer, the middle ones do not; all: all six",
                     "Matthies 1995 sec. 2"));
}

// The rocker-bogie linkage: its pivots and the knees of its arms.
void VisitLinkage(RoverGeometryParams& p, core::FieldVisitor& v) {
  v.Choice("bogie_end", p.bogie_end,
           Assumed("end of the rover that stands on the bogies (two wheels a side); the pivots are "
                   "given for rear and mirrored for front",
                   "driven bogies first, the model climbs the published 1.5 wheel diameters; "
                   "rockers first, no more than 0.5 at the same friction"));
  v.Real("rocker_pivot_x_m", p.rocker_pivot_x_m,
         Assumed("position of the rocker pivots",
                 "divides the distance from front axle to bogie pivot as on Rocky 7 (70:30)",
                 {-1.0, 1.0}, {-0.03, 0.05}));
  v.Real("rocker_pivot_z_m", p.rocker_pivot_z_m,
         Assumed("height of the rocker pivots", kRocky7, {0.02, 2.0}, {0.17, 0.22}));
  v.Real("bogie_pivot_z_m", p.bogie_pivot_z_m,
         Assumed("height of the bogie pivots, halfway between their wheels",
                 "between Rocky 7's 0.085 and the 0.164 of Perseverance at the same wheel radius: "
                 "arched bogies as on every rover with steered corner wheels",
                 {0.02, 2.0}, {0.085, 0.165}));
  v.Real("knee_z_m", p.knee_z_m,
         Assumed("height at which the struts of the wheels meet the arms",
                 "above the wheels, which steer about the struts", {0.02, 2.0}, {0.13, 0.17}));
}

// What may touch rocks besides the wheels: chassis, arms and hubs.
void VisitBody(RoverGeometryParams& p, core::FieldVisitor& v) {
  v.Real("belly_length_m", p.belly_length_m,
         Assumed("length of the chassis box, centred", kRocky7, {0.05, 5.0}, {0.30, 0.45}));
  v.Real("belly_width_m", p.belly_width_m,
         Assumed("width of the chassis box, centred", kRocky7, {0.05, 5.0}, {0.22, 0.27}));
  v.Real("arm_y_m", p.arm_y_m,
         Assumed("distance of the rocker and bogie arms from the middle plane: between the chassis "
                 "box and the wheels",
                 "the room between box and wheels", {0.02, 2.0}, {0.142, 0.152}));
  v.Real("arm_radius_m", p.arm_radius_m,
         Assumed("radius of the arms", "the room between box and wheels", {0.003, 0.2},
                 {0.008, 0.015}));
  v.Real("hub_radius_m", p.hub_radius_m,
         Assumed("radius of the ball that stands for motor and hub beside each wheel",
                 "smaller than the wheel", {0.003, 0.3}, {0.015, 0.035}));
}

// Where rockers and bogies stop.
void VisitStops(RoverGeometryParams& p, core::FieldVisitor& v) {
  v.Angle("rocker_limit_deg", p.rocker_limit_rad,
          Assumed("stop of the rockers on either side",
                  "a wheel of one side on 1.5 wheel diameters needs about 20", {1.0, 80.0},
                  {20.0, 35.0}));
  v.Angle("bogie_limit_deg", p.bogie_limit_rad,
          Assumed("stop of the bogies on either side",
                  "a bogie wheel on 1.5 wheel diameters needs 49", {1.0, 80.0}, {40.0, 60.0}));
}

// Requires that the parts find room beside one another, as MakeParts and MakeRoverGeometry presume.
void RequireRoom(const RoverGeometryParams& p, core::FieldVisitor& v) {
  const double bogie_pivot_x_m = 0.5 * (p.middle_wheel_x_m - 0.5 * p.wheelbase_m);
  constexpr double kRounding_m = 1e-9;
  v.Require("wheelbase_m", p.wheelbase_m + 2.0 * p.wheel_radius_m <= p.length_m + kRounding_m,
            "puts the outer wheels beyond the overall length",
            "use at most length_m less two wheel radii");
  v.Require("wheelbase_m",
            0.5 * p.wheelbase_m > std::abs(p.middle_wheel_x_m) + 2.0 * p.wheel_radius_m,
            "leaves no room for three wheels a side",
            "use more than four wheel radii plus twice the offset of the middle wheel");
  v.Require("rocker_pivot_x_m", p.rocker_pivot_x_m > bogie_pivot_x_m,
            "lies on the far side of the bogie pivot",
            "put it between bogie pivot and outer wheel");
  v.Require("width_m", 0.5 * p.width_m - p.wheel_width_m >= p.arm_y_m,
            "is too small for the wheels beside the arms", "reduce wheel_width_m or arm_y_m");
  v.Require("height_m", p.height_m > p.belly_clearance_m + 0.04,
            "leaves no chassis between underside and panel", "reduce belly_clearance_m");
}

}  // namespace

void RoverGeometryParams::Visit(core::FieldVisitor& v) {
  VisitExtent(*this, v);
  VisitWheels(*this, v);
  VisitLinkage(*this, v);
  VisitBody(*this, v);
  VisitStops(*this, v);
  RequireRoom(*this, v);
}

}  // namespace rockyard::rover
