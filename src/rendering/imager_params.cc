#include "rendering/imager_params.h"

namespace rockyard::rendering {
namespace {

using core::Assumed;
using core::Published;

// The KAI-0370's data sheet is not at hand: every value stands for interline CCDs of its pixel size
// (11.6 x 13.6 um) and time, or for the active pixel sensors that followed.
constexpr std::string_view kImagerClass =
    "interline CCDs of about 12 um pixels and early active pixel sensors; no data sheet at hand";

void VisitNonuniformity(DetectorParams& p, core::FieldVisitor& v) {
  v.Real("response_nonuniformity", p.response_nonuniformity,
         Assumed("standard deviation of the pixels' sensitivities over their mean; fixed",
                 kImagerClass, {0.0, 0.5}, {0.005, 0.05}));
  v.Real("offset_nonuniformity_e", p.offset_nonuniformity_e,
         Assumed("standard deviation of the pixels' offsets; fixed", kImagerClass, {0.0, 1e5},
                 {0.0, 1000.0}));
}

void VisitLens(ImagerParams& p, core::FieldVisitor& v) {
  v.Real("f_number", p.f_number,
         Assumed("focal length over diameter of the entrance pupil",
                 "small fixed-focus wide-angle lenses", {0.5, 64.0}, {2.0, 16.0}));
  v.Real("lens_transmission", p.lens_transmission,
         Assumed("of the lens without the filter", "about ten coated surfaces", {1e-3, 1.0},
                 {0.6, 0.95}));
  v.Real("filter_width_m", p.filter_width_m,
         Assumed("equivalent width of the optical bandpass around the wavelength of the lasers. "
                 "The filter sits behind the lens: in front of one that sees 2 rad, angles would "
                 "shift a narrow passband by more than its width",
                 "a laser diode drifts by 0.3 nm/K, which is 24 nm over 80 K; published: narrow",
                 {1e-10, 5e-7}, {10e-9, 250e-9}));
  v.Real("filter_transmission", p.filter_transmission,
         Assumed("of the bandpass at the wavelength of the lasers", "interference filters",
                 {1e-3, 1.0}, {0.4, 0.9}));
}

void VisitBlur(ImagerParams& p, core::FieldVisitor& v) {
  v.Real("blur_px", p.blur_px,
         Assumed("standard deviation of the blur along an image line, in pixels: focus, and charge "
                 "that 850 nm light sets free deep in the silicon; 0 is sharp",
                 "the beam alone is as wide as a pixel; a fixed-focus lens may add as much",
                 {0.0, 20.0}, {0.0, 1.5}));
}

void VisitBlackLevel(ImagerParams& p, core::FieldVisitor& v) {
  v.Real("black_level", p.black_level,
         Assumed("count without light over the largest count, so that noise is not cut off",
                 "usual setting", {0.0, 0.5}, {0.0, 0.1}));
}

}  // namespace

DetectorParams CmosDetector() {
  DetectorParams cmos;
  cmos.quantum_efficiency = 0.25;
  cmos.fill_factor = 0.3;
  cmos.full_well_e = 80000.0;
  cmos.read_noise_e = 80.0;
  cmos.dark_current_e_s = 5000.0;
  cmos.adc_bits = 8;
  cmos.response_nonuniformity = 0.02;
  cmos.offset_nonuniformity_e = 400.0;
  return cmos;
}

void DetectorParams::Visit(core::FieldVisitor& v) {
  v.Real("quantum_efficiency", quantum_efficiency,
         Assumed("electrons per photon on the sensitive part of a pixel, at 850 nm", kImagerClass,
                 {1e-4, 1.0}, {0.05, 0.4}));
  v.Real("fill_factor", fill_factor,
         Assumed("sensitive part of a pixel's area", kImagerClass, {0.01, 1.0}, {0.2, 1.0}));
  v.Real("full_well_e", full_well_e,
         Assumed("electrons at which a pixel saturates; the largest count stands for it",
                 kImagerClass, {100.0, 1e7}, {2e4, 2e5}));
  v.Real("read_noise_e", read_noise_e,
         Assumed("standard deviation of one read-out, in electrons", kImagerClass, {0.0, 1e5},
                 {10.0, 150.0}));
  v.Real("dark_current_e_s", dark_current_e_s,
         Assumed("electrons per second without light, near 0 C; doubles every 8 K or so",
                 kImagerClass, {0.0, 1e9}, {10.0, 2e4}));
  v.Integer("adc_bits", adc_bits,
            Assumed("bits of a count", "an 8-bit computer reads them", {1, 16}, {8, 12}));
  VisitNonuniformity(*this, v);
}

void ExposureParams::Visit(core::FieldVisitor& v) {
  v.Real("shortest_s", shortest_s,
         Assumed("shortest exposure", "electronic shutter of an interline CCD", {1e-7, 10.0},
                 {1e-5, 0.01}));
  v.Real("longest_s", longest_s,
         Assumed("longest exposure", "dark current must not fill the well", {1e-7, 100.0},
                 {0.03, 20.0}));
  v.Require("longest_s", longest_s >= shortest_s, "is shorter than shortest_s",
            "use a value of shortest_s or more");
  v.Real(
      "target_fill", target_fill,
      Assumed("share of the full well to which the bright part of the image without lasers is "
              "exposed; the rest is for the lasers' light",
              "published: the computer controls the exposure, not how", {0.01, 1.0}, {0.2, 0.9}));
  v.Real("brightest_share", brightest_share,
         Assumed("share of the metered pixels that may be brighter than that",
                 "a few glints must not darken the image", {0.0, 0.9}, {0.0, 0.1}));
  v.Real("repeatability", repeatability,
         Assumed("standard deviation of the exposure time without lasers over that with lasers, "
                 "less 1: what the difference of two sunlit images keeps of the sun",
                 "an 8085 clocks the imager by software: microseconds of some milliseconds",
                 {0.0, 0.5}, {0.0, 0.02}));
}

void ImagerParams::VisitOptics(core::FieldVisitor& v) {
  v.Choice("kind", kind,
           Published("which of the two imagers below is fitted",
                     "Matthies 1995 table 3: CCD; sec. 6: CMOS as an improvement"));
  VisitLens(*this, v);
  VisitBlur(*this, v);
  VisitBlackLevel(*this, v);
}

void ImagerParams::VisitDetectors(core::FieldVisitor& v) {
  v.Group("ccd", ccd, "interline CCD");
  v.Group("cmos", cmos, "CMOS active pixel sensor");
  v.Group("exposure", exposure, "exposure control");
}

}  // namespace rockyard::rendering
