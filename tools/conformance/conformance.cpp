#include "tools/conformance/conformance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "intersect/face_bounds.h"
#include "schemes/scheme_surface.h"

namespace shaolin {

namespace {

constexpr int most_sector_faces = 12;

/// Points in a cube around the origin, from a fixed sequence.
class Points {
 public:
  Vec3 next() {
    const double x = value(), y = value();
    return {x, y, value()};
  }
  double value() { return static_cast<double>(engine_() >> 11) * 0x1p-52 - 1; }  // in [-1, 1)
  double share() { return 0.5 + 0.5 * value(); }

 private:
  std::mt19937_64 engine_{20030901};
};

/// Keeps the worst figure of a check.
class Worst {
 public:
  Worst(std::string name, double bar, std::string meaning)
      : result_{std::move(name), "", 0, bar, Verdict::pass, ""}, meaning_(std::move(meaning)) {}

  void add(double figure, const std::string& subject) {
    if (!seen_ || !(figure <= result_.figure)) {  // NaN counts as the worst
      result_.figure = figure;
      result_.subject = subject;
    }
    seen_ = true;
  }
  CheckResult result() const {
    CheckResult result = result_;
    if (!seen_) result.subject = "nothing to look at";
    if (!(result.figure <= result.bar)) result.verdict = Verdict::fail, result.note = meaning_;
    return result;
  }

 private:
  CheckResult result_;
  std::string meaning_;
  bool seen_ = false;
};

template <FaceKind kind>
class Kit {
  using S = RuntimeScheme<kind>;
  using D = Domain<kind>;

 public:
  Kit(std::string name, const std::shared_ptr<const SchemeMasks>& masks, int most_faces)
      : scheme_(masks), most_faces_(most_faces) {
    report_.scheme = std::move(name);
    report_.face_kind = kind;
  }

  ConformanceReport run() {
    weights();  // asks for every mask, so that one which cannot be had is an error
    attempt("affine invariance", &Kit::affine_invariance);
    attempt("symmetry", &Kit::symmetry);
    attempt("creases", &Kit::creases);
    attempt("spectra", &Kit::spectra);
    attempt("characteristic maps", &Kit::characteristic_maps);
    attempt("limit masks", &Kit::limit_masks);
    attempt("regular basis", &Kit::regular_basis);
    attempt("bounds", &Kit::bounds);
    attempt("continuity", &Kit::continuity);
    attempt("degenerate and extreme nets", &Kit::extremes);
    return std::move(report_);
  }

 private:
  /// Where there is no surface to look at, that is the check's failure.
  void attempt(const std::string& name, void (Kit::*check)()) {
    try {
      (this->*check)();
    } catch (const InputError& error) {
      report_.checks.push_back(
          {name, "there is no surface", std::numeric_limits<double>::infinity(), 0, Verdict::fail, error.what()});
    }
  }

  /// The mesh of a star.
  struct Star {
    Star(const S& scheme, StarKind star, int faces) : control(vertex_star(kind, star, faces)), mesh(control, scheme) {}
    /// The patch of face 0, split towards vertex 0 until its configuration repeats itself.
    Patch<S> stationary() {
      Patch<S> patch = mesh.patch({0, 0});
      for (int level = 0; level < 8 && patch.child(0).configuration != patch.configuration; ++level)
        patch = patch.child(0);
      return patch;
    }
    ControlMesh control;
    SubdivisionMesh<S> mesh;
  };

  /// Calls visit(kind, faces) for every star that the kit looks at.
  template <class Visit>
  void each_star(Visit visit) const {
    for (const StarKind star : {StarKind::smooth, StarKind::dart})
      for (int n = 3; n <= most_faces_; ++n) visit(star, n);
    for (const StarKind star : {StarKind::crease, StarKind::corner})
      for (int k = 1; k <= most_sector_faces; ++k) visit(star, k);
  }
  static std::string subject(StarKind star, int faces) {
    return to_string(star) + " of " + std::to_string(faces) + (faces == 1 ? " face" : " faces");
  }

  /// A closed mesh of random points with vertices of several valences; around vertex 0, if asked to, a dart.
  ControlMesh random_mesh(int valence, StarKind star = StarKind::smooth) {
    ControlMesh mesh = vertex_star(kind, star, valence);
    for (Vec3& p : mesh.positions) p += 0.4 * points_.next();
    return mesh;
  }
  std::unique_ptr<LimitSurface> surface(const ControlMesh& mesh) const {
    return std::make_unique<SchemeSurface<S>>(mesh, scheme_);
  }
  SurfaceParameter random_place(const ControlMesh& mesh) {
    SurfaceParameter at{static_cast<int>(points_.share() * mesh.face_count()), 0, points_.share(), points_.share()};
    if (kind == FaceKind::triangle && at.u + at.v > 1) at.u = 1 - at.u, at.v = 1 - at.v;
    return at;
  }

