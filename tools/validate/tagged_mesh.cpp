#include "tools/validate/tagged_mesh.h"

#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <unordered_set>

namespace Far = OpenSubdiv::Far;

namespace OpenSubdiv {
namespace OPENSUBDIV_VERSION {
namespace Far {

// OpenSubdiv's way to read a mesh class: sizes, incidences, tags.
using TaggedFactory = TopologyRefinerFactory<shaolin::TaggedMesh>;

template <>
bool TaggedFactory::resizeComponentTopology(TopologyRefiner& refiner, const shaolin::TaggedMesh& mesh) {
  setNumBaseVertices(refiner, mesh.vertex_count());
  setNumBaseFaces(refiner, mesh.face_count());
  setNumBaseEdges(refiner, mesh.edge_count());
  for (int f = 0; f < mesh.face_count(); ++f) setNumBaseFaceVertices(refiner, f, mesh.face_vertices.count(f));
  for (int e = 0; e < mesh.edge_count(); ++e) setNumBaseEdgeFaces(refiner, e, mesh.edge_faces.count(e));
  // Two loops: GCC 12 at -O3 miscompiles OpenSubdiv's inline offset sums in one (all vertices' edges then start at 0).
  for (int v = 0; v < mesh.vertex_count(); ++v) setNumBaseVertexFaces(refiner, v, mesh.vertex_faces.count(v));
  for (int v = 0; v < mesh.vertex_count(); ++v) setNumBaseVertexEdges(refiner, v, mesh.vertex_edges.count(v));
  return true;
}

template <>
bool TaggedFactory::assignComponentTopology(TopologyRefiner& refiner, const shaolin::TaggedMesh& mesh) {
  const auto copy = [](const auto& from, auto to) { std::copy(from.begin(), from.end(), to.begin()); };
  for (int f = 0; f < mesh.face_count(); ++f) {
    copy(mesh.face_vertices[f], getBaseFaceVertices(refiner, f));
    copy(mesh.face_edges[f], getBaseFaceEdges(refiner, f));
  }
  for (int e = 0; e < mesh.edge_count(); ++e) {
    copy(mesh.edge_vertices[e], getBaseEdgeVertices(refiner, e));
    copy(mesh.edge_faces[e], getBaseEdgeFaces(refiner, e));
    copy(mesh.edge_face_slots[e], getBaseEdgeFaceLocalIndices(refiner, e));
    setBaseEdgeNonManifold(refiner, e, mesh.edge_non_manifold[e]);
  }
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    copy(mesh.vertex_faces[v], getBaseVertexFaces(refiner, v));
    copy(mesh.vertex_face_slots[v], getBaseVertexFaceLocalIndices(refiner, v));
    copy(mesh.vertex_edges[v], getBaseVertexEdges(refiner, v));
    copy(mesh.vertex_edge_slots[v], getBaseVertexEdgeLocalIndices(refiner, v));
    setBaseVertexNonManifold(refiner, v, mesh.vertex_non_manifold[v]);
  }
  return true;
}

template <>
bool TaggedFactory::assignComponentTags(TopologyRefiner& refiner, const shaolin::TaggedMesh& mesh) {
  for (int e = 0; e < mesh.edge_count(); ++e) setBaseEdgeSharpness(refiner, e, mesh.edge_sharpness[e]);
  for (int v = 0; v < mesh.vertex_count(); ++v) setBaseVertexSharpness(refiner, v, mesh.vertex_sharpness[v]);
  return true;
}

}  // namespace Far
}  // namespace OPENSUBDIV_VERSION
}  // namespace OpenSubdiv

