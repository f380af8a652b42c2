#include "rover/rover_geometry_params.h"

#include <cmath>

namespace rockyard::rover {
namespace {

using core::Origin;

constexpr std::string_view kRocky32 = "Matthies 1995 sec. 2 (MFEX; Rocky 3.2 has the same size)";
constexpr std::string_view kRocky7 =
    "Rocky 7, Tarokh and McDermott 2005: the same wheels on a rover of the same size";

// Overall dimensions.
void VisitExtent(RoverGeometryParams& p, core::FieldVisitor& v) {
  v.Real("length_m", p.length_m,
         {.doc = "overall length, which is that of the solar panel",
          .min = 0.2,
          .max = 5.0,
          .origin = Origin::kPublished,
          .source = kRocky32});
  v.Real("width_m", p.width_m,
         {.doc = "overall width; the outer faces of the wheels",
          .min = 0.2,
          .max = 5.0,
          .origin = Origin::kPublished,
          .source = kRocky32});
  v.Real("height_m", p.height_m,
         {.doc = "height of the top of the solar panel",
          .min = 0.1,
          .max = 3.0,
          .origin = Origin::kPublished,
          .source = kRocky32});
  v.Real("belly_clearance_m", p.belly_clearance_m,
         {.doc = "height of the underside of the chassis",
          .min = 0.02,
          .max = 2.0,
          .origin = Origin::kPublished,
          .source = "Matthies 1995 sec. 6"});
}

// Size and place of the wheels, and which of them steer.
void VisitWheels(RoverGeometryParams& p, core::FieldVisitor& v) {
  v.Real("wheel_radius_m", p.wheel_radius_m,
         {.doc = "wheel radius, cleats included",
          .min = 0.02,
          .max = 0.5,
          .origin = Origin::kPublished,
          .source = kRocky32});
  v.Real("wheel_width_m", p.wheel_width_m,
         {.doc = "wheel width",
          .min = 0.01,
          .max = 0.5,
          .origin = Origin::kAssumed,
          .source = kRocky7,
          .study_low = 0.06,
          .study_high = 0.08});
  v.Real("wheelbase_m", p.wheelbase_m,
         {.doc = "distance from the front to the rear axle, centred",
          .min = 0.1,
          .max = 5.0,
          .origin = Origin::kAssumed,
          .source = "the outer wheels end at the overall length",
          .study_low = 0.46,
          .study_high = 0.52});
  v.Real("middle_wheel_x_m", p.middle_wheel_x_m,
         {.doc = "position of the middle wheels, which do not steer: at 0 they do not scrub while "
                 "the rover turns in place",
          .min = -1.0,
          .max = 1.0,
          .origin = Origin::kAssumed,
          .source = "four wheels are steered for turns about the chassis centre",
          .study_low = -0.02,
          .study_high = 0.02});
  v.Choice("steered_wheels", p.steered_wheels,
           {.doc = "corners: the four outer wheels steer, the middle ones do not; all: all six",
            .origin = Origin::kPublished,
            .source = "Matthies 1995 sec. 2"});
}

// The rocker-bogie linkage: its pivots and the knees of its arms.
void VisitLinkage(RoverGeometryParams& p, core::FieldVisitor& v) {
  v.Choice("bogie_end", p.bogie_end,
           {.doc = "end of the rover that stands on the bogies (two wheels a side); the pivots are "
                   "given for rear and mirrored for front",
            .origin = Origin::kAssumed,
            .source = "driven bogies first, the model climbs the published 1.5 wheel diameters; "
                      "rockers first, no more than 0.5 at the same friction"});
  v.Real("rocker_pivot_x_m", p.rocker_pivot_x_m,
         {.doc = "position of the rocker pivots",
          .min = -1.0,
          .max = 1.0,
          .origin = Origin::kAssumed,
          .source = "divides the distance from front axle to bogie pivot as on Rocky 7 (70:30)",
          .study_low = -0.03,
          .study_high = 0.05});
  v.Real("rocker_pivot_z_m", p.rocker_pivot_z_m,
         {.doc = "height of the rocker pivots",
          .min = 0.02,
          .max = 2.0,
          .origin = Origin::kAssumed,
          .source = kRocky7,
          .study_low = 0.17,
          .study_high = 0.22});
  v.Real(
      "bogie_pivot_z_m", p.bogie_pivot_z_m,
      {.doc = "height of the bogie pivots, halfway between their wheels",
       .min = 0.02,
       .max = 2.0,
       .origin = Origin::kAssumed,
       .source = "between Rocky 7's 0.085 and the 0.164 of Perseverance at the same wheel radius: "
                 "arched bogies as on every rover with steered corner wheels",
       .study_low = 0.085,
       .study_high = 0.165});
  v.Real("knee_z_m", p.knee_z_m,
         {.doc = "height at which the struts of the wheels meet the arms",
          .min = 0.02,
          .max = 2.0,
          .origin = Origin::kAssumed,
          .source = "above the wheels, which steer about the struts",
          .study_low = 0.13,
          .study_high = 0.17});
}

// What may touch rocks besides the wheels: chassis, arms and hubs.
void VisitBody(RoverGeometryParams& p, core::FieldVisitor& v) {
  v.Real("belly_length_m", p.belly_length_m,
         {.doc = "length of the chassis box, centred",
          .min = 0.05,
          .max = 5.0,
          .origin = Origin::kAssumed,
          .source = kRocky7,
          .study_low = 0.30,
          .study_high = 0.45});
  v.Real("belly_width_m", p.belly_width_m,
         {.doc = "width of the chassis box, centred",
          .min = 0.05,
          .max = 5.0,
          .origin = Origin::kAssumed,
          .source = kRocky7,
          .study_low = 0.22,
          .study_high = 0.27});
  v.Real("arm_y_m", p.arm_y_m,
         {.doc = "distance of the rocker and bogie arms from the middle plane: between the chassis "
                 "box and the wheels",
          .min = 0.02,
          .max = 2.0,
          .origin = Origin::kAssumed,
          .source = "the room between box and wheels",
          .study_low = 0.142,
          .study_high = 0.152});
  v.Real("arm_radius_m", p.arm_radius_m,
         {.doc = "radius of the arms",
          .min = 0.003,
          .max = 0.2,
          .origin = Origin::kAssumed,
          .source = "the room between box and wheels",
          .study_low = 0.008,
          .study_high = 0.015});
  v.Real("hub_radius_m", p.hub_radius_m,
         {.doc = "radius of the ball that stands for motor and hub beside each wheel",
          .min = 0.003,
          .max = 0.3,
          .origin = Origin::kAssumed,
          .source = "smaller than the wheel",
          .study_low = 0.015,
          .study_high = 0.035});
}

// Where rockers and bogies stop.
void VisitStops(RoverGeometryParams& p, core::FieldVisitor& v) {
  v.Angle("rocker_limit_deg", p.rocker_limit_rad,
          {.doc = "stop of the rockers on either side",
           .min = 1.0,
           .max = 80.0,
           .origin = Origin::kAssumed,
           .source = "a wheel of one side on 1.5 wheel diameters needs about 20",
           .study_low = 20.0,
           .study_high = 35.0});
  v.Angle("bogie_limit_deg", p.bogie_limit_rad,
          {.doc = "stop of the bogies on either side",
           .min = 1.0,
           .max = 80.0,
           .origin = Origin::kAssumed,
           .source = "a bogie wheel on 1.5 wheel diameters needs 49",
           .study_low = 40.0,
           .study_high = 60.0});
}

// Whether the parts find room beside one another.
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
