#include "apps/io/picture/camera.hpp"

#include <algorithm>
#include <limits>

namespace powercell::io {

Camera fit_camera(const View& view, std::span<const Vec3> points) {
  constexpr float distance = 4.5f;  // a gentle perspective
  Camera camera;
  camera.forward = normalized(view.towards) * -1;
  camera.right = normalized(cross(camera.forward, view.up));
  camera.up = cross(camera.right, camera.forward);
  camera.eye = camera.forward * -distance;
  float low_x = std::numeric_limits<float>::max(), low_y = low_x, high_x = -low_x, high_y = -low_x;
  for (const Vec3& point : points) {
    const Projected at = camera.project(point);
    low_x = std::min(low_x, at.x);
    high_x = std::max(high_x, at.x);
    low_y = std::min(low_y, at.y);
    high_y = std::max(high_y, at.y);
  }
  if (points.empty()) low_x = low_y = -0.1f, high_x = high_y = 0.1f;
  const float across = std::max(high_x - low_x, 1e-6f), along = std::max(high_y - low_y, 1e-6f);
  const auto width = static_cast<float>(view.width), height = static_cast<float>(view.height);
  const float margin = 0.04f * std::min(width, height);
  camera.scale = std::min((width - 2 * margin) / across, (height - 2 * margin) / along);
  camera.width = std::max(1, static_cast<int>(std::ceil(2 * margin + (high_x - low_x) * camera.scale)));
  camera.height = std::max(1, static_cast<int>(std::ceil(2 * margin + (high_y - low_y) * camera.scale)));
  camera.left = margin - low_x * camera.scale;
  camera.top = margin - low_y * camera.scale;
  if (view.exact) {
    camera.left += (width - 2 * margin - (high_x - low_x) * camera.scale) / 2;
    camera.top += (height - 2 * margin - (high_y - low_y) * camera.scale) / 2;
    camera.width = view.width;
    camera.height = view.height;
  }
  return camera;
}

}  // namespace powercell::io
