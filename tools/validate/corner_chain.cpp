#include "tools/validate/corner_chain.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace shaolin {

CornerChain::CornerChain(const TaggedMesh& mesh, const SubdivisionRules& rules, int vertex, bool wide,
                         OpenSubdiv::Bfr::SurfaceFactoryCache& cache)
    : rules_(rules), cache_(cache), rings_(wide ? 4 : 3) {
  CutOut cut = cut_rings(mesh, vertex, rings_ - 1);
  for (int i = 0; i < mesh.vertex_faces.count(vertex); ++i) {
    const int face = mesh.vertex_faces[vertex][i];
    corners_.emplace_back(face, mesh.vertex_face_slots[vertex][i]);
    base_faces_.push_back(cut.face_index.at(face));
  }
  Level base;
  base.mesh = std::move(cut.mesh);
  base.centre = cut.vertex_index.at(vertex);
  base.origin = base.mesh.recentre(base.centre);
  levels_.push_back(std::move(base));
}

int CornerChain::corner_face(const Level& level, std::size_t corner) const {
  return level.cells.empty() ? base_faces_[corner] : level.cells[corner][corners_[corner].second];
}

void CornerChain::grow() {
  const Level& last = levels_.back();
  const CutOut coarse = cut_rings(last.mesh, last.centre, rings_ - 1);
  const Refined fine = refine(coarse.mesh, rules_);
  const int centre = fine.vertex_child[coarse.vertex_index.at(last.centre)];
  CutOut cut = cut_rings(fine.mesh, centre, rings_);
  Level next;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const int parent = coarse.face_index.at(corner_face(last, i));
    auto& cells = next.cells.emplace_back();
    for (int child = 0; child < 4; ++child) cells[child] = cut.face_index.at(fine.face_children[parent][child]);
  }
  next.mesh = std::move(cut.mesh);
  next.centre = cut.vertex_index.at(centre);
  next.origin = last.origin + next.mesh.recentre(next.centre);
  size_ += static_cast<std::size_t>(next.mesh.face_count());
  levels_.push_back(std::move(next));
}

Piece& CornerChain::piece(Level& level, int corner, int child) {
  const auto found = level.pieces.find({corner, child});
  if (found != level.pieces.end()) return found->second;
  return level.pieces.try_emplace({corner, child}, level.mesh, level.cells[corner][child], rules_, cache_)
      .first->second;
}

SurfaceValues CornerChain::evaluate(int face, int corner, int level, double u, double v) {
  const auto found = std::find(corners_.begin(), corners_.end(), Corner{face, corner});
  if (found == corners_.end()) throw std::logic_error("a face that does not touch the chain's vertex");
  while (static_cast<int>(levels_.size()) < level + 2) grow();
  const ChildPlace in = child_place(rules_.triangular(), u, v);
  Level& around = levels_[static_cast<std::size_t>(level) + 1];
  SurfaceValues values = piece(around, static_cast<int>(found - corners_.begin()), in.child).evaluate(in.u, in.v);
  values.position += around.origin;
  values.rescale(std::ldexp(in.direction, level + 1));
  return values;
}

}  // namespace shaolin
