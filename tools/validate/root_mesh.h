#pragma once
/// A control mesh as OpenSubdiv's topology holds it: the level 0 of the oracles.
#include <functional>
#include <vector>

#include "schemes/control_mesh.h"
#include "schemes/limit_sample.h"
#include "tools/validate/tagged_mesh.h"

namespace shaolin {

/// The options of a mesh in OpenSubdiv's terms.
SubdivisionRules rules_of(const ControlMesh& mesh, OpenSubdiv::Sdc::SchemeType scheme);

/// OpenSubdiv's refiner over a control mesh, with its boundary option and holes. Throws InputError for the triangle
/// split over other faces and for meshes that OpenSubdiv declines. O(size).
std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> control_refiner(const ControlMesh& mesh, SubdivisionRules rules);

/// The control mesh, or its first refinement if it has faces that are not the split's own kind, so that a corner of an
/// n-gon is a quad.
struct RootMesh {
  using Refine = std::function<Refined(const TaggedMesh&)>;

  /// Throws InputError for the triangle split over other faces and for meshes that OpenSubdiv declines. O(size).
  RootMesh(const ControlMesh& control, const SubdivisionRules& rules, const Refine& refine);

  /// A point of a face of `mesh`: its own u, v are `scale` times finer than the control face's.
  struct Place {
    int face;
    double u, v;
    double scale;
  };
  /// u and v are clamped to [0, 1]; so is u + v on triangles. Throws std::out_of_range for face or sub.
  Place place_of(const SurfaceParameter& at) const;

  /// See Oracle::is_inside().
  bool is_inside(const SurfaceParameter& at) const;

  double diagonal;
  SubdivisionRules rules;
  std::vector<char> has_limit;  ///< by control face
  std::vector<int> sub_counts;
  TaggedMesh mesh;
  Relation face_children;            ///< per control face: its faces in `mesh`; empty without refinement
  std::vector<char> face_has_limit;  ///< by face of `mesh`
};

}  // namespace shaolin
