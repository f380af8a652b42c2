#include "vision/cylinder/colour_regions.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

#include "core/check.h"

namespace rockyard::vision {
namespace {

// Pixels first to last of a row, of one region.
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

  // The earliest run of the set.
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
  // Sums, until all runs are there.
  region.centroid += Pixel(0.5 * (run.first + run.last), run.row) * pixels;
}

}  // namespace

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
