#pragma once
/// The public face of the intersector: a mesh in, queries on its limit surface out.
#include <memory>
#include <optional>
#include <string>

#include "../schemes/control_mesh.h"
#include "box.h"
#include "ray.h"

namespace shaolin {

class LimitSurface;
class SchemeMasks;

/// What rays are intersected with: the limit surface, to rounding error; or, for comparison, the triangles of a
/// tessellation, made when a ray first comes near (uniform.h).
enum class Method { exact, uniform };

struct SceneOptions {
  Method method = Method::exact;
  int level = 5;  ///< of Method::uniform: 1 to 10 refinement steps; time and memory grow as 4^level
};

/// One limit surface, ready for rays. Queries are const and may run concurrently; refinement that they cause is kept
/// and never changes an answer: results are bit-identical for any number of threads and any order of rays.
class Scene {
 public:
  /// Builds the hierarchy over the control faces. `scheme` as in make_limit_surface(). O(n log n) for n faces;
  /// nothing is refined before a ray asks. Throws InputError as make_limit_surface() does, or for a level out of range.
  explicit Scene(ControlMesh mesh, const std::string& scheme, const SceneOptions& options = {});
  /// By any scheme, for instance one from load_plugin(). What the masks throw comes out of this or of the query that is
  /// the first to need one.
  explicit Scene(ControlMesh mesh, const std::shared_ptr<const SchemeMasks>& masks, const SceneOptions& options = {});
  ~Scene();
  Scene(Scene&&) noexcept;
  Scene& operator=(Scene&&) noexcept;

  /// The closest hit with tmin <= t <= tmax, or empty. Throws InputError for a direction that is zero or not finite,
  /// an origin that is not finite or an interval that has a NaN; and, where the method is uniform, what
  /// SubdivisionMesh::refine() throws.
  std::optional<Hit> intersect(const Ray& ray) const;

  /// True if any point of the surface lies on the ray. Throws as intersect() does; cheaper.
  bool occluded(const Ray& ray) const;

  const LimitSurface& surface() const;
  Statistics statistics() const;

  /// A box that contains the surface: of the control neighbourhoods of the faces with a limit.
  Box bounds() const;

  class Implementation;  ///< defined in scheme_scene.h

 private:
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace shaolin