namespace shaolin {

namespace {

/// What PrimvarRefinerReal asks of its data.
struct Point {
  Vec3 value = Vec3::Zero();
  void Clear() { value.setZero(); }
  void AddWithWeight(const Point& other, double weight) { value += weight * other.value; }
};

std::vector<Vec3> refined_points(const Far::TopologyRefiner& refiner, const TaggedMesh& mesh) {
  std::vector<Point> coarse(mesh.points.size());
  for (std::size_t i = 0; i < coarse.size(); ++i) coarse[i].value = mesh.points[i];
  std::vector<Point> fine(static_cast<std::size_t>(refiner.GetLevel(1).GetNumVertices()));
  Far::PrimvarRefinerReal<double>(refiner).Interpolate(1, coarse, fine);
  std::vector<Vec3> points(fine.size());
  std::transform(fine.begin(), fine.end(), points.begin(), [](const Point& p) { return p.value; });
  return points;
}

/// Builds a cut-out: faces first, then the edges and vertices that they use, then the incidences that are left.
class Cutter {
 public:
  Cutter(const TaggedMesh& from, CutOut& to) : from_(from), to_(to) {}

  void add_face(int f) {
    if (!to_.face_index.emplace(f, to_.mesh.face_count()).second) return;
    for (int v : from_.face_vertices[f]) to_.mesh.face_vertices.push(index(to_.vertex_index, vertices_, v));
    for (int e : from_.face_edges[f]) to_.mesh.face_edges.push(index(edge_index_, edges_, e));
    to_.mesh.face_vertices.close();
    to_.mesh.face_edges.close();
  }

  void finish() {
    for (int e : edges_) add_edge(e);
    for (int v : vertices_) add_vertex(v);
  }

 private:
  /// A face or an edge at a vertex or edge, and which of its places that is.
  struct Slot {
    int element, slot;
  };

  static int index(std::unordered_map<int, int>& map, std::vector<int>& list, int old) {
    const auto [at, is_new] = map.try_emplace(old, static_cast<int>(list.size()));
    if (is_new) list.push_back(old);
    return at->second;
  }

  static std::vector<Slot> kept(std::span<const int> elements, std::span<const int> slots,
                                const std::unordered_map<int, int>& map) {
    std::vector<Slot> result;
    for (std::size_t i = 0; i < elements.size(); ++i) {
      const auto found = map.find(elements[i]);
      if (found != map.end()) result.push_back({found->second, slots[i]});
    }
    return result;
  }

  static void append(const std::vector<Slot>& from, Relation& elements, Relation& slots) {
    for (const Slot& s : from) elements.push(s.element), slots.push(s.slot);
    elements.close();
    slots.close();
  }

  void add_edge(int e) {
    const auto& [a, b] = from_.edge_vertices[e];
    to_.mesh.edge_vertices.push_back({to_.vertex_index.at(a), to_.vertex_index.at(b)});
    const auto faces = kept(from_.edge_faces[e], from_.edge_face_slots[e], to_.face_index);
    append(faces, to_.mesh.edge_faces, to_.mesh.edge_face_slots);
    to_.mesh.edge_sharpness.push_back(from_.edge_sharpness[e]);
    to_.mesh.edge_non_manifold.push_back(from_.edge_non_manifold[e] && faces.size() > 1);
  }

  void add_vertex(int v) {
    auto faces = kept(from_.vertex_faces[v], from_.vertex_face_slots[v], to_.face_index);
    auto edges = kept(from_.vertex_edges[v], from_.vertex_edge_slots[v], edge_index_);
    const bool complete = static_cast<int>(faces.size()) == from_.vertex_faces.count(v);
    const bool non_manifold = complete ? from_.vertex_non_manifold[v] : !order_fan(faces, edges);
    append(faces, to_.mesh.vertex_faces, to_.mesh.vertex_face_slots);
    append(edges, to_.mesh.vertex_edges, to_.mesh.vertex_edge_slots);
    to_.mesh.points.push_back(from_.points[v]);
    to_.mesh.vertex_sharpness.push_back(from_.vertex_sharpness[v]);
    to_.mesh.vertex_non_manifold.push_back(non_manifold);
    to_.mesh.vertex_cone.push_back(from_.vertex_cone[v]);
  }

