/// The steps of a ray, each by itself, over the patches of models: shaolin_bench_micro MODEL... [--benchmark_...]
///
/// Times are means of many calls in a row, so patches and tables are in the caches as they are not in a picture.
#include <benchmark/benchmark.h>

#include <exception>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "intersect/face_bounds.h"
#include "intersect/flat_finish.h"
#include "intersect/newton_finish.h"
#include "intersect/parts.h"
#include "intersect/ray_frame.h"
#include "schemes/catmull_clark.h"
#include "schemes/limit_surface.h"
#include "schemes/loop.h"
#include "schemes/obj.h"
#include "schemes/scheme_surface.h"

namespace shaolin {
namespace {

/// Patches of up to so many faces, spread over the model.
constexpr int most_faces = 256;

/// A polynomial as a ray sees it that comes along its normal, through a point off its middle or as far beside it as it
/// is wide.
struct Cell {
  Net met, missed;
  TraversalRay met_by{Ray()}, missed_by{Ray()};  ///< the same rays, for the polynomial in space
  double error;
};

template <Scheme S>
struct Subject {
  using Polynomial = RegularPatch<S::face_kind>;

  explicit Subject(ControlMesh mesh) : surface(std::move(mesh), S{}) {
    const int stride = 1 + surface.mesh().face_count() / most_faces;
    for (const int face : surface.mesh().faces()) {
      if (face % stride != 0 || !surface.mesh().has_limit(face)) continue;
      faces.push_back(face);
      const Patch<S> patch = surface.patch(face, 0);
      if (!patch.is_regular()) {
        for (const Patch<S>& child : patch.children())
          if (child.is_regular()) add(child.regular());
        irregular.push_back(patch);
      } else {
        add(patch.regular());
      }
    }
  }

  void add(const Polynomial& polynomial) {
    polynomials.push_back(polynomial);
    nets.emplace_back(polynomial);
    points.push_back(by_coordinate(nets.back()));
    variations.push_back(Variation::of<Polynomial>(nets.back()));
    const Box box = hull_of(nets.back());
    const Vec3 point = polynomial.position({0.15, 0.25});
    const Vec3 along_u = Polynomial::mean_du(polynomial.b);
    const Vec3 normal = along_u.cross(Polynomial::mean_dv(polynomial.b)).normalized();
    Cell cell;
    for (const bool met : {true, false}) {
      Ray ray;
      ray.origin = point + 3 * normal + (met ? Vec3(Vec3::Zero()) : along_u);
      ray.direction = -normal;
      const RayFrame frame(TraversalRay(ray), normal);
      frame.project(nets.back(), met ? cell.met : cell.missed);
      (met ? cell.met_by : cell.missed_by) = TraversalRay(ray);
      cell.error = RayFrame::error(TraversalRay(ray).origin, box);
    }
    cells.push_back(cell);
  }

  SchemeSurface<S> surface;
  std::vector<int> faces;
  std::vector<Patch<S>> irregular;
  std::vector<Polynomial> polynomials;
  std::vector<Net> nets;
  std::vector<std::array<double, 48>> points;  ///< of the nets
  std::vector<Variation> variations;
  std::vector<Cell> cells;
};

/// One call of step(i) a turn, for i below `count` over and over.
template <class Step>
void add(const std::string& name, std::size_t count, Step step) {
  if (count == 0) return;
  benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
    std::size_t i = 0;
    for (auto _ : state) {
      benchmark::DoNotOptimize(step(i));
      i = i + 1 < count ? i + 1 : 0;
    }
  });
}

