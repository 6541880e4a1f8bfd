#include "manifold.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>

#include "sharpness.h"

namespace shaolin {

namespace {

/// The sides of one edge, by number.
using EdgeSides = std::span<const int>;

class Cutter {
 public:
  explicit Cutter(const std::shared_ptr<const ControlMesh>& mesh)
      : mesh_(*mesh),
        half_edges_(mesh),
        is_whole_(half_edges_.is_manifold()),
        counts_(mesh->positions.size()),
        fans_(mesh->positions.size(), is_whole_) {
    for (const SharpEdge& edge : mesh_.sharp_edges) tags_[ManifoldMesh::edge_key(edge.a, edge.b)] = edge.sharpness;
  }

  ManifoldMesh cut(bool faces_stand_alone);

 private:
  bool is_manifold(EdgeSides edge) const;
  void find_fans();
  void inspect(EdgeSides edge);
  void join_fans(EdgeSides edge);
  bool isolate_faces();
  int piece(int corner);
  void join(int a, int b) { pieces_[static_cast<std::size_t>(piece(a))] = piece(b); }
  std::vector<int> numbered_vertices(std::vector<int>& origin, int& cut_vertices);
  ManifoldMesh with_tags(ManifoldMesh result, bool faces_stand_alone);
  void set_edge_sharpness(EdgeSides edge, ManifoldMesh& result) const;
  void set_vertex_sharpness(ManifoldMesh& result) const;
  void set_limits(ManifoldMesh& result, bool faces_stand_alone) const;

  /// Those of a whole mesh that are no boundary and have no tag say nothing.
  template <class Visit>
  void visit_edges(Visit visit) const {
    if (!is_whole_) return SidesByEdge(half_edges_).for_each_edge(visit);
    for (int side = 0; side < half_edges_.side_count(); ++side) {
      const std::array<int, 2> sides{side, half_edges_.twin(side)};
      if (sides[1] < side || (sides[1] > side && tags_.empty())) continue;
      visit(EdgeSides(sides).first(sides[1] == side ? 1 : 2));
    }
  }

  /// What the vertex rules count, on the input.
  struct Counts {
    int edges = 0, faces = 0, boundary = 0, non_manifold = 0;
    bool repeated = false;
    int loose_boundary = 0;  ///< boundary edges without an infinitely sharp tag
  };

