#pragma once
// The subdivision matrix of a vertex's ring, found by refining a mesh around it: no mask is read from the code.
#include <Eigen/Dense>

#include "schemes/subdivision_mesh.h"
#include "tests/models.h"

namespace shaolin {

/// The rows and columns: the vertex, its spokes, then (quads) the diagonals, counter-clockwise.
struct LocalMatrix {
  Eigen::MatrixXd matrix;
  int spokes = 0, faces = 0;
  std::vector<int> vertices;  ///< of the control mesh
};

/// Of the ring of vertex 0. O(size^2 x mesh size).
template <Scheme S>
LocalMatrix local_matrix(ControlMesh mesh) {
  const bool quads = S::face_kind == FaceKind::quad;
  const SubdivisionMesh<S> topology(mesh);
  const Ring ring = topology.ring(topology.corner_at(0));
  LocalMatrix result;
  result.spokes = static_cast<int>(ring.spokes.size());
  result.faces = static_cast<int>(ring.faces.size());
  std::vector<int> children{topology.child_of_vertex(0)};
  result.vertices = {0};
  for (const Ring::Spoke& spoke : ring.spokes) {
    result.vertices.push_back(spoke.end);
    children.push_back(topology.child_of_edge(spoke.edge));
  }
  if (quads) {
    for (const FaceSides& face : ring.faces) {
      result.vertices.push_back(face.vertex(2));
      children.push_back(topology.child_of_face(face.id()));
    }
  }
  const auto size = static_cast<Eigen::Index>(children.size());
  result.matrix.resize(size, size);
  for (Eigen::Index column = 0; column < size; column += 3) {
    for (Vec3& p : mesh.positions) p.setZero();
    for (int axis = 0; axis < 3 && column + axis < size; ++axis)
      mesh.positions[static_cast<std::size_t>(result.vertices[static_cast<std::size_t>(column + axis)])][axis] = 1;
    const SubdivisionMesh<S> control(mesh);
    const auto refined = control.refine();
    for (Eigen::Index row = 0; row < size; ++row)
      for (int axis = 0; axis < 3 && column + axis < size; ++axis)
        result.matrix(row, column + axis) = refined->point(children[static_cast<std::size_t>(row)])[axis];
  }
  return result;
}

/// A mask as a row over the local matrix's columns.
inline Eigen::RowVectorXd row_of(const LocalMatrix& local, const RingMask& mask) {
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(local.matrix.rows());
  row[0] = mask.vertex;
  for (std::size_t i = 0; i < mask.edges.size(); ++i) row[static_cast<Eigen::Index>(1 + i)] = mask.edges[i];
  for (std::size_t i = 0; i < mask.diagonals.size(); ++i)
    row[static_cast<Eigen::Index>(1 + i) + local.spokes] = mask.diagonals[i];
  return row;
}

/// |row matrix - eigenvalue row| relative to |row|.
inline double eigen_residual(const LocalMatrix& local, const Eigen::RowVectorXd& row, double eigenvalue) {
  return (row * local.matrix - eigenvalue * row).norm() / row.norm();
}

}  // namespace shaolin
