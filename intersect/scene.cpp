#include "scene.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <tuple>
#include <unordered_set>

#include "../schemes/errors.h"
#include "box_point.h"
#include "bvh.h"
#include "inside.h"
#include "placement.h"
#include "ray_order.h"

namespace shaolin {

namespace {

std::string text(const Vec3& v) {
  return "(" + std::to_string(v.x()) + ", " + std::to_string(v.y()) + ", " + std::to_string(v.z()) + ")";
}

/// Throws what says which.
[[noreturn]] void refuse(const Ray& ray) {
  if (!ray.origin.allFinite()) throw InputError("ray origin " + text(ray.origin) + " is not finite");
  if (!ray.direction.allFinite()) throw InputError("ray direction " + text(ray.direction) + " is not finite");
  if (ray.direction.isZero(0)) throw InputError("ray direction is zero; expected a direction of any other length");
  throw InputError("ray interval [tmin, tmax] has a NaN");
}

void check(const Ray& ray) {
  const Vec3 &o = ray.origin, &d = ray.direction;
  // 0 times a number is 0, unless that is infinite or none.
  const double zero = (0 * o.x() + 0 * o.y()) + (0 * o.z() + 0 * d.x()) + (0 * d.y() + 0 * d.z());
  const bool has_direction = d.x() != 0 || d.y() != 0 || d.z() != 0;
  if (std::isnan(zero) || !has_direction || std::isunordered(ray.tmin, ray.tmax)) refuse(ray);
}

std::uint64_t count_uncertified(const std::optional<Hit>& hit) { return hit && !hit->certificate.is_certified(); }

bool is_hit(const std::optional<Hit>& answer) { return answer.has_value(); }
bool is_hit(const std::vector<Crossing>& answer) { return !answer.empty(); }
bool is_hit(std::size_t answer) { return answer != 0; }

void check(const Vec3& point) {
  if (!point.allFinite()) throw InputError("point " + text(point) + " is not finite");
}

void check_radius(double radius) {
  if (!(radius > 0))
    throw InputError("radius " + std::to_string(radius) + " is out of range; expected a positive length");
}

}  // namespace

namespace {

/// So many answers, none made. What is large comes from the system page by page, cleared as each is first written to:
/// that is done by all threads before the one that constructs comes by. (Of a picture's closest hits it took a fifth of
/// the time.)
template <class Answer>
std::vector<Answer> room_for(std::size_t count) {
  constexpr std::size_t page = 4096, large = 256 * page;
  std::vector<Answer> answers;
  answers.reserve(count);
  if (const std::size_t bytes = count * sizeof(Answer); bytes > large) {
    auto* const storage = reinterpret_cast<char*>(answers.data());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, bytes / page, 64), [&](const auto& range) {
      for (std::size_t i = range.begin(); i != range.end(); ++i) storage[i * page] = 0;
    });
  }
  answers.resize(count);
  return answers;
}

}  // namespace

class Scene::Implementation {
 public:
  explicit Implementation(std::vector<Instance> instances);

  template <class Answer>
  Answer counted(const Ray& ray, Answer (Implementation::*query)(const Ray&, RayCounters&) const) const {
    check(ray);
    Statistics& local = own_counters();
    Answer answer = (this->*query)(ray, local);
    ++local.rays;
    local.hits += is_hit(answer);
    return answer;
  }

