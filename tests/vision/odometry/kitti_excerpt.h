// Ten frames of a drive in KITTI's layout, for tests that are given the folder (Geiger, Lenz and
// Urtasun 2012). Its licence keeps it out of this repository.
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "image_files/raw_image.h"
#include "image_files/read_image.h"
#include "math/pose.h"
#include "vision/cameras/rectification.h"
#include "vision/odometry/odometer.h"

namespace rockyard::vision {

struct KittiExcerpt {
  RectifiedPair cameras;
  std::vector<AlignedImages> images;
  std::vector<math::Transform> X_WC;  // camera: x right, y down, z ahead
};

inline std::vector<double> NumbersOf(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path.string());
  std::vector<double> numbers;
  for (double number = 0.0; file >> number;) numbers.push_back(number);
  return numbers;
}

inline GrayImage ReadGray(const std::filesystem::path& path) {
  return image_files::ToGray(image_files::ReadImage(path)).image;
}

inline KittiExcerpt ReadKittiExcerpt(const std::filesystem::path& folder) {
  KittiExcerpt excerpt;
  const std::vector<double> P = NumbersOf(folder / "calib.txt");  // P0, then P1
  const std::vector<double> poses = NumbersOf(folder / "poses.txt");
  for (std::size_t i = 0; i + 12 <= poses.size(); i += 12) {
    math::Transform X = math::Transform::Identity();
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 4; ++column) {
        X.matrix()(row, column) = poses[i + static_cast<std::size_t>(4 * row + column)];
      }
    }
    X.linear() = Eigen::Quaterniond(X.linear()).normalized().toRotationMatrix();
    excerpt.X_WC.push_back(X);
    const std::string name = "00000" + std::to_string(i / 12) + ".png";
    excerpt.images.push_back(
        {ReadGray(folder / "image_l" / name), ReadGray(folder / "image_r" / name)});
  }
  RectifiedPair& pair = excerpt.cameras;
  pair.focal_px = P[0];
  pair.baseline_m = -P[15] / P[12];
  pair.left.H = {P[0], 0.0, P[2]};
  pair.left.V = {0.0, P[5], P[6]};
  pair.right = pair.left;
  pair.right.C = {pair.baseline_m, 0.0, 0.0};
  pair.size = {excerpt.images[0].left.width(), excerpt.images[0].left.height()};
  return excerpt;
}

}  // namespace rockyard::vision
