#include "tools/validate/corner_limit.h"

#include <opensubdiv/far/primvarRefiner.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace shaolin {

namespace Far = OpenSubdiv::Far;

namespace {

/// A vertex, its ring, and one of the faces around it, all of the scheme's own kind.
struct Ring {
  TaggedMesh mesh;
  int face, corner;

  int centre() const { return mesh.face_vertices[face][corner]; }
};

Ring ring_of(const TaggedMesh& mesh, int face, int corner) {
  CutOut cut = cut_rings(mesh, mesh.face_vertices[face][corner], 1);
  return {std::move(cut.mesh), cut.face_index.at(face), corner};
}

bool semi_sharp(float sharpness) { return sharpness > 0 && sharpness < osd_infinite; }

bool stationary(const Ring& ring) {
  if (semi_sharp(ring.mesh.vertex_sharpness[ring.centre()])) return false;
  const auto edges = ring.mesh.vertex_edges[ring.centre()];
  return std::none_of(edges.begin(), edges.end(), [&](int e) { return semi_sharp(ring.mesh.edge_sharpness[e]); });
}

/// A combination of the ring's points, as PrimvarRefinerReal's data.
struct Row {
  std::map<int, double> weights;
  void Clear() { weights.clear(); }
  void AddWithWeight(const Row& other, double weight) {
    for (const auto& [index, w] : other.weights) weights[index] += weight * w;
  }
};

/// The subdivision matrix from the ring's points to the points of the child ring in the same order.
std::vector<Row> subdivision_rows(const Ring& ring, const SubdivisionRules& rules) {
  const auto refiner = make_refiner(ring.mesh, rules);
  Far::TopologyRefiner::UniformOptions one_level(1);
  one_level.fullTopologyInLastLevel = true;
  refiner->RefineUniform(one_level);
  const Far::TopologyLevel& base = refiner->GetLevel(0);
  std::vector<Row> units(ring.mesh.points.size());
  for (int v = 0; v < ring.mesh.vertex_count(); ++v) units[v].weights[v] = 1;
  std::vector<Row> fine(static_cast<std::size_t>(refiner->GetLevel(1).GetNumVertices()));
  Far::PrimvarRefinerReal<double>(*refiner).Interpolate(1, units, fine);

  const int centre = ring.centre();
  std::vector<Row> rows(units.size());
  rows[centre] = fine[base.GetVertexChildVertex(centre)];
  for (int e : ring.mesh.vertex_edges[centre]) {
    const auto& [a, b] = ring.mesh.edge_vertices[e];
    rows[a == centre ? b : a] = fine[base.GetEdgeChildVertex(e)];
  }
  for (int i = 0; i < ring.mesh.vertex_faces.count(centre) && !rules.triangular(); ++i) {
    const int f = ring.mesh.vertex_faces[centre][i], corner = ring.mesh.vertex_face_slots[centre][i];
    rows[ring.mesh.face_vertices[f][(corner + 2) % 4]] = fine[base.GetFaceChildVertex(f)];
  }
  return rows;
}

/// The point that the ring contracts to. The ring is recentred at each step, so the rounding shrinks with it. The
/// slowest contraction, at infinite valence, is 0.6545 = (6 + sqrt(20)) / 16 per step: 400 steps reach 1e-73.
Vec3 contract(const Ring& ring, const SubdivisionRules& rules) {
  const std::vector<Row> rows = subdivision_rows(ring, rules);
  std::vector<Vec3> points = ring.mesh.points, next(points.size());
  Vec3 limit = Vec3::Zero();
  for (int step = 0; step < 400; ++step) {
    const Vec3 origin = points[ring.centre()];
    limit += origin;
    double size = 0;
    for (Vec3& p : points) size = std::max(size, (p -= origin).norm());
    if (size <= 1e-20 * limit.norm() || size < 1e-300) break;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      next[i].setZero();
      for (const auto& [index, weight] : rows[i].weights) next[i] += weight * points[index];
    }
    points.swap(next);
  }
  return limit;
}

/// The ring flattened: a full turn for a closed sector, half a turn for one between two creases, in the orientation of
/// the faces. Whatever the tangents do here, they do to the surface.
std::vector<Vec3> flat_ring(const Ring& ring, const Sector& sector) {
  std::vector<Vec3> flat(ring.mesh.points.size(), Vec3::Zero());
  const double step = (sector.closed ? 2 : 1) * std::numbers::pi / sector.size();
  const auto at = [](double angle, double radius) {
    return Vec3(radius * std::cos(angle), radius * std::sin(angle), 0);
  };
  for (int i = 0; i < sector.size(); ++i) {
    const int f = sector.faces[i], corner = sector.corners[i];
    flat[ring.mesh.next_vertex(f, corner)] = at(i * step, 1);
    if (!sector.closed || i + 1 < sector.size()) flat[ring.mesh.previous_vertex(f, corner)] = at((i + 1) * step, 1);
    const auto face = ring.mesh.face_vertices[f];
    if (face.size() == 4) flat[face[(corner + 2) % 4]] = at((i + 0.5) * step, std::numbers::sqrt2);
  }
  return flat;
}

