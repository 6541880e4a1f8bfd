#include "control_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <string>
#include <tuple>
#include <utility>

#include "errors.h"
#include "mesh_places.h"

namespace shaolin {

namespace {

/// Warnings of one kind beyond this number are only counted.
constexpr int warnings_per_kind = 10;

class MeshCheck {
 public:
  MeshCheck(ControlMesh& mesh, const MeshPlaces& places) : mesh_(mesh), places_(places) {}

  void run() {
    require_positions();
    require_faces();
    require_tags();
    warn_about_vertices();
    warn_about_windings();
    warn_about_creases();
  }

 private:
  static int line_of(const std::vector<int>& lines, std::size_t element) {
    return element < lines.size() ? lines[element] : 0;
  }

  [[noreturn]] void fail(const std::string& message, const std::vector<int>& lines, std::size_t element) const {
    throw InputError(message, places_.file, line_of(lines, element));
  }

  void warn(const std::string& sentence, int line) {
    const auto is_known = [&](const std::string& warning) {
      return warning == sentence || warning.ends_with(": " + sentence);
    };
    if (std::any_of(mesh_.warnings.begin(), mesh_.warnings.end(), is_known)) return;
    mesh_.warnings.emplace_back(InputError(sentence, places_.file, line).what());
  }

  void require_positions() const {
    for (std::size_t i = 0; i < mesh_.positions.size(); ++i) {
      if (!mesh_.positions[i].allFinite()) {
        fail("vertex " + std::to_string(i) + " has a coordinate that is not finite", places_.positions, i);
      }
    }
  }

  void require_faces() const {
    const std::vector<int>& offsets = mesh_.face_offsets;
    if (offsets.size() < 2) throw InputError("the mesh is empty, expected at least one face", places_.file);
    if (offsets.front() != 0 || static_cast<std::size_t>(offsets.back()) != mesh_.face_vertices.size()) {
      throw InputError("the face offsets do not span the face vertices", places_.file);
    }
    for (std::size_t f = 0; f + 1 < offsets.size(); ++f) {
      const std::int64_t size = std::int64_t{offsets[f + 1]} - offsets[f];
      if (size < 3 || offsets[f + 1] > offsets.back()) {
        fail("face " + std::to_string(f) + " has " + std::to_string(size) + " corners, expected at least 3",
             places_.faces, f);
      }
    }
    for (int f = 0; f < mesh_.face_count(); ++f) {
      for (const int v : mesh_.face(f)) {
        if (!has_vertex(v)) fail_vertex("face " + std::to_string(f), v, places_.faces, f);
      }
    }
  }

  void require_tags() const {
    for (std::size_t i = 0; i < mesh_.sharp_edges.size(); ++i) {
      const SharpEdge& edge = mesh_.sharp_edges[i];
      for (const int v : {edge.a, edge.b}) {
        if (!has_vertex(v)) fail_vertex("crease", v, places_.sharp_edges, i);
      }
      require_sharpness(edge.sharpness, "crease", places_.sharp_edges, i);
    }
    for (std::size_t i = 0; i < mesh_.cones.size(); ++i)
      if (!has_vertex(mesh_.cones[i])) fail_vertex("cone", mesh_.cones[i], places_.cones, i);
    for (std::size_t i = 0; i < mesh_.sharp_vertices.size(); ++i) {
      const SharpVertex& corner = mesh_.sharp_vertices[i];
      if (!has_vertex(corner.vertex)) fail_vertex("corner", corner.vertex, places_.sharp_vertices, i);
      require_sharpness(corner.sharpness, "corner", places_.sharp_vertices, i);
    }
    for (std::size_t i = 0; i < mesh_.holes.size(); ++i) {
      const int face = mesh_.holes[i];
      if (face >= 0 && face < mesh_.face_count()) continue;
      fail("hole: face " + std::to_string(face) + " is out of range, expected 0 to " +
               std::to_string(mesh_.face_count() - 1),
           places_.holes, i);
    }
  }

