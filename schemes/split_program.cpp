#include "split_program.h"

namespace shaolin {

SplitProgram::Compiler::Compiler(const Neighbourhood& parent, FaceKind kind, SplitProgram& program)
    : kind_(kind), program_(program) {
  for (const Ring& ring : parent.rings) {
    rings_.try_emplace(ring.vertex, &ring);
    for (const FaceSides& face : ring.faces) faces_.try_emplace(face.id(), face);
    for (std::size_t i = 0; i < ring.spokes.size(); ++i) edges_.try_emplace(ring.spokes[i].edge, Place{&ring, i});
  }
}

int SplitProgram::Compiler::add_face(const FaceSides& face) {
  const auto [at, is_new] = face_steps_.try_emplace(face.id(), static_cast<int>(program_.face_steps_.size()));
  if (is_new) {
    program_.face_steps_.push_back({static_cast<int>(program_.indices_.size()), face.size()});
    for (int i = 0; i < face.size(); ++i) program_.indices_.push_back(face.vertex(i));
  }
  return at->second;
}

void SplitProgram::Compiler::add_vertex(const Ring& ring, const VertexTransition& to, const VertexMask& mask,
                                        const CreaseMask& crease) {
  VertexStep step{to, mask, crease, ring.vertex, {}, {}};
  std::vector<int> faces;
  if (kind_ == FaceKind::quad && ring.closed)
    for (const FaceSides& face : ring.faces) faces.push_back(add_face(face));
  std::vector<int>& indices = program_.indices_;
  step.spokes = {static_cast<int>(indices.size()), static_cast<int>(ring.spokes.size())};
  for (const Ring::Spoke& spoke : ring.spokes) indices.push_back(spoke.end);
  step.faces = {static_cast<int>(indices.size()), static_cast<int>(faces.size())};
  indices.insert(indices.end(), faces.begin(), faces.end());
  program_.steps_.push_back({RefinedVertex::Kind::vertex, static_cast<int>(program_.vertex_steps_.size())});
  program_.vertex_steps_.push_back(step);
}

int SplitProgram::Compiler::side(const FaceSides& face, int at) {
  return kind_ == FaceKind::triangle ? face.vertex((at + 2) % 3) : add_face(face);
}

int SplitProgram::Compiler::triangles_beside(int edge) const {
  const Place& place = edges_.at(edge);
  return place.inside() ? (place.left().size() == 3) + (place.right().size() == 3) : 0;
}

void SplitProgram::Compiler::add_edge(int edge, const EdgeMask& mask) {
  const Place& place = edges_.at(edge);
  const Ring::Spoke& spoke = place.ring->spokes[place.spoke];
  EdgeStep step{
      mask, edge_crease_share(spoke.sharpness, spoke.near_half, spoke.far_half), place.ring->vertex, spoke.end, 0, 0};
  if (step.crease_share != 1) {
    step.left = side(place.left(), 0);
    step.right = side(place.right(), place.right().size() - 1);
  }
  program_.steps_.push_back({RefinedVertex::Kind::edge, static_cast<int>(program_.edge_steps_.size())});
  program_.edge_steps_.push_back(step);
}

SplitProgram::StencilCompiler::StencilCompiler(const Neighbourhood& parent, SplitProgram& program) : program_(program) {
  for (const Ring& ring : parent.rings) {
    rings_.try_emplace(ring.vertex, &ring);
    for (const FaceSides& face : ring.faces) faces_.try_emplace(face.id(), face);
    for (std::size_t i = 0; i < ring.spokes.size(); ++i) {
      // A ring that holds the edge between two faces is to be had: at an end, the edge is a crease or a boundary.
      const bool inside = ring.closed || (i > 0 && i + 1 < ring.spokes.size());
      const auto [at, is_new] = edges_.try_emplace(ring.spokes[i].edge, &ring, i);
      if (!is_new && inside) at->second = {&ring, i};
    }
  }
}

void SplitProgram::StencilCompiler::add(const Stencil& stencil) {
  program_.rows_.push_back({static_cast<int>(program_.indices_.size()), static_cast<int>(stencil.weights().size())});
  for (const auto& [point, weight] : stencil.weights()) {
    program_.indices_.push_back(point);
    program_.weights_.push_back(weight);
  }
}

std::size_t SplitProgram::bytes() const {
  return (face_steps_.capacity() + rows_.capacity()) * sizeof(Span) + vertex_steps_.capacity() * sizeof(VertexStep) +
         edge_steps_.capacity() * sizeof(EdgeStep) + steps_.capacity() * sizeof(Step) +
         indices_.capacity() * sizeof(int) + weights_.capacity() * sizeof(double);
}

void SplitProgram::run(const Vec3* parent, Vec3* child) const {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    child[i].setZero();
    for (int at = rows_[i].begin; at < rows_[i].begin + rows_[i].count; ++at)
      child[i] += weights_[static_cast<std::size_t>(at)] * parent[indices_[static_cast<std::size_t>(at)]];
  }
  static thread_local std::vector<Vec3> face_points;
  face_points.resize(face_steps_.size());
  for (std::size_t i = 0; i < face_steps_.size(); ++i) face_points[i] = face_point(gather(parent, face_steps_[i]));
  const Vec3* sides = sides_are_face_points_ ? face_points.data() : parent;

  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const auto at = static_cast<std::size_t>(steps_[i].index);
    if (steps_[i].kind == RefinedVertex::Kind::vertex) {
      const VertexStep& step = vertex_steps_[at];
      child[i] = vertex_point(step.rule, step.mask, step.crease, parent[step.vertex], gather(parent, step.spokes),
                              gather(face_points.data(), step.faces));
    } else if (steps_[i].kind == RefinedVertex::Kind::edge) {
      const EdgeStep& step = edge_steps_[at];
      child[i] = edge_point(step.mask, step.crease_share, parent[step.a], parent[step.b], sides + step.left,
                            sides + step.right);
    } else {
      child[i] = face_points[at];
    }
  }
}

}  // namespace shaolin