  /// Sorts what is left around a vertex counter-clockwise from the boundary edge; false if it is not a single fan.
  bool order_fan(std::vector<Slot>& faces, std::vector<Slot>& edges) const {
    if (edges.size() != faces.size() + 1) return false;
    std::map<int, Slot> by_next;
    std::map<int, int> edge_slot;
    std::unordered_set<int> trailing;
    for (const Slot& f : faces) {
      by_next.emplace(to_.mesh.next_edge(f.element, f.slot), f);
      trailing.insert(to_.mesh.previous_edge(f.element, f.slot));
    }
    for (const Slot& e : edges) edge_slot.emplace(e.element, e.slot);
    const auto first = std::find_if(edges.begin(), edges.end(), [&](const Slot& e) {
      return by_next.contains(e.element) && !trailing.contains(e.element);
    });
    if (first == edges.end()) return false;
    std::vector<Slot> fan, rim{*first};
    while (fan.size() < faces.size()) {
      const auto next = by_next.find(rim.back().element);
      if (next == by_next.end()) return false;
      fan.push_back(next->second);
      const int edge = to_.mesh.previous_edge(next->second.element, next->second.slot);
      rim.push_back({edge, edge_slot.at(edge)});
      by_next.erase(next);
    }
    faces.swap(fan);
    edges.swap(rim);
    return true;
  }