  bool has_vertex(int vertex) const { return vertex >= 0 && static_cast<std::size_t>(vertex) < mesh_.positions.size(); }

  [[noreturn]] void fail_vertex(const std::string& who, int vertex, const std::vector<int>& lines,
                                std::size_t element) const {
    if (mesh_.positions.empty())
      fail(who + ": vertex " + std::to_string(vertex) + ", the mesh has none", lines, element);
    fail(who + ": vertex " + std::to_string(vertex) + " is out of range, expected 0 to " +
             std::to_string(mesh_.positions.size() - 1),
         lines, element);
  }

  void require_sharpness(float sharpness, const char* who, const std::vector<int>& lines, std::size_t element) const {
    if (sharpness >= 0) return;  // false for NaN
    fail(std::string(who) + ": sharpness " + std::to_string(sharpness) + ", expected a number from 0", lines, element);
  }

  /// One pass finds repeated and isolated vertices: each vertex remembers the last face that used it.
  void warn_about_vertices() {
    std::vector<int> last_face(mesh_.positions.size(), -1);
    int repeating_faces = 0;
    for (int f = 0; f < mesh_.face_count(); ++f) {
      int repeated = -1;
      for (const int v : mesh_.face(f)) {
        if (std::exchange(last_face[v], f) == f && repeated < 0) repeated = v;
      }
      if (repeated < 0 || ++repeating_faces > warnings_per_kind) continue;
      warn("face " + std::to_string(f) + " repeats vertex " + std::to_string(repeated) + " (counted from 0)",
           line_of(places_.faces, f));
    }
    warn_about_more(repeating_faces, "faces that repeat a vertex");

    const auto isolated = std::count(last_face.begin(), last_face.end(), -1);
    if (isolated == 0) return;
    const auto first = std::find(last_face.begin(), last_face.end(), -1) - last_face.begin();
    warn("isolated vertices: " + std::to_string(isolated) + ", the first is vertex " + std::to_string(first) +
             " (counted from 0)",
         line_of(places_.positions, static_cast<std::size_t>(first)));
  }

  /// Edges of two faces that run along them in the same direction. Sides are put in order by the vertex that they
  /// leave, by counting: a large mesh is not to wait for a sort.
  void warn_about_windings() {
    struct Side {
      int to, face;
    };
    std::vector<std::size_t> first(mesh_.positions.size() + 2, 0);
    for (const int v : mesh_.face_vertices) ++first[static_cast<std::size_t>(v) + 2];
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<Side> sides(mesh_.face_vertices.size());
    for (int f = 0; f < mesh_.face_count(); ++f) {
      int from = mesh_.face(f).back();
      for (const int to : mesh_.face(f)) sides[first[static_cast<std::size_t>(from) + 1]++] = {to, f}, from = to;
    }
    const auto leaving = [&](int v) {  // each place has moved on to the next vertex's first side
      return std::span(sides).subspan(first[static_cast<std::size_t>(v)],
                                      first[static_cast<std::size_t>(v) + 1] - first[static_cast<std::size_t>(v)]);
    };
    int opposed = 0;
    for (int from = 0; from < static_cast<int>(mesh_.positions.size()); ++from) {
      const std::span<Side> around = leaving(from);
      std::sort(around.begin(), around.end(),
                [](const Side& a, const Side& b) { return std::tie(a.to, a.face) < std::tie(b.to, b.face); });
      for (auto same = around.begin(); same != around.end();) {
        const auto end = std::find_if(same, around.end(), [&](const Side& side) { return side.to != same->to; });
        const std::span<Side> back = leaving(same->to);
        const bool is_pair = end - same == 2 && same[0].face != same[1].face && same->to != from &&
                             std::none_of(back.begin(), back.end(), [&](const Side& side) { return side.to == from; });
        if (is_pair && ++opposed <= warnings_per_kind)
          warn("faces " + std::to_string(same[0].face) + " and " + std::to_string(same[1].face) +
                   " are wound against each other: both lead from vertex " + std::to_string(from) + " to vertex " +
                   std::to_string(same->to) + " (counted from 0); the surface is cut along that edge",
               line_of(places_.faces, static_cast<std::size_t>(same[1].face)));
        same = end;
      }
    }
    warn_about_more(opposed, "edges between faces that are wound against each other");
  }

