#pragma once
// Rays at random through a box, and what it means for two answers to be the same.
#include <optional>
#include <vector>

#include "intersect/scene.h"
#include "tests/random.h"

namespace shaolin {

/// A ray from outside the box's sphere to a point of the box. It need not meet the surface.
inline Ray random_ray(const Box& box, Random& random) {
  const Vec3 size = box.upper - box.lower;
  const Vec3 target = box.centre() + 0.5 * size.cwiseProduct(random.point());
  const double distance = size.norm() * random.uniform(0.6, 3);
  const Vec3 origin = box.centre() + distance * random.direction();
  return {origin, target - origin, 0, std::numeric_limits<double>::infinity()};
}

inline std::vector<Ray> random_rays(const Box& box, int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Ray> rays;
  for (int i = 0; i < count; ++i) rays.push_back(random_ray(box, random));
  return rays;
}

/// Equal in every number. (None of them is ever NaN, and 0 and -0 are the same answer.)
inline bool same(const std::optional<Hit>& a, const std::optional<Hit>& b) {
  if (!a || !b) return !a && !b;
  const auto &p = a->sample.derivatives, &q = b->sample.derivatives;
  if (p.has_value() != q.has_value()) return false;
  if (p && !(p->du == q->du && p->dv == q->dv && p->duu == q->duu && p->duv == q->duv && p->dvv == q->dvv))
    return false;
  return a->t == b->t && a->at.face == b->at.face && a->at.sub == b->at.sub && a->at.u == b->at.u &&
         a->at.v == b->at.v && a->level == b->level && a->sample.position == b->sample.position &&
         a->sample.normal == b->sample.normal && a->certificate.status == b->certificate.status &&
         a->certificate.residual == b->certificate.residual && a->certificate.error == b->certificate.error;
}

/// What rays hit, in their order.
using Hits = std::vector<std::optional<Hit>>;

/// How many of them are not the same.
inline std::size_t differences(const Hits& a, const Hits& b) {
  std::size_t count = a.size() != b.size();
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i) count += !same(a[i], b[i]);
  return count;
}

}  // namespace shaolin
