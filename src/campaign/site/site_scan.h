// Sites of an elevation model by their slopes: windows over the whole file, picked and ranked. The
// command `terrain --scan-sites` lists them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "campaign/site/surface_statistics.h"
#include "image_files/elevation_raster.h"

namespace rockyard::campaign {

struct Range {
  double low = 0.0;
  double high = 0.0;
};

struct ScanRequest {
  std::filesystem::path file;
  double size_m = 60.0;              // side of a window
  std::optional<Range> median = {};  // of slopes, degrees; any where it is not given
  std::optional<Range> high = {};    // 90 % are less
  int count = 10;                    // sites that are listed
  bool by_map = false;               // as of ElevationRequest
  std::optional<double> cell_m = {};
  std::optional<double> height_scale = {};
};

struct ScannedSite {
  image_files::RasterWindow window;
  std::string place;  // as --at takes it
  SlopeFigures slopes;
  double relief_m = 0.0;  // highest less lowest
};

struct SiteScan {
  std::vector<ScannedSite> sites;  // the best first; none overlaps one before it
  std::int64_t windows = 0;        // that were looked at
  std::int64_t incomplete = 0;     // of these, with nodes without data
  double cell_m = 0.0;             // in the middle of the file
};

// Looks at windows half a side apart, whose slopes are those between cells of the file as they are:
// a map that is stretched counts with its stretch, and heights are not resampled. Sites whose
// median is nearest to the middle of its range come first; without a range the smoothest. At most
// 128 MB of the file are in memory. Time: about 0.3 s for a million cells. Throws core::UserError:
// as ReadElevation, a window larger than the file, cells of more than a tenth of a window.
SiteScan ScanSites(const ScanRequest& request);

}  // namespace rockyard::campaign
