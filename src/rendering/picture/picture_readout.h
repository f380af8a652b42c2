// From the light of a picture to the numbers that a camera delivers: the last step of the stereo
// cameras' images. Records of drives by these images depend on its bits and draws; stuck pixels
// come from (kPixelDefect, camera): their number, then column, row and count of each.
#pragma once

#include <cstdint>
#include <vector>

#include "core/random.h"
#include "rendering/image_readout.h"
#include "rendering/picture/picture.h"
#include "rendering/picture/picture_params.h"
#include "rendering/picture/pixel_rays.h"
#include "vision/image.h"

namespace rockyard::rendering {

// An image as it leaves the camera.
struct RawImage {
  vision::Image<std::uint16_t> counts;
  double exposure_s = 0.0;
};

// One camera's optics and imager. Light goes through
//   blur       a Gaussian over rows and columns; beyond the edges the image goes on as at them
//   vignetting gain g of the pixel, 1 on the axis
//   rate       electrons per second = ElectronsPerRadiance * g * L
//   exposure   ExposureTime over all pixels as they are delivered: all but brightest_share of them
//              below target_fill of the largest count
//   read-out   by ImageReadout: shot, dark and read noise, fixed pattern, well, black level, bits
//   flat field where it is corrected: (count - black) / (g (1 + r)) + black, r the pixel's response
//   stuck      pixels that always show 0 or the largest count, half of them each
// Pattern and stuck pixels belong to (trial, camera), noise to (trial, image).
class PictureReadout {
 public:
  // `camera` numbers the cameras of a rover, from 0. The axis is the ray through the middle of the
  // image.
  PictureReadout(const PictureCameraParams& params, const PixelRays& rays, int camera,
                 core::TrialKey key);

  int largest_count() const { return readout_.largest_count(); }

  // Returns the vignetting of a pixel: 1 on the axis. Natural vignetting is the solid angle of the
  // pixel times the cosine from the axis, over the solid angle on the axis: cos^4 for a pinhole.
  float Gain(int column, int row) const { return gain_.At(column, row); }

  // Returns electrons per second, by pixel.
  vision::Image<float> Rates(const Picture& picture) const;

  // Returns the time that exposure control settles at for these rates.
  double Exposure(const vision::Image<float>& rates_e_s) const;

  // Reads out an image that is exposed for exposure_s. Draws from (kImageNoise, image).
  RawImage Read(const vision::Image<float>& rates_e_s, double exposure_s, ImageNumber image) const;

 private:
  void SetGain(const PixelRays& rays);
  void SetPattern(int camera);

  PictureCameraParams params_;
  core::TrialKey key_;
  ImageReadout readout_;
  double electrons_per_radiance_;
  vision::Image<float> gain_;
  std::vector<PixelPattern> pattern_;  // by row
  struct Stuck {
    int column, row;
    std::uint16_t count;
  };
  std::vector<Stuck> stuck_;
};

// Returns the image with 8 bits a pixel: the highest eight of its `bits`.
vision::GrayImage ToGray(const vision::Image<std::uint16_t>& counts, int bits);

// Blurs an image by a Gaussian of that standard deviation along rows and columns. Its weights are
// sampled at whole pixels, up to four deviations, and normalized. Beyond the edges the image is
// taken to be as at the edges.
vision::Image<float> Blurred(const vision::Image<float>& sharp, double sigma_px);

}  // namespace rockyard::rendering
