// Values and derivatives from nets, by vector instructions, against those of the Bezier patches themselves.
#include "intersect/net_evaluation.h"

#include "tests/catch.h"
#include "tests/random.h"

namespace shaolin {

TEMPLATE_TEST_CASE("Nets are evaluated as their patches are", "[intersect][finish]", BezierQuad, BezierTriangle) {
  Random random(5);
  double jets = 0, coordinates = 0;
  for (int k = 0; k < 1000; ++k) {
    TestType patch;
    for (Vec3& point : patch.b) point = random.point();
    const Parameter at = TestType::DomainType::nearest({random.uniform(-0.2, 1.2), random.uniform(-0.2, 1.2)});
    const Net net(patch);
    const Vec3 position = patch.position(at);
    const Derivatives expected = patch.derivatives(at);

    const std::array<double, 48> points = by_coordinate(net);
    const Jet whole = jet(SplineWindow<TestType>(points.data(), 4, RowMap<TestType>::identity()), at);
    const Derivatives& found = whole.derivatives;
    jets = std::max({jets, (whole.position - position).norm(), (found.du - expected.du).norm(),
                     (found.dv - expected.dv).norm(), (found.duu - expected.duu).norm(),
                     (found.duv - expected.duv).norm(), (found.dvv - expected.dvv).norm()});

    std::array<double, 4> y;  // value, du, dv
    const NetEvaluation<TestType> evaluation(at);
    evaluation(net.y).store(y.data());
    coordinates = std::max({coordinates, std::abs(y[0] - position.y()), std::abs(y[1] - expected.du.y()),
                            std::abs(y[2] - expected.dv.y())});
  }
  // Second derivatives are sums of up to nine points, with weights that sum to 48 at most.
  CHECK(jets < 1e-13);
  CHECK(coordinates < 1e-14);
}

}  // namespace shaolin
