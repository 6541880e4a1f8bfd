#pragma once
/// What a scene is made of: one mesh with its limit surface, ready for rays, shared by all instances that show it.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "../schemes/control_mesh.h"
#include "box.h"
#include "chord_options.h"
#include "closest_point.h"
#include "counters.h"
#include "crossings.h"
#include "ray.h"

namespace shaolin {

class LimitSurface;
class PatchBudget;
class SchemeMasks;
class SurfaceCell;

/// What rays are intersected with: the limit surface, to rounding error; or, for comparison, what Mueller et al. 2003
/// measured: chord triangles where their algorithm stops refining (chord_finish.h), the same by Woodward's tests
/// (a3_finish.h), or the triangles of a tessellation, made when a ray first comes near (uniform.h).
enum class Method { exact, chord, a3, uniform };

struct SceneOptions {
  Method method = Method::exact;
  int level = 5;       ///< of Method::uniform: 1 to 10 refinement steps; time and memory grow as 4^level
  ChordOptions chord;  ///< of Method::chord and Method::a3
  /// Bounds the memory of what rays refine, of all objects that share it; null: all is kept. Not for Method::uniform,
  /// whose triangles are one piece.
  std::shared_ptr<PatchBudget> budget = nullptr;
};

/// A limit surface and its intersector, in the coordinates of its control mesh. Queries are const and may run
/// concurrently, from several scenes, too; refinement that they cause is kept (see SceneOptions::budget) and never
/// changes an answer. make_object() makes one, a Scene asks it.
class Object {
 public:
  virtual ~Object() = default;

  virtual const LimitSurface& surface() const = 0;

  /// A box that contains the surface: of the control neighbourhoods of the faces with a limit. Empty (lower > upper) if
  /// there are none.
  virtual Box bounds() const = 0;

  /// What rays have made so far: faces, faces_touched, patches_split, patches_evicted, bytes, invalid_patches and
  /// unresolved_patches. The other fields are a scene's.
  virtual void add_to(Statistics& total) const = 0;

  /// The closest hit with tmin <= t <= tmax, or empty. A scene has checked the ray's numbers.
  virtual std::optional<Hit> intersect(const Ray& ray, RayCounters& counters) const = 0;

  /// All hits with tmin <= t <= tmax, in ascending order, each once. Throws InputError where the method is not exact.
  virtual std::vector<Crossing> all_hits(const Ray& ray, RayCounters& counters) const = 0;

  /// True if any point of the surface lies on the ray; as intersect(), cheaper.
  virtual bool occluded(const Ray& ray, RayCounters& counters) const = 0;

  /// See Scene::certify().
  virtual Certificate certify(const Ray& ray, const Hit& hit) const = 0;

  /// The closest place within the query's radius, or empty: of its answer, all but distance and instance, in the
  /// object's space. Throws InputError unless the method is exact.
  virtual std::optional<ClosestPoint> closest_point(const PointQuery& query, RayCounters& counters) const = 0;

  /// The surface as one cell, from which a query goes on to its parts (surface_cell.h); null if there is none. It is of
  /// one thread, and patches that it meets stay as long as it lives. Throws InputError unless the method is exact.
  virtual std::unique_ptr<SurfaceCell> cells() const = 0;
};

/// Builds the hierarchy over the control faces. `scheme` as in make_limit_surface(). O(n log n) for n faces; nothing is
/// refined before a ray asks. Throws InputError as make_limit_surface() does, or for options out of range.
std::shared_ptr<const Object> make_object(ControlMesh mesh, const std::string& scheme,
                                          const SceneOptions& options = {});
/// By any scheme, for instance one from load_plugin(). What the masks throw comes out of this or of the query that is
/// the first to need one.
std::shared_ptr<const Object> make_object(ControlMesh mesh, const std::shared_ptr<const SchemeMasks>& masks,
                                          const SceneOptions& options = {});

}  // namespace shaolin
