// What is promised around irregular corners: nets as far from the characteristic one as the tolerance allows, and
// farther ones, held against samples of the limit.
#include "schemes/corner_regularity.h"

#include <limits>

#include "schemes/catmull_clark.h"
#include "schemes/loop.h"
#include "schemes/scheme_surface.h"
#include "tests/catch.h"
#include "tests/meshes.h"
#include "tests/schemes/stationary_patch.h"

namespace shaolin {

namespace {

/// The least Jacobian over samples on the rings of some levels, each per unit of its own parameters and scaled by the
/// eigenvalues' product.
template <Scheme S>
double least_jacobian(Patch<S> patch, double shrinking) {
  double least = std::numeric_limits<double>::infinity(), scale = 1;
  for (int level = 0; level < 12; ++level, scale *= shrinking) {
    for (int k = 1; k < patch.configuration->child_count(); ++k) {
      const auto piece = patch.child(k).regular();
      constexpr int steps = 12;
      for (int j = 0; j <= steps; ++j)
        for (int i = 0; i <= (S::face_kind == FaceKind::quad ? steps : steps - j); ++i) {
          const Derivatives d = piece.derivatives({double(i) / steps, double(j) / steps});
          least = std::min(least, (d.du.x() * d.dv.y() - d.du.y() * d.dv.x()) / scale);
        }
    }
    patch = patch.child(0);
  }
  return least;
}

}  // namespace

TEMPLATE_TEST_CASE("Near the characteristic net the limit nowhere turns over", "[schemes][corner_regularity]", Loop,
                   CatmullClark) {
  using S = TestType;
  Random random(8);
  for (const int n : {3, 5, 7, 8, 10}) {
    CAPTURE(n);
    const SubdivisionMesh<S> mesh(poles(S::name, n));
    Patch<S> patch = stationary(mesh);
    const auto& regularity = patch.configuration->corner_regularity(0);
    REQUIRE(regularity);
    CHECK(regularity->tolerance > 1e-4);
    const Eigen::Index points = regularity->right.rows();
    const Eigen::MatrixXd split = matrix_of(patch.configuration->child(0).program, static_cast<int>(points));
    const Eigen::Vector3d values = (regularity->left.transpose() * split * regularity->right).diagonal();
    CHECK(values[0] == Approx(1));
    CHECK(values[1] >= values[2] - 1e-9);
    CHECK((regularity->left.transpose() * regularity->right - Eigen::Matrix3d::Identity()).norm() < 1e-9);

    double least_far = std::numeric_limits<double>::infinity();
    for (int round = 0; round < 40; ++round) {
      Eigen::MatrixXd rest(points, 2);
      for (Eigen::Index i = 0; i < points; ++i) rest.row(i) = random.point().head<2>().transpose();
      rest -= regularity->right * (regularity->left.transpose() * rest);
      rest /= rest.rowwise().norm().maxCoeff();
      const auto with = [&](double share) {
        for (Eigen::Index i = 0; i < points; ++i) {
          Vec3& p = patch.points[static_cast<std::size_t>(i)];
          p << (regularity->right.template rightCols<2>().row(i) + share * rest.row(i)).transpose(), random.uniform();
          p.head<2>() += Eigen::Vector2d(3, -2);
        }
      };
      with(0.98 * regularity->tolerance);
      REQUIRE(regularity->holds_for(patch.points, 1e-13));
      REQUIRE(least_jacobian(patch, values[1] * values[2]) > 0);
      // Mirrored, or with points that may be off by as much, nothing is known.
      for (Vec3& p : patch.points) p.x() = -p.x();
      REQUIRE_FALSE(regularity->holds_for(patch.points, 1e-13));
      with(1.01 * regularity->tolerance);
      REQUIRE_FALSE(regularity->holds_for(patch.points, 1e-13));
      REQUIRE_FALSE(regularity->holds_for(patch.points, 1.0));
      with(300 * regularity->tolerance);
      least_far = std::min(least_far, least_jacobian(patch, values[1] * values[2]));
    }
    CHECK(least_far < 0);
  }
}

}  // namespace shaolin
