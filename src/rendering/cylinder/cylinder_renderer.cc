#include "rendering/cylinder/cylinder_renderer.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "rendering/cylinder/backdrop.h"
#include "rendering/cylinder/colour_readout.h"
#include "rendering/cylinder/cylinder_scene.h"

namespace rockyard::rendering {
namespace {

using math::Vector3;

// Columns and rows of an image, both ends inclusive.
struct PixelBox {
  int left = 0;
  int top = 0;
  int right = -1;
  int bottom = -1;

  bool Holds(int column, int row) const {
    return column >= left && column <= right && row >= top && row <= bottom;
  }
};

// Rays of a pinhole with square, upright pixels.
class PinholeRays {
 public:
  explicit PinholeRays(const vision::Cahv& camera) : camera_(camera) {
    const Vector3 across = camera.H - camera.H.dot(camera.A) * camera.A;
    const Vector3 down = camera.V - camera.V.dot(camera.A) * camera.A;
    per_column_ = across / across.squaredNorm();
    per_row_ = down / down.squaredNorm();
    first_ = camera.A - camera.H.dot(camera.A) * per_column_ - camera.V.dot(camera.A) * per_row_;
  }

  ColourRay At(double column, double row) const {
    return {camera_.C, first_ + column * per_column_ + row * per_row_};
  }

 private:
  vision::Cahv camera_;
  Vector3 per_column_;
  Vector3 per_row_;
  Vector3 first_;
};

// Returns the pixels that a body may cover: all where the body reaches behind the camera.
PixelBox BoxOf(const BodyCaster& body, const vision::Cahv& camera, const ColourPlane& plane) {
  const PixelBox all{0, 0, plane.width() - 1, plane.height() - 1};
  double left = std::numeric_limits<double>::infinity();
  double right = -left;
  double top = left;
  double bottom = -left;
  for (const Vector3& corner_L : body.Corners()) {
    const auto pixel = vision::Project(camera, corner_L);
    if (!pixel) return all;
    left = std::fmin(left, pixel->x());
    right = std::fmax(right, pixel->x());
    top = std::fmin(top, pixel->y());
    bottom = std::fmax(bottom, pixel->y());
  }
  // One pixel around: edges are looked for there, too.
  const auto clamped = [](double value, int last) {
    return static_cast<int>(std::clamp(value, -1.0, last + 1.0));
  };
  return {std::max(all.left, clamped(std::floor(left) - 1.0, all.right)),
          std::max(all.top, clamped(std::floor(top) - 1.0, all.bottom)),
          std::min(all.right, clamped(std::ceil(right) + 1.0, all.right)),
          std::min(all.bottom, clamped(std::ceil(bottom) + 1.0, all.bottom))};
}

class EyeRenderer {
 public:
  EyeRenderer(const std::vector<BodyCaster>& bodies, const ColourLight& light,
              const vision::Cahv& camera, int edge_samples, ColourPlanes& planes)
      : bodies_(bodies),
        light_(light),
        rays_(camera),
        edge_samples_(edge_samples),
        planes_(planes),
        background_(planes),
        parts_(planes[0].width(), planes[0].height(), kBackground),
        depths_(planes[0].width(), planes[0].height(), std::numeric_limits<float>::infinity()) {
    for (const BodyCaster& body : bodies) boxes_.push_back(BoxOf(body, camera, planes[0]));
  }

  void Draw() {
    for (std::size_t i = 0; i < bodies_.size(); ++i) DrawMiddles(i);
    for (const PixelBox& box : boxes_) SplitEdges(box);
  }

 private:
  static constexpr std::int16_t kBackground = -1;

  Colour Shade(const BodyCaster& body, const BodyHit& hit) const {
    return body.body().colours[static_cast<std::size_t>(hit.part)] * light_.On(hit.normal);
  }

