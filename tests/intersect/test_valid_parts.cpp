// OpenSubdiv's limit judges what is called valid: over dense samples, no such patch folds in its projection.
#include "intersect/valid_parts.h"

#include <cmath>

#include "intersect/validity.h"
#include "schemes/builtin.h"
#include "schemes/load_plugin.h"
#include "schemes/scheme_surface.h"
#include "tests/catch.h"
#include "tests/models.h"
#include "tests/plugins/plugin_files.h"
#include "tools/validate/opensubdiv_oracle.h"

namespace shaolin {

namespace {

using Flat = Eigen::Vector2d;

double cross(const Flat& a, const Flat& b) { return a.x() * b.y() - a.y() * b.x(); }

/// What samples of a part's limit show in its projection.
struct Judgement {
  int folded = 0;     ///< triangles of the sample grid that are turned over, beyond the oracle's error
  int crossings = 0;  ///< pairs of border segments that cross
};

class Judge {
 public:
  explicit Judge(const Model& model) : oracle_(model.mesh, model.scheme) {}

  const OpenSubdivOracle& oracle() const { return oracle_; }

  /// `to_root` maps the part's parameters to those of (face, sub).
  template <FaceKind kind, class ToRoot>
  Judgement judge(int face, int sub, const Vec3& normal, ToRoot to_root, int steps) const {
    const Vec3 u = normal.unitOrthogonal(), v = normal.cross(u);
    const int last = steps + 1;
    std::vector<Flat> grid(static_cast<std::size_t>(last * last), Flat::Zero());
    const auto at = [&](int i, int j) -> Flat& { return grid[static_cast<std::size_t>(j * last + i)]; };
    const auto row = [&](int j) { return kind == FaceKind::quad ? steps : steps - j; };
    for (int j = 0; j <= steps; ++j)
      for (int i = 0; i <= row(j); ++i) {
        const Parameter p = to_root(Parameter(double(i) / steps, double(j) / steps));
        const Vec3 position = oracle_.evaluate({face, sub, p.x(), p.y()})->position;
        at(i, j) = {u.dot(position), v.dot(position)};
      }
    Judgement result;
    const double error = 1e-13 * oracle_.diagonal();
    const auto add = [&](const Flat& a, const Flat& b, const Flat& c) {
      const double slack = 4 * error * ((b - a).norm() + (c - a).norm() + error);
      result.folded += cross(b - a, c - a) < -slack;
    };
    for (int j = 0; j < steps; ++j)
      for (int i = 0; i < row(j); ++i) {
        add(at(i, j), at(i + 1, j), at(i, j + 1));
        if (i + 1 <= row(j + 1)) add(at(i + 1, j + 1), at(i, j + 1), at(i + 1, j));
      }
    std::vector<Flat> border;
    for (int i = 0; i < steps; ++i) border.push_back(at(i, 0));
    for (int j = 0; j < steps; ++j) border.push_back(at(row(j), j));
    if (kind == FaceKind::quad)
      for (int i = steps; i > 0; --i) border.push_back(at(i, steps));
    for (int j = steps; j > 0; --j) border.push_back(at(0, j));
    result.crossings = crossings(border, error);
    return result;
  }

 private:
  static int crossings(const std::vector<Flat>& border, double error) {
    const std::size_t n = border.size();
    int count = 0;
    const auto apart = [&](const Flat& a, const Flat& b, const Flat& c, const Flat& d) {
      const double slack = 4 * error * ((b - a).norm() + (c - a).norm() + (d - a).norm() + error);
      const double left = cross(b - a, c - a), right = cross(b - a, d - a);
      return (left > slack && right < -slack) || (left < -slack && right > slack);
    };
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i + 2; j < n; ++j) {
        if (i == 0 && j == n - 1) continue;
        const Flat &a = border[i], &b = border[i + 1], &c = border[j], &d = border[(j + 1) % n];
        count += apart(a, b, c, d) && apart(c, d, a, b);
      }
    return count;
  }