/// The unit normal from two tangents of the surface and of the flattened ring; zero if they do not span a plane.
Vec3 oriented_normal(const Vec3& t1, const Vec3& t2, const Vec3& flat1, const Vec3& flat2) {
  const double turn = flat1.cross(flat2).z();
  if (std::abs(turn) <= 1e-6 * flat1.norm() * flat2.norm()) return Vec3::Zero();
  const Vec3 normal = t1.cross(t2) * (turn > 0 ? 1 : -1);
  const double length = normal.norm();
  if (!(length > 1e-12 * t1.norm() * t2.norm())) return Vec3::Zero();
  return normal / length;
}

/// By OpenSubdiv's limit masks.
Vec3 normal_by_masks(const Ring& ring, const Sector& sector, const SubdivisionRules& rules) {
  struct Pair {
    Vec3 point = Vec3::Zero(), flat = Vec3::Zero();
    void Clear() { point.setZero(), flat.setZero(); }
    void AddWithWeight(const Pair& other, double weight) {
      point += weight * other.point;
      flat += weight * other.flat;
    }
  };
  const auto refiner = make_refiner(ring.mesh, rules);
  const std::vector<Vec3> flat = flat_ring(ring, sector);
  std::vector<Pair> points(flat.size()), limit(flat.size()), t1(flat.size()), t2(flat.size());
  for (std::size_t i = 0; i < flat.size(); ++i) {
    points[i].point = ring.mesh.points[i];
    points[i].flat = flat[i];
  }
  Far::PrimvarRefinerReal<double>(*refiner).Limit(points, limit, t1, t2);
  const int centre = ring.centre();
  return oriented_normal(t1[centre].point, t2[centre].point, t1[centre].flat, t2[centre].flat);
}

/// By the left eigenvectors of the second and third eigenvalue. Zero if these are not real or the fourth is as large.
Vec3 normal_by_eigenvectors(const Ring& ring, const Sector& sector, const SubdivisionRules& rules) {
  const auto n = static_cast<Eigen::Index>(ring.mesh.points.size());
  if (n > 500) return Vec3::Zero();  // cubic cost; no verdict rather than a wait of minutes
  const std::vector<Row> rows = subdivision_rows(ring, rules);
  Eigen::MatrixXd transposed = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (const auto& [index, weight] : rows[i].weights) transposed(index, i) = weight;
  }
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(transposed);
  std::vector<Eigen::Index> order(static_cast<std::size_t>(n));
  for (Eigen::Index i = 0; i < n; ++i) order[i] = i;
  const auto& values = solver.eigenvalues();
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return std::abs(values[a]) > std::abs(values[b]); });
  if (n < 3 || std::abs(values[order[1]].imag()) + std::abs(values[order[2]].imag()) > 1e-9) return Vec3::Zero();
  if (n > 3 && std::abs(values[order[3]]) > std::abs(values[order[2]]) - 1e-6) return Vec3::Zero();

  const std::vector<Vec3> flat = flat_ring(ring, sector);
  Vec3 tangents[2], flat_tangents[2];
  for (int k = 0; k < 2; ++k) {
    const Eigen::VectorXd left = solver.eigenvectors().col(order[k + 1]).real();
    tangents[k].setZero();
    flat_tangents[k].setZero();
    for (Eigen::Index i = 0; i < n; ++i) {
      tangents[k] += left[i] * ring.mesh.points[i];
      flat_tangents[k] += left[i] * flat[i];
    }
  }
  return oriented_normal(tangents[0], tangents[1], flat_tangents[0], flat_tangents[1]);
}

/// The normal between the two edges that bound an open sector.
Vec3 normal_of_ends(const Ring& ring, const Sector& sector) {
  const Vec3& v = ring.mesh.points[ring.centre()];
  const Vec3 a = ring.mesh.points[ring.mesh.next_vertex(sector.faces.front(), sector.corners.front())] - v;
  const Vec3 b = ring.mesh.points[ring.mesh.previous_vertex(sector.faces.back(), sector.corners.back())] - v;
  return oriented_normal(a, b, Vec3::UnitX(), Vec3::UnitY());
}

