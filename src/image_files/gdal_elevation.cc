#include "image_files/gdal_elevation.h"

#ifdef ROCKYARD_GDAL
#include <fmt/format.h>
#include <gdal.h>
#include <gdal_frmts.h>
#include <ogr_srs_api.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "core/check.h"
#include "image_files/raw_image.h"
#endif

#include "image_files/gdal_library.h"

namespace rockyard::image_files {

#ifdef ROCKYARD_GDAL
namespace {

// The functions of the library that are used here, of the types in its headers.
struct ElevationFunctions {
  decltype(&::GDALClose) close = nullptr;
  decltype(&::GDALDataTypeIsComplex) is_complex = nullptr;
  decltype(&::GDALGetBlockSize) block_size = nullptr;
  decltype(&::GDALGetDataTypeSizeBytes) type_bytes = nullptr;
  decltype(&::GDALGetGeoTransform) transform = nullptr;
  decltype(&::GDALGetRasterBand) band = nullptr;
  decltype(&::GDALGetRasterCount) bands = nullptr;
  decltype(&::GDALGetRasterDataType) data_type = nullptr;
  decltype(&::GDALGetRasterNoDataValue) no_data = nullptr;
  decltype(&::GDALGetRasterOffset) offset = nullptr;
  decltype(&::GDALGetRasterScale) scale = nullptr;
  decltype(&::GDALGetRasterUnitType) unit = nullptr;
  decltype(&::GDALGetRasterXSize) width = nullptr;
  decltype(&::GDALGetRasterYSize) height = nullptr;
  decltype(&::GDALGetSpatialRef) frame = nullptr;
  decltype(&::GDALOpenEx) open = nullptr;
  decltype(&::GDALRasterIO) read = nullptr;
  decltype(&::OCTDestroyCoordinateTransformation) destroy_way = nullptr;
  decltype(&::OCTNewCoordinateTransformation) new_way = nullptr;
  decltype(&::OCTTransform) go = nullptr;
  decltype(&::OSRClone) clone = nullptr;
  decltype(&::OSRCloneGeogCS) clone_geographic = nullptr;
  decltype(&::OSRDestroySpatialReference) destroy_frame = nullptr;
  decltype(&::OSRGetName) frame_name = nullptr;
  decltype(&::OSRIsGeographic) is_geographic = nullptr;
  decltype(&::OSRIsProjected) is_projected = nullptr;
  decltype(&::OSRSetAE) set_azimuthal = nullptr;
  decltype(&::OSRSetAxisMappingStrategy) set_axes = nullptr;
  decltype(&::OSRSetProjCS) set_projected = nullptr;
};

// Returns the functions and makes the drivers of elevation models known.
std::optional<ElevationFunctions> LoadElevationFunctions() {
  if (GdalLibrary() == nullptr) return std::nullopt;
  ElevationFunctions f;
  bool complete =
      FindFunction("GDALClose", f.close) && FindFunction("GDALDataTypeIsComplex", f.is_complex) &&
      FindFunction("GDALGetBlockSize", f.block_size) &&
      FindFunction("GDALGetDataTypeSizeBytes", f.type_bytes) &&
      FindFunction("GDALGetGeoTransform", f.transform) &&
      FindFunction("GDALGetRasterBand", f.band) && FindFunction("GDALGetRasterCount", f.bands) &&
      FindFunction("GDALGetRasterDataType", f.data_type) &&
      FindFunction("GDALGetRasterNoDataValue", f.no_data) &&
      FindFunction("GDALGetRasterOffset", f.offset) &&
      FindFunction("GDALGetRasterScale", f.scale) &&
      FindFunction("GDALGetRasterUnitType", f.unit) &&
      FindFunction("GDALGetRasterXSize", f.width) && FindFunction("GDALGetRasterYSize", f.height) &&
      FindFunction("GDALGetSpatialRef", f.frame) && FindFunction("GDALOpenEx", f.open) &&
      FindFunction("GDALRasterIO", f.read) &&
      FindFunction("OCTDestroyCoordinateTransformation", f.destroy_way) &&
      FindFunction("OCTNewCoordinateTransformation", f.new_way) &&
      FindFunction("OCTTransform", f.go) && FindFunction("OSRClone", f.clone) &&
      FindFunction("OSRCloneGeogCS", f.clone_geographic) &&
      FindFunction("OSRDestroySpatialReference", f.destroy_frame) &&
      FindFunction("OSRGetName", f.frame_name) &&
      FindFunction("OSRIsGeographic", f.is_geographic) &&
      FindFunction("OSRIsProjected", f.is_projected) && FindFunction("OSRSetAE", f.set_azimuthal) &&
      FindFunction("OSRSetAxisMappingStrategy", f.set_axes) &&
      FindFunction("OSRSetProjCS", f.set_projected);
  for (const char* driver : {"GDALRegister_AAIGrid", "GDALRegister_GTiff", "GDALRegister_ISIS3",
                             "GDALRegister_PDS", "GDALRegister_PDS4", "GDALRegister_VICAR"}) {
    void (*make_known)() = nullptr;
    complete = complete && FindFunction(driver, make_known);
    if (complete) make_known();
  }
  if (!complete) return std::nullopt;
  return f;
}

const std::optional<ElevationFunctions>& Functions() {
  static const std::optional<ElevationFunctions> functions = LoadElevationFunctions();
  return functions;
}

struct CloseDataset {
  void operator()(void* dataset) const { Functions()->close(dataset); }
};
struct DestroyFrame {
  void operator()(OGRSpatialReferenceH frame) const { Functions()->destroy_frame(frame); }
};
struct DestroyWay {
  void operator()(OGRCoordinateTransformationH way) const { Functions()->destroy_way(way); }
};
using Dataset = std::unique_ptr<void, CloseDataset>;
using Frame = std::unique_ptr<void, DestroyFrame>;
using Way = std::unique_ptr<std::remove_pointer_t<OGRCoordinateTransformationH>, DestroyWay>;

// The largest piece that GDAL may have to hold at once to read one cell.
constexpr std::int64_t kMostBlockBytes = std::int64_t{1} << 28;
// Beyond it lie only marks of missing data: PDS3 has several around -3.4e38.
constexpr double kLargestHeight = 1e30;

Dataset OpenDataset(const std::string& name, const char* driver) {
  const GdalErrors errors;
  const std::array<const char*, 2> drivers{driver, nullptr};
  // Grids of text would else be whole numbers where their first rows are.
  const bool is_text = std::string_view(driver) == "AAIGrid";
  const std::array<const char*, 2> options{is_text ? "DATATYPE=Float64" : nullptr, nullptr};
  const std::array<const char*, 1> none{nullptr};  // of files beside it
  Dataset dataset(Functions()->open(name.c_str(),
                                    GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR,
                                    drivers.data(), options.data(), none.data()));
  if (!dataset) FailDamaged(name, errors.first());
  return dataset;
}

void CheckBand(const std::string& name, void* dataset) {
  const ElevationFunctions& f = *Functions();
  if (f.bands(dataset) != 1) {
    FailUnsupported(name, fmt::format("has {} bands", f.bands(dataset)),
                    "take the band of heights out first: gdal_translate -b 1");
  }
  const GDALRasterBandH band = f.band(dataset, 1);
  const GDALDataType type = f.data_type(band);
  if (f.is_complex(type) != 0) {
    FailUnsupported(name, "holds complex numbers", "name a file of heights");
  }
  int columns = 0;
  int rows = 0;
  f.block_size(band, &columns, &rows);
  if (std::int64_t{columns} * rows * f.type_bytes(type) > kMostBlockBytes) {
    FailUnsupported(name, fmt::format("is stored in pieces of {} x {} cells", columns, rows),
                    "divide it first: gdal_translate -co TILED=YES");
  }
}

RasterInfo InfoOf(void* dataset) {
  const ElevationFunctions& f = *Functions();
  const GDALRasterBandH band = f.band(dataset, 1);
  RasterInfo info;
  info.rows = f.height(dataset);
  info.columns = f.width(dataset);
  std::array<double, 6> transform{};
  if (f.transform(dataset, transform.data()) == CE_None) info.transform = transform;
  const OGRSpatialReferenceH frame = f.frame(dataset);
  if (frame != nullptr && (f.is_geographic(frame) != 0 || f.is_projected(frame) != 0)) {
    const char* name = f.frame_name(frame);
    info.frame = name == nullptr || *name == '\0' ? "unnamed" : name;
  }
  if (const char* unit = f.unit(band)) info.unit = unit;
  int there = 0;
  const double scale = f.scale(band, &there);
  if (there != 0 && std::isfinite(scale) && scale != 0.0) info.scale = scale;
  const double offset = f.offset(band, &there);
  if (there != 0 && std::isfinite(offset)) info.offset = offset;
  const double no_data = f.no_data(band, &there);
  if (there != 0) info.no_data = no_data;
  return info;
}

class GdalElevation final : public ElevationRaster {
 public:
  GdalElevation(std::string name, RasterInfo info, Dataset dataset)
      : ElevationRaster(std::move(name), std::move(info)), dataset_(std::move(dataset)) {
    if (!HasFrame()) return;
    frame_.reset(Functions()->clone(Functions()->frame(dataset_.get())));
    geographic_.reset(Functions()->clone_geographic(frame_.get()));
    Functions()->set_axes(frame_.get(), OAMS_TRADITIONAL_GIS_ORDER);
    if (geographic_) Functions()->set_axes(geographic_.get(), OAMS_TRADITIONAL_GIS_ORDER);
  }

