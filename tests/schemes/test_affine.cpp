// An affine map of the control points maps the surface: all masks sum to 1, tangent masks to 0.
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "schemes/limit_surface.h"
#include "tests/catch.h"
#include "tests/models.h"
#include "tests/property.h"

namespace shaolin {

namespace {

/// Every kind of feature: a dart, a semi-sharp crease, sharp vertices that decay or stay, a hole, a boundary, n-gons.
std::vector<Model> featured() {
  std::vector<Model> result;
  for (const std::string scheme : {"loop", "catmark"}) {
    ControlMesh body = shaken(poles(scheme, 5), 0.2);
    const std::vector<int> v(body.face(0).begin(), body.face(0).end());
    body.sharp_edges = {{v[0], v[1], 10}, {v[1], v[2], 2.5f}};
    body.sharp_vertices = {{1, 1.3f}, {v[2], 10}};
    result.push_back({"body", scheme, body});
    ControlMesh open = shaken(sheet(scheme, 3, 3), 0.2);
    open.sharp_edges = {{5, 6, 10}, {6, 10, 0.7f}};
    open.holes = {8};
    result.push_back({"sheet", scheme, open});
    open.boundary = BoundaryInterpolation::edge_only;
    result.push_back({"sheet without corners", scheme, open});
  }
  ControlMesh gons = shaken(prism(5), 0.2);
  gons.sharp_edges = {{0, 2, 10}, {1, 3, 1.7f}};
  result.push_back({"n-gons", "catmark", gons});
  return result;
}

/// Far from singular, so that normals keep their digits: the identity and less than half of it (in the norm of row
/// sums).
Eigen::Matrix3d linear_part(const Vec3& a, const Vec3& b, const Vec3& c) {
  Eigen::Matrix3d m;
  m << a, b, c;
  return Eigen::Matrix3d::Identity() + m / 25;
}

std::vector<std::array<double, 2>> parameters(bool triangular) {
  std::vector<std::array<double, 2>> result{{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.3, 0.45}, {0.999, 1e-4}, {1e-4, 1e-5}};
  if (!triangular) result.push_back({1, 1});
  return result;
}

}  // namespace

TEST_CASE("Affine maps of control points map positions, derivatives and normals", "[schemes][affine]") {
  const std::vector<Model> models = featured();
  std::vector<std::unique_ptr<LimitSurface>> surfaces;
  for (const Model& model : models) surfaces.push_back(make_limit_surface(model.mesh, model.scheme));

  const auto which = rc::gen::inRange<std::size_t>(0, models.size());
  check_property(
      [&] {
        const std::size_t k = *which;
        const Eigen::Matrix3d linear = linear_part(*any_point(), *any_point(), *any_point());
        const Vec3 shift = *any_point();
        const LimitSurface& surface = *surfaces[k];
        ControlMesh moved = models[k].mesh;
        for (Vec3& p : moved.positions) p = linear * p + shift;
        const double size = moved.diagonal() + shift.norm();
        const auto image = make_limit_surface(moved, models[k].scheme);
        const Eigen::Matrix3d cofactor = linear.inverse().transpose();

        const int face = *rc::gen::inRange(0, surface.face_count());
        RC_PRE(surface.has_limit(face));
        const int sub = *rc::gen::inRange(0, surface.sub_count(face));
        for (const auto& [u, v] : parameters(surface.triangular())) {
          const LimitSample a = *surface.evaluate({face, sub, u, v}), b = *image->evaluate({face, sub, u, v});
          RC_LOG() << models[k].scheme << " " << models[k].name << " face " << face << " sub " << sub << " (" << u
                   << ", " << v << ")\n";
          RC_ASSERT((linear * a.position + shift - b.position).norm() < 1e-14 * size);
          // One-sided normals at corners of several faces, and those beside them, are found with fewer digits.
          RC_ASSERT(((cofactor * a.normal).normalized() - b.normal).norm() < 1e-9);
          RC_ASSERT(a.derivatives.has_value() == b.derivatives.has_value());
          if (!a.derivatives) continue;
          const Derivatives &p = *a.derivatives, &q = *b.derivatives;
          const auto agree = [&](const Vec3& x, const Vec3& y, double more) {
            return (linear * x - y).norm() < 1e-11 * (size + y.norm()) + more;
          };
          RC_ASSERT(agree(p.du, q.du, 0));
          RC_ASSERT(agree(p.dv, q.dv, 0));
          // Second derivatives carry the rounding of the first ones, divided by the distance between the points.
          const double distance = std::min({std::hypot(u, v), std::hypot(1 - u, v), std::hypot(u, 1 - v)});
          const double rounding = distance > 0 ? 1e-14 * size / distance : 0;
          RC_ASSERT(agree(p.duu, q.duu, rounding));
          RC_ASSERT(agree(p.duv, q.duv, rounding));
          RC_ASSERT(agree(p.dvv, q.dvv, rounding));
        }
      },
      200);
}

TEST_CASE("A constant mesh has constant limits and no derivatives to speak of", "[schemes][affine]") {
  const Vec3 point(0.3, -1.7, 2.9);
  for (Model& model : featured()) {
    for (Vec3& p : model.mesh.positions) p = point;
    const auto surface = make_limit_surface(model.mesh, model.scheme);
    for (int face = 0; face < surface->face_count(); ++face) {
      if (!surface->has_limit(face)) continue;
      for (int sub = 0; sub < surface->sub_count(face); ++sub) {
        const LimitSample s = *surface->evaluate({face, sub, 0.3, 0.45});
        CAPTURE(model.scheme, model.name, face, sub);
        CHECK((s.position - point).norm() < 1e-14);
        CHECK(s.derivatives->du.norm() < 1e-13);
        CHECK(s.derivatives->dv.norm() < 1e-13);
        CHECK(s.derivatives->duu.norm() < 1e-12);
      }
    }
  }
}

}  // namespace shaolin