template <Scheme S>
void add_all(const std::string& model, ControlMesh mesh) {
  using Polynomial = typename Subject<S>::Polynomial;
  const auto subject = std::make_shared<const Subject<S>>(std::move(mesh));
  const auto name = [&](const char* step) { return model + "/" + step; };
  const BoxSpace space(hull_of(subject->surface.control_mesh().positions));

  add(name("match a face with its configuration"), subject->faces.size(),
      [=](std::size_t i) { return subject->surface.patch(subject->faces[i], 0).points.size(); });
  add(name("bound all faces"), 1, [=](std::size_t) { return face_bounds(subject->surface.mesh()).size(); });
  add(name("split an irregular patch"), subject->irregular.size(),
      [=](std::size_t i) { return subject->irregular[i].children().size(); });
  add(name("parts of an irregular patch"), subject->irregular.size(),
      [=](std::size_t i) { return Parts<S>(*PatchNode<S>::make(subject->irregular[i], {}), space).splits(); });
  add(name("parts of a polynomial"), subject->polynomials.size(), [=](std::size_t i) {
    return Parts<S>(LonePolynomialPatch<S>(subject->polynomials[i], {}, false, 0), space).splits();
  });
  add(name("bound a polynomial"), subject->nets.size(), [=](std::size_t i) { return hull_of(subject->nets[i]); });
  add(name("make a coordinate of a piece"), subject->nets.size(), [=](std::size_t i) {
    std::array<double, 16> piece;
    constexpr int number = 1;  // the first part of the first cut, of quads and triangles
    return pieces_of<Polynomial>.restrict_to(number, subject->nets[i].x, piece)[0];
  });
  const auto solve = [](const Net& cell, double error) {
    RayCounters counters;
    NewtonFinish<Polynomial> finish(error, 0, std::numeric_limits<double>::infinity(), false, counters);
    return finish.solve(cell);
  };
  const auto decide = [=](std::size_t i, bool met) {
    const Cell& cell = subject->cells[i];
    const SplineWindow<Polynomial> window(subject->points[i].data(), 4, RowMap<Polynomial>::identity());
    RayCounters counters;
    PatchHit hit;
    return FlatFinish<Polynomial>(window, Pieces<Polynomial>::domain(0), subject->variations[i])
        .solve(met ? cell.met_by : cell.missed_by, std::numeric_limits<double>::infinity(), false, cell.error, false,
               counters, hit);
  };
  add(name("how a polynomial varies"), subject->nets.size(),
      [=](std::size_t i) { return Variation::of<Polynomial>(subject->nets[i]).of_du(Variation::along_n); });
  add(name("decide a flat piece that is missed"), subject->cells.size(),
      [=](std::size_t i) { return decide(i, false); });
  add(name("decide a flat piece that is met"), subject->cells.size(), [=](std::size_t i) { return decide(i, true); });
  add(name("test a cell that is missed"), subject->cells.size(),
      [=](std::size_t i) { return solve(subject->cells[i].missed, subject->cells[i].error); });
  add(name("find a hit by Newton steps"), subject->cells.size(),
      [=](std::size_t i) { return solve(subject->cells[i].met, subject->cells[i].error); });

  if (subject->nets.size() < 8) return;
  EightBoxes boxes;
  for (std::size_t i = 0; i < 8; ++i) boxes.set(i, {hull_of(subject->nets[i]), space});
  add(name("order eight boxes along a ray"), subject->cells.size(), [=](std::size_t i) {
    Ray ray;
    ray.origin = subject->polynomials[i].b[0] + Vec3(1, 2, 3);
    ray.direction = -Vec3(1, 2, 3);
    const BoxRay box_ray(TraversalRay(ray), space, 0);
    return BoxOrder(boxes, box_ray, std::numeric_limits<float>::infinity()).count();
  });
}

void add_model(const std::string& file) {
  ControlMesh mesh = read_obj(file);
  const std::string model = file.substr(file.rfind('/') + 1);
  if (default_scheme(mesh) == "loop")
    add_all<Loop>(model, std::move(mesh));
  else
    add_all<CatmullClark>(model, std::move(mesh));
}

}  // namespace
}  // namespace shaolin

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (argc < 2) {
    std::cerr << "usage: shaolin_bench_micro MODEL... [--benchmark_filter=REGEX] ...\n";
    return 2;
  }
  try {
    for (int i = 1; i < argc; ++i) shaolin::add_model(argv[i]);
  } catch (const std::exception& error) {
    std::cerr << "shaolin_bench_micro: error: " << error.what() << '\n';
    return 3;
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