  std::vector<double> Read(const RasterWindow& window) override {
    EXPECT(window.rows * window.columns <= kMostWindowCells);
    const GdalErrors errors;
    std::vector<double> heights(static_cast<std::size_t>(window.rows * window.columns));
    const auto columns = static_cast<int>(window.columns);
    const auto rows = static_cast<int>(window.rows);
    const CPLErr failure =
        Functions()->read(Functions()->band(dataset_.get(), 1), GF_Read,
                          static_cast<int>(window.column), static_cast<int>(window.row), columns,
                          rows, heights.data(), columns, rows, GDT_Float64, 0, 0);
    if (failure != CE_None || errors.any()) FailDamaged(name(), errors.first());
    for (double& height : heights) {
      const bool missing = !std::isfinite(height) || std::abs(height) > kLargestHeight ||
                           (info().no_data && height == *info().no_data);
      height = missing ? std::numeric_limits<double>::quiet_NaN()
                       : height * info().scale + info().offset;
    }
    return heights;
  }

  std::vector<MapPoint> ToMap(const GeoPoint& around,
                              std::span<const LocalPoint> points) const override {
    const GdalErrors errors;
    const Frame local(geographic_ ? Functions()->clone(geographic_.get()) : nullptr);
    if (!local) FailFrame(errors);
    Functions()->set_projected(local.get(), "local");
    Functions()->set_azimuthal(local.get(), around.latitude_deg, around.longitude_deg, 0.0, 0.0);
    Functions()->set_axes(local.get(), OAMS_TRADITIONAL_GIS_ORDER);
    std::vector<MapPoint> places;
    places.reserve(points.size());
    for (const LocalPoint& point : points) places.push_back({point.east_m, point.north_m});
    Transform(local.get(), frame_.get(), places, errors);
    return places;
  }