/// The ring of the sector alone: its end edges become a boundary, which obeys the same rule as the crease.
Ring sector_ring(const Ring& ring, const Sector& sector) {
  CutOut cut = cut_faces(ring.mesh, sector.faces);
  return {std::move(cut.mesh), cut.face_index.at(ring.face), ring.corner};
}

/// A side of a crease or a corner: n faces between two sharp edges. Its modes are those of the crease (1/2 along it,
/// 1/4) and the oscillating ones of angle pi j / n, which have the eigenvalue of a smooth vertex at 2 pi j / valence.
/// One face: everything but the crease's own plane contracts like 1/4 or slower modes lie in that plane (for
/// Catmull-Clark the twist is driven along the crease's second difference), so the end edges span the tangent plane.
/// More faces: the tangent plane is that of the first oscillating mode and the crease's direction, as long as the
/// second oscillating mode stays below 1/2 (Catmull-Clark: n < 4, Loop: n < 6). A sharp corner has both ends at 1/2;
/// already the first oscillating mode must stay below (Loop, two faces: 3/8).
Vec3 open_sector_normal(const Ring& ring, const Sector& sector, const SubdivisionRules& rules) {
  const int n = sector.size();
  const bool corner =
      ring.mesh.vertex_sharpness[ring.centre()] >= osd_infinite || crease_count(ring.mesh, ring.centre()) > 2;
  if (n == 1 || (corner && rules.triangular() && n == 2)) return normal_of_ends(ring, sector);
  if (corner || n > (rules.triangular() ? 5 : 3)) return Vec3::Zero();
  const Ring side = sector_ring(ring, sector);
  return normal_by_eigenvectors(side, sector_around(side.mesh, side.face, side.corner), rules);
}

}  // namespace

int crease_count(const TaggedMesh& mesh, int vertex) {
  const auto edges = mesh.vertex_edges[vertex];
  return static_cast<int>(std::count_if(edges.begin(), edges.end(), [&](int e) { return mesh.is_crease(e); }));
}

Sector sector_around(const TaggedMesh& mesh, int face, int corner, bool across_creases) {
  const int vertex = mesh.face_vertices[face][corner];
  using Corner = std::pair<int, int>;
  std::map<int, Corner> by_next, by_previous;
  for (int i = 0; i < mesh.vertex_faces.count(vertex); ++i) {
    const Corner at{mesh.vertex_faces[vertex][i], mesh.vertex_face_slots[vertex][i]};
    by_next[mesh.next_edge(at.first, at.second)] = at;
    by_previous[mesh.previous_edge(at.first, at.second)] = at;
  }
  const auto ends_at = [&](int e) { return across_creases ? !mesh.is_manifold(e) : mesh.is_crease(e); };
  const Corner start{face, corner};
  Corner at = start;
  Sector sector;
  for (int e = mesh.next_edge(face, corner); !ends_at(e) && by_previous.contains(e);
       e = mesh.next_edge(at.first, at.second)) {
    at = by_previous.at(e);
    if (at == start) break;
  }
  const Corner first = at;  // the clockwise end of an open sector
  do {
    sector.faces.push_back(at.first);
    sector.corners.push_back(at.second);
    const int e = mesh.previous_edge(at.first, at.second);
    if (ends_at(e) || !by_next.contains(e)) return sector;
    at = by_next.at(e);
  } while (at != first);
  sector.closed = true;
  return sector;
}

CornerLimit corner_limit(const TaggedMesh& mesh, const SubdivisionRules& rules, int face, int corner) {
  Ring ring = ring_of(mesh, face, corner);
  Vec3 origin = ring.mesh.recentre(ring.centre());
  // A face's child at corner i is child i and has the child of that corner as vertex i. At least one step: the ring
  // of the control mesh may be tangled (faces that meet in more than an edge), that of its children is not.
  do {
    const Refined fine = refine(ring.mesh, rules);
    ring = ring_of(fine.mesh, fine.face_children[ring.face][ring.corner], ring.corner);
    origin += ring.mesh.recentre(ring.centre());
  } while (!stationary(ring));

  CornerLimit result{origin + contract(ring, rules), Vec3::Zero()};
  const Sector sector = sector_around(ring.mesh, ring.face, ring.corner);
  const bool dart = !sector.closed && crease_count(ring.mesh, ring.centre()) == 1;
  const bool sharp = ring.mesh.vertex_sharpness[ring.centre()] >= osd_infinite;
  if (dart && !sharp) {
    Sector turn = sector;
    turn.closed = true;
    result.normal = normal_by_eigenvectors(ring, turn, rules);
  } else if (!sector.closed) {
    result.normal = open_sector_normal(ring, sector, rules);
  } else if (!sharp && sector.size() > 2) {
    result.normal = normal_by_masks(ring, sector, rules);
  }
  return result;
}

}  // namespace shaolin
