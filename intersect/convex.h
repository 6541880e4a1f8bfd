#pragma once
/// Convex shapes as searches see them: by the point that is nearest, and by how far they reach.
#include <memory>
#include <optional>
#include <vector>

#include "box.h"
#include "shapes.h"

namespace shaolin {

/// The coordinates of a query: about its shape's middle, in units that bring all lengths that matter to about 1 (times
/// a power of two, which rounds nothing). So neither the place of a scene nor its size costs digits.
struct QueryFrame {
  Vec3 centre = Vec3::Zero();
  double scale = 1;

  /// Of a shape that is in a box, and a scene.
  QueryFrame(const Box& shape, const Box& scene);

  Vec3 operator()(const Vec3& point) const { return scale * (point - centre); }
  Vec3 to_world(const Vec3& point) const { return point / scale + centre; }
};

/// All points within a radius of a convex core, in a query's frame.
class Convex {
 public:
  /// A point of the core that is nearest to a given one, and how the core may be left from there: the first `rank`
  /// columns of `normals` are an orthonormal basis of what is normal to the side, edge or corner that the point lies
  /// on.
  struct Nearest {
    Vec3 point;
    int rank = 0;  ///< 0 inside, 1 on a side, 2 on an edge, 3 in a corner
    Eigen::Matrix3d normals = Eigen::Matrix3d::Identity();
  };

  /// The point, line or plane that holds a core without an inside: what is normal to it, as a projection, and a point.
  struct Flat {
    Eigen::Matrix3d across;
    Vec3 point;
  };

  explicit Convex(double radius) : radius_(radius) {}
  virtual ~Convex() = default;

  double radius() const { return radius_; }
  virtual Nearest nearest(const Vec3& point) const = 0;
  /// The largest n . x of the core.
  virtual double support(const Vec3& n) const = 0;
  virtual std::optional<Flat> flat() const { return {}; }
  /// The normals of its sides, where it has some.
  virtual const std::vector<Vec3>& sides() const { return no_sides; }

 private:
  static inline const std::vector<Vec3> no_sides;
  double radius_;
};

/// The core is one point, two or three, and what is between them.
class Simplex final : public Convex {
 public:
  Simplex(std::vector<Vec3> corners, double radius);

  Nearest nearest(const Vec3& point) const override;
  double support(const Vec3& n) const override;
  std::optional<Flat> flat() const override;
  const std::vector<Vec3>& sides() const override { return sides_; }

 private:
  std::vector<Vec3> corners_;
  std::vector<Vec3> sides_;  ///< of a triangle: its normal, both ways
};

class Block final : public Convex {
 public:
  Block(const Vec3& centre, const Eigen::Matrix3d& axes, const Vec3& half);

  Nearest nearest(const Vec3& point) const override;
  double support(const Vec3& n) const override;
  const std::vector<Vec3>& sides() const override { return sides_; }

 private:
  Vec3 centre_;
  Eigen::Matrix3d axes_;
  Vec3 half_;
  std::vector<Vec3> sides_;
};

/// What half-spaces with unit normals have in common, if that is bounded.
class Polytope final : public Convex {
 public:
  explicit Polytope(std::vector<HalfSpace> half_spaces);

  /// No point is in all of the half-spaces.
  bool is_empty() const { return corners_.empty(); }

  Nearest nearest(const Vec3& point) const override;
  double support(const Vec3& n) const override;
  const std::vector<Vec3>& sides() const override { return sides_; }

 private:
  bool holds(const Vec3& point) const;

  std::vector<HalfSpace> half_spaces_;
  std::vector<Vec3> corners_, sides_;
};

/// Throw InputError for a number that is not finite, a negative extent, a radius that is not positive, axes that are
/// not unit or not at right angles to 1e-9, and a frustum without a side or with a normal that is zero.
void check(const Sphere& sphere);
void check(const OrientedBox& box);
void check(const Capsule& capsule);
void check(const Triangle& triangle);
void check(const SphereSweep& sweep);
void check(const Frustum& frustum);

Box bounds(const Sphere& sphere);
Box bounds(const OrientedBox& box);
Box bounds(const Capsule& capsule);
Box bounds(const Triangle& triangle);

std::unique_ptr<Convex> convex(const Sphere& sphere, const QueryFrame& frame);
std::unique_ptr<Convex> convex(const OrientedBox& box, const QueryFrame& frame);
std::unique_ptr<Convex> convex(const Capsule& capsule, const QueryFrame& frame);
std::unique_ptr<Convex> convex(const Triangle& triangle, const QueryFrame& frame);

}  // namespace shaolin
