#pragma once
/// A limit surface found by other means than the product's own evaluation: what surfaces are held against.
#include <optional>

#include "schemes/limit_sample.h"
#include "tools/validate/root_mesh.h"

namespace shaolin {

/// Not for concurrent use: evaluation may fill caches.
class Oracle {
 public:
  virtual ~Oracle() = default;

  int face_count() const { return static_cast<int>(root_.has_limit.size()); }
  bool triangular() const { return root_.rules.triangular(); }
  /// False for holes and faces at a boundary that is not interpolated: OpenSubdiv's own answer.
  bool has_limit(int face) const { return root_.has_limit.at(static_cast<std::size_t>(face)); }
  /// 1, or the number of corners of an n-gon of the quad split.
  int sub_count(int face) const { return root_.sub_counts.at(static_cast<std::size_t>(face)); }
  /// The diagonal of the control points' bounding box.
  double diagonal() const { return root_.diagonal; }
  /// True if the surface goes on to all sides of a point: inside a face, or between faces that all have a limit. A ray
  /// that crosses it there cannot miss.
  bool is_inside(const SurfaceParameter& at) const { return root_.is_inside(at); }

  /// True if samples carry derivatives (where the surface has them).
  virtual bool has_derivatives() const = 0;
  /// Empty if the face has no limit surface. u and v are clamped to [0, 1]; so is u + v on triangles. The normal is
  /// zero where the oracle has none to tell. Throws std::out_of_range for face or sub.
  virtual std::optional<LimitSample> evaluate(const SurfaceParameter& at) const = 0;

 protected:
  explicit Oracle(RootMesh root) : root_(std::move(root)) {}

  RootMesh root_;
};

}  // namespace shaolin
