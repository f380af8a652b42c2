// From expected photoelectrons to the numbers that an imager delivers.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/random.h"
#include "sensing/imager_params.h"
#include "sensing/pixel_noise.h"
#include "sensing/rendered_row.h"

namespace rockyard::sensing {

// Names the image of a trial that is read out.
struct ImageName {
  static constexpr std::int64_t kScans = std::int64_t{1} << 26;  // that have names of their own

  std::int64_t scan = 0;
  int camera = 0;
  int group = 0;
  bool lit = false;

  std::uint32_t substream() const {
    constexpr std::int64_t kGroups = 16;
    return static_cast<std::uint32_t>(((scan * 2 + camera) * kGroups + group) * 2 + (lit ? 1 : 0));
  }
};

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
// Laser light on a pixel carries the factor max(0, 1 + c z') of its speckle, new for each image.
// EMVA 1288 has the same model. Left out: non-linearity, smear and charge transfer loss.
class ImageReadout {
 public:
  ImageReadout(const ImagerParams& imager, double speckle_contrast);

  int largest_count() const { return largest_count_; }
  double electrons_per_count() const { return electrons_per_count_; }

  // Returns the time of the image without lasers that goes with one of exposure_s with them: longer
  // by the factor 1 + N(0, repeatability). Draws from (kImageExposure, name).
  double DarkTime(double exposure_s, core::TrialKey key, const ImageName& name) const;

  // Returns the pattern of `columns` pixels of a line. Draws from (kPixelPattern, camera): once for
  // the trial, whatever is read out.
  PixelPattern Pattern(int camera, int row, int first_column, int columns,
                       core::TrialKey key) const;

  // Reads one line; group_of[laser] says which lasers are on in a lit image. Draws from
  // (kImageNoise, name) and, where it meets laser light, (kImageSpeckle, name). Appends to
  // `counts`.
  void Read(const RenderedRow& row, const PixelPattern& pattern, int first_column,
            double exposure_s, core::TrialKey key, const ImageName& name,
            std::span<const int> group_of, std::vector<std::uint16_t>& counts) const;

 private:
  std::vector<double> Photoelectrons(const RenderedRow& row, int first_column, double exposure_s,
                                     core::TrialKey key, const ImageName& name,
                                     std::span<const int> group_of) const;

  DetectorParams detector_;
  double repeatability_;
  double speckle_contrast_;
  int largest_count_;
  double black_counts_;
  double electrons_per_count_;
};

}  // namespace rockyard::sensing
