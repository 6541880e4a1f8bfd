#pragma once
/// LimitSurface for one scheme.
#include <string>

#include "errors.h"
#include "limit_surface.h"
#include "subdivision_mesh.h"

namespace shaolin {

/// The subdivision mesh of a control mesh with the configurations that its patches share.
template <Scheme S>
class SchemeSurface final : public LimitSurface {
 public:
  explicit SchemeSurface(ControlMesh control, const S& scheme = {})
      : control_(std::make_shared<const ControlMesh>(std::move(control))), mesh_(control_, scheme) {}

  int face_count() const override { return control_->face_count(); }
  int sub_count(int face) const override { return splits_by_corner(face) ? control_->face_size(face) : 1; }
  bool triangular() const override { return S::face_kind == FaceKind::triangle; }
  bool has_limit(int face) const override { return mesh_.has_limit(face); }
  const ControlMesh& control_mesh() const override { return *control_; }

  std::optional<LimitSample> evaluate(const SurfaceParameter& at) const override {
    check_range(at);
    if (!has_limit(at.face)) return {};
    return sample(patch(at.face, at.sub), at);
  }

  std::unique_ptr<const LimitPatch> limit_patch(int face, int sub) const override {
    check_range({face, sub, 0, 0});
    return has_limit(face) ? std::make_unique<const FacePatch>(*this, face, sub) : nullptr;
  }

  PointPlaces places_of(const SurfaceParameter& at) const override {
    check_range(at);
    return shaolin::places_of(mesh_, at);
  }

  /// The patch of a face, or of an n-gon's corner.
  Patch<S> patch(int face, int sub) const {
    Patch<S> root = mesh_.patch({face, sub});
    return splits_by_corner(face) ? root.child(0) : root;
  }

  /// True for an n-gon of the quad split: its patches are those of its corners, half the size.
  bool splits_by_corner(int face) const { return control_->face_size(face) != Domain<S::face_kind>::corner_count; }

  const SubdivisionMesh<S>& mesh() const { return mesh_; }

 private:
  class FacePatch final : public LimitPatch {
   public:
    FacePatch(const SchemeSurface& surface, int face, int sub)
        : surface_(surface), face_(face), sub_(sub), patch_(surface.patch(face, sub)) {}
    LimitSample evaluate(double u, double v) const override {
      const SurfaceParameter at{face_, sub_, u, v};
      surface_.check_range(at);
      return surface_.sample(patch_, at);
    }

   private:
    const SchemeSurface& surface_;
    int face_, sub_;
    Patch<S> patch_;
  };

  LimitSample sample(const Patch<S>& patch, const SurfaceParameter& at) const {
    LimitSample sample = shaolin::evaluate(patch, Parameter(at.u, at.v));
    if (!sample.position.allFinite())
      throw InputError("the limit at face " + std::to_string(at.face) +
                       " is not finite: its coordinates are too large, or the masks of the scheme do not converge; see "
                       "'shaolin scheme check'");
    if (control_->is_collapsed(at.face)) sample.normal.setZero();  // rounding alone gave it a direction
    return sample;
  }

  void check_range(const SurfaceParameter& at) const {
    if (at.face < 0 || at.face >= face_count())
      throw InputError("face " + std::to_string(at.face) + " is out of range; expected 0 to " +
                       std::to_string(face_count() - 1));
    if (at.sub < 0 || at.sub >= sub_count(at.face))
      throw InputError("sub " + std::to_string(at.sub) + " is out of range; face " + std::to_string(at.face) +
                       " has sub 0 to " + std::to_string(sub_count(at.face) - 1));
    if (!Domain<S::face_kind>::contains({at.u, at.v}))
      throw InputError("(u, v) = (" + std::to_string(at.u) + ", " + std::to_string(at.v) +
                       ") is out of range; expected " +
                       (triangular() ? "u, v >= 0 and u + v <= 1" : "u and v in [0, 1]"));
  }

  std::shared_ptr<const ControlMesh> control_;  ///< the mesh's own, too, where nothing is cut
  SubdivisionMesh<S> mesh_;
};

}  // namespace shaolin
