#pragma once
/// A pinhole camera: where it stands, and the rays through its pixels.
#include <string>

#include "intersect/ray.h"
#include "intersect/scene.h"

namespace shaolin {

struct ImageSize {
  int width = 800;
  int height = 800;
  double aspect() const { return static_cast<double>(width) / height; }
};

/// Parses "WxH", each from 1 to 32768. Throws std::invalid_argument that says what was expected.
ImageSize parse_size(const std::string& text);

struct Camera {
  Vec3 eye = Vec3::UnitZ();
  Vec3 target = Vec3::Zero();
  double fov = 40;          ///< the vertical opening angle, in degrees, between 0 and 180
  Vec3 up = Vec3::UnitY();  ///< what the image's up direction leans towards
};

/// What is wrong with a camera, and what was expected: the target must lie apart from the eye, 0 < fov < 180, and `up`
/// have a direction. Empty if nothing is.
std::string fault_of(const Camera& camera);

/// Parses "ex,ey,ez,tx,ty,tz,fov[,ux,uy,uz]": finite numbers that make a camera without a fault. Throws
/// std::invalid_argument that says what was expected.
Camera parse_camera(const std::string& text);

/// The same text, which parses back to the same camera; without `up` where that is y.
std::string to_string(const Camera& camera);

/// Looks at the box's centre from the front, right and above, near enough that the box's bounding sphere just fits.
Camera default_camera(const Box& bounds, ImageSize size);

/// A camera with an image in front of it.
class View {
 public:
  /// The image's up direction leans towards the camera's `up`. Looking along that, or against it, it leans towards +z
  /// when looking up and -z when looking down, as a camera that was tilted there from looking along -z (if `up` is
  /// along z: +y and -y).
  View(const Camera& camera, ImageSize size);

  /// The ray through the centre of a pixel; row 0 is the top row. Its direction is unit, so t is the distance.
  Ray ray(int x, int y) const;
  /// The way to a place of the image, not unit: pixels are squares between whole numbers, (0, 0) is the upper left
  /// corner.
  Vec3 direction(double x, double y) const;

  const Camera& camera() const { return camera_; }
  const ImageSize& size() const { return size_; }
  const Vec3& right() const { return right_; }      ///< unit
  const Vec3& up() const { return up_; }            ///< unit
  const Vec3& forward() const { return forward_; }  ///< unit

 private:
  Camera camera_;
  ImageSize size_;
  Vec3 right_, up_, forward_;
  double half_height_;  ///< of the image plane at distance 1
};

}  // namespace shaolin
