#pragma once
/// A model that rays are thrown at, and the party that answers them.
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "intersect/scene.h"
#include "tools/stress/sites.h"

namespace shaolin::stress {

struct StressModel {
  std::string name;
  ControlMesh mesh;
  std::string scheme;                                  ///< built in
  std::shared_ptr<const SchemeMasks> masks = nullptr;  ///< of a plug-in; null: `scheme`
};

/// The party that is checked: Scene's functions. All are called from several threads at once.
struct RayQueries {
  std::function<std::optional<Hit>(const Ray&)> intersect;
  std::function<bool(const Ray&)> occluded;
  std::function<std::vector<Crossing>(const Ray&)> all_hits;
  std::function<Certificate(const Ray&, const Hit&)> certify;

  static RayQueries of(const Scene& scene);
};
/// Of a scene; tests put faulty ones in its place.
using QueriesOf = std::function<RayQueries(const Scene&)>;

/// A model, perhaps moved, with a scene of it alone.
class Subject {
 public:
  /// `variant` says what was done to the model: to its control points, or by `map`, the transform of its one instance.
  /// Throws InputError as Scene does.
  explicit Subject(const StressModel& model, const QueriesOf& queries_of, std::string variant = {},
                   const Affine& map = Affine::Identity());

  const std::string& name() const { return name_; }
  const std::string& variant() const { return variant_; }
  bool is_moved_instance() const { return !is_identity_; }
  const RayQueries& queries() const { return queries_; }
  const LimitSurface& surface() const { return scene_->surface(); }
  const Sites& sites() const { return sites_; }
  /// The box of the surface, by corners and middles of its pieces, in the world's space; its diagonal, above 0.
  const Box& box() const { return box_; }
  double diagonal() const { return diagonal_; }
  /// Every side of a face is one of exactly one other, the other way round, and all faces have a limit.
  bool is_closed() const { return is_closed_; }

  /// A place of the limit surface in the world's space, evaluated: no ray is asked. It must exist.
  LimitSample evaluate(const SurfaceParameter& at) const;
  /// Of a point from the surface; infinite if there is none.
  double distance(const Vec3& point) const;

  /// How far coordinates of points of the surface and of points along a ray may be off in the library's frames of the
  /// ray: RayFrame::error()'s bound, 160 u of the largest coordinate of the control points and 64 u of their largest
  /// coordinate relative to the ray's origin (u = 2^-53). Under a transform A it grows by the condition |A| |A^-1|, for
  /// the ray is rounded in the object's space.
  double rounding(const Ray& ray) const;
  /// The cosine at which a ray goes 16 times the bound of rounding deep into a surface before it comes out again, for a
  /// radius of curvature of an eighth of the diagonal: sqrt(2 * 16 * rounding * 8 / diagonal); at least 1e-4, from
  /// where on contact_uncertainty() takes a surface to turn away.
  double grazing(const Ray& ray) const;
  /// The largest coordinate of the control points and of the ray's origin.
  double magnitude(const Ray& ray) const;

 private:
  std::string name_, variant_;
  Affine map_;
  std::unique_ptr<const Scene> scene_;
  RayQueries queries_;
  Sites sites_;
  std::vector<std::vector<std::unique_ptr<const LimitPatch>>>
      patches_;  ///< by face and sub, which are asked many times
  Box box_, control_box_;
  Eigen::Matrix3d normals_;  ///< the inverse transpose of the map
  double diagonal_ = 1, condition_ = 1, object_size_ = 0;
  bool is_identity_ = true, is_closed_ = false;
};

}  // namespace shaolin::stress
