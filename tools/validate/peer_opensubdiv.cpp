// OpenSubdiv as a peer: Bfr's limit surface and Far's refinement.
#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/version.h>

#include <stdexcept>

#include "schemes/limit_surface.h"
#include "tools/validate/opensubdiv_oracle.h"
#include "tools/validate/peer.h"

namespace shaolin {
namespace {

namespace Bfr = OpenSubdiv::Bfr;

std::string opensubdiv_version() {
  return std::to_string(OPENSUBDIV_VERSION_MAJOR) + '.' + std::to_string(OPENSUBDIV_VERSION_MINOR) + '.' +
         std::to_string(OPENSUBDIV_VERSION_PATCH);
}

bool opensubdiv_offers(const PeerCase& of) { return OpenSubdivOracle::knows(of.scheme) && of.mesh.cones.empty(); }

class BfrPeer final : public Peer {
 public:
  std::string name() const override { return "OpenSubdiv Bfr"; }
  std::string version() const override { return opensubdiv_version(); }
  bool offers(const PeerCase& of) const override { return opensubdiv_offers(of); }
  double error(const PeerCase& of) const override;
};

/// Against the limit surface of shaolin, on a grid and close to the corners of all faces of the scheme's own kind.
double BfrPeer::error(const PeerCase& of) const {
  constexpr double places[][2] = {{0, 0},        {0.5, 0},     {0.5, 0.5},          {0.25, 0.25}, {0.125, 0.625},
                                  {0.625, 0.25}, {1e-3, 1e-3}, {1e-4, 0.25 * 1e-4}, {0.03, 0.01}, {0.9, 0.05}};
  const SubdivisionRules rules = rules_of(of.mesh, scheme_type(of.scheme));
  const auto refiner = control_refiner(of.mesh, rules);
  const Bfr::RefinerSurfaceFactory<> factory(*refiner);
  const auto ours = make_limit_surface(of.mesh, of.scheme);
  std::vector<double> positions;
  for (const Vec3& p : of.mesh.positions) positions.insert(positions.end(), p.data(), p.data() + 3);
  double worst = 0;
  for (int face = 0; face < of.mesh.face_count(); ++face) {
    Bfr::Surface<double> surface;
    if (of.mesh.face_size(face) != rules.face_size() || !ours->has_limit(face)) continue;
    if (!factory.InitVertexSurface(face, &surface)) throw std::runtime_error("no surface for a face");
    std::vector<double> points(static_cast<std::size_t>(3 * surface.GetNumPatchPoints()));
    surface.PreparePatchPoints(positions.data(), 3, points.data(), 3);
    for (const auto& uv : places) {
      Vec3 position;
      surface.Evaluate(uv, points.data(), 3, position.data());
      worst = std::max(worst, (position - ours->evaluate({face, 0, uv[0], uv[1]})->position).norm());
    }
  }
  return worst / of.mesh.diagonal();
}

class FarPeer final : public Peer {
 public:
  std::string name() const override { return "OpenSubdiv Far"; }
  std::string version() const override { return opensubdiv_version(); }
  bool offers(const PeerCase& of) const override { return opensubdiv_offers(of); }
  double error(const PeerCase& of) const override {
    const SubdivisionRules rules = rules_of(of.mesh, scheme_type(of.scheme));
    const auto step = [&](const TaggedMesh& mesh) { return refine(mesh, rules); };
    RootMesh root(of.mesh, rules, step);
    for (int level = root.face_children.size() > 0; level < peer_levels; ++level)
      root.mesh = std::move(step(root.mesh).mesh);
    return set_distance(root.mesh.points, plainly_refined(of), of.mesh);
  }
};

}  // namespace

std::unique_ptr<const Peer> bfr_peer() { return std::make_unique<BfrPeer>(); }
std::unique_ptr<const Peer> far_peer() { return std::make_unique<FarPeer>(); }

}  // namespace shaolin
