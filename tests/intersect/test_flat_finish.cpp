// What is clear of flat pieces, by their variation, against where rays are known to meet them and against NewtonFinish.
#include "intersect/flat_finish.h"

#include "intersect/pieces.h"
#include "intersect/ray_frame.h"
#include "tests/catch.h"
#include "tests/infinity.h"
#include "tests/random_patches.h"

namespace shaolin {

namespace {

/// A plane's points, at `scale` a unit and somewhere in space, moved by so many times a side at random.
template <class Bezier>
Bezier bent_patch(Random& random, double scale, double wildness) {
  using D = typename Bezier::DomainType;
  std::array<Vec3, Bezier::spline_size> corners{};
  const Vec3 origin = random.point(), along_u = random.direction(),
             along_v = random.uniform(0.05, 2) * random.direction();
  for (std::size_t k = 0; k < D::corners.size(); ++k)
    corners[k] = origin + scale * (D::corners[k][0] * along_u + D::corners[k][1] * along_v);
  Bezier patch = Bezier::from_corners(corners);
  for (Vec3& point : patch.b) point += scale * wildness * random.point();
  return patch;
}

template <class Bezier>
struct Flat {
  explicit Flat(const Bezier& patch)
      : points(by_coordinate(Net(patch))), window(points.data(), 4, RowMap<Bezier>::identity()) {}

