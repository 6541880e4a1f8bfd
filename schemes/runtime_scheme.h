#pragma once
/// Schemes chosen at run time: one model of the concept per face kind, whose masks are virtual functions. They are
/// asked once per configuration, never per ray.
#include <memory>

#include "scheme.h"

namespace shaolin {

/// What a scheme says, behind virtual functions; the meaning is that of the concept's members of the same names. Masks
/// that a scheme does not have are not asked for: smooth_edge() for radius 1, edge_end() and face_corner() for radius
/// 2, limit masks if it has closed forms.
class SchemeMasks {
 public:
  virtual ~SchemeMasks() = default;

  virtual FaceKind face_kind() const = 0;
  virtual int radius() const = 0;
  virtual Basis basis() const { return Basis::none; }
  virtual CreaseMask crease() const { return cubic_crease; }
  virtual Smoothness smoothness() const { return smooth_surface; }
  virtual VertexMask smooth_vertex(int n) const = 0;
  virtual VertexMask dart_vertex(int n) const { return smooth_vertex(n); }
  virtual VertexMask cone_vertex(int n) const { return smooth_vertex(n); }
  virtual EdgeMask smooth_edge() const { return {}; }
  virtual EdgeMask triangle_edge(int) const { return smooth_edge(); }
  virtual RingMask edge_end(int, int) const { return {}; }
  virtual RingMask face_corner(int n) const { return quarter_of_corner(n); }
  virtual bool has_closed_limits() const { return false; }
  virtual LimitMask smooth_limit(int) const { return {}; }
  virtual RingMask smooth_tangent(int, double) const { return {}; }
  virtual RingMask crease_cross_tangent(int) const { return {}; }
};

/// The masks of a scheme that is known at compile time.
template <Scheme S>
class MasksOf final : public SchemeMasks {
 public:
  FaceKind face_kind() const override { return S::face_kind; }
  int radius() const override { return radius_of(scheme_); }
  Basis basis() const override { return basis_of(scheme_); }
  CreaseMask crease() const override { return crease_of(scheme_); }
  Smoothness smoothness() const override { return smoothness_of(scheme_); }
  VertexMask smooth_vertex(int n) const override { return scheme_.smooth_vertex(n); }
  VertexMask dart_vertex(int n) const override { return dart_vertex_of(scheme_, n); }
  VertexMask cone_vertex(int n) const override { return cone_vertex_of(scheme_, n); }
  EdgeMask smooth_edge() const override {
    if constexpr (EdgeMasks<S>) return scheme_.smooth_edge();
    return {};
  }
  EdgeMask triangle_edge(int triangles) const override {
    if constexpr (requires { scheme_.triangle_edge(triangles); }) return scheme_.triangle_edge(triangles);
    return smooth_edge();
  }
  RingMask edge_end(int n, int other) const override {
    if constexpr (RingMasks<S>) return scheme_.edge_end(n, other);
    return {};
  }
  RingMask face_corner(int n) const override { return face_corner_of(scheme_, n); }
  bool has_closed_limits() const override { return ClosedLimits<S>; }
  LimitMask smooth_limit(int n) const override {
    if constexpr (ClosedLimits<S>) return scheme_.smooth_limit(n);
    return {};
  }
  RingMask smooth_tangent(int n, double first) const override {
    if constexpr (ClosedLimits<S>) return scheme_.smooth_tangent(n, first);
    return {};
  }
  RingMask crease_cross_tangent(int k) const override {
    if constexpr (ClosedLimits<S>) return scheme_.crease_cross_tangent(k);
    return {};
  }

 private:
  S scheme_;
};

template <FaceKind kind>
struct RuntimeScheme {
  static constexpr FaceKind face_kind = kind;

  explicit RuntimeScheme(std::shared_ptr<const SchemeMasks> of)
      : masks(std::move(of)),
        radius(masks->radius()),
        basis(masks->basis()),
        crease(masks->crease()),
        smoothness(masks->smoothness()),
        closed_limits(masks->has_closed_limits()) {}

  std::shared_ptr<const SchemeMasks> masks;
  int radius;
  Basis basis;
  CreaseMask crease;
  Smoothness smoothness;
  bool closed_limits;

  VertexMask smooth_vertex(int n) const { return masks->smooth_vertex(n); }
  VertexMask dart_vertex(int n) const { return masks->dart_vertex(n); }
  VertexMask cone_vertex(int n) const { return masks->cone_vertex(n); }
  EdgeMask smooth_edge() const { return masks->smooth_edge(); }
  EdgeMask triangle_edge(int triangles) const { return masks->triangle_edge(triangles); }
  RingMask edge_end(int n, int other) const { return masks->edge_end(n, other); }
  RingMask face_corner(int n) const { return masks->face_corner(n); }
  LimitMask smooth_limit(int n) const { return masks->smooth_limit(n); }
  RingMask smooth_tangent(int n, double first) const { return masks->smooth_tangent(n, first); }
  RingMask crease_cross_tangent(int k) const { return masks->crease_cross_tangent(k); }
};

/// Calls use(scheme) with the RuntimeScheme of the masks' face kind.
template <class Use>
auto with_masks(const std::shared_ptr<const SchemeMasks>& masks, Use use) {
  return masks->face_kind() == FaceKind::triangle ? use(RuntimeScheme<FaceKind::triangle>(masks))
                                                  : use(RuntimeScheme<FaceKind::quad>(masks));
}

static_assert(Scheme<RuntimeScheme<FaceKind::triangle>> && Scheme<RuntimeScheme<FaceKind::quad>>);

}  // namespace shaolin