  template <class Answer, class Query>
  std::vector<Answer> counted(std::span<const Ray> rays, Query query) const {
    constexpr std::size_t grain = 64;  // rays that a thread takes at a time
    for (std::size_t i = 0; i < rays.size(); ++i) {
      try {
        check(rays[i]);
      } catch (const InputError& error) {
        throw InputError("ray " + std::to_string(i) + ": " + error.what());
      }
    }
    const std::vector<std::uint32_t> order = coherent_order(rays, bounds_);
    std::vector<Answer> answers = room_for<Answer>(rays.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rays.size(), grain), [&](const auto& range) {
      for (std::size_t i = range.begin(); i != range.end(); ++i) {
        const std::uint32_t ray = order[i];
        answers[ray] = counted(rays[ray], query);
      }
    });
    return answers;
  }

  std::optional<Hit> intersect(const Ray& ray, RayCounters& counters) const {
    std::optional<Hit> hit = sole_ ? sole_->intersect(ray, counters) : intersect_instances(ray, counters);
    counters.uncertified += count_uncertified(hit);
    return hit;
  }
  bool occluded(const Ray& ray, RayCounters& counters) const {
    return sole_ ? sole_->occluded(ray, counters) : occluded_by_instances(ray, counters);
  }
  std::vector<Crossing> all_hits(const Ray& ray, RayCounters& counters) const {
    std::vector<Crossing> all = sole_ ? sole_->all_hits(ray, counters) : all_hits_of_instances(ray, counters);
    counters.uncertified += count_uncertified(all);
    return all;
  }
  std::size_t count(const Ray& ray, RayCounters& counters) const {
    const std::vector<Crossing> all = all_hits(ray, counters);
    const auto crosses = [](const Crossing& crossing) { return crossing.sense != Sense::touches; };
    return static_cast<std::size_t>(std::count_if(all.begin(), all.end(), crosses));
  }
  bool contains(const Vec3& point) const;
  void expect_closed_instances() const;

  std::optional<ClosestPoint> closest_point(const Vec3& p, double radius) const {
    check(p);
    check_radius(radius);
    Statistics& local = own_counters();
    std::optional<ClosestPoint> answer = closest_point(p, radius, local);
    ++local.points;
    return answer;
  }
  std::vector<std::optional<ClosestPoint>> closest_points(std::span<const Vec3> points, double radius) const;

  std::vector<PlacedObject> objects_near(const Vec3& point, double radius) const;
  void count_shape(const RayCounters& counters) const {
    Statistics& local = own_counters();
    local += counters;
    ++local.shapes;
  }

  Statistics statistics() const;
  const Box& bounds() const { return bounds_; }
  const std::vector<Instance>& instances() const { return instances_; }

 private:
  struct Leaf;

  std::optional<ClosestPoint> closest_point(const Vec3& p, double radius, RayCounters& counters) const;
  static std::optional<ClosestPoint> closest_point(const Leaf& leaf, const Vec3& p, double radius,
                                                   RayCounters& counters);
  template <class Reach, class Visit>
  void nearest_first(const Vec3& p, Reach reach, Visit visit) const;
  std::optional<Hit> intersect_instances(const Ray& ray, RayCounters& counters) const;
  bool occluded_by_instances(const Ray& ray, RayCounters& counters) const;
  std::vector<Crossing> all_hits_of_instances(const Ray& ray, RayCounters& counters) const;

  /// This thread's counters. A thread asks one scene many times in a row, so it remembers its last answer: looking them
  /// up is a twentieth of a ray that misses.
  Statistics& own_counters() const {
    thread_local std::uint64_t last_scene = 0;
    thread_local Statistics* last = nullptr;
    if (last_scene != serial_) {
      last = &counters_.local();
      last_scene = serial_;
    }
    return *last;
  }

  /// A number that no other scene ever has; 0 is none's.
  static std::uint64_t next_serial() {
    static std::atomic<std::uint64_t> last{0};
    return ++last;
  }

  /// What the hierarchy's leaves stand for: instances whose objects have a surface.
  struct Leaf {
    Placement placement;
    const Object* object;
    int instance;
  };

  std::vector<Instance> instances_;
  std::vector<const Object*> objects_;  ///< each once
  const Object* sole_ = nullptr;        ///< the only instance's object, if that stands where it is
  std::vector<Leaf> leaves_;
  Bvh bvh_;  ///< of leaves; none if there is a sole object
  Box bounds_;
  std::uint64_t serial_ = next_serial();
  mutable tbb::enumerable_thread_specific<Statistics> counters_;
  mutable std::once_flag closed_;  ///< once expect_closed_instances() has found nothing
};