  std::array<double, 48> points;
  SplineWindow<Bezier> window;
};

template <class Bezier>
struct Answer {
  typename FlatFinish<Bezier>::Verdict verdict;
  PatchHit hit;
};

template <class Bezier>
Answer<Bezier> ask(const SplineWindow<Bezier>& window, int number, const Bezier& piece, const Ray& ray,
                   bool any = false) {
  const TraversalRay along(ray);
  RayCounters counters;
  Answer<Bezier> answer;
  const double error = RayFrame::error(along.origin, hull_of(window.net()));
  answer.verdict = FlatFinish<Bezier>(window, Pieces<Bezier>::domain(number), Variation::of<Bezier>(Net(piece)))
                       .solve(along, along.far, false, error, any, counters, answer.hit);
  return answer;
}

/// All hits by NewtonFinish, in the piece's parameters.
template <class Bezier>
std::vector<PatchHit> hits_of(const Bezier& piece, const Ray& ray) {
  const TraversalRay along(ray);
  const RayFrame frame(along, Bezier::mean_du(piece.b).cross(Bezier::mean_dv(piece.b)));
  Net net;
  frame.project(Net(piece), net);
  RayCounters counters;
  std::vector<PatchHit> hits;
  NewtonFinish<Bezier>(RayFrame::error(along.origin, hull_of(Net(piece))), along.near, along.far, false, counters)
      .solve(net, hits);
  return hits;
}

/// Through a point, from some sides of the patch away.
Ray ray_through(const Vec3& point, double scale, Random& random) {
  Ray ray;
  ray.direction = random.direction();
  ray.origin = point - random.uniform(1, 4) * scale * ray.direction;
  return ray;
}

}  // namespace

TEMPLATE_TEST_CASE("A piece varies no more than its bounds say", "[intersect][finish]", BezierQuad, BezierTriangle) {
  using D = typename TestType::DomainType;
  Random random(11);
  double fullest = 0;
  for (int k = 0; k < 400; ++k) {
    const double scale = std::exp2(random.uniform(-30, 30));
    const auto patch = bent_patch<TestType>(random, scale, random.uniform(0, 0.2));
    const Variation variation = Variation::of<TestType>(Net(patch));
    const Derivatives centre = patch.derivatives(D::centre());
    Eigen::Matrix3d basis;
    basis << centre.du, centre.dv, variation.n_scale() * centre.du.cross(centre.dv);
    const Eigen::Matrix3d inverse = basis.inverse();
    for (int i = 0; i < 50; ++i) {
      const Parameter at = random_parameter<D>(random), from = at - D::centre();
      const Derivatives d = patch.derivatives(at);
      const Vec3 off = inverse * (patch.position(at) - patch.position(D::centre())) - Vec3(from.x(), from.y(), 0);
      const Vec3 of_du = inverse * (d.du - centre.du), of_dv = inverse * (d.dv - centre.dv);
      for (const auto axis : {Variation::along_su, Variation::along_sv, Variation::along_n}) {
        CHECK(off[axis] <= variation.above(axis));
        CHECK(-off[axis] <= variation.below(axis));
        CHECK(std::abs(of_du[axis]) <= variation.of_du(axis));
        CHECK(std::abs(of_dv[axis]) <= variation.of_dv(axis));
        if (std::abs(of_du[axis]) > 0.01) fullest = std::max(fullest, std::abs(of_du[axis]) / variation.of_du(axis));
      }
    }
  }
  CHECK(fullest > 0.8);  // they are bounds of these, not of something else
}

TEST_CASE("Nothing is said of needles and of points", "[intersect][finish]") {
  BezierQuad point, needle;
  for (std::size_t k = 0; k < 16; ++k) {
    point.b[k] = Vec3(1, 2, 3);
    const std::size_t row = k / 4;
    needle.b[k] = Vec3(static_cast<double>(k % 4), 1e-8 * static_cast<double>(row), 0);
  }
  CHECK(Variation::of<BezierQuad>(Net(point)).of_du(Variation::along_su) == infinity);
  CHECK(Variation::of<BezierQuad>(Net(needle)).of_du(Variation::along_su) < infinity);
  for (Vec3& p : needle.b) p.x() += 1e7 * p.y();  // along the other side to 1e-7
  CHECK(Variation::of<BezierQuad>(Net(needle)).of_du(Variation::along_su) == infinity);
}

TEMPLATE_TEST_CASE("Clear hits and misses of flat pieces are as they are known", "[intersect][finish]", BezierQuad,
                   BezierTriangle) {
  using D = typename TestType::DomainType;
  using Verdict = typename FlatFinish<TestType>::Verdict;
  Random random(12);
  int aimed = 0, found = 0, missing = 0, none = 0;
  for (int k = 0; k < 6000; ++k) {
    const double scale = std::exp2(random.uniform(-12, 20));
    const auto patch = bent_patch<TestType>(random, scale, random.uniform(0, 0.05));
    const Flat<TestType> flat(patch);
    const Parameter at = random_parameter<D>(random);
    const Ray ray = ray_through(patch.position(at), scale, random);
    const Answer<TestType> answer = ask(flat.window, 0, patch, ray);
    CHECK(answer.verdict != Verdict::none);
    ++aimed;
    if (answer.verdict == Verdict::found) {
      ++found;
      const Derivatives d = patch.derivatives(at);
      const double cosine = std::abs(d.du.cross(d.dv).dot(ray.direction.normalized())) / (d.du.norm() * d.dv.norm());
      // The point aimed at, and rays there, are good to some roundings of coordinates up to 4.
      CHECK((answer.hit.at - at).norm() <= 1e-14 * std::max(1.0, 1 / scale) * 8 / (cosine * cosine));
      CHECK(answer.hit.is_proven);
      const Vec3 there = patch.position(answer.hit.at), o = ray.origin, way = ray.direction.normalized();
      CHECK(std::abs((there - o).dot(way) - answer.hit.distance) <= 1e-14 * (4 + 8 * scale));
    }

    // Beside the piece, where it may meet the ray elsewhere.
    const Parameter beside = at + random.uniform(0.5, 1.5) * Parameter(random.point().head<2>().normalized());
    const Ray past = ray_through(patch.position(beside), scale, random);
    const auto known = hits_of(patch, past);
    const Answer<TestType> other = ask(flat.window, 0, patch, past);
    if (other.verdict == Verdict::found) {
      REQUIRE(!known.empty());
      CHECK((known.front().at - other.hit.at).norm() <= 1e-6);
    }
    if (other.verdict == Verdict::none) CHECK(known.empty());
    missing += known.empty();
    none += other.verdict == Verdict::none;

    // That there is a hit is all that is asked.
    for (const auto& one : {ray, past}) {
      const Answer<TestType> any = ask(flat.window, 0, patch, one, true);
      const auto all = hits_of(patch, one);
      if (any.verdict == Verdict::none) CHECK(all.empty());
      if (any.verdict != Verdict::found) continue;
      REQUIRE(!all.empty());
      CHECK(((all.front().at - any.hit.at).cwiseAbs() - any.hit.radius).maxCoeff() <= 1e-9);
    }
  }
  CHECK(found > 0.4 * aimed);
  CHECK(none > 0.9 * missing);
}

TEST_CASE("Flat pieces of spline patches are met where the whole is", "[intersect][finish]") {
  using Verdict = FlatFinish<BezierQuad>::Verdict;
  Random random(13);
  int found = 0;
  for (int k = 0; k < 3000; ++k) {
    std::array<Vec3, 16> spline;
    for (std::size_t row = 0; row < 4; ++row)
      for (std::size_t i = 0; i < 4; ++i)
        spline[4 * row + i] = Vec3(static_cast<double>(i), static_cast<double>(row), 0) + 0.4 * random.point();
    const BezierQuad whole = BezierQuad::from_spline(spline);
    BezierQuad places;
    places.b = spline;
    const std::array<double, 48> points = by_coordinate(Net(places));
    const SplineWindow<BezierQuad> window(points.data(), 4, RowMap<BezierQuad>::of_spline());
    // A quarter's quarter, by both ways of cutting.
    const auto first = whole.halves(0)[0], second = first.halves(1)[1];
    constexpr int number = 1 + 2 * 7;  // u: interval 1, v: interval 2
    const SubDomain domain = Pieces<BezierQuad>::domain(number);
    const Parameter at(random.uniform(), random.uniform());
    const Ray ray = ray_through(whole.position(domain(at)), 1, random);
    const Answer<BezierQuad> answer = ask(window, number, second, ray);
    CHECK(answer.verdict != Verdict::none);
    if (answer.verdict != Verdict::found) continue;
    ++found;
    if (hits_of(second, ray).size() == 1) CHECK((answer.hit.at - at).norm() <= 1e-8);
  }
  CHECK(found > 2400);
}

TEST_CASE("What lies before or behind the ray's interval is no clear hit", "[intersect][finish]") {
  using Verdict = FlatFinish<BezierQuad>::Verdict;
  Random random(14);
  const auto patch = bent_patch<BezierQuad>(random, 1, 0.05);
  const Flat<BezierQuad> flat(patch);
  Ray ray;
  const Derivatives d = patch.derivatives({0.4, 0.6});
  ray.direction = d.du.cross(d.dv).normalized();
  ray.origin = patch.position({0.4, 0.6}) - 2 * ray.direction;
  CHECK(ask(flat.window, 0, patch, ray).verdict == Verdict::found);
  for (const bool any : {false, true}) {
    ray.tmin = 2.001;
    ray.tmax = infinity;
    CHECK(ask(flat.window, 0, patch, ray, any).verdict == Verdict::none);
    ray.tmin = 0;
    ray.tmax = 1.999;
    CHECK(ask(flat.window, 0, patch, ray, any).verdict == Verdict::none);
    ray.tmax = 2.001;
    CHECK(ask(flat.window, 0, patch, ray, any).verdict == Verdict::found);
  }
}

}  // namespace shaolin
