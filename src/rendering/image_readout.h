// From expected photoelectrons to the numbers that an imager delivers.
#pragma once

#include <cstdint>
#include <vector>

#include "core/random.h"
#include "rendering/imager_params.h"
#include "rendering/pixel_noise.h"
#include "rendering/view_row.h"

namespace rockyard::rendering {

// Names the image of a trial that is read out: its substream within the streams of image noise.
using ImageNumber = std::uint32_t;

// How the pixels of one line depart from the average pixel, always.
struct PixelPattern {
  std::vector<double> response;  // relative
  std::vector<double> offset_e;
};

// A pixel collects
//   N = min(W, (1 + r) R t + D t + sqrt(R t + D t + s^2) z + o)   electrons
// and is read as round(N / g + black level), between 0 and the largest count: R rate of
// photoelectrons, t exposure, D dark current, s read noise, W full well, g electrons per count; z
// standard normal and new for each image (Poisson noise of more than some tens of electrons is
// nearly normal), r and o the pixel's own departures in response and offset, fixed for the trial.
// A lamp's light on a pixel carries the factor max(0, 1 + c z') of its speckle, new for each image;
// c is 0 where it is not coherent.
// EMVA 1288 has the same model. Left out: non-linearity, smear and charge transfer loss.
class ImageReadout {
 public:
  ImageReadout(const ImagerParams& imager, double speckle_contrast);

  int largest_count() const { return largest_count_; }
  double electrons_per_count() const { return electrons_per_count_; }

  // Returns the time of an image that is to be exposed for as long as another one, exposure_s:
  // longer by the factor 1 + N(0, repeatability). Draws from (kImageExposure, image).
  double RepeatedTime(double exposure_s, core::TrialKey key, ImageNumber image) const;

  // Returns the pattern of `columns` pixels of a line. Draws from (kPixelPattern, camera): once for
  // the trial, whatever is read out.
  PixelPattern Pattern(int camera, int row, int first_column, int columns,
                       core::TrialKey key) const;

  // Reads one line; lamp_is_on says so of each lamp. Draws from (kImageNoise, image) and, where it
  // meets a lamp's light, (kImageSpeckle, image). Appends to `counts`.
  void Read(const RenderedRow& row, const PixelPattern& pattern, int first_column,
            double exposure_s, core::TrialKey key, ImageNumber image,
            const std::vector<bool>& lamp_is_on, std::vector<std::uint16_t>& counts) const;

 private:
  std::vector<double> Photoelectrons(const RenderedRow& row, int first_column, double exposure_s,
                                     core::TrialKey key, ImageNumber image,
                                     const std::vector<bool>& lamp_is_on) const;

  DetectorParams detector_;
  double repeatability_;
  double speckle_contrast_;
  int largest_count_;
  double black_counts_;
  double electrons_per_count_;
};

}  // namespace rockyard::rendering
