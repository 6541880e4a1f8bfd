#include "tools/conformance/characteristic_map.h"

#include <cmath>
#include <numbers>

#include "schemes/evaluate.h"

namespace shaolin {

namespace {

/// The two right eigenvectors of the double eigenvalue, combined so that spokes 0 and 1 stand where they should.
Eigen::MatrixX2d layout(const Eigen::MatrixXd& matrix, double eigenvalue, const Ring& ring) {
  const Eigen::Index n = matrix.rows();
  const Eigen::MatrixX2d basis = null_space(matrix - eigenvalue * Eigen::MatrixXd::Identity(n, n), 2);
  const double step = 2 * std::numbers::pi / static_cast<double>(ring.spokes.size());
  Eigen::Matrix2d spokes, wanted;
  spokes << basis.row(ring.spokes[0].end), basis.row(ring.spokes[1].end);
  wanted << 1, 0, std::cos(step), std::sin(step);
  return basis * spokes.inverse() * wanted;
}

/// Twice the signed area of a triangle.
double area(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const Eigen::Vector2d u = b - a, v = c - a;
  return u.x() * v.y() - u.y() * v.x();
}

}  // namespace

template <FaceKind kind>
CharacteristicMap characteristic_map(const Patch<RuntimeScheme<kind>>& patch) {
  CharacteristicMap map;
  const Ring& ring = patch.configuration->neighbourhood().rings[0];
  const Eigen::MatrixXd matrix = matrix_of(patch.configuration->child(0).program, patch.configuration->point_count());
  const auto values = eigenvalues(matrix);
  if (values.size() < 3 || std::abs(values[1] - values[2]) > 1e-9 || std::abs(values[1].imag()) > 1e-9) return map;
  const Eigen::MatrixX2d points = layout(matrix, 0.5 * (values[1].real() + values[2].real()), ring);
  if (!points.allFinite()) return map;
  map.faces = static_cast<int>(ring.spokes.size());

  Patch<RuntimeScheme<kind>> flat = patch;
  for (std::size_t i = 0; i < flat.points.size(); ++i)
    flat.points[i] << points.row(static_cast<Eigen::Index>(i)).transpose(), 0;
  const auto at = [&](double u, double v) { return evaluate(flat, Parameter(u, v)); };

  // The ring: parameters of size (the larger of u and v, or their sum on triangles) between 1/2 and 1.
  // Steps are powers of two: without polynomials, evaluation takes as many splits as a parameter has bits.
  constexpr int across = 16, along = 32, drawn = 4;
  const auto parameter = [](double size, double share) -> Parameter {
    if (kind == FaceKind::triangle) return {size * (1 - share), size * share};
    return share <= 0.5 ? Parameter(size, 2 * size * share) : Parameter(2 * size * (1 - share), size);
  };
  double sum = 0, swept = 0;
  int count = 0;
  bool has_derivatives = false;
  map.least_jacobian = std::numeric_limits<double>::infinity();
  const auto add = [&](double jacobian) {
    sum += jacobian;
    ++count;
    map.least_jacobian = std::min(map.least_jacobian, jacobian);
  };
  std::vector<Eigen::Vector2d> before;
  for (int i = 0; i <= across; ++i) {
    std::vector<Eigen::Vector2d> line;
    for (int j = 0; j <= along; ++j) {
      const Parameter p = parameter(0.5 + 0.5 * i / across, static_cast<double>(j) / along);
      const LimitSample sample = at(p.x(), p.y());
      line.emplace_back(sample.position.x(), sample.position.y());
      if (!sample.derivatives) continue;
      has_derivatives = true;
      add(sample.derivatives->du.cross(sample.derivatives->dv).z());
    }
    // Without derivatives, the areas of the grid's triangles.
    for (std::size_t j = 1; j < before.size() && !has_derivatives; ++j) {
      add(area(before[j - 1], line[j - 1], line[j]));
      add(area(before[j - 1], line[j], before[j]));
    }
    before = line;
    if (i == across)
      for (std::size_t j = 1; j < line.size(); ++j) {
        const Eigen::Vector2d &a = line[j - 1], &b = line[j];
        swept += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
      }
    if (i % drawn == 0) map.lines.push_back(std::move(line));
  }
  for (int j = 0; j <= along; j += drawn) {
    std::vector<Eigen::Vector2d> line;
    for (int i = 0; i <= across; ++i) {
      const Parameter p = parameter(0.5 + 0.5 * i / across, static_cast<double>(j) / along);
      const Vec3 position = at(p.x(), p.y()).position;
      line.emplace_back(position.x(), position.y());
    }
    map.lines.push_back(std::move(line));
  }
  map.least_jacobian /= std::abs(sum) / count;
  map.sweep = swept / (2 * std::numbers::pi / map.faces);
  return map;
}

template CharacteristicMap characteristic_map(const Patch<RuntimeScheme<FaceKind::triangle>>&);
template CharacteristicMap characteristic_map(const Patch<RuntimeScheme<FaceKind::quad>>&);

}  // namespace shaolin