Scene::Implementation::Implementation(std::vector<Instance> instances) : instances_(std::move(instances)) {
  std::unordered_set<const Object*> known;
  std::vector<Box> boxes;
  leaves_.reserve(instances_.size());
  boxes.reserve(instances_.size());
  for (std::size_t i = 0; i < instances_.size(); ++i) {
    const Instance& instance = instances_[i];
    const auto fail = [&](const std::string& what) { throw InputError("instance " + std::to_string(i) + ": " + what); };
    if (!instance.object) fail("has no object; expected one from make_object()");
    if (known.insert(instance.object.get()).second) objects_.push_back(instance.object.get());
    try {
      leaves_.push_back({Placement(instance.transform), instance.object.get(), static_cast<int>(i)});
    } catch (const InputError& error) {
      fail(error.what());
    }
    const Box own = instance.object->bounds();
    const Box box = leaves_.back().placement.is_identity() ? own : transformed(own, instance.transform);
    if ((box.lower.array() > box.upper.array()).any()) {
      leaves_.pop_back();
      continue;
    }
    if (!box.lower.allFinite() || !box.upper.allFinite()) fail("the transform takes it beyond the range of numbers");
    boxes.push_back(box);
    bounds_.add(box);
  }
  if (instances_.size() == 1 && instances_.front().transform.matrix() == Affine::Identity().matrix()) {
    sole_ = instances_.front().object.get();
    bounds_ = sole_->bounds();
    return;
  }
  bvh_ = Bvh(boxes);
}

/// A farther instance is asked with the nearest t so far, and a little more: t and a distance along the ray, which the
/// objects work with, differ by a few roundings, and of instances at equal t all must answer for the lowest to be
/// found.
std::optional<Hit> Scene::Implementation::intersect_instances(const Ray& ray, RayCounters& counters) const {
  const TraversalRay traversal(ray);
  const std::optional<BoxRay> box_ray = bvh_.enter(traversal);
  if (!box_ray) return {};
  std::optional<Hit> best;
  const Leaf* of_best = nullptr;
  Ray reach = ray;
  float box_far = box_ray->local(traversal.far);
  bvh_.traverse(
      *box_ray, [&] { return box_far; },
      [&](int primitive) {
        const Leaf& leaf = leaves_[static_cast<std::size_t>(primitive)];
        const std::optional<Ray> local = leaf.placement.to_object(reach);
        if (!local) return false;
        std::optional<Hit> hit = leaf.object->intersect(*local, counters);
        if (!hit) return false;
        hit->instance = leaf.instance;
        if (best && std::pair(best->t, best->instance) < std::pair(hit->t, hit->instance)) return false;
        best = hit;
        of_best = &leaf;
        reach.tmax = std::min(ray.tmax, hit->t + 16 * unit_roundoff * std::abs(hit->t));
        box_far = box_ray->local(traversal.distance(reach.tmax));
        return false;
      });
  if (best) of_best->placement.to_world(*best, traversal);
  return best;
}

bool Scene::Implementation::occluded_by_instances(const Ray& ray, RayCounters& counters) const {
  const TraversalRay traversal(ray);
  const std::optional<BoxRay> box_ray = bvh_.enter(traversal);
  if (!box_ray) return false;
  bool met = false;
  const float box_far = box_ray->local(traversal.far);
  bvh_.traverse(
      *box_ray, [&] { return box_far; },
      [&](int primitive) {
        const Leaf& leaf = leaves_[static_cast<std::size_t>(primitive)];
        const std::optional<Ray> local = leaf.placement.to_object(ray);
        met = local && leaf.object->occluded(*local, counters);
        return met;
      });
  return met;
}

std::vector<Crossing> Scene::Implementation::all_hits_of_instances(const Ray& ray, RayCounters& counters) const {
  const TraversalRay traversal(ray);
  const std::optional<BoxRay> box_ray = bvh_.enter(traversal);
  if (!box_ray) return {};
  std::vector<Crossing> all;
  const float box_far = box_ray->local(traversal.far);
  bvh_.traverse(
      *box_ray, [&] { return box_far; },
      [&](int primitive) {
        const Leaf& leaf = leaves_[static_cast<std::size_t>(primitive)];
        const std::optional<Ray> local = leaf.placement.to_object(ray);
        if (!local) return false;
        for (Crossing& crossing : leaf.object->all_hits(*local, counters)) {
          crossing.hit.instance = leaf.instance;
          leaf.placement.to_world(crossing.hit, traversal);
          all.push_back(std::move(crossing));
        }
        return false;
      });
  std::stable_sort(all.begin(), all.end(), [](const Crossing& a, const Crossing& b) {
    return std::tie(a.hit.t, a.hit.instance) < std::tie(b.hit.t, b.hit.instance);
  });
  return all;
}

