#pragma once
/// The limit surface of one control mesh under one scheme, type-erased: evaluation anywhere.
#include <memory>
#include <optional>
#include <string>

#include "control_mesh.h"
#include "limit_sample.h"
#include "places.h"

namespace shaolin {

class SchemeMasks;

/// One face of a surface, or the quad at an n-gon's corner, to be evaluated many times: what depends on the face alone
/// is found once, which is half of an evaluation and more.
class LimitPatch {
 public:
  virtual ~LimitPatch() = default;
  /// As LimitSurface::evaluate(), to the last bit.
  virtual LimitSample evaluate(double u, double v) const = 0;
};

class LimitSurface {
 public:
  virtual ~LimitSurface() = default;

  virtual int face_count() const = 0;
  /// The number of values of `sub` for a face: 1, or the number of corners of an n-gon under Catmull-Clark.
  virtual int sub_count(int face) const = 0;
  /// True if a patch's domain is the triangle u + v <= 1, false for the unit square.
  virtual bool triangular() const = 0;
  /// False for holes and for faces at a boundary that is not interpolated.
  virtual bool has_limit(int face) const = 0;

  /// Position, normal and derivatives at a parameter; empty if the face has no limit surface. Exact to rounding
  /// anywhere, however close to an irregular vertex: the patch is split until the parameter lies in a regular piece.
  /// Throws InputError if face, sub, u or v is out of range, or if the scheme's masks lead to no finite point.
  /// O(valence x log2(1 / distance to an irregular corner)).
  virtual std::optional<LimitSample> evaluate(const SurfaceParameter& at) const = 0;

  /// The face's patch, or null if it has no limit surface. The surface must outlive it. Throws InputError if face or
  /// sub is out of range. O(size of the neighbourhood).
  virtual std::unique_ptr<const LimitPatch> limit_patch(int face, int sub = 0) const = 0;

  /// The places that are one point of the surface with `at`, see places.h. Throws InputError as evaluate() does.
  virtual PointPlaces places_of(const SurfaceParameter& at) const = 0;

  /// The control mesh that it was made from.
  virtual const ControlMesh& control_mesh() const = 0;
};

/// The scheme a mesh asks for: its `t scheme` hint, else "loop" if all faces are triangles, else "catmark".
std::string default_scheme(const ControlMesh& mesh);

/// Builds the surface by a built-in scheme (see builtin.h). Throws InputError for another name, or if a triangle scheme
/// is given a face that is not a triangle. O(mesh size).
std::unique_ptr<LimitSurface> make_limit_surface(ControlMesh mesh, const std::string& scheme);

/// By any scheme, for instance one from load_plugin(). The masks may throw, here and whenever a place of the surface is
/// asked for whose kind has not been seen before.
std::unique_ptr<LimitSurface> make_limit_surface(ControlMesh mesh, const std::shared_ptr<const SchemeMasks>& masks);

}  // namespace shaolin
