#include "manifold.h"

#include <algorithm>
#include <numeric>
#include <span>

#include "sharpness.h"

namespace shaolin {

namespace {

/// One side of a face: it runs from its corner's vertex to the next corner's.
struct Side {
  int low, high;  ///< the edge's vertices in order
  int face, corner;
  bool forward;  ///< runs from low to high
};

class Cutter {
 public:
  explicit Cutter(const ControlMesh& mesh)
      : mesh_(mesh), alone_(static_cast<std::size_t>(mesh.face_count()), 0), pieces_(mesh.face_vertices.size()) {
    collect_sides();
  }

  ManifoldMesh cut(bool faces_stand_alone);

 private:
  void collect_sides();
  bool is_manifold(std::span<const Side> edge) const;
  void inspect(std::span<const Side> edge);
  void join_fans(std::span<const Side> edge);
  bool isolate_faces();
  int piece(int corner);
  void join(int a, int b) { pieces_[static_cast<std::size_t>(piece(a))] = piece(b); }
  void number_vertices(ManifoldMesh& result);
  void set_edge_sharpness(ManifoldMesh& result) const;
  void set_vertex_sharpness(ManifoldMesh& result) const;
  void set_limits(ManifoldMesh& result, bool faces_stand_alone) const;
  int corner_index(const Side& side, bool at_end) const;

  template <class Visit>
  void visit_edges(Visit visit) const {
    for (std::size_t begin = 0, end; begin < sides_.size(); begin = end) {
      end = begin + 1;
      while (end < sides_.size() && sides_[end].low == sides_[begin].low && sides_[end].high == sides_[begin].high)
        ++end;
      visit(std::span(sides_).subspan(begin, end - begin));
    }
  }

  /// What the vertex rules count, on the input.
  struct Counts {
    int edges = 0, faces = 0, boundary = 0, non_manifold = 0;
    bool repeated = false;
    int loose_boundary = 0;  ///< boundary edges without an infinitely sharp tag
  };