  OpenSubdivOracle oracle_;
};

/// The map from the parameters of a part to those of its start patch.
template <FaceKind kind>
Parameter to_root(const std::vector<std::uint8_t>& path, Parameter p) {
  for (auto k = path.rbegin(); k != path.rend(); ++k) p = Domain<kind>::to_parent(*k, p);
  return p;
}

/// Judges the valid parts of a model's patches, and valid patches among the control patches and their children.
template <Scheme S>
void judge_model(const Model& model, const S& scheme, int& judged) {
  constexpr FaceKind kind = S::face_kind;
  const Judge judge(model);
  const SchemeSurface<S> surface(model.mesh, scheme);
  Judgement worst;
  std::string where;
  const auto look = [&](int face, int sub, const Vec3& normal, const std::vector<std::uint8_t>& path, int steps) {
    const auto map = [&](const Parameter& p) { return to_root<kind>(path, p); };
    const Judgement found = judge.judge<kind>(face, sub, normal, map, steps);
    ++judged;
    if (found.folded + found.crossings > 0 && where.empty())
      where = "face " + std::to_string(face) + " sub " + std::to_string(sub) + " level " + std::to_string(path.size());
    worst.folded += found.folded;
    worst.crossings += found.crossings;
  };
  const int stride = 1 + surface.face_count() / 150;
  for (int face = 0; face < surface.face_count(); face += stride) {
    if (!surface.has_limit(face)) continue;
    for (int sub = 0; sub < surface.sub_count(face); ++sub) {
      const Patch<S> start = surface.patch(face, sub);
      for_each_valid_part(start, [&](const ValidPart<S>& part) {
        if (part.resolved) look(face, sub, part.plane_normal, part.path, part.path.size() < 3 ? 16 : 4);
      });
      // In the start patch's plane, which suits children less well.
      const Vec3 normal = chord_plane_normal(start);
      for (int k = 0; k < start.configuration->child_count(); ++k) {
        const Patch<S> child = start.child(k);
        if (projects_without_overlap(child, normal)) look(face, sub, normal, {static_cast<std::uint8_t>(k)}, 8);
      }
    }
  }
  CAPTURE(model.name, where);
  CHECK(worst.folded == 0);
  CHECK(worst.crossings == 0);
}

}  // namespace

TEST_CASE("No patch that is called valid folds, says OpenSubdiv", "[intersect][overlap][sweep]") {
  int judged = 0;
  for (const Model& model : all_models()) {
    if (!OpenSubdivOracle::knows(model.scheme)) continue;
    with_scheme(model.scheme, [&](const auto& scheme) { judge_model(model, scheme, judged); });
  }
  CHECK(judged > 10000);
}

TEST_CASE("Most patches of the models are valid as they are, and nearly all parts are", "[intersect][overlap]") {
  ValidityCounts total;
  for (const Model& model : all_models()) {
    const auto surface = make_limit_surface(model.mesh, model.scheme);
    const ValidityCounts counts = count_valid_parts(*surface);
    std::size_t patches = 0;
    for (int f = 0; f < surface->face_count(); ++f)
      if (surface->has_limit(f)) patches += static_cast<std::size_t>(surface->sub_count(f));
    CAPTURE(model.name);
    CHECK(counts.patches == patches);
    CHECK(counts.split <= counts.patches);
    CHECK(counts.parts >= counts.patches);
    // Two triangles that share two edges: their limit is folded along a curve.
    if (model.name != "loop_val2_interior") CHECK(counts.unresolved <= 2 * counts.patches);
    total += counts;
  }
  CHECK(10 * total.split <= 2 * total.patches);
}

TEST_CASE("Of schemes without polynomials nothing is claimed, at the cost of one look", "[intersect][overlap]") {
  const RuntimeScheme<FaceKind::quad> kobbelt(load_plugin(test::example_plugin("kobbelt")).masks);
  const SchemeSurface<RuntimeScheme<FaceKind::quad>> surface(cube(), kobbelt);
  const ValidityCounts counts = count_valid_parts(surface);
  CHECK(counts.patches == 6);
  CHECK(counts.split == 0);
  CHECK(counts.parts == 6);
  CHECK(counts.unresolved == 6);
}

}  // namespace shaolin