  void weights() {
    Worst sums("weights sum to one", 1e-13, "a constant control net does not stay constant");
    each_star([&](StarKind star, int faces) {
      Star s(scheme_, star, faces);
      const Patch<S> patch = s.mesh.patch({0, 0});
      for (int k = 0; k < patch.configuration->child_count(); ++k) {
        const Eigen::MatrixXd matrix =
            matrix_of(patch.configuration->child(k).program, patch.configuration->point_count());
        sums.add((matrix.rowwise().sum().array() - 1).abs().maxCoeff(), subject(star, faces));
      }
    });
    report_.checks.push_back(sums.result());
  }

  void affine_invariance() {
    Worst worst("affine invariance", 1e-12, "the surface of the moved net is not the moved surface");
    for (const int n : {3, 4, 5, 6, 7, 12}) {
      const ControlMesh mesh = random_mesh(n);
      Eigen::Matrix3d linear;
      linear << points_.next(), points_.next(), points_.next();
      const Vec3 shift = 3 * points_.next();
      ControlMesh moved = mesh;
      for (Vec3& p : moved.positions) p = linear * p + shift;
      const auto before = surface(mesh), after = surface(moved);
      for (int i = 0; i < 40; ++i) {
        const SurfaceParameter at = random_place(mesh);
        const Vec3 expected = linear * before->evaluate(at)->position + shift;
        worst.add((after->evaluate(at)->position - expected).norm(), "valence " + std::to_string(n));
      }
    }
    report_.checks.push_back(worst.result());
  }

  /// Turned: every face begins at its next corner. Mirrored: every face is walked the other way around.
  void symmetry() {
    Worst worst("symmetry", 1e-12, "the surface depends on where a face begins, or on its orientation");
    for (const int n : {3, 4, 5, 6, 7, 12}) {
      const ControlMesh mesh = random_mesh(n);
      ControlMesh turned = mesh, mirrored = mesh;
      for (int f = 0; f < mesh.face_count(); ++f) {
        const auto begin = static_cast<std::ptrdiff_t>(mesh.face_offsets[static_cast<std::size_t>(f)]);
        const auto end = begin + mesh.face_size(f);
        std::rotate(turned.face_vertices.begin() + begin, turned.face_vertices.begin() + begin + 1,
                    turned.face_vertices.begin() + end);
        std::reverse(mirrored.face_vertices.begin() + begin, mirrored.face_vertices.begin() + end);
      }
      const auto plain = surface(mesh), first = surface(turned), second = surface(mirrored);
      const Parameter centre = D::centre();
      for (int f = 0; f < mesh.face_count(); ++f) {
        const SurfaceParameter at{f, 0, centre.x(), centre.y()};
        const Vec3 expected = plain->evaluate(at)->position;
        worst.add((first->evaluate(at)->position - expected).norm(), "turned, valence " + std::to_string(n));
        worst.add((second->evaluate(at)->position - expected).norm(), "mirrored, valence " + std::to_string(n));
      }
    }
    report_.checks.push_back(worst.result());
  }

  /// Along a crease the surface is the curve of the crease's own points, whatever lies beside it.
  void creases() {
    Worst worst("crease is its curve", 1e-13, "points beside the crease move it, or its limit is not the curve's");
    for (int k = 1; k <= most_sector_faces; ++k) {
      Star star(scheme_, StarKind::crease, k);
      Patch<S> patch = star.stationary();
      for (Vec3& p : patch.points) p = points_.next();
      const Ring& ring = patch.configuration->neighbourhood().rings[0];
      const Vec3 start[3] = {patch.points[static_cast<std::size_t>(ring.spokes.front().end)],
                             patch.points[static_cast<std::size_t>(ring.vertex)],
                             patch.points[static_cast<std::size_t>(ring.spokes.back().end)]};
      // The curve by itself: refine it until its neighbours are there.
      Vec3 left = start[0], middle = start[1], right = start[2];
      for (int level = 0; level < 100; ++level) {
        const Vec3 next = scheme_.crease.vertex * middle + scheme_.crease.edge * (left + right);
        left = 0.5 * (left + middle), right = 0.5 * (right + middle), middle = next;
      }
      const std::optional<LimitAtCorner> limit = corner_limit(patch, 0);
      worst.add(limit ? (limit->position - middle).norm() : 1, subject(StarKind::crease, k));
    }
    report_.checks.push_back(worst.result());
  }