  const ControlMesh& mesh_;
  std::vector<Side> sides_;
  std::vector<char> alone_;  ///< faces cut off all around
  std::vector<int> pieces_;  ///< union-find over corners: the fan that a corner belongs to
  std::vector<Counts> counts_;
  std::vector<int> fans_;  ///< fans per input vertex
  std::unordered_map<std::uint64_t, float> tags_;
};

void Cutter::collect_sides() {
  for (const SharpEdge& edge : mesh_.sharp_edges) tags_[ManifoldMesh::edge_key(edge.a, edge.b)] = edge.sharpness;
  const auto for_each_side = [&](auto visit) {
    for (int f = 0; f < mesh_.face_count(); ++f) {
      const std::span<const int> v = mesh_.face(f);
      for (std::size_t i = 0; i < v.size(); ++i) {
        const int a = v[i], b = v[(i + 1) % v.size()];
        visit(Side{std::min(a, b), std::max(a, b), f, static_cast<int>(i), a < b});
      }
    }
  };
  // By counting, then within the few sides of each lower vertex: O(size).
  std::vector<std::size_t> ends(mesh_.positions.size() + 1, 0);
  for_each_side([&](const Side& side) { ++ends[static_cast<std::size_t>(side.low) + 1]; });
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  sides_.resize(mesh_.face_vertices.size());
  for_each_side([&](const Side& side) { sides_[ends[static_cast<std::size_t>(side.low)]++] = side; });
  std::size_t begin = 0;  // each entry of `ends` has moved on to its vertex's end
  for (std::size_t v = 0; v < mesh_.positions.size(); begin = ends[v++])
    std::sort(sides_.begin() + static_cast<std::ptrdiff_t>(begin),
              sides_.begin() + static_cast<std::ptrdiff_t>(ends[v]), [](const Side& x, const Side& y) {
                return std::tie(x.high, x.face, x.corner) < std::tie(y.high, y.face, y.corner);
              });
  counts_.resize(mesh_.positions.size());
  fans_.resize(mesh_.positions.size());
}

bool Cutter::is_manifold(std::span<const Side> edge) const {
  if (edge[0].low == edge[0].high || edge.size() > 2) return false;
  if (edge.size() == 1) return true;
  const auto alone = [&](const Side& side) { return alone_[static_cast<std::size_t>(side.face)] != 0; };
  return edge[0].face != edge[1].face && edge[0].forward != edge[1].forward && !alone(edge[0]) && !alone(edge[1]);
}

void Cutter::inspect(std::span<const Side> edge) {
  const bool boundary = edge.size() == 1 && edge[0].low != edge[0].high;
  const auto tag = tags_.find(ManifoldMesh::edge_key(edge[0].low, edge[0].high));
  const bool loose = boundary && (tag == tags_.end() || !is_infinite(tag->second));
  const auto add = [&](int vertex) {
    Counts& counts = counts_[static_cast<std::size_t>(vertex)];
    ++counts.edges;
    counts.boundary += boundary;
    counts.loose_boundary += loose;
    counts.non_manifold += !is_manifold(edge);
    counts.repeated |= edge[0].low == edge[0].high;
  };
  add(edge[0].low);
  if (edge[0].low != edge[0].high) add(edge[0].high);
}

/// The flat index of the corner at a side's start or end.
int Cutter::corner_index(const Side& side, bool at_end) const {
  const int corner = at_end ? (side.corner + 1) % mesh_.face_size(side.face) : side.corner;
  return mesh_.face_offsets[static_cast<std::size_t>(side.face)] + corner;
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
void Cutter::join_fans(std::span<const Side> edge) {
  if (edge[0].low == edge[0].high) {
    for (const Side& side : edge)
      if (!mesh_.is_collapsed(side.face)) join(corner_index(side, false), corner_index(side, true));
  } else if (edge.size() == 2 && is_manifold(edge)) {
    join(corner_index(edge[0], false), corner_index(edge[1], true));
    join(corner_index(edge[0], true), corner_index(edge[1], false));
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

ManifoldMesh Cutter::cut(bool faces_stand_alone) {
  ManifoldMesh result;
  result.crease_method = mesh_.crease_method;
  do {
    std::iota(pieces_.begin(), pieces_.end(), 0);
    visit_edges([&](std::span<const Side> edge) { join_fans(edge); });
  } while (isolate_faces());
  visit_edges([&](std::span<const Side> edge) {
    inspect(edge);
    result.cut_edges += !is_manifold(edge);
  });
  for (const int vertex : mesh_.face_vertices) ++counts_[static_cast<std::size_t>(vertex)].faces;
  number_vertices(result);
  set_edge_sharpness(result);
  set_vertex_sharpness(result);
  set_limits(result, faces_stand_alone);
  return result;
}

/// The first fan of an input vertex keeps the vertex's number; further ones are appended.
void Cutter::number_vertices(ManifoldMesh& result) {
  result.origin.resize(mesh_.positions.size());
  std::iota(result.origin.begin(), result.origin.end(), 0);
  result.face_offsets = mesh_.face_offsets;
  result.face_vertices.resize(mesh_.face_vertices.size());
  std::vector<int> number_of_piece(pieces_.size(), -1);
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    int& number = number_of_piece[static_cast<std::size_t>(piece(static_cast<int>(i)))];
    if (number < 0) {
      const int vertex = mesh_.face_vertices[i];
      const int fan = fans_[static_cast<std::size_t>(vertex)]++;
      number = fan == 0 ? vertex : static_cast<int>(result.origin.size());
      if (fan == 1) ++result.cut_vertices;
      if (fan > 0) result.origin.push_back(vertex);
    }
    result.face_vertices[i] = number;
  }
}

void Cutter::set_edge_sharpness(ManifoldMesh& result) const {
  visit_edges([&](std::span<const Side> edge) {
    const auto tag = tags_.find(ManifoldMesh::edge_key(edge[0].low, edge[0].high));
    float sharpness = tag == tags_.end() ? 0 : tag->second;
    if (edge.size() == 1 || !is_manifold(edge)) sharpness = infinite_sharpness;
    if (!is_sharp(sharpness)) return;
    for (const Side& side : edge) {
      const int a = result.face_vertices[static_cast<std::size_t>(corner_index(side, false))];
      const int b = result.face_vertices[static_cast<std::size_t>(corner_index(side, true))];
      result.sharp_edges[ManifoldMesh::edge_key(a, b)] = sharpness;
    }
  });
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
  for (int f = 0; f < mesh_.face_count(); ++f) {
    const std::span<const int> v = mesh_.face(f);
    for (const int vertex : v) {
      const bool loose = counts_[static_cast<std::size_t>(vertex)].loose_boundary > 0;
      if (loose && !faces_stand_alone && mesh_.boundary == BoundaryInterpolation::none)
        result.has_limit[static_cast<std::size_t>(f)] = 0;
    }
  }
}

}  // namespace

ManifoldMesh cut_to_manifold(const ControlMesh& mesh, bool faces_stand_alone) {
  return Cutter(mesh).cut(faces_stand_alone);
}

}  // namespace shaolin
