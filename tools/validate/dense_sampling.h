#pragma once
/// The distance of a point from a limit surface by brute force: it shares no code with the search that it checks, only
/// the evaluation of the surface.
#include <algorithm>
#include <map>
#include <memory>
#include <vector>

#include "schemes/limit_surface.h"

namespace shaolin {

/// Samples on a grid over every patch; from the nearest few, descent inside the patch and along its sides. What it
/// finds are points of the surface, so its distance is never too small; it is the least one if a sample lies in its
/// basin.
class DenseSampling {
 public:
  struct Sample {
    SurfaceParameter at;
    Vec3 position;
  };

  DenseSampling(const LimitSurface& surface, int steps) : surface_(surface) {
    for (int face = 0; face < surface.face_count(); ++face) {
      auto& patches = patches_.emplace_back();
      if (!surface.has_limit(face)) continue;
      for (int sub = 0; sub < surface.sub_count(face); ++sub) {
        patches.push_back(surface.limit_patch(face, sub));
        for (int j = 0; j <= steps; ++j)
          for (int i = 0; i <= (surface.triangular() ? steps - j : steps); ++i) {
            const SurfaceParameter at{face, sub, static_cast<double>(i) / steps, static_cast<double>(j) / steps};
            samples_.push_back({at, evaluate(at).position});
          }
      }
    }
  }

  const std::vector<Sample>& samples() const { return samples_; }

  double distance(const Vec3& p) const {
    constexpr std::size_t looked_at = 200, most_starts = 10, most_ends = 4;
    constexpr int most_of_patch = 2;
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < samples_.size(); ++i) order.emplace_back((samples_[i].position - p).norm(), i);
    const auto end = order.begin() + static_cast<std::ptrdiff_t>(std::min(looked_at, order.size()));
    std::partial_sort(order.begin(), end, order.end());
    std::vector<std::pair<double, SurfaceParameter>> ends;
    std::map<std::pair<int, int>, int> starts;
    for (auto at = order.begin(); at != end && ends.size() < most_starts; ++at) {
      const SurfaceParameter& start = samples_[at->second].at;
      if (++starts[{start.face, start.sub}] <= most_of_patch) ends.push_back(descend(p, start));
    }
    std::sort(ends.begin(), ends.end(), [](const auto& one, const auto& other) { return one.first < other.first; });
    ends.resize(std::min(ends.size(), most_ends));
    double best = ends.front().first;
    for (const auto& [distance, at] : ends) best = std::min(best, along_sides(p, at));
    return best;
  }

 private:
  LimitSample evaluate(const SurfaceParameter& at) const {
    return patches_[static_cast<std::size_t>(at.face)][static_cast<std::size_t>(at.sub)]->evaluate(at.u, at.v);
  }
  double distance(const Vec3& p, const SurfaceParameter& at) const { return (evaluate(at).position - p).norm(); }

  SurfaceParameter moved(SurfaceParameter at, double du, double dv) const {
    at.u = std::clamp(at.u + du, 0.0, 1.0);
    at.v = std::clamp(at.v + dv, 0.0, 1.0);
    if (surface_.triangular() && at.v > 1 - at.u) {
      at.u = std::clamp(0.5 * (1 + at.u - at.v), 0.0, 1.0);
      at.v = 1 - at.u;
    }
    return at;
  }

  /// Damped Newton steps, clamped to the patch.
  std::pair<double, SurfaceParameter> descend(const Vec3& p, SurfaceParameter at) const {
    double best = distance(p, at);
    bool goes_on = true;
    constexpr int most_steps = 40;
    for (int i = 0; i < most_steps && goes_on; ++i) {
      goes_on = false;
      const LimitSample sample = evaluate(at);
      if (!sample.derivatives) break;
      const Derivatives& d = *sample.derivatives;
      const Vec3 r = sample.position - p;
      const Eigen::Vector2d gradient(d.du.dot(r), d.dv.dot(r));
      Eigen::Matrix2d metric, hessian;
      metric << d.du.dot(d.du), d.du.dot(d.dv), d.du.dot(d.dv), d.dv.dot(d.dv);
      hessian << d.duu.dot(r), d.duv.dot(r), d.duv.dot(r), d.dvv.dot(r);
      hessian += metric;
      for (const Eigen::Matrix2d& model : {hessian, metric})
        for (double damping = 0; damping < 1e6 && !goes_on; damping = damping > 0 ? 8 * damping : 1e-3) {
          Eigen::Matrix2d damped = model;
          damped.diagonal() += damping * metric.diagonal();
          if (!(damped.determinant() > 0 && damped(0, 0) > 0)) continue;
          const Eigen::Vector2d step = -damped.inverse() * gradient;
          const SurfaceParameter next = moved(at, step.x(), step.y());
          if (const double there = distance(p, next); there < best) {
            best = there;
            at = next;
            goes_on = true;
          }
        }
    }
    return {best, at};
  }

  /// Golden sections of the sides, about the places nearest to a parameter.
  double along_sides(const Vec3& p, const SurfaceParameter& about) const {
    static constexpr double quad[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, triangle[3][2] = {{0, 0}, {1, 0}, {0, 1}};
    const auto* corners = surface_.triangular() ? triangle : quad;
    const int count = surface_.triangular() ? 3 : 4;
    double best = std::numeric_limits<double>::infinity();
    for (int i = 0; i < count; ++i) {
      const Eigen::Vector2d from(corners[i][0], corners[i][1]);
      const Eigen::Vector2d along = Eigen::Vector2d(corners[(i + 1) % count][0], corners[(i + 1) % count][1]) - from;
      const auto at = [&](double t) {
        const Eigen::Vector2d place = from + t * along;
        return distance(p, moved({about.face, about.sub, 0, 0}, place.x(), place.y()));
      };
      constexpr double reach = 0.3, ratio = 0.6180339887498949, shortest = 1e-8;
      const double middle = along.dot(Eigen::Vector2d(about.u, about.v) - from) / along.squaredNorm();
      if ((from + std::clamp(middle, 0.0, 1.0) * along - Eigen::Vector2d(about.u, about.v)).norm() > reach) continue;
      double low = std::clamp(middle - reach, 0.0, 1.0), high = std::clamp(middle + reach, 0.0, 1.0);
      best = std::min({best, at(low), at(high)});
      double a = high - ratio * (high - low), b = low + ratio * (high - low), at_a = at(a), at_b = at(b);
      while (high - low > shortest) {
        if (at_a < at_b) {
          high = b;
          b = a;
          at_b = at_a;
          at_a = at(a = high - ratio * (high - low));
        } else {
          low = a;
          a = b;
          at_a = at_b;
          at_b = at(b = low + ratio * (high - low));
        }
      }
      best = std::min({best, at_a, at_b});
    }
    return best;
  }

  const LimitSurface& surface_;
  std::vector<std::vector<std::unique_ptr<const LimitPatch>>> patches_;  ///< by face and sub
  std::vector<Sample> samples_;
};

}  // namespace shaolin
