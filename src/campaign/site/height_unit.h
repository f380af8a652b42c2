// The unit in which an elevation file has its heights.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "image_files/elevation_raster.h"

namespace rockyard::campaign {

// Returns metres per unit of the file's heights, and says in a note what was assumed. Throws
// core::UserError for a unit that is not known, unless the request says how long it is.
double HeightUnit_m(const image_files::RasterInfo& info, const std::string& name,
                    std::optional<double> stated, std::vector<std::string>& notes);

}  // namespace rockyard::campaign
