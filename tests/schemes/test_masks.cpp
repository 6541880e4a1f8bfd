// The schemes' masks: published values, sums, and limit and tangent masks as left eigenvectors of the local subdivision
// matrix, which is measured on refined meshes.
#include <cmath>
#include <numbers>

#include "schemes/catmull_clark.h"
#include "schemes/loop.h"
#include "tests/catch.h"
#include "tests/schemes/local_matrix.h"
#include "tests/schemes/mask_sum.h"

namespace shaolin {

namespace {

std::vector<int> valences(int most) {
  std::vector<int> result{360};
  for (int n = 3; n <= most; ++n) result.push_back(n);
  return result;
}

template <Scheme S>
Eigen::RowVectorXd limit_row(const LocalMatrix& local, int n) {
  const LimitMask mask = S::smooth_limit(n);
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(local.matrix.rows());
  row[0] = mask.vertex;
  row.segment(1, n).setConstant(mask.edge);
  if (S::face_kind == FaceKind::quad) row.segment(1 + n, n).setConstant(mask.diagonal);
  return row;
}

/// The subdominant eigenvalue of a smooth vertex, in the literature's closed forms.
double subdominant(FaceKind kind, double angle) {
  const double c = std::cos(angle);
  return kind == FaceKind::triangle ? 3.0 / 8 + c / 4 : (5 + c + std::cos(angle / 2) * std::sqrt(18 + 2 * c)) / 16;
}

double magnitude(const RingMask& mask) {
  double total = std::abs(mask.vertex);
  for (const double w : mask.edges) total += std::abs(w);
  for (const double w : mask.diagonals) total += std::abs(w);
  return total;
}

}  // namespace

TEST_CASE("Loop's masks have the published values", "[schemes][masks]") {
  CHECK(Loop::smooth_vertex(3).edge == Approx(3.0 / 16).epsilon(1e-15));
  CHECK(Loop::smooth_vertex(3).vertex == Approx(7.0 / 16).epsilon(1e-15));
  CHECK(Loop::smooth_vertex(4).edge == Approx(31.0 / 256).epsilon(1e-15));
  CHECK(Loop::smooth_vertex(6).edge == 1.0 / 16);
  CHECK(Loop::smooth_vertex(6).vertex == 5.0 / 8);
  CHECK(Loop::smooth_edge().end == 3.0 / 8);
  CHECK(Loop::smooth_edge().side == 1.0 / 8);
  CHECK(Loop::smooth_limit(6).vertex == 0.5);
  CHECK(Loop::smooth_limit(6).edge == 1.0 / 12);
  CHECK(Loop::smooth_limit(3).vertex == Approx(2.0 / 5).epsilon(1e-15));
  CHECK(Loop::smooth_limit(3).edge == Approx(1.0 / 5).epsilon(1e-15));
}

TEST_CASE("Catmull and Clark's masks have the published values", "[schemes][masks]") {
  CHECK(CatmullClark::smooth_vertex(4).vertex == 0.5);
  CHECK(CatmullClark::smooth_vertex(4).edge == 1.0 / 16);
  CHECK(CatmullClark::smooth_vertex(4).face == 1.0 / 16);
  CHECK(CatmullClark::smooth_vertex(3).vertex == Approx(1.0 / 3).epsilon(1e-15));
  CHECK(CatmullClark::smooth_vertex(3).edge == Approx(1.0 / 9).epsilon(1e-15));
  CHECK(CatmullClark::smooth_edge().end == 0.25);
  CHECK(CatmullClark::smooth_edge().side == 0.25);
  CHECK(CatmullClark::smooth_limit(4).vertex == Approx(4.0 / 9).epsilon(1e-15));
  CHECK(CatmullClark::smooth_limit(4).edge == Approx(1.0 / 9).epsilon(1e-15));
  CHECK(CatmullClark::smooth_limit(4).diagonal == Approx(1.0 / 36).epsilon(1e-15));
}

TEST_CASE("The crease's masks are those of the cubic B-spline", "[schemes][masks]") {
  CHECK(cubic_crease.vertex + 2 * cubic_crease.edge == 1);
  CHECK(cubic_crease.limit_vertex + 2 * cubic_crease.limit_edge == Approx(1).epsilon(1e-15));
}

TEMPLATE_TEST_CASE("Weights sum to one, tangent weights to zero", "[schemes][masks]", Loop, CatmullClark, Warren) {
  using S = TestType;
  CHECK(2 * (S::smooth_edge().end + S::smooth_edge().side) == 1);
  for (const int n : valences(40)) {
    CAPTURE(n);
    const VertexMask vertex = S::smooth_vertex(n);
    CHECK(std::abs(vertex.vertex + n * (vertex.edge + vertex.face) - 1) < 1e-14);
    const LimitMask limit = S::smooth_limit(n);
    CHECK(std::abs(limit.vertex + n * (limit.edge + limit.diagonal) - 1) < 1e-14);
    CHECK(vertex.vertex >= 0);
    CHECK(limit.vertex > 0);
    for (const double first : {0.0, n / 4.0, 0.3}) {
      const RingMask mask = S::smooth_tangent(n, first);
      CHECK(std::abs(sum(mask)) < 1e-13 * magnitude(mask));
    }
  }
  for (int k = 1; k <= 12; ++k) {
    CAPTURE(k);
    const RingMask mask = S::crease_cross_tangent(k);
    CHECK(std::abs(sum(mask)) < 1e-13 * magnitude(mask));
  }
}

TEMPLATE_TEST_CASE("Refinement of a ring reads the ring only, with weights that sum to one", "[schemes][masks]", Loop,
                   CatmullClark, Warren) {
  using S = TestType;
  for (const int n : {3, 4, 5, 6, 7, 17}) {
    CAPTURE(n);
    const LocalMatrix local = local_matrix<S>(poles(S::name, n));
    CHECK((local.matrix.rowwise().sum().array() - 1).abs().maxCoeff() < 1e-14);
    CHECK(local.matrix.minCoeff() >= 0);
  }
}

TEMPLATE_TEST_CASE("Smooth limit and tangent masks are left eigenvectors", "[schemes][masks]", Loop, CatmullClark,
                   Warren) {
  using S = TestType;
  for (const int n : valences(40)) {
    CAPTURE(n);
    const LocalMatrix local = local_matrix<S>(poles(S::name, n));
    REQUIRE(local.spokes == n);
    CHECK(eigen_residual(local, limit_row<S>(local, n), 1) < 1e-14);
    const double lambda = subdominant(S::face_kind, 2 * std::numbers::pi / n);
    for (const double first : {0.0, n / 4.0})
      CHECK(eigen_residual(local, row_of(local, S::smooth_tangent(n, first)), lambda) < 1e-14);
  }
}

TEMPLATE_TEST_CASE("The tangents' eigenvalue is the subdominant one", "[schemes][masks]", Loop, CatmullClark, Warren) {
  using S = TestType;
  for (const int n : {3, 4, 5, 6, 7, 8, 12, 20}) {
    CAPTURE(n);
    const LocalMatrix local = local_matrix<S>(poles(S::name, n));
    std::vector<double> values;
    for (const std::complex<double>& value : eigenvalues(local.matrix)) values.push_back(std::abs(value));
    std::sort(values.rbegin(), values.rend());
    CHECK(values[0] == Approx(1).epsilon(1e-12));
    CHECK(values[1] == Approx(subdominant(S::face_kind, 2 * std::numbers::pi / n)).epsilon(1e-8));
    CHECK(values[2] == Approx(values[1]).epsilon(1e-8));
  }
}

TEMPLATE_TEST_CASE("Crease masks are left eigenvectors in sectors of 2 to 12 faces", "[schemes][masks]", Loop,
                   CatmullClark, Warren) {
  using S = TestType;
  for (int k = 1; k <= 12; ++k) {
    CAPTURE(k);
    ControlMesh mesh = fan(S::name, k);
    mesh.boundary = BoundaryInterpolation::edge_only;
    const LocalMatrix local = local_matrix<S>(mesh);
    REQUIRE(local.spokes == k + 1);
    Eigen::RowVectorXd position = Eigen::RowVectorXd::Zero(local.matrix.rows()), along = position;
    position[0] = cubic_crease.limit_vertex;
    position[1] = position[1 + k] = cubic_crease.limit_edge;
    along[1] = 1;
    along[1 + k] = -1;
    CHECK(eigen_residual(local, position, 1) < 1e-15);
    CHECK(eigen_residual(local, along, 0.5) < 1e-15);
    // One face: 1/4, the curve's second difference (see single_face_crease_tangent).
    const double across = k == 1 ? 0.25 : subdominant(S::face_kind, std::numbers::pi / k);
    CHECK(eigen_residual(local, row_of(local, S::crease_cross_tangent(k)), across) < 1e-13);
  }
}

TEMPLATE_TEST_CASE("A crease's cross tangent points into the sector", "[schemes][masks]", Loop, CatmullClark, Warren) {
  using S = TestType;
  for (int k = 1; k <= 12; ++k) {
    ControlMesh mesh = fan(S::name, k);
    const Vec3 inside(0, 1, 0);  // the fan covers the half plane y > 0
    const LocalMatrix local = [&] {
      mesh.boundary = BoundaryInterpolation::edge_only;
      return local_matrix<S>(mesh);
    }();
    const Eigen::RowVectorXd row = row_of(local, S::crease_cross_tangent(k));
    Vec3 tangent = Vec3::Zero();
    for (std::size_t i = 0; i < local.vertices.size(); ++i)
      tangent += row[static_cast<Eigen::Index>(i)] * mesh.positions[static_cast<std::size_t>(local.vertices[i])];
    CAPTURE(k);
    if (k > 1) CHECK(tangent.dot(inside) > 0);
    CHECK(std::abs(tangent.z()) < 1e-14);
  }
}

}  // namespace shaolin
