#include "perception/cloud_params.h"

#include "messages/stripe_array.h"

namespace rockyard::perception {
namespace {

using core::Assumed;

void VisitGround(CloudElevationParams& p, core::FieldVisitor& v) {
  const auto length = [&v](std::string_view name, double& value, std::string_view doc,
                           std::string_view reason, double study_low, double study_high) {
    v.Real(name, value, Assumed(doc, reason, {0.0, 20.0}, {study_low, study_high}));
  };
  length("near_m", p.near_m, "nearest edge of the ground, from the chassis centre, as they look",
         "where the light stripe array begins on Rocky 3.2", 0.4, 0.8);
  length("far_m", p.far_m, "its farthest edge", "five times as long as the light stripe array", 0.8,
         2.5);
  v.Require("far_m", p.far_m > p.near_m, "is not larger than near_m", "use a larger value");
  length("half_width_m", p.half_width_m, "its edges left and right of the middle line",
         "a rover's width and as much again for clearance", 0.37, 1.2);
  v.Require("half_width_m", p.half_width_m > 0.0, "leaves no ground", "use a positive value");
}

}  // namespace

void CloudElevationParams::Visit(core::FieldVisitor& v) {
  v.Integer("rows", rows,
            Assumed("rows of bins, from near to far", "as many as the light stripe array has",
                    {2, static_cast<double>(messages::kMaxStripeRows)}, {4, 7}));
  v.Integer("stripes", stripes,
            Assumed("bins of a row, from left to right", "as many as the light stripe array has",
                    {3, static_cast<double>(messages::kMaxStripes)}, {5, 9}));
  VisitGround(*this, v);
  v.Real(
      "quantile", quantile,
      Assumed("share of a bin's points that lie no higher than its elevation; 1: the highest point",
              "the highest point: what noise adds is much the same in all bins, and less shows a "
              "rock that fills a tenth of one",
              {0.0, 1.0}, {0.5, 1.0}));
  v.Integer("min_points", min_points,
            Assumed("points from which a bin counts as seen", "one stray point is no ground",
                    {1, 100000}, {1, 10}));
  v.Choice("frame", frame,
           Assumed("frame in which heights count",
                   "over a metre, a pitch of 7 deg is as high as the clearance"));
}

}  // namespace rockyard::perception
