#pragma once
/// How far a limit patch may leave the hull of its control points if masks have negative weights.
#include <Eigen/Core>
#include <unordered_map>
#include <vector>

#include "split_program.h"

namespace shaolin {

/// What some splits in a row do to the points of a patch: child = matrix * parent. All rows are `mean` plus what
/// differs: a limit point of the child, sum phi_j child_j with sum phi_j = 1, has weights mean + sum phi_j (row_j -
/// mean), so their absolute values sum to `mean_norm` + `spread` * (the child's own such sum) at most.
struct Descent {
  int child;         ///< the configuration that it leads to
  double mean_norm;  ///< sum of |mean|
  double spread;     ///< the largest sum of |row - mean|
};

/// The descent of one matrix. Infinite if rows do not sum to one.
Descent descent(const Eigen::MatrixXd& matrix, int child);

/// For every configuration a bound of sum |phi_i| over its patch, for the limit functions phi_i of its points, by the
/// descents from it: the largest fixed point of b = max (mean_norm + spread b_child), which is finite where spreads
/// are less than 1 (a difference scheme that contracts; the same holds for the functions of every finite level, whose
/// bounds these are by induction, so limit functions exist). Sums of absolute weights alone would grow with every
/// level.
std::vector<double> limit_bounds(const std::vector<std::vector<Descent>>& descents);

/// The matrix of a split with few entries a row, times a dense one.
Eigen::MatrixXd split_product(const SplitProgram& program, const Eigen::MatrixXd& before);

/// The share of its control points' extent along an axis by which a limit patch may pass their hull: (b - 1) / 2, for
/// weights that sum to one and whose absolute values sum to b have negative ones that sum to (b - 1) / 2. Looks at all
/// configurations that splits lead to; each keeps its own descents. Infinite if none is proven.
template <class Configuration>
double limit_hull_expansion(const Configuration& root) {
  std::vector<const Configuration*> all{&root};
  std::unordered_map<const Configuration*, int> numbers{{&root, 0}};
  const auto number_of = [&](const Configuration* configuration) {
    const auto [at, is_new] = numbers.try_emplace(configuration, static_cast<int>(all.size()));
    if (is_new) all.push_back(configuration);
    return at->second;
  };
  std::vector<std::vector<Descent>> descents;
  for (std::size_t i = 0; i < all.size(); ++i) {
    std::vector<Descent>& own = descents.emplace_back();
    for (const auto& [child, way] : all[i]->descents()) {
      own.push_back(way);
      own.back().child = number_of(child);
    }
  }
  return 0.5 * (limit_bounds(descents).front() - 1) * (1 + 1e-9);  // roundings of products of a few matrices
}

/// The descents from a configuration, through so many splits that they contract, and where they lead; those to the same
/// configuration as one.
template <class Configuration>
std::vector<std::pair<const Configuration*, Descent>> descents_from(const Configuration& root) {
  // Spreads fall by about half a split. Three bring those of the butterfly and of Kobbelt's scheme below 1; more cost
  // four times as much each.
  constexpr int least_splits = 2, most_splits = 6;
  constexpr double enough = 0.75;
  std::vector<std::pair<const Configuration*, Eigen::MatrixXd>> level{
      {&root, Eigen::MatrixXd::Identity(root.point_count(), root.point_count())}};
  std::vector<std::pair<const Configuration*, Descent>> found;
  for (int splits = 1; splits <= most_splits; ++splits) {
    std::vector<std::pair<const Configuration*, Eigen::MatrixXd>> next;
    for (const auto& [configuration, matrix] : level)
      for (int k = 0; k < configuration->child_count(); ++k) {
        const auto& child = configuration->child(k);
        next.emplace_back(child.configuration, split_product(child.program, matrix));
      }
    level = std::move(next);
    if (splits < least_splits) continue;
    found.clear();
    double widest = 0;
    for (const auto& [configuration, matrix] : level) {
      const Descent way = descent(matrix, 0);
      widest = std::max(widest, way.spread);
      const auto same = std::find_if(found.begin(), found.end(),
                                     [&, to = configuration](const auto& known) { return known.first == to; });
      if (same == found.end()) {
        found.emplace_back(configuration, way);
      } else {
        same->second.mean_norm = std::max(same->second.mean_norm, way.mean_norm);
        same->second.spread = std::max(same->second.spread, way.spread);
      }
    }
    if (widest <= enough) break;
  }
  return found;
}

}  // namespace shaolin
