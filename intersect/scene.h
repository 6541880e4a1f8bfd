#pragma once
/// The public face of the intersector: objects and where they stand in, queries on their limit surfaces out.
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "affine.h"
#include "object.h"
#include "shape_contact.h"
#include "shapes.h"

namespace shaolin {

/// An object, and the map from its space to the world's. Instances share their object: its patches exist once.
struct Instance {
  std::shared_ptr<const Object> object;
  Affine transform = Affine::Identity();
};

class Placement;

/// An instance as queries see it, for as long as its scene is there.
struct PlacedObject {
  const Object* object;
  const Placement* placement;
  int instance;
};

/// Limit surfaces, ready for rays. Queries are const and may run concurrently; refinement that they cause is kept and
/// never changes an answer: results are bit-identical for any number of threads and any order of rays.
class Scene {
 public:
  /// Builds a hierarchy over the instances' boxes. O(n log n) for n instances. Throws InputError that names the
  /// instance: no object, a transform that inverse() refuses, a box that exceeds the range of doubles.
  explicit Scene(std::vector<Instance> instances);

  /// One object, where it is: make_object() with these arguments, under the identity.
  explicit Scene(ControlMesh mesh, const std::string& scheme, const SceneOptions& options = {});
  explicit Scene(ControlMesh mesh, const std::shared_ptr<const SchemeMasks>& masks, const SceneOptions& options = {});
  ~Scene();
  Scene(Scene&&) noexcept;
  Scene& operator=(Scene&&) noexcept;

  /// The closest hit with tmin <= t <= tmax, or empty, in the world's space; where instances are met at equal t, the
  /// one with the lowest index. Throws InputError for a direction that is zero or not finite, an origin that is not
  /// finite or an interval that has a NaN; and, where the method is uniform, what SubdivisionMesh::refine() throws.
  ///
  /// The ray is rounded once more for each instance with a transform: by a few units in the last place of its origin's
  /// distance from the object, times the condition of the map.
  std::optional<Hit> intersect(const Ray& ray) const;

  /// True if any point of a surface lies on the ray. Throws as intersect() does; cheaper.
  bool occluded(const Ray& ray) const;

  /// All hits with tmin <= t <= tmax in ascending order of t, then of the instance: each crossing of a surface once,
  /// at edges, vertices and creases, too, and where the ray touches without crossing. On a closed surface those that
  /// are crossings alternate between entering and leaving. Throws as intersect() does, and InputError if an object's
  /// method is not exact.
  std::vector<Crossing> all_hits(const Ray& ray) const;

  /// A certificate for a hit of this scene on this ray, by more work than a ray is given: where patches meet, at edges,
  /// creases and vertices, a disk of the surface is shown to be crossed once (disk_proof.h). That of the hit if it is
  /// certified, or if nothing is proven: along tangents, at outlines and boundaries, and where the method is not exact.
  /// Some 0.1 to 1 ms. Throws InputError if the scene has no such instance or surface place, or the ray no direction.
  Certificate certify(const Ray& ray, const Hit& hit) const;

  /// The number of hits that are crossings, not touches: even for a ray without limits and a closed surface, odd from
  /// inside of it. Throws as all_hits() does.
  std::size_t count(const Ray& ray) const;

  /// True if the point is inside of any instance, all of which must be closed surfaces, see inside.h. Throws InputError
  /// if the point is not finite, if an instance is open (it names the edge), or an object's method is not exact.
  bool contains(const Vec3& point) const;

  /// The distance to the closest point of any surface, negative where contains() is true; infinite for an empty scene.
  /// Throws as contains() and closest_point() do.
  double signed_distance(const Vec3& point) const;

  /// Many rays, coherent or not, on as many threads as oneTBB gives: answer i is that to rays[i] alone, bit for bit.
  /// They are traced in an order in which rays follow each other that are likely to meet the same patches. Throw
  /// InputError that names the first ray that intersect() refuses, before any is traced. O(n log n) in addition.
  std::vector<std::optional<Hit>> intersect(std::span<const Ray> rays) const;
  /// The same; 1 where any point of a surface lies on the ray. (Of char, for std::vector<bool> shares bytes.)
  std::vector<char> occluded(std::span<const Ray> rays) const;
  std::vector<std::vector<Crossing>> all_hits(std::span<const Ray> rays) const;
  std::vector<std::size_t> count(std::span<const Ray> rays) const;

