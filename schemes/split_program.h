#pragma once
/// How the control points of a child patch come from its parent's: masks and indices, compiled once per configuration.
#include <array>
#include <cstddef>
#include <map>
#include <memory_resource>
#include <unordered_map>
#include <utility>
#include <vector>

#include "point_rules.h"
#include "refinement.h"
#include "ring_stencils.h"

namespace shaolin {

/// Radius 1: first the new face points that are needed (quad split), then every point of the child, in the child's
/// order, by symmetric sums. Radius 2: every point as a stencil.
class SplitProgram {
 public:
  /// Compiles the points `wanted` of the level below `parent`, whose vertices are numbered as the parent's points.
  template <Scheme S>
  static SplitProgram compile(const Rules<S>& rules, const Neighbourhood& parent,
                              const std::vector<RefinedVertex>& wanted);

  int point_count() const { return static_cast<int>(steps_.size() + rows_.size()); }

  /// Writes point_count() points. O(point_count() x ring size).
  void run(const Vec3* parent, Vec3* child) const;

  /// Bytes on the heap.
  std::size_t bytes() const;

 private:
  struct Span {
    int begin = 0;
    int count = 0;
  };
  struct VertexStep {
    VertexTransition rule;
    VertexMask mask;
    CreaseMask crease;
    int vertex;
    Span spokes, faces;
  };
  struct EdgeStep {
    EdgeMask mask;
    float crease_share;
    int a, b;
    int left, right;  ///< new face points (quads) or opposite vertices (triangles)
  };
  struct Step {
    RefinedVertex::Kind kind;
    int index;  ///< into vertex_steps_, edge_steps_ or the new face points
  };
  class Compiler;
  class StencilCompiler;

  PointGather gather(const Vec3* points, const Span& span) const {
    return {points, indices_.data() + span.begin, span.count};
  }

  bool sides_are_face_points_ = false;
  std::vector<Span> face_steps_;
  std::vector<VertexStep> vertex_steps_;
  std::vector<EdgeStep> edge_steps_;
  std::vector<Step> steps_;
  std::vector<int> indices_;
  std::vector<Span> rows_;  ///< stencils: a stretch of indices_ and weights_ each
  std::vector<double> weights_;
};

/// Looks masks and rings up and writes the program.
class SplitProgram::Compiler {
 public:
  Compiler(const Neighbourhood& parent, FaceKind kind, SplitProgram& program);

  int add_face(const FaceSides& face);
  const FaceSides& face(int id) const { return faces_.at(id); }
  const Ring& ring(int vertex) const { return *rings_.at(vertex); }
  void add_vertex(const Ring& ring, const VertexTransition& to, const VertexMask& mask, const CreaseMask& crease);
  int triangles_beside(int edge) const;
  void add_edge(int edge, const EdgeMask& mask);

 private:
  /// What an edge's smooth mask reads beyond it, in the face whose side in place `at` the edge is.
  int side(const FaceSides& face, int at);

  /// An edge as a spoke of a ring.
  struct Place {
    const Ring* ring;
    std::size_t spoke;

    /// The faces to the spoke's left and right; the edge must be inside the ring.
    const FaceSides& left() const { return ring->faces[spoke]; }
    const FaceSides& right() const { return ring->faces[(spoke + ring->faces.size() - 1) % ring->faces.size()]; }
    bool inside() const { return ring->closed || (spoke > 0 && spoke < ring->faces.size()); }
  };

  std::array<std::byte, 8192> buffer_;  // for the maps' nodes
  std::pmr::monotonic_buffer_resource memory_{buffer_.data(), buffer_.size()};
  FaceKind kind_;
  SplitProgram& program_;
  std::pmr::map<int, const Ring*> rings_{&memory_};
  std::pmr::map<int, FaceSides> faces_{&memory_};
  std::pmr::map<int, Place> edges_{&memory_};
  std::pmr::map<int, int> face_steps_{&memory_};
};

/// Writes stencils. A neighbourhood's rings and the edges and faces in them are looked up by name.
class SplitProgram::StencilCompiler {
 public:
  StencilCompiler(const Neighbourhood& parent, SplitProgram& program);

  const Ring* ring(int vertex) const {
    const auto at = rings_.find(vertex);
    return at == rings_.end() ? nullptr : at->second;
  }
  const FaceSides& face(int id) const { return faces_.at(id); }
  /// A ring and the place of an edge among its spokes.
  const std::pair<const Ring*, std::size_t>& edge(int id) const { return edges_.at(id); }
  void add(const Stencil& stencil);

 private:
  SplitProgram& program_;
  std::unordered_map<int, const Ring*> rings_;
  std::unordered_map<int, FaceSides> faces_;
  std::unordered_map<int, std::pair<const Ring*, std::size_t>> edges_;
};

template <Scheme S>
SplitProgram SplitProgram::compile(const Rules<S>& rules, const Neighbourhood& parent,
                                   const std::vector<RefinedVertex>& wanted) {
  SplitProgram program;
  if (rules.radius() == 2) {
    StencilCompiler compiler(parent, program);
    const RingStencils stencils(rules, [&](int vertex) { return compiler.ring(vertex); });
    for (const RefinedVertex& from : wanted) {
      if (from.kind == RefinedVertex::Kind::vertex) {
        compiler.add(stencils.vertex(*compiler.ring(from.id)));
      } else if (from.kind == RefinedVertex::Kind::edge) {
        const auto& [ring, spoke] = compiler.edge(from.id);
        compiler.add(stencils.edge(*ring, spoke));
      } else {
        compiler.add(stencils.face(compiler.face(from.id)));
      }
    }
    return program;
  }
  Compiler compiler(parent, S::face_kind, program);
  program.sides_are_face_points_ = S::face_kind == FaceKind::quad;
  for (const RefinedVertex& from : wanted) {
    switch (from.kind) {
      case RefinedVertex::Kind::vertex: {
        const Ring& ring = compiler.ring(from.id);
        const VertexTransition to = vertex_transition(ring.sharpness, ring.spoke_sharpness(), ring.half_sharpness());
        compiler.add_vertex(ring, to, rules.vertex(static_cast<int>(ring.spokes.size()), to, ring.cone),
                            rules.crease());
        break;
      }
      case RefinedVertex::Kind::edge:
        compiler.add_edge(from.id, rules.edge(compiler.triangles_beside(from.id)));
        break;
      case RefinedVertex::Kind::face:
        program.steps_.push_back({from.kind, compiler.add_face(compiler.face(from.id))});
        break;
    }
  }
  return program;
}

}  // namespace shaolin