  void DrawMiddles(std::size_t number) {
    const PixelBox& box = boxes_[number];
    for (int row = box.top; row <= box.bottom; ++row) {
      for (int column = box.left; column <= box.right; ++column) {
        const auto hit = bodies_[number].Cast(rays_.At(column, row));
        if (!hit || hit->along >= depths_.At(column, row)) continue;
        depths_.At(column, row) = static_cast<float>(hit->along);
        parts_.At(column, row) =
            static_cast<std::int16_t>(static_cast<int>(number) * kBodyParts + hit->part);
        SetPixel(planes_, column, row, Shade(bodies_[number], *hit));
      }
    }
  }

  // Returns whether a neighbour shows another part; beyond the image nothing differs.
  bool IsEdge(int column, int row) const {
    const std::int16_t part = parts_.At(column, row);
    const auto differs = [&](int x, int y) {
      const bool inside = x >= 0 && y >= 0 && x < parts_.width() && y < parts_.height();
      return inside && parts_.At(x, y) != part;
    };
    return differs(column - 1, row) || differs(column + 1, row) || differs(column, row - 1) ||
           differs(column, row + 1);
  }

  void SplitEdges(const PixelBox& box) {
    for (int row = box.top; row <= box.bottom; ++row) {
      for (int column = box.left; column <= box.right; ++column) {
        if (IsEdge(column, row)) SetPixel(planes_, column, row, MeanOf(column, row));
      }
    }
  }

  Colour MeanOf(int column, int row) const {
    std::vector<std::size_t> near;
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      if (boxes_[i].Holds(column, row)) near.push_back(i);
    }
    const Colour background = PixelOf(background_, column, row);
    Colour sum = Colour::Zero();
    for (int j = 0; j < edge_samples_; ++j) {
      for (int i = 0; i < edge_samples_; ++i) {
        const double x = column - 0.5 + (i + 0.5) / edge_samples_;
        const double y = row - 0.5 + (j + 0.5) / edge_samples_;
        sum += Seen(near, rays_.At(x, y), background);
      }
    }
    return sum / static_cast<double>(edge_samples_ * edge_samples_);
  }

  Colour Seen(const std::vector<std::size_t>& near, const ColourRay& ray,
              const Colour& background) const {
    std::optional<BodyHit> nearest;
    const BodyCaster* seen = nullptr;
    for (const std::size_t i : near) {
      const auto hit = bodies_[i].Cast(ray);
      if (!hit || (nearest && hit->along >= nearest->along)) continue;
      nearest = hit;
      seen = &bodies_[i];
    }
    return seen == nullptr ? background : Shade(*seen, *nearest);
  }

  const std::vector<BodyCaster>& bodies_;
  const ColourLight& light_;
  PinholeRays rays_;
  int edge_samples_;
  ColourPlanes& planes_;
  ColourPlanes background_;
  vision::Image<std::int16_t> parts_;  // body times kBodyParts plus part
  ColourPlane depths_;
  std::vector<PixelBox> boxes_;
};

}  // namespace

std::array<ColourPlanes, 2> RenderCylinder(const CylinderPictureParams& params,
                                           const CylinderView& view, core::TrialKey key) {
  const ColourLight light(params.light, ToColour(params.backdrop.ground));
  const std::vector<BodyCaster> bodies = CylinderBodies(params, view, key);
  const auto cameras = CylinderCameras(params, view);
  Backdrop backdrop(params.backdrop, light, key);
  std::array<ColourPlanes, 2> images;
  for (std::size_t eye = 0; eye < images.size(); ++eye) {
    images[eye] =
        MakePlanes(static_cast<int>(params.cameras.columns), static_cast<int>(params.cameras.rows));
    backdrop.Fill(cameras[eye], images[eye]);
    EyeRenderer(bodies, light, cameras[eye], static_cast<int>(params.edge_samples), images[eye])
        .Draw();
  }
  return images;
}

}  // namespace rockyard::rendering