  /// Many points, on as many threads as oneTBB gives; 1 where contains() is true.
  std::vector<char> contains(std::span<const Vec3> points) const;
  /// The same for signed distances.
  std::vector<double> signed_distance(std::span<const Vec3> points) const;

  /// The point of the surfaces that is closest to p, at most `radius` away, or empty: exact on the limit surface, which
  /// is refined where it must be to prove that nothing is nearer. A distance exceeds the least one by rounding only: by
  /// some 1e-14 of the scene's size and its distance from p, at instances of the size of their transforms' numbers. Of
  /// places equally near to that, the answer is one, by an order that depends on scene and point alone. Throws
  /// InputError for a point that is not finite, a radius that is not above 0, and where the method is not exact.
  std::optional<ClosestPoint> closest_point(const Vec3& p,
                                            double radius = std::numeric_limits<double>::infinity()) const;

  /// Many points, on as many threads as oneTBB gives: answer i is that to points[i] alone, bit for bit. Throws
  /// InputError that names the first point that closest_point() refuses, before any is asked.
  std::vector<std::optional<ClosestPoint>> closest_points(
      std::span<const Vec3> points, double radius = std::numeric_limits<double>::infinity()) const;

  /// A point of the surfaces that the shape holds, or empty: exact on the limit surface, which is refined where it must
  /// be to prove that there is none. Touching is overlapping, to rounding: to some 1e-13 of the size of scene and shape
  /// and their distance. (Of a sphere it is the closest point to its centre, and its distance at most the radius.)
  /// Which point it is depends on scene and shape alone. Throws InputError for what check() in convex.h refuses, and
  /// where the method is not exact.
  std::optional<ShapeContact> overlaps(const Shape& shape) const;

  /// Many shapes, on as many threads as oneTBB gives: answer i is that to shapes[i] alone, bit for bit. Throws
  /// InputError that names the first shape that is refused, before any is asked.
  std::vector<std::optional<ShapeContact>> overlaps(std::span<const Shape> shapes) const;

  /// A point that a surface of this scene and one of another have in common, or empty; as overlaps() of a shape. Both
  /// stand in the same world. Crossings are found in a few steps; surfaces that touch along curves, or nearly do, take
  /// as many cells as the curve has of their size.
  std::optional<SurfaceContact> overlaps(const Scene& other) const;

  /// The faces that the frustum holds a point of the surface of, in ascending order of instance and face: exact on the
  /// limit surface, to rounding as overlaps(), with faces that hide each other. Faces that are inside as a whole cost
  /// their boxes. Throws InputError for what check() in convex.h refuses, and where the method is not exact.
  std::vector<PickedFace> pick(const Frustum& frustum) const;

  /// Where a moving sphere first touches a surface, or empty if it never does. At that time the surfaces are the radius
  /// away from its centre, and before it farther, to rounding as overlaps(). If they are nearer than the radius at the
  /// start, it is the closest point at t = 0. Throws InputError for numbers that are not finite, a radius that is not
  /// above 0, and where the method is not exact.
  std::optional<SweepContact> sweep(const SphereSweep& sweep) const;
  /// Many, as overlaps() of many shapes.
  std::vector<std::optional<SweepContact>> sweep(std::span<const SphereSweep> sweeps) const;

  const std::vector<Instance>& instances() const;

  /// The surface of an instance's object, in the object's own space. Throws InputError if there is no such instance.
  const LimitSurface& surface(int instance = 0) const;

  /// Rays and hits are this scene's. Faces, patches and memory are those of the objects, each counted once, whichever
  /// scenes they are in.
  Statistics statistics() const;

  /// A box that contains the surfaces; empty (lower > upper) if there are none.
  Box bounds() const;

 private:
  class Implementation;

  /// Objects whose boxes are within a radius of a point, nearest first.
  std::vector<PlacedObject> objects_near(const Vec3& point, double radius) const;
  /// Adds a query with a shape to the statistics.
  void count_shape(const RayCounters& counters) const;

  std::unique_ptr<const Implementation> implementation_;
};

}  // namespace shaolin