  std::vector<GeoPoint> ToGeographic(std::span<const MapPoint> points) const override {
    const GdalErrors errors;
    if (!geographic_) FailFrame(errors);
    std::vector<MapPoint> places(points.begin(), points.end());
    Transform(frame_.get(), geographic_.get(), places, errors);
    std::vector<GeoPoint> found;
    found.reserve(places.size());
    for (const MapPoint& place : places) found.push_back({place.y, place.x});
    return found;
  }

 private:
  [[noreturn]] void FailFrame(const GdalErrors& errors) const {
    FailUnsupported(name(),
                    fmt::format("has a frame, {}, in which places cannot be found: {}",
                                info().frame, errors.first()),
                    "name the part by --crop ROW,COLUMN,ROWS,COLUMNS and --crs map");
  }

  // Takes the places, first and second axis, from one frame to another.
  void Transform(OGRSpatialReferenceH from, OGRSpatialReferenceH to, std::vector<MapPoint>& places,
                 const GdalErrors& errors) const {
    const Way way(Functions()->new_way(from, to));
    if (!way) FailFrame(errors);
    std::vector<double> x;
    std::vector<double> y;
    for (const MapPoint& place : places) {
      x.push_back(place.x);
      y.push_back(place.y);
    }
    const int all =
        Functions()->go(way.get(), static_cast<int>(x.size()), x.data(), y.data(), nullptr);
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (all == 0 || !std::isfinite(x[i]) || !std::isfinite(y[i])) FailFrame(errors);
      places[i] = {x[i], y[i]};
    }
  }

  Dataset dataset_;
  Frame frame_;       // none without HasFrame()
  Frame geographic_;  // of the same body
};

}  // namespace

std::string MissingGdal() { return Functions() ? "" : GdalRemedy(); }

std::unique_ptr<ElevationRaster> OpenByGdal(const std::filesystem::path& path, const char* driver) {
  const GdalErrors quiet;  // what is odd about a label is no failure
  const std::string name = path.string();
  Dataset dataset = OpenDataset(std::filesystem::absolute(path).string(), driver);
  CheckBand(name, dataset.get());
  RasterInfo info = InfoOf(dataset.get());
  info.format = driver;
  // A cell of text takes a digit and a blank. GDAL would look for each missing row from the first
  // on.
  const std::uintmax_t bytes = std::filesystem::file_size(path);
  if (info.format == "AAIGrid" &&
      static_cast<std::uintmax_t>(info.rows) * static_cast<std::uintmax_t>(info.columns) >
          bytes / 2 + 1) {
    FailTruncated(name);
  }
  return std::make_unique<GdalElevation>(name, std::move(info), std::move(dataset));
}
#else
std::string MissingGdal() { return GdalRemedy(); }

std::unique_ptr<ElevationRaster> OpenByGdal(const std::filesystem::path&, const char*) {
  return nullptr;  // nobody asks where it is missing
}
#endif

}  // namespace rockyard::image_files
