#include "image_files/disparity_file.h"

#include <cmath>
#include <limits>
#include <string>

#include "core/check.h"
#include "core/whole_file.h"
#include "image_files/image_errors.h"
#include "image_files/pfm_file.h"
#include "image_files/read_image.h"

namespace rockyard::image_files {
namespace {

vision::Image<float> Scaled(const SamplePlane& samples, double samples_a_pixel) {
  vision::Image<float> disparity(samples.width(), samples.height(),
                                 std::numeric_limits<float>::quiet_NaN());
  for (std::size_t i = 0; i < samples.values().size(); ++i) {
    const std::uint16_t sample = samples.values()[i];
    if (sample != 0) disparity.values()[i] = static_cast<float>(sample / samples_a_pixel);
  }
  return disparity;
}

}  // namespace

vision::Image<float> ReadDisparity(const std::filesystem::path& path, double samples_a_pixel,
                                   const ImageLimits& limits) {
  EXPECT(samples_a_pixel > 0.0 && std::isfinite(samples_a_pixel));
  const std::string name = path.string();
  const std::string bytes = core::ReadWholeFile(path, kMaxFileBytes, "a file of disparities");
  if (IsPfm(bytes)) {
    if (samples_a_pixel != 1.0) {
      FailUnsupported(name, "is a PFM file, which holds disparities in pixels",
                      "leave --reference-samples out");
    }
    return DecodePfm(bytes, name, limits);
  }
  const RawImage image = DecodeImage(bytes, name, limits);
  if (image.format == "JPEG") {
    FailUnsupported(name, "is a JPEG file, whose samples are not exact", "name a PFM or PNG file");
  }
  for (const SamplePlane& plane : image.planes) {
    if (plane != image.planes.front()) {
      FailUnsupported(name, "is in colour, which states no disparity", "name a PFM or PNG file");
    }
  }
  return Scaled(image.planes.front(), samples_a_pixel);
}

}  // namespace rockyard::image_files
