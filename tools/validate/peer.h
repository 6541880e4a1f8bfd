#pragma once
/// Other libraries' subdivision, called as their users call it, and how far it is from the scheme's surface.
#include <memory>
#include <string>
#include <vector>

#include "schemes/control_mesh.h"
#include "schemes/runtime_scheme.h"

namespace shaolin {

/// A mesh under a scheme: "loop", "catmark", "bilinear", or a plug-in's name.
struct PeerCase {
  const ControlMesh& mesh;
  std::string scheme;
  std::shared_ptr<const SchemeMasks> masks;
};

class Peer {
 public:
  virtual ~Peer() = default;

  virtual std::string name() const = 0;
  virtual std::string version() const = 0;
  /// Whether the library's documentation claims the scheme, with all tags that the mesh has.
  virtual bool offers(const PeerCase& of) const = 0;
  /// The largest distance, in diagonals of the control mesh, between the library's points and the right ones. Throws
  /// std::runtime_error where it cannot hold the mesh after all. O(size).
  virtual double error(const PeerCase& of) const = 0;
};

/// OpenSubdiv's limit surface by Bfr with its default options, and its uniform refinement by Far; CGAL's
/// Subdivision_method_3; OpenMesh's subdividers.
std::vector<std::unique_ptr<const Peer>> peers();
std::unique_ptr<const Peer> bfr_peer();
std::unique_ptr<const Peer> far_peer();
std::unique_ptr<const Peer> cgal_peer();
std::unique_ptr<const Peer> openmesh_peer();

/// Uniform steps that points are compared after: enough to show a wrong rule for new vertices of every kind.
inline constexpr int peer_levels = 3;

/// The points after so many steps by plain reading of the masks, see mask_refinement.h.
std::vector<Vec3> plainly_refined(const PeerCase& of);
/// The largest distance from a point of either set to the nearest of the other, in diagonals of the control mesh.
double set_distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b, const ControlMesh& mesh);

/// What a mesh asks of a library, as a few words: "closed", "boundary, creases", ...
std::string shape_class(const ControlMesh& mesh);

/// True if nothing but positions, faces and smooth boundaries decides on the surface.
bool has_no_tags(const ControlMesh& mesh);

}  // namespace shaolin
