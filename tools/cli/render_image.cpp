#include "tools/cli/render_image.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>

#include "tools/cli/progress.h"
#include "tools/cli/shade.h"

namespace shaolin {
namespace {

constexpr int tile_side = 32;

std::array<float, 3> to_float(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

/// One sample, at the pixel's centre: the image depends on nothing else.
Pixel render_pixel(const Scene& scene, const Shader& shader, const std::optional<Vec3>& background, const Ray& ray) {
  Pixel pixel;
  const std::optional<Hit> hit = scene.intersect(ray);
  if (!hit) {
    if (background) {
      pixel.color = to_float(*background);
      pixel.alpha = 1;
    }
    return pixel;
  }
  pixel.color = shader.shade(ray, *hit);
  pixel.alpha = 1;
  pixel.z = static_cast<float>(hit->t);
  pixel.normal = to_float(hit->sample.normal);
  pixel.position = to_float(hit->sample.position);
  pixel.uv = {static_cast<float>(hit->at.u), static_cast<float>(hit->at.v)};
  pixel.face = static_cast<std::uint32_t>(hit->at.face);
  pixel.level = static_cast<std::uint32_t>(hit->level);
  pixel.instance = static_cast<std::uint32_t>(hit->instance);
  return pixel;
}

}  // namespace

// In square tiles: neighbouring rays refine the same patches.
Image render_image(const Scene& scene, const View& view, const Look& look, const SceneOptions& options) {
  Image image(view.size());
  const Shader shader(scene, view, look, options);
  const int columns = (image.size.width + tile_side - 1) / tile_side;
  const int rows = (image.size.height + tile_side - 1) / tile_side;
  Progress progress(static_cast<std::size_t>(columns) * rows);
  const auto render_tile = [&](int tile) {
    const int left = tile % columns * tile_side, top = tile / columns * tile_side;
    for (int y = top; y < std::min(top + tile_side, image.size.height); ++y)
      for (int x = left; x < std::min(left + tile_side, image.size.width); ++x)
        image.at(x, y) = render_pixel(scene, shader, look.background, view.ray(x, y));
    progress.advance();
  };
  tbb::parallel_for(
      tbb::blocked_range<int>(0, columns * rows, 1),
      [&](const tbb::blocked_range<int>& tiles) {
        for (int tile = tiles.begin(); tile != tiles.end(); ++tile) render_tile(tile);
      },
      tbb::simple_partitioner());
  return image;
}

}  // namespace shaolin