void Scene::Implementation::expect_closed_instances() const {
  std::call_once(closed_, [&] {
    for (std::size_t i = 0; i < instances_.size(); ++i) {
      try {
        expect_closed(instances_[i].object->surface());
      } catch (const InputError& error) {
        throw InputError("instance " + std::to_string(i) + ": " + error.what());
      }
    }
  });
}

bool Scene::Implementation::contains(const Vec3& point) const {
  check(point);
  expect_closed_instances();
  RayCounters counters;
  bool inside = false;
  if (sole_) {
    inside = is_inside(*sole_, point, counters);
  } else {
    // A ray that ends where it starts meets the boxes that the point is in.
    const Ray here{point, Vec3::UnitX(), 0, 0};
    const TraversalRay traversal(here);
    if (const std::optional<BoxRay> box_ray = bvh_.enter(traversal))
      bvh_.traverse(
          *box_ray, [far = box_ray->local(traversal.far)] { return far; },
          [&](int primitive) {
            const Leaf& leaf = leaves_[static_cast<std::size_t>(primitive)];
            const std::optional<Ray> local = leaf.placement.to_object(here);
            return inside = local && is_inside(*leaf.object, local->origin, counters);
          });
  }
  own_counters() += counters;
  return inside;
}

std::optional<ClosestPoint> Scene::Implementation::closest_point(const Leaf& leaf, const Vec3& p, double radius,
                                                                 RayCounters& counters) {
  std::optional<ClosestPoint> closest = leaf.object->closest_point({p, leaf.placement, radius}, counters);
  if (!closest) return {};
  leaf.placement.to_world(closest->sample);
  closest->distance = std::min((closest->sample.position - p).stableNorm(), radius);
  closest->instance = leaf.instance;
  return closest;
}

/// Calls visit(leaf) for those whose boxes are not farther from the point than `reach()`, which may shrink meanwhile.
template <class Reach, class Visit>
void Scene::Implementation::nearest_first(const Vec3& p, Reach reach, Visit visit) const {
  const Vec3 in_boxes = bvh_.space()(p);
  const bool is_finite = in_boxes.allFinite();
  const double unit = is_finite ? 1 / power_of_two_below(in_boxes.lpNorm<1>() + 1) : 1;
  const BoxPoint point(is_finite ? in_boxes : Vec3(Vec3::Zero()), unit * Eigen::Matrix3d::Identity(),
                       is_finite ? 0 : std::numeric_limits<double>::infinity(),
                       {bvh_.space()(bounds_.lower), bvh_.space()(bounds_.upper)});
  bvh_.nearest_first(
      point, [&] { return point.local(unit * (bvh_.space().scale * reach())); },
      [&](int primitive, float) { visit(leaves_[static_cast<std::size_t>(primitive)]); });
}

std::optional<ClosestPoint> Scene::Implementation::closest_point(const Vec3& p, double radius,
                                                                 RayCounters& counters) const {
  if (leaves_.empty()) return {};
  if (sole_) return closest_point(leaves_.front(), p, radius, counters);
  std::optional<ClosestPoint> best;
  double reach = radius;
  nearest_first(
      p, [&] { return reach; },
      [&](const Leaf& leaf) {
        const auto closest = closest_point(leaf, p, reach, counters);
        if (!closest || (best && best->distance <= closest->distance)) return;
        best = closest;
        reach = closest->distance;
      });
  return best;
}

std::vector<PlacedObject> Scene::Implementation::objects_near(const Vec3& point, double radius) const {
  std::vector<PlacedObject> near;
  const auto add = [&](const Leaf& leaf) { near.push_back({leaf.object, &leaf.placement, leaf.instance}); };
  if (sole_)
    std::for_each(leaves_.begin(), leaves_.end(), add);
  else
    nearest_first(
        point, [radius] { return radius; }, add);
  return near;
}

std::vector<std::optional<ClosestPoint>> Scene::Implementation::closest_points(std::span<const Vec3> points,
                                                                               double radius) const {
  constexpr std::size_t grain = 16;  // points that a thread takes at a time
  check_radius(radius);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!points[i].allFinite())
      throw InputError("point " + std::to_string(i) + ": " + text(points[i]) + " is not finite");
  std::vector<std::optional<ClosestPoint>> answers(points.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), grain), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) answers[i] = closest_point(points[i], radius);
  });
  return answers;
}

