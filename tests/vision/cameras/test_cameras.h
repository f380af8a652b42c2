// Cameras to test with, and the flight cameras of tests/data/cameras.
#pragma once

#include <string>
#include <vector>

#include "core/archive.h"
#include "core/json_file.h"
#include "vision/cameras/camera_fields.h"
#include "vision/cameras/camera_model.h"

namespace rockyard::vision {

struct NamedCamera {
  std::string name;
  CameraModel camera;
};

inline core::JsonValue LoadCameraData(const std::string& file) {
  return core::LoadJsonFile(ROCKYARD_SOURCE_DIR "/tests/data/cameras/" + file);
}

inline CameraModel CameraOf(const core::JsonValue& json) {
  CameraFields fields;
  core::ReadParams(json, fields);
  return ModelOf(fields);
}

// The real flight cameras.
inline std::vector<NamedCamera> FlightCameras() {
  const core::JsonValue data = LoadCameraData("flight_models.json");
  std::vector<NamedCamera> cameras;
  for (const core::JsonValue& model : data.Find("models")->list()) {
    cameras.push_back({model.Find("name")->text(), CameraOf(*model.Find("camera"))});
  }
  return cameras;
}

inline CameraModel FlightCamera(const std::string& name) {
  for (NamedCamera& named : FlightCameras()) {
    if (named.name == name) return named.camera;
  }
  throw std::invalid_argument(name);
}

// One with f = 300 px whose axis is z, rows along x, columns along y; turned and shifted by X_AC.
inline Cahv TestCahv(const math::Transform& X_AC = math::Transform::Identity()) {
  return Moved(X_AC, Cahv{{0, 0, 0}, {0, 0, 1}, {300, 2, 319.5}, {-1, 310, 239.5}});
}

// A pose with all of it other than zero.
inline math::Transform TestPose() { return math::MakePose({0.4, -0.2, 1.1}, 0.3, -0.4, 0.5); }

// One of every model, and of every type and range of linearity.
inline std::vector<NamedCamera> ModelCameras() {
  const ImageSize size{640, 480};
  const math::Transform X_AC = TestPose();
  const Cahv linear = TestCahv(X_AC);
  const math::Vector3 O = X_AC.linear() * math::Vector3(0.012, -0.02, 1.0).normalized();
  const math::Vector3 R(0.003, -0.05, 0.012);
  const math::Vector3 E(0.004, 0.006, -0.003);
  std::vector<NamedCamera> cameras = {{"cahv", {linear, size}},
                                      {"cahvor", {Cahvor{linear, O, R}, size}}};
  const math::Vector3 mild(0.003, -0.01, 0.002);
  cameras.push_back(
      {"cahvore perspective", {Cahvore{linear, O, R, E, CahvoreType::kPerspective}, size}});
  cameras.push_back(
      {"cahvore fisheye", {Cahvore{linear, O, mild, E, CahvoreType::kFisheye}, size}});
  for (const double linearity : {-0.5, -0.2, 0.0, 0.37, 0.5, 0.9}) {
    cameras.push_back({"cahvore general " + std::to_string(linearity),
                       {Cahvore{linear, O, mild, E, CahvoreType::kGeneral, linearity}, size}});
  }
  BrownPinhole brown{X_AC, 310, 300, 322, 236};
  brown.k1 = -0.11;
  brown.k2 = 0.03;
  brown.k3 = -0.002;
  brown.p1 = 0.0012;
  brown.p2 = -0.0008;
  cameras.push_back({"brown", {brown, size}});
  return cameras;
}

}  // namespace rockyard::vision
