#include "sensing/stripe_imager_params.h"

#include "core/sources.h"

namespace rockyard::sensing {
namespace {

using core::kMatthiesTable3;
using core::Origin;

void VisitBeam(LaserParams& p, core::FieldVisitor& v) {
  v.Real("beam_width_rad", p.beam_width_rad,
         {.doc = "width of the beam across the light plane: between the 1/e2 points of a Gaussian, "
                 "or edge to edge",
          .min = 1e-5,
          .max = 0.1,
          .origin = Origin::kPublished,
          .source = kMatthiesTable3});
  v.Choice("profile", p.profile,
           {.doc = "cross section of the beam",
            .origin = Origin::kAssumed,
            .source = "the paper gives a width alone; a laser diode behind a collimator is nearly "
                      "Gaussian"});
  v.Choice(
      "fan", p.fan,
      {.doc = "full: the light of an emitter spreads over its fan; three_scanlines: over three "
              "scanlines around each measured point, from an emitter of its own",
       .origin = Origin::kPublished,
       .source = "Matthies 1995 sec. 6: table 3's fan, and the first improvement listed"});
  v.Real("speckle_contrast", p.speckle_contrast,
         {.doc = "standard deviation over mean of the laser light on one pixel",
          .min = 0.0,
          .max = 1.0,
          .origin = Origin::kAssumed,
          .source = "1/sqrt(M) of M speckles of width wavelength x f-number on a pixel (Goodman "
                    "2007 ch. 2): 0.27 for one mode at f/4, less for a diode of several modes",
          .study_low = 0.0,
          .study_high = 0.27});
}

}  // namespace

void LaserParams::Visit(core::FieldVisitor& v) {
  v.Real("input_power_w", input_power_w,
         {.doc = "electrical power of one emitter",
          .min = 1e-6,
          .max = 100.0,
          .origin = Origin::kPublished,
          .source = kMatthiesTable3});
  v.Real(
      "optical_efficiency", optical_efficiency,
      {.doc = "light that leaves the fan's optics over electrical power",
       .min = 1e-6,
       .max = 1.0,
       .origin = Origin::kAssumed,
       .source = "laser diodes of 1994 reach 0.1 to 0.3; driver and line optics take their share",
       .study_low = 0.02,
       .study_high = 0.25});
  v.Real("wavelength_m", wavelength_m,
         {.doc = "of the light",
          .min = 3e-7,
          .max = 1.1e-6,
          .origin = Origin::kPublished,
          .source = kMatthiesTable3});
  VisitBeam(*this, v);
}

void StripeImagerParams::Visit(core::FieldVisitor& v) {
  VisitOptics(v);
  v.Integer("averaging_rows", averaging_rows,
            {.doc = "image lines that are read around each scanline for averaging; odd",
             .min = 1,
             .max = 63,
             .origin = Origin::kPublished,
             .source = "Matthies 1995 sec. 6: 5 x 5 averaging"});
  v.Require("averaging_rows", averaging_rows % 2 == 1, "is even: no line is the middle one",
            "use 5");
  v.Integer("margin_rows", margin_rows,
            {.doc = "further lines read above and below those",
             .min = 0,
             .max = 256,
             .origin = Origin::kSetting});
  VisitDetectors(v);
}

}  // namespace rockyard::sensing