  int declared(StarKind star) const {
    const Smoothness& s = scheme_.smoothness;
    return star == StarKind::smooth   ? s.smooth
           : star == StarKind::dart   ? s.dart
           : star == StarKind::crease ? s.crease
                                      : s.corner;
  }

  /// Eigenvalues at every star against the smoothness that the scheme declares there.
  void spectra() {
    CheckResult converges{"convergence", "", 0, 1 - 1e-9, Verdict::pass, ""};
    std::vector<CheckResult> smooth;
    for (const StarKind star : {StarKind::smooth, StarKind::dart, StarKind::crease, StarKind::corner})
      smooth.push_back({"spectrum, " + to_string(star), declared(star) >= 1 ? "all" : "declared continuous only", 0,
                        1e-9, Verdict::pass, ""});
    Worst mean("mean mode", 1e-9, "no eigenvalue is the square of the tangents', as the scheme declares");
    each_star([&](StarKind star, int faces) {
      Star s(scheme_, star, faces);
      const Patch<S> patch = s.stationary();
      const auto values =
          eigenvalues(matrix_of(patch.configuration->child(0).program, patch.configuration->point_count()));
      SpectrumRow row{star, faces, {}};
      for (std::size_t i = 0; i < std::min<std::size_t>(6, values.size()); ++i)
        row.moduli.push_back(std::abs(values[i]));
      report_.spectra.push_back(row);

      if (!(row.moduli[1] <= converges.figure)) {
        converges.figure = row.moduli[1];
        converges.subject = subject(star, faces);
      }
      if (!(std::abs(values[0] - 1.0) <= 1e-9) || !(row.moduli[1] <= converges.bar)) {
        converges.verdict = Verdict::fail;
        converges.note = "1 is not the single largest eigenvalue at a " + subject(star, faces) + ": no limit point";
      }
      if (star == StarKind::smooth && scheme_.smoothness.square_mean_mode) {
        double nearest = 1;
        for (const auto& value : values) nearest = std::min(nearest, std::abs(value - values[1] * values[1]));
        mean.add(nearest, subject(star, faces));
      }
      if (declared(star) >= 1) judge(smooth[static_cast<std::size_t>(star)], star, faces, values);
    });
    report_.checks.push_back(converges);
    report_.checks.insert(report_.checks.end(), smooth.begin(), smooth.end());
    if (scheme_.smoothness.square_mean_mode) report_.checks.push_back(mean.result());
  }

  /// C1: two real positive subdominant eigenvalues, larger than all others; equal ones at a smooth vertex. On a crease
  /// one of them belongs to the crease's own tangent, 1/2.
  static void judge(CheckResult& check, StarKind star, int faces, const std::vector<std::complex<double>>& values) {
    const auto fail = [&](double figure, const char* note) {
      if (check.verdict == Verdict::fail) return;
      check = {check.name, subject(star, faces), figure, check.bar, Verdict::fail, note};
    };
    const std::complex<double> first = values[1], second = values[2];
    const double third = values.size() > 3 ? std::abs(values[3]) : 0;
    const double imaginary = std::max(std::abs(first.imag()), std::abs(second.imag()));
    // Rounding parts a defective double eigenvalue by the root of the precision, into a pair that may be complex.
    constexpr double defective = 1e-6;
    if (imaginary > defective) return fail(imaginary, "the subdominant eigenvalues are complex: the surface spirals");
    if (star == StarKind::smooth && std::abs(first - second) > check.bar)
      return fail(std::abs(first - second), "the subdominant eigenvalue is not double: a cone, or a fold");
    if (second.real() <= 0) return fail(-second.real(), "a subdominant eigenvalue is not positive");
    if (star == StarKind::crease) {
      const bool own = std::abs(first.real() - 0.5) < 1e-6 || std::abs(second.real() - 0.5) < 1e-6;
      if ((!own || second.real() <= third + check.bar) && check.verdict == Verdict::pass)
        check = {check.name,
                 subject(star, faces),
                 third / second.real(),
                 check.bar,
                 Verdict::finding,
                 faces == 1 ? "across a sector of one face the eigenvalue 1/4 stands in a Jordan block"
                            : "further modes are as slow as the crease's tangent (1/2): known of published rules"};
      return;
    }
    if (second.real() <= third + check.bar)
      fail(third - second.real(), "a third mode is as slow as the two tangents: no tangent plane");
  }

