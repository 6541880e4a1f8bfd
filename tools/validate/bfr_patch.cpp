#include "tools/validate/bfr_patch.h"

#include <opensubdiv/bfr/refinerSurfaceFactory.h>

#include <algorithm>
#include <stdexcept>

#include "tools/validate/face_list.h"

namespace shaolin {

namespace Bfr = OpenSubdiv::Bfr;
namespace Sdc = OpenSubdiv::Sdc;

namespace {

bool has_chaikin_creases(const TaggedMesh& mesh, const SubdivisionRules& rules) {
  return rules.options.GetCreasingMethod() == Sdc::Options::CREASE_CHAIKIN &&
         std::any_of(mesh.edge_sharpness.begin(), mesh.edge_sharpness.end(),
                     [](float sharpness) { return sharpness > 0 && sharpness < osd_infinite; });
}

}  // namespace

void SurfaceValues::rescale(double factor) {
  du *= factor, dv *= factor;
  duu *= factor * factor, duv *= factor * factor, dvv *= factor * factor;
}

BfrPatch::BfrPatch(const TaggedMesh& mesh, int face, const SubdivisionRules& rules, Bfr::SurfaceFactoryCache& cache)
    : triangular_(rules.triangular()) {
  FaceList ring = unfolded_ring(mesh, face);
  origin_ = ring.points[ring.vertices[0]];
  for (Vec3& p : ring.points) p -= origin_;
  const auto refiner = make_refiner(ring, rules);
  Bfr::SurfaceFactory::Options options;
  options.SetApproxLevelSmooth(10).SetApproxLevelSharp(10).SetExternalCache(&cache);
  const Bfr::RefinerSurfaceFactory<> factory(*refiner, options);
  if (!factory.InitVertexSurface(0, &surface_)) throw std::runtime_error("Bfr has no surface for a face");
  points_.resize(static_cast<std::size_t>(3 * surface_.GetNumPatchPoints()));
  surface_.PreparePatchPoints(ring.points.front().data(), 3, points_.data(), 3);
}

SurfaceValues BfrPatch::as_bfr_says(double u, double v) const {
  const double uv[2] = {u, v};
  SurfaceValues values;
  surface_.Evaluate(uv, points_.data(), 3, values.position.data(), values.du.data(), values.dv.data(),
                    values.duu.data(), values.duv.data(), values.dvv.data());
  values.position += origin_;
  return values;
}

/// OpenSubdiv 3.5 gives the second derivatives the wrong sign in those triangular pieces of an irregular face that are
/// turned by half a turn: it applies the turn's sign three times, not twice. The change of the first derivatives over
/// small steps tells which sign is meant. Steps towards all three corners stay inside the face, and no surface is
/// straight in all their directions unless its second derivatives vanish.
SurfaceValues BfrPatch::evaluate(double u, double v) const {
  SurfaceValues values = as_bfr_says(u, v);
  if (!triangular_ || surface_.IsRegular()) return values;
  constexpr double share = 1.0 / (1 << 20);
  constexpr double corners[3][2] = {{0, 0}, {1, 0}, {0, 1}};
  double agreement = 0;
  for (const auto& corner : corners) {
    const double step_u = share * (corner[0] - u), step_v = share * (corner[1] - v);
    const SurfaceValues there = as_bfr_says(u + step_u, v + step_v);
    agreement += (values.duu * step_u + values.duv * step_v).dot(there.du - values.du) +
                 (values.duv * step_u + values.dvv * step_v).dot(there.dv - values.dv);
  }
  if (agreement < 0) {
    values.duu = -values.duu, values.duv = -values.duv, values.dvv = -values.dvv;
  }
  return values;
}

Piece::Piece(const TaggedMesh& mesh, int face, const SubdivisionRules& rules, Bfr::SurfaceFactoryCache& cache)
    : rules_(rules), cache_(cache) {
  if (!has_chaikin_creases(cut_neighbourhood(mesh, face, 1).mesh, rules)) {
    patch_.emplace(mesh, face, rules, cache);
    return;
  }
  CutOut cut = cut_neighbourhood(mesh, face, 2);
  surroundings_ = std::move(cut.mesh);
  face_ = cut.face_index.at(face);
}

/// The children's 2-rings lie in the children of this face's 1-ring, whose vertices are complete in its 2-ring.
void Piece::split() {
  const Refined fine = refine(surroundings_, rules_);
  for (std::size_t i = 0; i < 4; ++i) {
    children_[i] = std::make_unique<Piece>(fine.mesh, fine.face_children[face_][i], rules_, cache_);
  }
  surroundings_ = {};
}

SurfaceValues Piece::evaluate(double u, double v) {
  if (patch_) return patch_->evaluate(u, v);
  if (!children_[0]) split();
  const ChildPlace in = child_place(rules_.triangular(), u, v);
  SurfaceValues values = children_[static_cast<std::size_t>(in.child)]->evaluate(in.u, in.v);
  values.rescale(2 * in.direction);
  return values;
}

bool may_need_children(const TaggedMesh& mesh, const SubdivisionRules& rules) {
  return has_chaikin_creases(mesh, rules);
}

}  // namespace shaolin
