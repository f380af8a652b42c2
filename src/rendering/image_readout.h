// From expected photoelectrons to the numbers that an imager delivers, with noise drawn by place in
// the image: for stripe images and pictures of the terrain. PixelNoise serves more: textures, the
// cylinder's images and the stereo error model draw from it. Records of drives by images depend on
// all bits of the read-out.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/random.h"
#include "rendering/imager_params.h"
#include "rendering/row_renderer.h"

namespace rockyard::rendering {

// Independent standard normal numbers, one for each pixel of an image. Eight pixels share a Philox
// block: each takes 16 bits of it through a table of the inverse cumulative function at the middles
// of 65536 equally likely cells. The numbers are therefore discrete, symmetric, at most 4.3 in
// size, and have the variance 0.99995; averages over tens of pixels do not show it. Cost: about 1
// ns each by lines, 3 ns by blocks.
//
// Must stay: the table and the layout of the counter. Records of all that draws from PixelNoise
// depend on them. Users draw by place and never in turn.
class PixelNoise {
 public:
  static constexpr int kBlock = 8;

  // `image` names the image within the stream of the purpose, e.g. scan number and exposure.
  PixelNoise(core::TrialKey key, core::Purpose purpose, std::uint32_t image)
      : counter_{0, image, static_cast<std::uint32_t>(purpose), key.trial},
        key_{static_cast<std::uint32_t>(key.seed), static_cast<std::uint32_t>(key.seed >> 32)} {}

  // Returns the numbers of eight neighbouring pixels of a line: of columns 8 k .. 8 k + 7 for k =
  // block_column. Columns and rows may be negative, down to -2^15.
  std::array<float, kBlock> Block(int row, int block_column) const;

  // Writes the cells of the pixels of a line from the first one of block `first_block` on: what
  // Block looks up, eight a block. As many blocks are drawn as fill `cells`, side by side.
  void Cells(int row, int first_block, std::span<std::uint16_t> cells) const;

  // Returns the number that each cell stands for, ascending.
  static std::span<const float, 65536> NumbersOfCells();

  // Returns the number of one pixel.
  float At(int row, int column) const {
    const int block = BlockOf(column);
    return Block(row, block)[static_cast<std::size_t>(column - kBlock * block)];
  }

  static constexpr int BlockOf(int column) {
    constexpr int kOffset = 1 << 15;  // a multiple of kBlock: rounds negative columns down
    return (column + kOffset) / kBlock - kOffset / kBlock;
  }

 private:
  std::array<std::uint32_t, 4> counter_;
  std::array<std::uint32_t, 2> key_;
};

// Calls use(column, number) for the columns first .. first + count - 1 of a line.
template <typename Use>
void ForEachPixelNoise(const PixelNoise& noise, int row, int first, int count, Use use) {
  constexpr int kBlock = PixelNoise::kBlock;
  std::array<std::uint16_t, 16 * kBlock> cells{};
  const std::span<const float, 65536> numbers = PixelNoise::NumbersOfCells();
  const int end = first + count;
  int column = first;
  while (column < end) {
    const int block = PixelNoise::BlockOf(column);
    const int last_block = std::min(PixelNoise::BlockOf(end - 1), block + 15);
    const auto size = static_cast<std::size_t>(last_block - block + 1) * kBlock;
    noise.Cells(row, block, std::span(cells).first(size));
    const int chunk_end = std::min(end, (last_block + 1) * kBlock);
    for (; column < chunk_end; ++column) {
      use(column, numbers[cells[static_cast<std::size_t>(column - block * kBlock)]]);
    }
  }
}

// Names the image of a trial that is read out: its substream within the streams of image noise.
using ImageNumber = std::uint32_t;

// How the pixels of one line depart from the average pixel, in all images of a trial.
struct PixelPattern {
  std::vector<double> response;  // relative
  std::vector<double> offset_e;
};

// The read-out of an imager. A pixel collects
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

  // Returns the exposure time of an image that is to repeat another one's, exposure_s: exposure_s
  // times 1 + N(0, repeatability), at least 0. Draws from (kImageExposure, image).
  double RepeatedTime(double exposure_s, core::TrialKey key, ImageNumber image) const;

  // Returns the pattern of `columns` pixels of a line. Draws from (kPixelPattern, camera) alone:
  // the pattern of a pixel is the same in all images of the trial.
  PixelPattern Pattern(int camera, int row, int first_column, int columns,
                       core::TrialKey key) const;

  // Reads one line and appends its counts to `counts`. `lamp_is_on` holds a flag for each lamp.
  // Draws from (kImageNoise, image) and, for the light of lamps, from (kImageSpeckle, image).
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
