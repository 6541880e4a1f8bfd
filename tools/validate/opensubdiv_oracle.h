#pragma once
/// The limit surface according to OpenSubdiv, made exact where Bfr alone is not. It shares no code with the product's
/// own evaluation.
#include <memory>
#include <string>

#include "tools/validate/oracle.h"

namespace shaolin {

/// How the oracle decides which of its two ways to take. Both give the same surface; the default is for use,
/// other values are for testing one way against the other.
struct OracleOptions {
  /// Distances (in a quad's or triangle's parameter square) from an irregular corner up to which the neighbourhood is
  /// refined before Bfr evaluates it. Bfr's end-caps begin at 2^-10, so this must not be smaller; at most 1.
  double zone = 1.0 / 256;
  /// Vertices of more faces are kept out of Bfr's patches altogether: its tables grow with the valence's square.
  int heavy_valence = 40;
};

/// OpenSubdiv's scheme of that name: "loop", "catmark" or "bilinear". Throws InputError for another name.
OpenSubdiv::Sdc::SchemeType scheme_type(const std::string& scheme);

/// Evaluation of Bfr's surface in double at approximation levels (10, 10). Near an irregular corner the 3-ring of the
/// corner is refined by Far until the parameter lies in a piece that does not touch the corner, and Bfr evaluates that
/// piece. Exactly at an irregular corner the position is the limit of Far's refinement.
/// A mesh that has faces which are not the scheme's own kind is refined once as a whole first, so that a corner of an
/// n-gon is a quad.
class OpenSubdivOracle final : public Oracle {
 public:
  /// `scheme` is "loop", "catmark" or "bilinear". Throws InputError for another name, for Loop over other faces than
  /// triangles, for conical vertices and for meshes that OpenSubdiv declines. O(mesh size).
  OpenSubdivOracle(const ControlMesh& mesh, const std::string& scheme, const OracleOptions& options = {});
  ~OpenSubdivOracle() override;

  /// True if `scheme` is one of OpenSubdiv's.
  static bool knows(const std::string& scheme);

  bool has_derivatives() const override { return true; }
  /// Exactly at an irregular corner the derivatives are empty. The normal is zero where du and dv do not span a plane
  /// and at corners that have no tangent plane, see CornerLimit. Amortised O(1) away from irregular corners,
  /// O(valence x log2(1 / distance)) for the first query near one.
  std::optional<LimitSample> evaluate(const SurfaceParameter& at) const override;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace shaolin
