#include "rendering/image_readout.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "core/random.h"
#include "rendering/philox_lanes.h"

namespace rockyard::rendering {

namespace {

constexpr std::size_t kCells = 1 << 16;

std::vector<float> MakeTable() {
  std::vector<float> table(kCells);
  // The lower half must mirror the upper one, so that the mean is 0 to the last bit.
  for (std::size_t i = kCells / 2; i < kCells; ++i) {
    // z at the middle of cell i: the inverse normal distribution at (i + 1/2) / 65536.
    const double middle = (static_cast<double>(i) + 0.5) / kCells;
    table[i] = static_cast<float>(core::NormalQuantile(middle));
    table[kCells - 1 - i] = -table[i];
  }
  return table;
}

constexpr int kOffset = 1 << 15;

// Returns the counter's word of a block. Row and block share it, 16 bits each, both counted from
// -2^15.
std::uint32_t CounterOf(int row, int block_column) {
  EXPECT(row >= -kOffset && row < kOffset);
  EXPECT(block_column >= -kOffset && block_column < kOffset);
  return (static_cast<std::uint32_t>(row + kOffset) << 16) |
         static_cast<std::uint32_t>(block_column + kOffset);
}

}  // namespace

std::span<const float, kCells> PixelNoise::NumbersOfCells() {
  static const std::vector<float> kTable = MakeTable();
  return std::span<const float, kCells>(kTable);
}

void PixelNoise::Cells(int row, int first_block, std::span<std::uint16_t> cells) const {
  if (cells.empty()) return;
  const std::size_t blocks = cells.size() / kBlock;
  EXPECT(cells.size() % kBlock == 0 && first_block + static_cast<int>(blocks) <= kOffset);
  std::array<std::uint32_t, 4> counter = counter_;
  counter[0] = CounterOf(row, first_block);
  PhiloxHalves(counter, key_, cells);
}

std::array<float, PixelNoise::kBlock> PixelNoise::Block(int row, int block_column) const {
  std::array<std::uint32_t, 4> counter = counter_;
  counter[0] = CounterOf(row, block_column);
  const auto bits = core::Philox4x32(counter, key_);
  const std::span<const float, kCells> table = NumbersOfCells();
  std::array<float, kBlock> numbers{};
  for (std::size_t i = 0; i < bits.size(); ++i) {
    // Two numbers of 16 bits from each of the block's four words.
    numbers[2 * i] = table[bits[i] & 0xFFFFU];
    numbers[2 * i + 1] = table[bits[i] >> 16];
  }
  return numbers;
}

ImageReadout::ImageReadout(const ImagerParams& imager, double speckle_contrast)
    : detector_(imager.detector()),
      repeatability_(imager.exposure.repeatability),
      speckle_contrast_(speckle_contrast),
      largest_count_((1 << detector_.adc_bits) - 1),
      black_counts_(imager.black_level * largest_count_),
      // The black level is a share of the largest count, and a full well fills the rest.
      electrons_per_count_(detector_.full_well_e / (largest_count_ - black_counts_)) {}

double ImageReadout::RepeatedTime(double exposure_s, core::TrialKey key, ImageNumber image) const {
  core::RandomStream stream(key, core::Purpose::kImageExposure, image);
  // t' = t (1 + N(0, repeatability)).
  return exposure_s * std::max(0.0, 1.0 + core::SampleNormal(stream, 0.0, repeatability_));
}

PixelPattern ImageReadout::Pattern(int camera, int row, int first_column, int columns,
                                   core::TrialKey key) const {
  const auto draw = [&](std::uint32_t kind, double deviation) {
    // Response and offset have an image of noise each, for each camera.
    const ImageNumber image = 2 * static_cast<ImageNumber>(camera) + kind;
    std::vector<double> values(static_cast<std::size_t>(columns));
    ForEachPixelNoise(PixelNoise(key, core::Purpose::kPixelPattern, image), row, first_column,
                      columns, [&](int column, float z) {
                        values[static_cast<std::size_t>(column - first_column)] = deviation * z;
                      });
    return values;
  };
  return {draw(0, detector_.response_nonuniformity), draw(1, detector_.offset_nonuniformity_e)};
}

std::vector<double> ImageReadout::Photoelectrons(const RenderedRow& row, int first_column,
                                                 double exposure_s, core::TrialKey key,
                                                 ImageNumber image,
                                                 const std::vector<bool>& lamp_is_on) const {
  std::vector<double> mean_e(row.sun_e_s.size());
  std::transform(row.sun_e_s.begin(), row.sun_e_s.end(), mean_e.begin(),
                 [exposure_s](double rate_e_s) { return rate_e_s * exposure_s; });
  const PixelNoise speckle(key, core::Purpose::kImageSpeckle, image);
  for (const RenderedRow::LampPixel& light : row.lamps) {
    if (!lamp_is_on[static_cast<std::size_t>(light.lamp)]) continue;
    const double z = speckle.At(row.row, first_column + light.pixel);
    // Speckle multiplies the lamp's light alone.
    mean_e[static_cast<std::size_t>(light.pixel)] +=
        light.rate_e_s * exposure_s * std::max(0.0, 1.0 + speckle_contrast_ * z);
  }
  return mean_e;
}

void ImageReadout::Read(const RenderedRow& row, const PixelPattern& pattern, int first_column,
                        double exposure_s, core::TrialKey key, ImageNumber image,
                        const std::vector<bool>& lamp_is_on,
                        std::vector<std::uint16_t>& counts) const {
  const std::vector<double> mean_e =
      Photoelectrons(row, first_column, exposure_s, key, image, lamp_is_on);
  const double dark_e = detector_.dark_current_e_s * exposure_s;
  const double read2_e2 = detector_.read_noise_e * detector_.read_noise_e;
  const double counts_per_electron = 1.0 / electrons_per_count_;
  const std::size_t first = counts.size();
  counts.resize(first + mean_e.size());
  ForEachPixelNoise(
      PixelNoise(key, core::Purpose::kImageNoise, image), row.row, first_column,
      static_cast<int>(mean_e.size()), [&](int column, float z) {
        const auto i = static_cast<std::size_t>(column - first_column);
        // Poisson variance of light and dark charge is their mean; read noise adds its own:
        //   N = R t + D t + r R t + o + sqrt(R t + D t + s^2) z.
        const double random_e = mean_e[i] + dark_e;
        const double e = random_e + pattern.response[i] * mean_e[i] + pattern.offset_e[i] +
                         std::sqrt(random_e + read2_e2) * z;
        // The full well cuts before the black level is added; adding 1/2 rounds, since the
        // conversion to whole numbers cuts off.
        const double count =
            std::min(e, detector_.full_well_e) * counts_per_electron + black_counts_ + 0.5;
        counts[first + i] =
            static_cast<std::uint16_t>(std::clamp(count, 0.0, static_cast<double>(largest_count_)));
      });
}

}  // namespace rockyard::rendering