  void characteristic_maps() {
    CheckResult check{"characteristic map", "", 0, 0, Verdict::pass, ""};
    if (scheme_.smoothness.smooth < 1) {
      check.subject = "declared continuous only";
      report_.checks.push_back(check);
      return;
    }
    double least = std::numeric_limits<double>::infinity();
    for (int n = 3; n <= most_faces_; ++n) {
      Star star(scheme_, StarKind::smooth, n);
      CharacteristicMap map = characteristic_map(star.stationary());
      if (map.least_jacobian < least) least = map.least_jacobian, check.subject = subject(StarKind::smooth, n);
      if (map.faces == 0 || !map.is_injective()) {
        check.verdict = Verdict::fail;
        check.note = map.faces == 0 ? "there is none: no double real subdominant eigenvalue"
                                    : "it folds over or does not close once";
        check.subject = subject(StarKind::smooth, n);
      }
      if (n <= 12 && map.faces > 0) report_.maps.push_back(std::move(map));
    }
    check.figure = -least;  // at most 0: the least Jacobian is positive
    report_.checks.push_back(check);
  }

  /// Closed forms against derived masks, and both against refinement.
  void limit_masks() {
    Worst closed("limit masks", 1e-12, "the position mask is not the left eigenvector of eigenvalue 1");
    Worst tangents("tangent masks", 1e-9, "the normal is not that of the subdominant left eigenvectors");
    Worst brute("limit by refinement", 1e-10, "refining 150 times towards the vertex leads elsewhere");
    each_star([&](StarKind star, int faces) {
      if (star == StarKind::corner) return;
      Star s(scheme_, star, faces);
      Patch<S> patch = s.stationary();
      for (Vec3& p : patch.points) p = points_.next();
      const std::optional<LimitAtCorner> masked = corner_limit(patch, 0);
      const std::optional<LimitRows>& rows = patch.configuration->derived_limit(0);
      if (!masked || !rows) return closed.add(1, subject(star, faces));
      const LimitAtCorner derived = *detail::derived_limit(patch, 0);
      closed.add((masked->position - derived.position).norm(), subject(star, faces));
      // Where a sector is so wide that further modes count, tangents are the spectrum's finding.
      const bool wide = star == StarKind::crease && faces > (kind == FaceKind::triangle ? 5 : 3);
      if (declared(star) >= 1 && masked->normal && derived.normal && !wide && faces > 1)
        tangents.add((*masked->normal - *derived.normal).norm(), subject(star, faces));
      Patch<S> fine = patch;
      for (int level = 0; level < 150; ++level) fine = fine.child(0);
      brute.add((masked->position - fine.points.front()).norm(), subject(star, faces));
    });
    for (const Worst& worst : {closed, tangents, brute}) report_.checks.push_back(worst.result());
  }

  /// The polynomial of a regular patch, cut in four, against the polynomials of its children.
  void regular_basis() {
    Worst worst("regular basis", 1e-13, "the polynomial that the scheme names is not what its masks refine to");
    const int regular = kind == FaceKind::triangle ? 6 : 4;
    const auto look_at = [&](Patch<S> patch, const std::string& where) {
      for (Vec3& p : patch.points) p = points_.next();
      if (!patch.is_regular()) return;
      const auto quarters = patch.regular().split();
      for (int k = 0; k < 4; ++k) {
        const Patch<S> child = patch.child(k);
        if (!child.is_regular()) return worst.add(1, where + ", whose child is irregular");
        const auto own = child.regular();
        for (std::size_t i = 0; i < own.b.size(); ++i)
          worst.add((own.b[i] - quarters[static_cast<std::size_t>(k)].b[i]).norm(), where);
      }
    };
    for (const StarKind star : {StarKind::smooth, StarKind::crease, StarKind::corner})
      for (const int faces : {1, regular / 2, regular}) {
        if (star == StarKind::smooth && faces < 3) continue;
        Star s(scheme_, star, faces);
        Patch<S> patch = s.mesh.patch({0, 0});
        look_at(patch, subject(star, faces));
        for (int level = 0; level < 3; ++level) {
          for (int k = 0; k < 4; ++k) look_at(patch.child(k), subject(star, faces));
          patch = patch.child(level % 2 ? 2 : 0);
        }
      }
    report_.checks.push_back(worst.result());
  }