  const TaggedMesh& from_;
  CutOut& to_;
  std::vector<int> vertices_, edges_;
  std::unordered_map<int, int> edge_index_;
};

/// The faces within rings of the given ones; these themselves are ring 0.
std::vector<int> grow(const TaggedMesh& mesh, std::vector<int> faces, int rings) {
  std::unordered_set<int> known_faces(faces.begin(), faces.end()), known_vertices;
  std::size_t first = 0;
  for (int ring = 0; ring < rings; ++ring) {
    const std::size_t end = faces.size();
    for (std::size_t i = first; i < end; ++i) {
      for (int v : mesh.face_vertices[faces[i]]) {
        if (!known_vertices.insert(v).second) continue;
        for (int f : mesh.vertex_faces[v]) {
          if (known_faces.insert(f).second) faces.push_back(f);
        }
      }
    }
    first = end;
  }
  return faces;
}

}  // namespace

int TaggedMesh::previous_edge(int face, int corner) const {
  return face_edges[face][corner == 0 ? face_edges.count(face) - 1 : corner - 1];
}
int TaggedMesh::next_vertex(int face, int corner) const {
  return face_vertices[face][corner + 1 == face_vertices.count(face) ? 0 : corner + 1];
}
int TaggedMesh::previous_vertex(int face, int corner) const {
  return face_vertices[face][corner == 0 ? face_vertices.count(face) - 1 : corner - 1];
}

bool TaggedMesh::is_crease(int edge) const { return !is_manifold(edge) || edge_sharpness[edge] >= osd_infinite; }

Vec3 TaggedMesh::recentre(int vertex) {
  const Vec3 origin = points[vertex];
  for (Vec3& p : points) p -= origin;
  return origin;
}

CutOut cut_faces(const TaggedMesh& mesh, std::span<const int> faces) {
  CutOut cut;
  Cutter cutter(mesh, cut);
  for (int f : faces) cutter.add_face(f);
  cutter.finish();
  return cut;
}

CutOut cut_rings(const TaggedMesh& mesh, int vertex, int rings) {
  const auto fan = mesh.vertex_faces[vertex];
  return cut_faces(mesh, grow(mesh, {fan.begin(), fan.end()}, rings - 1));
}

CutOut cut_neighbourhood(const TaggedMesh& mesh, int face, int rings) {
  return cut_faces(mesh, grow(mesh, {face}, rings));
}

namespace {

/// Guards against wrong offsets in OpenSubdiv's tables, see resizeComponentTopology(): the first lists would be
/// overwritten.
bool holds_first_lists(const Far::TopologyLevel& level, const TaggedMesh& mesh) {
  const auto same = [](const auto& a, const auto& b) { return std::equal(a.begin(), a.end(), b.begin(), b.end()); };
  return same(level.GetVertexEdges(0), mesh.vertex_edges[0]) && same(level.GetVertexFaces(0), mesh.vertex_faces[0]) &&
         same(level.GetEdgeFaces(0), mesh.edge_faces[0]) && same(level.GetFaceVertices(0), mesh.face_vertices[0]);
}

}  // namespace

std::unique_ptr<Far::TopologyRefiner> make_refiner(const TaggedMesh& mesh, const SubdivisionRules& rules) {
  std::unique_ptr<Far::TopologyRefiner> refiner(
      Far::TaggedFactory::Create(mesh, Far::TaggedFactory::Options(rules.scheme, rules.options)));
  if (!refiner)
    throw std::runtime_error("OpenSubdiv cannot build the topology of a mesh of " + std::to_string(mesh.face_count()) +
                             " faces");
  if (!holds_first_lists(refiner->GetLevel(0), mesh))
    throw std::logic_error("OpenSubdiv holds another mesh than given");
  return refiner;
}

TaggedMesh tagged_level(const Far::TopologyLevel& level, std::vector<Vec3> points) {
  TaggedMesh mesh;
  mesh.points = std::move(points);
  for (int f = 0; f < level.GetNumFaces(); ++f) {
    mesh.face_vertices.append(level.GetFaceVertices(f));
    mesh.face_edges.append(level.GetFaceEdges(f));
  }
  for (int e = 0; e < level.GetNumEdges(); ++e) {
    const Far::ConstIndexArray ends = level.GetEdgeVertices(e);
    mesh.edge_vertices.push_back({ends[0], ends[1]});
    mesh.edge_faces.append(level.GetEdgeFaces(e));
    mesh.edge_face_slots.append(level.GetEdgeFaceLocalIndices(e));
    mesh.edge_sharpness.push_back(level.GetEdgeSharpness(e));
    mesh.edge_non_manifold.push_back(level.IsEdgeNonManifold(e));
  }
  for (int v = 0; v < level.GetNumVertices(); ++v) {
    mesh.vertex_faces.append(level.GetVertexFaces(v));
    mesh.vertex_face_slots.append(level.GetVertexFaceLocalIndices(v));
    mesh.vertex_edges.append(level.GetVertexEdges(v));
    mesh.vertex_edge_slots.append(level.GetVertexEdgeLocalIndices(v));
    mesh.vertex_sharpness.push_back(level.GetVertexSharpness(v));
    mesh.vertex_non_manifold.push_back(level.IsVertexNonManifold(v));
    mesh.vertex_cone.push_back(0);
  }
  return mesh;
}

Refined refine(const TaggedMesh& mesh, const SubdivisionRules& rules) {
  const auto refiner = make_refiner(mesh, rules);
  Far::TopologyRefiner::UniformOptions one_level(1);
  one_level.fullTopologyInLastLevel = true;
  refiner->RefineUniform(one_level);
  Refined result;
  result.mesh = tagged_level(refiner->GetLevel(1), refined_points(*refiner, mesh));
  const Far::TopologyLevel& base = refiner->GetLevel(0);
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    const int child = base.GetVertexChildVertex(v);
    result.vertex_child.push_back(child);
    if (child >= 0) result.mesh.vertex_cone[child] = mesh.vertex_cone[v];
  }
  for (int f = 0; f < mesh.face_count(); ++f) result.face_children.append(base.GetFaceChildFaces(f));
  return result;
}

ChildPlace child_place(bool triangular, double u, double v) {
  if (!triangular) {
    constexpr int child[2][2] = {{0, 3}, {1, 2}};
    const int a = u > 0.5, b = v > 0.5;
    return {child[a][b], 2 * u - a, 2 * v - b, 1};
  }
  if (u > 0.5) return {1, 2 * u - 1, 2 * v, 1};
  if (v > 0.5) return {2, 2 * u, 2 * v - 1, 1};
  if (u + v < 0.5) return {0, 2 * u, 2 * v, 1};
  return {3, 1 - 2 * u, 1 - 2 * v, -1};
}

}  // namespace shaolin
