#include "tools/validate/face_list.h"

#include <opensubdiv/far/topologyDescriptor.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>

#include "tools/validate/corner_limit.h"

namespace shaolin {

namespace Far = OpenSubdiv::Far;

namespace {

/// Copies of faces whose corners are glued together, pair by pair.
class Unfolding {
 public:
  explicit Unfolding(const TaggedMesh& mesh) : mesh_(mesh) {}

  int add_copy(int face) {
    copies_.push_back({face, static_cast<int>(parent_.size())});
    for (int v : mesh_.face_vertices[face]) {
      parent_.push_back(static_cast<int>(parent_.size()));
      source_.push_back(v);
    }
    return static_cast<int>(copies_.size()) - 1;
  }

  /// Glues copy b to copy a along the edge that leads into a's corner and out of b's.
  void glue(int a, int corner_a, int b, int corner_b) {
    join(corner(a, corner_a), corner(b, corner_b));
    join(corner(a, corner_a + size(a) - 1), corner(b, corner_b + 1));
  }

  FaceList result() {
    FaceList list;
    std::map<int, int> index;
    const auto index_of = [&](int glued) {
      const auto [at, is_new] = index.try_emplace(find(glued), static_cast<int>(list.points.size()));
      if (is_new) add_vertex(list, source_[glued]);
      return at->second;
    };
    for (const Copy& copy : copies_) {
      const int n = mesh_.face_vertices.count(copy.face);
      list.sizes.push_back(n);
      for (int i = 0; i < n; ++i) {
        const int a = index_of(copy.first + i), b = index_of(copy.first + (i + 1) % n);
        list.vertices.push_back(a);
        const float sharpness = mesh_.edge_sharpness[mesh_.next_edge(copy.face, i)];
        if (sharpness > 0) list.creases.push_back({a, b, sharpness});
      }
    }
    return list;
  }

 private:
  struct Copy {
    int face, first;
  };

  int size(int copy) const { return mesh_.face_vertices.count(copies_[copy].face); }
  int corner(int copy, int i) const { return copies_[copy].first + i % size(copy); }
  int find(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(int a, int b) { parent_[find(b)] = find(a); }

  /// A vertex of more than two sharp edges is a corner; a copy may have lost sight of some of them.
  void add_vertex(FaceList& list, int v) const {
    const bool corner = crease_count(mesh_, v) > 2 && mesh_.vertex_non_manifold[v];
    const float sharpness = corner ? osd_infinite : mesh_.vertex_sharpness[v];
    if (sharpness > 0) list.corners.push_back({static_cast<int>(list.points.size()), sharpness});
    list.points.push_back(mesh_.points[v]);
  }

  const TaggedMesh& mesh_;
  std::vector<Copy> copies_;
  std::vector<int> parent_, source_;  // per corner of a copy
};

}  // namespace

FaceList face_list(const ControlMesh& mesh) {
  FaceList list{mesh.positions, {}, mesh.face_vertices, {}, mesh.sharp_vertices, mesh.holes};
  for (int f = 0; f < mesh.face_count(); ++f) list.sizes.push_back(mesh.face_size(f));
  if (mesh.sharp_edges.empty()) return list;
  std::set<std::pair<int, int>> edges;
  for (int f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    for (std::size_t i = 0; i < face.size(); ++i) edges.insert(std::minmax(face[i], face[(i + 1) % face.size()]));
  }
  std::copy_if(mesh.sharp_edges.begin(), mesh.sharp_edges.end(), std::back_inserter(list.creases),
               [&](const SharpEdge& crease) { return edges.contains(std::minmax(crease.a, crease.b)); });
  return list;
}

/// Around each corner the copies follow one another; only the face itself and the faces across its own edges are in
/// the sequences of two corners. Around a corner of valence 2 one face lies across both edges.
FaceList unfolded_ring(const TaggedMesh& mesh, int face) {
  Unfolding unfolding(mesh);
  const int n = mesh.face_vertices.count(face), centre = unfolding.add_copy(face);
  std::vector<Sector> fans;
  std::vector<int> side(static_cast<std::size_t>(n)), across(static_cast<std::size_t>(n), -1);
  std::iota(side.begin(), side.end(), 0);
  for (int i = 0; i < n; ++i) {
    fans.push_back(sector_around(mesh, face, i, true));
    if (fans[i].closed && fans[i].size() == 2) std::replace(side.begin(), side.end(), side[i], side[(i + n - 1) % n]);
  }
  const auto copy_across = [&](int edge, int f) {
    int& copy = across[side[edge]];
    if (copy < 0) copy = unfolding.add_copy(f);
    return copy;
  };
  for (int i = 0; i < n; ++i) {
    const Sector& fan = fans[i];
    const int count = fan.size();
    int start = 0;
    while (fan.faces[start] != face || fan.corners[start] != i) ++start;
    const auto place = [&](int k) { return fan.closed ? (k + count) % count : k; };
    std::vector<int> copies(static_cast<std::size_t>(count), -1);
    copies[start] = centre;
    const int after = place(start + 1), before = place(start - 1);
    if (after < count && copies[after] < 0) copies[after] = copy_across((i + n - 1) % n, fan.faces[after]);
    if (before >= 0 && copies[before] < 0) copies[before] = copy_across(i, fan.faces[before]);
    for (int k = 0; k < count; ++k) {
      if (copies[k] < 0) copies[k] = unfolding.add_copy(fan.faces[k]);
    }
    for (int k = 0; k + 1 < count + fan.closed; ++k) {
      unfolding.glue(copies[k], fan.corners[k], copies[place(k + 1)], fan.corners[place(k + 1)]);
    }
  }
  return unfolding.result();
}

std::unique_ptr<Far::TopologyRefiner> make_refiner(const FaceList& mesh, const SubdivisionRules& rules) {
  std::vector<int> edges, corners;
  std::vector<float> edge_weights, corner_weights;
  for (const SharpEdge& crease : mesh.creases) {
    edges.insert(edges.end(), {crease.a, crease.b});
    edge_weights.push_back(crease.sharpness);
  }
  for (const SharpVertex& corner : mesh.corners) {
    corners.push_back(corner.vertex);
    corner_weights.push_back(corner.sharpness);
  }
  Far::TopologyDescriptor descriptor;
  descriptor.numVertices = static_cast<int>(mesh.points.size());
  descriptor.numFaces = static_cast<int>(mesh.sizes.size());
  descriptor.numVertsPerFace = mesh.sizes.data();
  descriptor.vertIndicesPerFace = mesh.vertices.data();
  descriptor.numCreases = static_cast<int>(edge_weights.size());
  descriptor.creaseVertexIndexPairs = edges.data();
  descriptor.creaseWeights = edge_weights.data();
  descriptor.numCorners = static_cast<int>(corners.size());
  descriptor.cornerVertexIndices = corners.data();
  descriptor.cornerWeights = corner_weights.data();
  descriptor.numHoles = static_cast<int>(mesh.holes.size());
  descriptor.holeIndices = mesh.holes.data();
  using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  std::unique_ptr<Far::TopologyRefiner> refiner(
      Factory::Create(descriptor, Factory::Options(rules.scheme, rules.options)));
  if (!refiner)
    throw std::runtime_error("OpenSubdiv cannot build the topology of a mesh of " + std::to_string(mesh.sizes.size()) +
                             " faces");
  return refiner;
}

}  // namespace shaolin
