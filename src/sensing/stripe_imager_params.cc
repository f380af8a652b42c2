#include "sensing/stripe_imager_params.h"

#include "core/sources.h"

namespace rockyard::sensing {
namespace {

using core::Assumed;
using core::kMatthiesTable3;
using core::Published;
using core::Setting;

void VisitBeam(LaserParams& p, core::FieldVisitor& v) {
  v.Real("beam_width_rad", p.beam_width_rad,
         Published("width of the beam across the light plane: between the 1/e2 points of a "
                   "Gaussian, or edge to edge",
                   kMatthiesTable3, {1e-5, 0.1}));
  v.Choice(
      "profile", p.profile,
      Assumed(
          "cross section of the beam",
          "the paper gives a width alone; a laser diode behind a collimator is nearly Gaussian"));
  v.Choice("fan", p.fan,
           Published("full: the light of an emitter spreads over its fan; three_scanlines: over "
                     "three scanlines around each measured point, from an emitter of its own",
                     "Matthies 1995 sec. 6: table 3's fan, and the first improvement listed"));
  v.Real("speckle_contrast", p.speckle_contrast,
         Assumed("standard deviation over mean of the laser light on one pixel",
                 "1/sqrt(M) of M speckles of width wavelength x f-number on a pixel (Goodman 2007 "
                 "ch. 2): 0.27 for one mode at f/4, less for a diode of several modes",
                 {0.0, 1.0}, {0.0, 0.27}));
}

}  // namespace

void LaserParams::Visit(core::FieldVisitor& v) {
  v.Real("input_power_w", input_power_w,
         Published("electrical power of one emitter", kMatthiesTable3, {1e-6, 100.0}));
  v.Real("optical_efficiency", optical_efficiency,
         Assumed("light that leaves the fan's optics over electrical power",
                 "laser diodes of 1994 reach 0.1 to 0.3; driver and line optics take their share",
                 {1e-6, 1.0}, {0.02, 0.25}));
  v.Real("wavelength_m", wavelength_m, Published("of the light", kMatthiesTable3, {3e-7, 1.1e-6}));
  VisitBeam(*this, v);
}

void StripeImagerParams::Visit(core::FieldVisitor& v) {
  VisitOptics(v);
  v.Integer("averaging_rows", averaging_rows,
            Published("image lines that are read around each scanline for averaging; odd",
                      "Matthies 1995 sec. 6: 5 x 5 averaging", {1, 63}));
  v.Require("averaging_rows", averaging_rows % 2 == 1, "is even: no line is the middle one",
            "use 5");
  v.Integer("margin_rows", margin_rows,
            Setting("further lines read above and below those", {0, 256}));
  VisitDetectors(v);
}

}  // namespace rockyard::sensing
