#pragma once
/// Schemes chosen at run time: one model of the concept per face kind, whose masks are virtual functions. They are
/// asked once per configuration, never per ray.
#include <memory>
#include <type_traits>

#include "bezier_quad.h"
#include "bezier_triangle.h"
#include "scheme.h"

namespace shaolin {

/// What a scheme says, behind virtual functions; the meaning is that of the concept's members of the same names.
class SchemeMasks {
 public:
  virtual ~SchemeMasks() = default;

  virtual FaceKind face_kind() const = 0;
  virtual Basis basis() const = 0;
  virtual CreaseMask crease() const = 0;
  virtual Smoothness smoothness() const = 0;
  virtual VertexMask smooth_vertex(int n) const = 0;
  virtual VertexMask dart_vertex(int n) const { return smooth_vertex(n); }
  virtual VertexMask cone_vertex(int n) const { return smooth_vertex(n); }
  virtual EdgeMask smooth_edge() const = 0;
  virtual LimitMask smooth_limit(int n) const = 0;
  virtual TangentMask smooth_tangent(int n, double first) const = 0;
  virtual TangentMask crease_cross_tangent(int k) const = 0;
};

/// The masks of a scheme that is known at compile time.
template <Scheme S>
class MasksOf final : public SchemeMasks {
 public:
  FaceKind face_kind() const override { return S::face_kind; }
  Basis basis() const override { return scheme_.basis; }
  CreaseMask crease() const override { return scheme_.crease; }
  Smoothness smoothness() const override { return scheme_.smoothness; }
  VertexMask smooth_vertex(int n) const override { return scheme_.smooth_vertex(n); }
  VertexMask cone_vertex(int n) const override {
    if constexpr (requires { scheme_.cone_vertex(n); }) return scheme_.cone_vertex(n);
    return scheme_.smooth_vertex(n);
  }
  VertexMask dart_vertex(int n) const override {
    if constexpr (requires { scheme_.dart_vertex(n); }) return scheme_.dart_vertex(n);
    return scheme_.smooth_vertex(n);
  }
  EdgeMask smooth_edge() const override { return scheme_.smooth_edge(); }
  LimitMask smooth_limit(int n) const override { return scheme_.smooth_limit(n); }
  TangentMask smooth_tangent(int n, double first) const override { return scheme_.smooth_tangent(n, first); }
  TangentMask crease_cross_tangent(int k) const override { return scheme_.crease_cross_tangent(k); }

 private:
  S scheme_;
};

template <FaceKind kind>
struct RuntimeScheme {
  static constexpr FaceKind face_kind = kind;
  static constexpr int radius = 1;
  using Regular = std::conditional_t<kind == FaceKind::triangle, BezierTriangle, BezierQuad>;

  explicit RuntimeScheme(std::shared_ptr<const SchemeMasks> of)
      : masks(std::move(of)), basis(masks->basis()), crease(masks->crease()), smoothness(masks->smoothness()) {}

  std::shared_ptr<const SchemeMasks> masks;
  Basis basis;
  CreaseMask crease;
  Smoothness smoothness;

  VertexMask smooth_vertex(int n) const { return masks->smooth_vertex(n); }
  VertexMask dart_vertex(int n) const { return masks->dart_vertex(n); }
  VertexMask cone_vertex(int n) const { return masks->cone_vertex(n); }
  EdgeMask smooth_edge() const { return masks->smooth_edge(); }
  LimitMask smooth_limit(int n) const { return masks->smooth_limit(n); }
  TangentMask smooth_tangent(int n, double first) const { return masks->smooth_tangent(n, first); }
  TangentMask crease_cross_tangent(int k) const { return masks->crease_cross_tangent(k); }
};

static_assert(Scheme<RuntimeScheme<FaceKind::triangle>> && Scheme<RuntimeScheme<FaceKind::quad>>);

}  // namespace shaolin
