#include "vision/stereo/blob.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "vision/stereo/blob_links.h"

namespace rockyard::vision {
namespace {

// Linked pixels of one row, [begin, end).
struct Run {
  std::int32_t begin;
  std::int32_t end;
  std::int32_t parent;  // a run of the same region; the root is its own parent
  std::int32_t pixels;  // of the whole region, at the root
};

// Runs of the rows seen so far, joined to regions.
class Regions {
 public:
  std::size_t size() const { return runs_.size(); }
  const Run& operator[](std::size_t i) const { return runs_[i]; }

  void Begin(std::int32_t x) {
    const auto number = static_cast<std::int32_t>(runs_.size());
    runs_.push_back({x, x, number, 0});
  }
  void End(std::size_t run, std::int32_t end) {
    runs_[run].end = end;
    runs_[run].pixels = end - runs_[run].begin;
  }
  void Join(std::size_t a, std::size_t b) {
    const std::size_t root_a = Root(a);
    const std::size_t root_b = Root(b);
    if (root_a == root_b) return;
    const auto [root, other] = std::minmax(root_a, root_b);
    runs_[other].parent = static_cast<std::int32_t>(root);
    runs_[root].pixels += runs_[other].pixels;
  }
  std::int32_t Pixels(std::size_t run) { return runs_[Root(run)].pixels; }

 private:
  // Returns the root of a run, and halves the path to it.
  std::size_t Root(std::size_t run) {
    while (static_cast<std::size_t>(runs_[run].parent) != run) {
      runs_[run].parent = runs_[static_cast<std::size_t>(runs_[run].parent)].parent;
      run = static_cast<std::size_t>(runs_[run].parent);
    }
    return run;
  }

  std::vector<Run> runs_;
};

template <typename Action>
void ForEachBit(std::uint64_t bits, std::size_t word, const Action& action) {
  for (; bits != 0; bits &= bits - 1) {
    action(64 * word + static_cast<std::size_t>(std::countr_zero(bits)));
  }
}

// The runs of one row, and in which run a pixel is.
class RowRuns {
 public:
  explicit RowRuns(std::size_t width)
      : links(width), starts_(links.valid.size()), before_(starts_) {}

  // Adds the runs of the row that `links` describes.
  void AddTo(Regions& regions) {
    std::size_t ending = regions.size();
    for (std::size_t word = 0; word < starts_.size(); ++word) {
      starts_[word] = links.valid[word] & ~links.to_left[word];
      before_[word] = regions.size();
      ForEachBit(starts_[word], word,
                 [&](std::size_t x) { regions.Begin(static_cast<std::int32_t>(x)); });
    }
    for (std::size_t word = 0; word < starts_.size(); ++word) {
      const std::uint64_t next = word + 1 < starts_.size() ? links.to_left[word + 1] : 0;
      const std::uint64_t continued = links.to_left[word] >> 1 | next << 63;
      ForEachBit(links.valid[word] & ~continued, word,
                 [&](std::size_t x) { regions.End(ending++, static_cast<std::int32_t>(x + 1)); });
    }
  }

  // Returns the run of pixel x, which is valid: the last run that begins at x or before.
  std::size_t RunAt(std::size_t x) const {
    const std::uint64_t upto = ~std::uint64_t{0} >> (63 - x % 64);
    return before_[x / 64] + static_cast<std::size_t>(std::popcount(starts_[x / 64] & upto)) - 1;
  }

  RowLinks links;

 private:
  std::vector<std::uint64_t> starts_;
  std::vector<std::size_t> before_;  // runs of all rows that begin before the word
};

// Joins the runs of two rows. Of neighbouring links between the same two runs the first is enough.
void JoinRows(const RowRuns& row, const RowRuns& above, Regions& regions) {
  std::uint64_t last_link = 0;
  for (std::size_t word = 0; word < row.links.valid.size(); ++word) {
    const std::uint64_t links = row.links.to_above[word];
    const std::uint64_t said =
        (links << 1 | last_link >> 63) & row.links.to_left[word] & above.links.to_left[word];
    last_link = links;
    ForEachBit(links & ~said, word,
               [&](std::size_t x) { regions.Join(above.RunAt(x), row.RunAt(x)); });
  }
}

}  // namespace

void FilterBlobs(const StereoFilterParams& filters, DisparityImage& disparities) {
  if (disparities.empty()) return;
  const auto width = static_cast<std::size_t>(disparities.width());
  const auto max_step =
      static_cast<std::int16_t>(std::floor(filters.blob_max_step_px * kDisparityOne));
  Regions regions;
  std::vector<std::size_t> row_ends;
  PaddedRow pixels(width);
  PaddedRow pixels_above(width);
  RowRuns row(width);
  RowRuns above(width);
  for (int y = 0; y < disparities.height(); ++y) {
    std::swap(pixels, pixels_above);
    std::swap(row, above);
    pixels.Assign(disparities.Row(y));
    FindLinks(pixels, pixels_above, width, max_step, row.links);
    row.AddTo(regions);
    JoinRows(row, above, regions);
    row_ends.push_back(regions.size());
  }
  std::size_t run = 0;
  for (int y = 0; y < disparities.height(); ++y) {
    for (; run < row_ends[static_cast<std::size_t>(y)]; ++run) {
      if (regions.Pixels(run) >= filters.blob_min_px) continue;
      const std::span<std::int16_t> values = disparities.Row(y);
      std::fill(values.begin() + regions[run].begin, values.begin() + regions[run].end,
                Dropped(Drop::kBlob));
    }
  }
}

}  // namespace rockyard::vision