  const ControlMesh& mesh_;
  const HalfEdges half_edges_;  ///< as far as they fit
  const bool is_whole_;         ///< there is nothing to cut
  std::vector<char> alone_;     ///< faces cut off all around
  std::vector<int> pieces_;     ///< union-find over corners: the fan that a corner belongs to
  std::vector<Counts> counts_;  ///< per input vertex; of a whole mesh some edges are left out
  std::vector<int> fans_;       ///< per input vertex
  std::unordered_map<std::uint64_t, float> tags_;
};

bool Cutter::is_manifold(EdgeSides edge) const {
  if (is_whole_) return true;
  if (half_edges_.is_degenerate(edge[0]) || edge.size() > 2) return false;
  if (edge.size() == 1) return true;
  const auto alone = [&](int side) { return alone_[static_cast<std::size_t>(half_edges_.face(side))] != 0; };
  return half_edges_.face(edge[0]) != half_edges_.face(edge[1]) && half_edges_.twin(edge[0]) == edge[1] &&
         !alone(edge[0]) && !alone(edge[1]);
}

void Cutter::inspect(EdgeSides edge) {
  const int from = half_edges_.from(edge[0]), to = half_edges_.to(edge[0]);
  const bool boundary = edge.size() == 1 && from != to;
  const auto tag = tags_.find(ManifoldMesh::edge_key(from, to));
  const bool loose = boundary && (tag == tags_.end() || !is_infinite(tag->second));
  const auto add = [&](int vertex) {
    Counts& counts = counts_[static_cast<std::size_t>(vertex)];
    ++counts.edges;
    counts.boundary += boundary;
    counts.loose_boundary += loose;
    counts.non_manifold += !is_manifold(edge);
    counts.repeated |= from == to;
  };
  add(from);
  if (from != to) add(to);
}

int Cutter::piece(int corner) {
  auto at = static_cast<std::size_t>(corner);
  while (pieces_[at] != static_cast<int>(at)) {
    pieces_[at] = pieces_[static_cast<std::size_t>(pieces_[at])];
    at = static_cast<std::size_t>(pieces_[at]);
  }
  return static_cast<int>(at);
}

/// Two faces that meet in a manifold edge are in one fan at both ends; so are both corners of an edge of equal ends. A
/// collapsed face, which has no inside that half-edges could go round, keeps its corners apart: every one is sharp, and
/// so is every side, so it is what it would be with vertices of its own, a segment or a point.
void Cutter::join_fans(EdgeSides edge) {
  if (half_edges_.is_degenerate(edge[0])) {
    for (const int side : edge)
      if (!mesh_.is_collapsed(half_edges_.face(side))) join(side, half_edges_.next(side));
  } else if (edge.size() == 2 && is_manifold(edge)) {
    join(edge[0], half_edges_.next(edge[1]));
    join(half_edges_.next(edge[0]), edge[1]);
  }
}

/// Cuts every face off that comes twice, at places apart, to one fan: half-edges cannot hold it. (It has an edge folded
/// onto itself, and neighbours that close the fan.) True if there is a new one; then the fans are to be joined anew.
bool Cutter::isolate_faces() {
  bool found = false;
  std::vector<int> fans;
  for (int f = 0; f < mesh_.face_count(); ++f) {
    const std::span<const int> v = mesh_.face(f);
    fans.clear();
    for (std::size_t i = 0; i < v.size(); ++i)
      if (v[i] != v[(i + 1) % v.size()])
        fans.push_back(piece(mesh_.face_offsets[static_cast<std::size_t>(f)] + static_cast<int>(i)));
    std::sort(fans.begin(), fans.end());
    char& alone = alone_[static_cast<std::size_t>(f)];
    if (alone || std::adjacent_find(fans.begin(), fans.end()) == fans.end()) continue;
    alone = 1;
    found = true;
  }
  return found;
}

void Cutter::find_fans() {
  const SidesByEdge edges(half_edges_);
  alone_.assign(static_cast<std::size_t>(mesh_.face_count()), 0);
  pieces_.resize(mesh_.face_vertices.size());
  do {
    std::iota(pieces_.begin(), pieces_.end(), 0);
    edges.for_each_edge([&](EdgeSides edge) { join_fans(edge); });
  } while (isolate_faces());
}

/// The first fan of an input vertex keeps the vertex's number; further ones are appended.
std::vector<int> Cutter::numbered_vertices(std::vector<int>& origin, int& cut_vertices) {
  std::vector<int> result(mesh_.face_vertices.size()), number_of_piece(pieces_.size(), -1);
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    int& number = number_of_piece[static_cast<std::size_t>(piece(static_cast<int>(i)))];
    if (number < 0) {
      const int vertex = mesh_.face_vertices[i];
      const int fan = fans_[static_cast<std::size_t>(vertex)]++;
      number = fan == 0 ? vertex : static_cast<int>(origin.size());
      if (fan == 1) ++cut_vertices;
      if (fan > 0) origin.push_back(vertex);
    }
    result[i] = number;
  }
  return result;
}

ManifoldMesh Cutter::cut(bool faces_stand_alone) {
  std::vector<int> origin(mesh_.positions.size());
  std::iota(origin.begin(), origin.end(), 0);
  if (is_whole_) return with_tags(ManifoldMesh(half_edges_, std::move(origin)), faces_stand_alone);
  find_fans();
  PolygonMesh pieces;
  int cut_vertices = 0;
  pieces.face_vertices = numbered_vertices(origin, cut_vertices);
  pieces.face_offsets = mesh_.face_offsets;
  pieces.positions.reserve(origin.size());
  for (const int from : origin) pieces.positions.push_back(mesh_.positions[static_cast<std::size_t>(from)]);
  ManifoldMesh result(HalfEdges(std::make_shared<const PolygonMesh>(std::move(pieces))), std::move(origin));
  result.cut_vertices = cut_vertices;
  return with_tags(std::move(result), faces_stand_alone);
}

ManifoldMesh Cutter::with_tags(ManifoldMesh result, bool faces_stand_alone) {
  result.crease_method = mesh_.crease_method;
  visit_edges([&](EdgeSides edge) {
    inspect(edge);
    result.cut_edges += !is_manifold(edge);
    set_edge_sharpness(edge, result);
  });
  for (const int vertex : mesh_.face_vertices) ++counts_[static_cast<std::size_t>(vertex)].faces;
  set_vertex_sharpness(result);
  set_limits(result, faces_stand_alone);
  return result;
}

void Cutter::set_edge_sharpness(EdgeSides edge, ManifoldMesh& result) const {
  const auto tag = tags_.find(ManifoldMesh::edge_key(half_edges_.from(edge[0]), half_edges_.to(edge[0])));
  float sharpness = tag == tags_.end() ? 0 : tag->second;
  if (edge.size() == 1 || !is_manifold(edge)) sharpness = infinite_sharpness;
  if (!is_sharp(sharpness)) return;
  for (const int side : edge)
    result.sharp_edges[ManifoldMesh::edge_key(result.half_edges.from(side), result.half_edges.to(side))] = sharpness;
}

void Cutter::set_vertex_sharpness(ManifoldMesh& result) const {
  std::vector<float> input(mesh_.positions.size(), 0);
  for (const SharpVertex& tag : mesh_.sharp_vertices) input[static_cast<std::size_t>(tag.vertex)] = tag.sharpness;
  for (std::size_t v = 0; v < input.size(); ++v) {
    const Counts& c = counts_[v];
    const bool corner = mesh_.boundary == BoundaryInterpolation::edge_and_corner && c.faces == 1 && c.edges == 2;
    const bool manifold = c.non_manifold == 0 && fans_[v] <= 1;
    const bool fins = c.non_manifold == 2 && c.boundary == 0 && c.faces > c.edges && !c.repeated;
    if (corner || !(manifold || fins)) input[v] = infinite_sharpness;
  }
  result.vertex_sharpness.reserve(result.origin.size());
  for (const int origin : result.origin) result.vertex_sharpness.push_back(input[static_cast<std::size_t>(origin)]);
  std::vector<char> cones(mesh_.positions.size(), 0);
  for (const int vertex : mesh_.cones) cones[static_cast<std::size_t>(vertex)] = 1;
  for (const int origin : result.origin) result.is_cone.push_back(cones[static_cast<std::size_t>(origin)]);
}

void Cutter::set_limits(ManifoldMesh& result, bool faces_stand_alone) const {
  result.has_limit.assign(static_cast<std::size_t>(mesh_.face_count()), 1);
  for (const int hole : mesh_.holes) result.has_limit[static_cast<std::size_t>(hole)] = 0;
  if (faces_stand_alone || mesh_.boundary != BoundaryInterpolation::none) return;
  for (int f = 0; f < mesh_.face_count(); ++f) {
    const std::span<const int> v = mesh_.face(f);
    for (const int vertex : v) {
      const bool loose = counts_[static_cast<std::size_t>(vertex)].loose_boundary > 0;
      if (loose) result.has_limit[static_cast<std::size_t>(f)] = 0;
    }
  }
}

}  // namespace

ManifoldMesh cut_to_manifold(const std::shared_ptr<const ControlMesh>& mesh, bool faces_stand_alone) {
  return Cutter(mesh).cut(faces_stand_alone);
}

}  // namespace shaolin