  static std::uint64_t edge_key(int a, int b) {
    const auto [low, high] = std::minmax(a, b);
    return (static_cast<std::uint64_t>(low) << 32) | static_cast<std::uint32_t>(high);
  }

  /// The creased vertex pairs that are edges of faces, sorted.
  std::vector<std::uint64_t> existing_creases() const {
    std::vector<bool> creased(mesh_.positions.size(), false);
    std::vector<std::uint64_t> wanted, found;
    for (const SharpEdge& edge : mesh_.sharp_edges) {
      creased[edge.a] = creased[edge.b] = true;
      wanted.push_back(edge_key(edge.a, edge.b));
    }
    std::sort(wanted.begin(), wanted.end());
    for (int f = 0; f < mesh_.face_count(); ++f) {
      int from = mesh_.face(f).back();
      for (const int to : mesh_.face(f)) {
        if (creased[from] && creased[to]) {
          const std::uint64_t key = edge_key(from, to);
          if (std::binary_search(wanted.begin(), wanted.end(), key)) found.push_back(key);
        }
        from = to;
      }
    }
    std::sort(found.begin(), found.end());
    return found;
  }

  void warn_about_creases() {
    if (mesh_.sharp_edges.empty()) return;
    const std::vector<std::uint64_t> existing = existing_creases();
    int missing = 0;
    for (std::size_t i = 0; i < mesh_.sharp_edges.size(); ++i) {
      const SharpEdge& edge = mesh_.sharp_edges[i];
      if (std::binary_search(existing.begin(), existing.end(), edge_key(edge.a, edge.b))) continue;
      if (++missing > warnings_per_kind) continue;
      warn("crease " + std::to_string(edge.a) + " " + std::to_string(edge.b) +
               " lies on no edge of any face, it has no effect",
           line_of(places_.sharp_edges, i));
    }
    warn_about_more(missing, "creases that lie on no edge");
  }

  void warn_about_more(int count, const char* what) {
    if (count > warnings_per_kind) warn("and " + std::to_string(count - warnings_per_kind) + " more " + what, 0);
  }

  ControlMesh& mesh_;
  const MeshPlaces& places_;
};

}  // namespace

bool ControlMesh::is_collapsed(int face_index) const {
  const std::span<const int> v = face(face_index);
  std::size_t steps = 0;
  for (std::size_t i = 0; i < v.size(); ++i) steps += v[i] != v[(i + 1) % v.size()];
  return steps < 3;
}

bool ControlMesh::all_triangles() const {
  for (int f = 0; f < face_count(); ++f) {
    if (face_size(f) != 3) return false;
  }
  return true;
}

double ControlMesh::diagonal() const {
  if (positions.empty()) return 0;
  Vec3 lower = positions.front(), upper = positions.front();
  for (const Vec3& p : positions) {
    lower = lower.cwiseMin(p);
    upper = upper.cwiseMax(p);
  }
  return (upper - lower).norm();
}

void check(ControlMesh& mesh) { check(mesh, MeshPlaces{}); }

void check(ControlMesh& mesh, const MeshPlaces& places) { MeshCheck(mesh, places).run(); }

void check_faces(const ControlMesh& mesh, FaceKind kind, const MeshPlaces& places) {
  if (kind != FaceKind::triangle) return;
  for (int f = 0; f < mesh.face_count(); ++f) {
    const std::size_t corners = mesh.face(f).size();
    if (corners == 3) continue;
    throw InputError("face " + std::to_string(f) + " has " + std::to_string(corners) +
                         " corners; a triangle scheme such as Loop expects triangles only",
                     places.file, places.faces.empty() ? 0 : places.faces[static_cast<std::size_t>(f)]);
  }
}

}  // namespace shaolin
