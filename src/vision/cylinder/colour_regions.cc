#include "vision/cylinder/colour_regions.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

#include "core/check.h"

namespace rockyard::vision {
namespace {

// Returns whether low <= value / over <= high.
bool RatioIn(double value, double over, double low, double high) {
  return value >= low * over && value <= high * over;
}

bool IsOfClass(const Rgb& pixel, const ColourRatioParams& ratios, double darkest) {
  const double red = pixel.red;
  const double green = pixel.green;
  const double blue = pixel.blue;
  double over = red;
  double first = green;
  double second = blue;
  if (ratios.over == PrimaryColour::kGreen) {
    over = green;
    first = red;
  } else if (ratios.over == PrimaryColour::kBlue) {
    over = blue;
    first = red;
    second = green;
  }
  return over >= darkest && RatioIn(first, over, ratios.first_low, ratios.first_high) &&
         RatioIn(second, over, ratios.second_low, ratios.second_high);
}

// Fills columns first to end - 1, which are background.
void FillGap(int first, int end, int row, std::span<std::uint8_t> labels) {
  const std::uint8_t left = labels[static_cast<std::size_t>(first - 1)];
  const std::uint8_t right = labels[static_cast<std::size_t>(end)];
  const int of_left = (end - first + (row % 2 == 0 ? 1 : 0)) / 2;
  for (int x = first; x < end; ++x) {
    labels[static_cast<std::size_t>(x)] = x < first + of_left ? left : right;
  }
}

// Neighbouring pixels of one region, first to last of a row.
struct ColourRun {
  int row = 0;
  int first = 0;
  int last = 0;
  std::uint8_t label = kBackground;
};

class RunSets {
 public:
  explicit RunSets(std::size_t count) : parents_(count) {
    std::iota(parents_.begin(), parents_.end(), std::size_t{0});
  }

  // Returns the earliest run of the set.
  std::size_t Find(std::size_t run) {
    while (parents_[run] != run) {
      parents_[run] = parents_[parents_[run]];
      run = parents_[run];
    }
    return run;
  }

  void Join(std::size_t a, std::size_t b) {
    const std::size_t root_a = Find(a);
    const std::size_t root_b = Find(b);
    parents_[std::max(root_a, root_b)] = std::min(root_a, root_b);
  }

 private:
  std::vector<std::size_t> parents_;
};

std::vector<ColourRun> RunsOf(const ClassImage& classes, const ImagePart& part,
                              RegionColours colours) {
  std::vector<ColourRun> runs;
  for (int y = part.top; y <= part.bottom; ++y) {
    const std::span<const std::uint8_t> row = classes.Row(y);
    std::uint8_t before = kBackground;
    for (int x = part.left; x <= part.right; ++x) {
      const std::uint8_t label = row[static_cast<std::size_t>(x)];
      if (label != kBackground) {
        const bool goes_on =
            before != kBackground && (colours == RegionColours::kAny || before == label);
        if (goes_on) {
          runs.back().last = x;
        } else {
          runs.push_back({y, x, x, label});
        }
      }
      before = label;
    }
  }
  return runs;
}

bool Touch(const ColourRun& above, const ColourRun& below, RegionColours colours) {
  return above.first <= below.last && below.first <= above.last &&
         (colours == RegionColours::kAny || above.label == below.label);
}

// Joins the runs that touch from row to row.
void JoinRunRows(const std::vector<ColourRun>& runs, RegionColours colours, RunSets& sets) {
  std::size_t above = 0;  // the first run that may still touch one of this row
  for (std::size_t i = 0; i < runs.size(); ++i) {
    while (runs[above].row < runs[i].row - 1 ||
           (runs[above].row == runs[i].row - 1 && runs[above].last < runs[i].first)) {
      ++above;
    }
    for (std::size_t j = above; runs[j].row == runs[i].row - 1 && runs[j].first <= runs[i].last;
         ++j) {
      if (Touch(runs[j], runs[i], colours)) sets.Join(j, i);
    }
  }
}

void Add(const ColourRun& run, ColourRegion& region) {
  const int pixels = run.last - run.first + 1;
  region.left = std::min(region.left, run.first);
  region.right = std::max(region.right, run.last);
  region.bottom = std::max(region.bottom, run.row);
  region.pixels += pixels;
  // The centroid holds sums until FindRegions divides them.
  region.centroid += Pixel(0.5 * (run.first + run.last), run.row) * pixels;
}

}  // namespace

std::uint8_t ClassOf(const Rgb& pixel, const ColourClassParams& params) {
  if (IsOfClass(pixel, params.blue, params.darkest)) return LabelOf(CylinderColour::kBlue);
  if (IsOfClass(pixel, params.magenta, params.darkest)) return LabelOf(CylinderColour::kMagenta);
  if (IsOfClass(pixel, params.red, params.darkest)) return LabelOf(CylinderColour::kRed);
  return kBackground;
}

ClassImage ClassifyColours(const ColourImage& image, int first_row,
                           const ColourClassParams& params) {
  EXPECT(first_row >= 0 && first_row <= image.height());
  ClassImage classes(image.width(), image.height(), kBackground);
  for (int y = first_row; y < image.height(); ++y) {
    const std::span<const Rgb> pixels = image.Row(y);
    std::transform(pixels.begin(), pixels.end(), classes.Row(y).begin(),
                   [&](const Rgb& pixel) { return ClassOf(pixel, params); });
  }
  return classes;
}

void FillGaps(int longest, ClassImage& classes) {
  for (int y = 0; y < classes.height(); ++y) {
    const std::span<std::uint8_t> row = classes.Row(y);
    int last = -1;  // the last column that is no background
    for (int x = 0; x < classes.width(); ++x) {
      const std::uint8_t label = row[static_cast<std::size_t>(x)];
      if (label == kBackground) continue;
      const int gap = x - last - 1;
      if (last >= 0 && gap >= 1 && gap <= longest && row[static_cast<std::size_t>(last)] != label) {
        FillGap(last + 1, x, y, row);
      }
      last = x;
    }
  }
}

ImagePart WholeOf(const ClassImage& classes) {
  EXPECT(!classes.empty());
  return {0, 0, classes.width() - 1, classes.height() - 1};
}

std::vector<ColourRegion> FindRegions(const ClassImage& classes, const ImagePart& part,
                                      RegionColours colours) {
  EXPECT(part.left >= 0 && part.top >= 0 && part.right < classes.width() &&
         part.bottom < classes.height());
  const std::vector<ColourRun> runs = RunsOf(classes, part, colours);
  RunSets sets(runs.size());
  JoinRunRows(runs, colours, sets);
  std::vector<ColourRegion> regions;
  std::vector<std::size_t> region_of(runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::size_t root = sets.Find(i);
    const ColourRun& run = runs[i];
    if (root == i) {
      region_of[i] = regions.size();
      ColourRegion region;
      region.left = run.first;
      region.right = run.last;
      region.top = run.row;
      region.bottom = run.row;
      if (colours == RegionColours::kSingle) region.colour = ColourOf(run.label);
      regions.push_back(region);
    }
    Add(run, regions[region_of[root]]);
  }
  for (ColourRegion& region : regions) region.centroid /= region.pixels;
  return regions;
}

std::optional<ColourRegion> LargestOf(const std::vector<ColourRegion>& regions) {
  const auto largest = std::max_element(
      regions.begin(), regions.end(),
      [](const ColourRegion& a, const ColourRegion& b) { return a.pixels < b.pixels; });
  if (largest == regions.end()) return std::nullopt;
  return *largest;
}

}  // namespace rockyard::vision