  /// Points of the surface against the boxes that the intersector would use for its faces.
  void bounds() {
    Worst worst("bound", 1e-13, "the surface leaves the bound: rays would miss it");
    for (int n = 3; n <= 12; ++n) {
      const ControlMesh mesh = random_mesh(n);
      const SchemeSurface<S> limit(mesh, scheme_);
      const std::vector<Box> boxes = face_bounds(limit.mesh());
      for (int i = 0; i < 200; ++i) {
        const SurfaceParameter at = random_place(mesh);
        const Box& box = boxes[static_cast<std::size_t>(at.face)];
        const Vec3 p = limit.evaluate(at)->position;
        worst.add(std::max({(box.lower - p).maxCoeff(), (p - box.upper).maxCoeff(), 0.0}),
                  "valence " + std::to_string(n));
      }
    }
    report_.checks.push_back(worst.result());
  }

  /// Both faces at an edge give one point; so do a patch and its child at a T-junction.
  void continuity() {
    Worst edges("continuity across edges", 1e-13, "two faces give different points on their edge");
    Worst junctions("continuity at T-junctions", 1e-13, "a patch and its child give different points");
    for (const auto& [star, n] : {std::pair{StarKind::smooth, 3},
                                  {StarKind::smooth, 4},
                                  {StarKind::smooth, 5},
                                  {StarKind::smooth, 6},
                                  {StarKind::smooth, 7},
                                  {StarKind::smooth, 12},
                                  {StarKind::dart, 3},
                                  {StarKind::dart, 4},
                                  {StarKind::dart, 5},
                                  {StarKind::dart, 6}}) {
      const SchemeSurface<S> limit(random_mesh(n, star), scheme_);
      const std::string where = subject(star, n);
      for (int f = 0; f < n; ++f) {
        // Faces f and f + 1 share the last side of the one and the first of the other.
        for (const double t : {0.05, points_.share(), 0.9}) {
          const Vec3 a = limit.evaluate({f, 0, 0, t})->position, b = limit.evaluate({(f + 1) % n, 0, t, 0})->position;
          edges.add((a - b).norm(), where);
        }
        const Patch<S> patch = limit.patch(f, 0);
        for (int k = 0; k < 4; ++k) {
          const Parameter at = 0.5 * D::centre();
          const Vec3 child = shaolin::evaluate(patch.child(k), at).position;
          junctions.add((child - shaolin::evaluate(patch, D::to_parent(k, at)).position).norm(), where);
        }
      }
    }
    for (const Worst& check : {edges, junctions}) report_.checks.push_back(check.result());
  }

  /// Nets without extent and nets of extreme size: a point stays a point, scaling by a power of two is exact, and no
  /// value turns into NaN.
  void extremes() {
    Worst worst("degenerate and extreme nets", 1e-13, "a collapsed or scaled net gives another surface");
    for (const int n : {3, 5, 8}) {
      const ControlMesh mesh = random_mesh(n);
      const auto plain = surface(mesh);
      for (const double scale : {0.0, 0x1p-400, 0x1p+400}) {
        ControlMesh scaled = mesh;
        for (Vec3& p : scaled.positions) p *= scale;
        const auto limit = surface(scaled);
        for (int i = 0; i < 20; ++i) {
          SurfaceParameter at = random_place(mesh);
          if (i % 4 == 0) at.u = at.v = 0;
          const Vec3 p = limit->evaluate(at)->position;
          const double error = scale == 0 ? p.norm() : (p / scale - plain->evaluate(at)->position).norm();
          worst.add(error, scale == 0 ? "all points equal" : "scaled by a power of two");
        }
      }
    }
    report_.checks.push_back(worst.result());
  }

  S scheme_;
  int most_faces_;
  Points points_;
  ConformanceReport report_;
};

}  // namespace

bool ConformanceReport::passed() const {
  return std::none_of(checks.begin(), checks.end(), [](const CheckResult& c) { return c.verdict == Verdict::fail; });
}

ConformanceReport check_conformance(const std::string& name, const std::shared_ptr<const SchemeMasks>& masks,
                                    int most_faces) {
  return masks->face_kind() == FaceKind::triangle ? Kit<FaceKind::triangle>(name, masks, most_faces).run()
                                                  : Kit<FaceKind::quad>(name, masks, most_faces).run();
}

}  // namespace shaolin