Statistics Scene::Implementation::statistics() const {
  Statistics total;
  for (const Statistics& local : counters_) {
    total += local;
    total.rays += local.rays;
    total.hits += local.hits;
    total.points += local.points;
    total.shapes += local.shapes;
  }
  for (const Object* object : objects_) object->add_to(total);
  if (!sole_) total.bytes += bvh_.bytes() + leaves_.size() * sizeof(Leaf);
  return total;
}

Scene::Scene(std::vector<Instance> instances)
    : implementation_(std::make_unique<const Implementation>(std::move(instances))) {}
Scene::Scene(ControlMesh mesh, const std::string& scheme, const SceneOptions& options)
    : Scene({Instance{make_object(std::move(mesh), scheme, options)}}) {}
Scene::Scene(ControlMesh mesh, const std::shared_ptr<const SchemeMasks>& masks, const SceneOptions& options)
    : Scene({Instance{make_object(std::move(mesh), masks, options)}}) {}
Scene::~Scene() = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;

std::optional<Hit> Scene::intersect(const Ray& ray) const {
  return implementation_->counted(ray, &Implementation::intersect);
}
bool Scene::occluded(const Ray& ray) const { return implementation_->counted(ray, &Implementation::occluded); }
std::vector<std::optional<Hit>> Scene::intersect(std::span<const Ray> rays) const {
  return implementation_->counted<std::optional<Hit>>(rays, &Implementation::intersect);
}
std::vector<char> Scene::occluded(std::span<const Ray> rays) const {
  return implementation_->counted<char>(rays, &Implementation::occluded);
}
std::vector<Crossing> Scene::all_hits(const Ray& ray) const {
  return implementation_->counted(ray, &Implementation::all_hits);
}
std::size_t Scene::count(const Ray& ray) const { return implementation_->counted(ray, &Implementation::count); }
std::vector<std::vector<Crossing>> Scene::all_hits(std::span<const Ray> rays) const {
  return implementation_->counted<std::vector<Crossing>>(rays, &Implementation::all_hits);
}
std::vector<std::size_t> Scene::count(std::span<const Ray> rays) const {
  return implementation_->counted<std::size_t>(rays, &Implementation::count);
}
bool Scene::contains(const Vec3& point) const { return implementation_->contains(point); }
double Scene::signed_distance(const Vec3& point) const {
  const bool inside = contains(point);
  const std::optional<ClosestPoint> closest = closest_point(point);
  const double distance = closest ? closest->distance : std::numeric_limits<double>::infinity();
  return inside ? -distance : distance;
}
std::vector<char> Scene::contains(std::span<const Vec3> points) const {
  std::vector<char> answers(points.size());
  tbb::parallel_for(std::size_t{0}, points.size(),
                    [&](std::size_t i) { answers[i] = static_cast<char>(contains(points[i])); });
  return answers;
}
std::vector<double> Scene::signed_distance(std::span<const Vec3> points) const {
  std::vector<double> answers(points.size());
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) { answers[i] = signed_distance(points[i]); });
  return answers;
}
std::optional<ClosestPoint> Scene::closest_point(const Vec3& p, double radius) const {
  return implementation_->closest_point(p, radius);
}
std::vector<std::optional<ClosestPoint>> Scene::closest_points(std::span<const Vec3> points, double radius) const {
  return implementation_->closest_points(points, radius);
}
std::vector<PlacedObject> Scene::objects_near(const Vec3& point, double radius) const {
  return implementation_->objects_near(point, radius);
}
void Scene::count_shape(const RayCounters& counters) const { implementation_->count_shape(counters); }
const std::vector<Instance>& Scene::instances() const { return implementation_->instances(); }
Statistics Scene::statistics() const { return implementation_->statistics(); }
Box Scene::bounds() const { return implementation_->bounds(); }

const LimitSurface& Scene::surface(int instance) const {
  const std::vector<Instance>& all = instances();
  if (instance < 0 || static_cast<std::size_t>(instance) >= all.size())
    throw InputError("there is no instance " + std::to_string(instance) + "; the scene has " +
                     std::to_string(all.size()));
  return all[static_cast<std::size_t>(instance)].object->surface();
}

}  // namespace shaolin
