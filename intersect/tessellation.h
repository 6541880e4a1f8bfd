#pragma once
/// A limit surface as flat facets: the control mesh refined everywhere to one level, its vertices on the limit.
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "../schemes/scheme_surface.h"

namespace shaolin {

/// A face of the finest level.
template <FaceKind kind>
struct Facet {
  static constexpr std::size_t corner_count = Domain<kind>::corner_count;

  std::array<int, corner_count> corners{};   ///< into Tessellation::points
  std::array<Vec3, corner_count> normals{};  ///< the limit's, as this facet sees it; zero where there is none
  int face = 0, sub = 0;                     ///< the start patch that it belongs to
  Parameter origin = Parameter::Zero();      ///< patch parameter = origin + scale * the facet's
  double scale = 1;                          ///< negative where a triangle is turned by half a turn
};

template <FaceKind kind>
struct Tessellation {
  std::vector<Vec3> points;  ///< limit points, each once: facets that share a vertex share its place
  std::vector<Facet<kind>> facets;
};

namespace detail {

/// The facet of every face of a level, without corners yet; of faces that have no limit, none.
template <FaceKind kind>
using FacetsOfLevel = std::vector<std::optional<Facet<kind>>>;

template <Scheme S>
FacetsOfLevel<S::face_kind> facets_of_children(const SubdivisionMesh<S>& coarse, int children,
                                               const FacetsOfLevel<S::face_kind>& parents) {
  using D = Domain<S::face_kind>;
  FacetsOfLevel<S::face_kind> result(static_cast<std::size_t>(children));
  for (const int f : coarse.faces()) {
    const auto& parent = parents[static_cast<std::size_t>(f)];
    if (!parent) continue;
    const bool by_corner = coarse.face_size(f) != D::corner_count;  // an n-gon: its children are start patches
    for (int k = 0; k < coarse.child_count(f); ++k) {
      auto& child = result[static_cast<std::size_t>(coarse.child_face(f, k))];
      child = *parent;
      if (by_corner) {
        child->sub = k;
      } else {
        child->origin = parent->origin + parent->scale * D::to_parent(k, Parameter::Zero());
        child->scale = parent->scale * D::scale(k);
      }
    }
  }
  return result;
}

}  // namespace detail

/// Refines the whole mesh `level` times, at least once (before, an n-gon is no facet). A vertex on no sharp edge is
/// asked for its limit once, another from each face: beside a crease each side has its own normal. Throws InputError as
/// SubdivisionMesh::refine() does. O(faces 4^level).
template <Scheme S>
Tessellation<S::face_kind> tessellate(const SubdivisionMesh<S>& control, int level) {
  using OneFacet = Facet<S::face_kind>;
  detail::FacetsOfLevel<S::face_kind> facets(static_cast<std::size_t>(control.face_count()));
  for (const int f : control.faces()) {
    if (!control.has_limit(f)) continue;
    facets[static_cast<std::size_t>(f)] = OneFacet();
    facets[static_cast<std::size_t>(f)]->face = f;
  }
  std::vector<std::unique_ptr<SubdivisionMesh<S>>> levels;
  const SubdivisionMesh<S>* mesh = &control;
  for (int l = 0; l < level; ++l) {
    levels.push_back(mesh->refine());
    facets = detail::facets_of_children(*mesh, levels.back()->face_count(), facets);
    mesh = levels.back().get();
  }

  std::vector<char> is_sharp(static_cast<std::size_t>(mesh->vertex_count()));
  for (const int v : mesh->vertices())
    is_sharp[static_cast<std::size_t>(v)] = mesh->vertex_sharpness(v) > 0 || mesh->is_cone(v);
  for (const int e : mesh->edges()) {
    const Mesh::Edge edge = mesh->edge(e);
    if (edge.sharpness > 0) is_sharp[static_cast<std::size_t>(edge.a)] = is_sharp[static_cast<std::size_t>(edge.b)] = 1;
  }

  Tessellation<S::face_kind> result;
  std::vector<int> place_of(is_sharp.size(), -1);
  std::vector<Vec3> normal_at;
  for (const int f : mesh->faces()) {
    if (!facets[static_cast<std::size_t>(f)]) continue;
    OneFacet& facet = *facets[static_cast<std::size_t>(f)];
    for (std::size_t k = 0; k < OneFacet::corner_count; ++k) {
      const auto vertex = static_cast<std::size_t>(mesh->face(f)[k]);
      int& place = place_of[vertex];
      std::optional<LimitSample> limit;
      if (place < 0 || is_sharp[vertex]) limit = mesh->limit(f, static_cast<int>(k));
      if (place < 0) {
        place = static_cast<int>(result.points.size());
        result.points.push_back(limit->position);
        normal_at.push_back(limit->normal);
      }
      facet.corners[k] = place;
      facet.normals[k] = limit ? limit->normal : normal_at[static_cast<std::size_t>(place)];
    }
    result.facets.push_back(facet);
  }
  return result;
}

}  // namespace shaolin
