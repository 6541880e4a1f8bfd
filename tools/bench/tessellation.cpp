#include "tools/bench/tessellation.h"

#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include <memory>

#include "schemes/errors.h"

namespace shaolin {
namespace {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

/// A point as PrimvarRefiner wants it.
struct FarPoint {
  std::array<float, 3> xyz{};

  void Clear() { xyz = {}; }
  void AddWithWeight(const FarPoint& other, float weight) {
    for (std::size_t axis = 0; axis < 3; ++axis) xyz[axis] += weight * other.xyz[axis];
  }
};

Sdc::Options sdc_options(const ControlMesh& mesh) {
  Sdc::Options options;
  switch (mesh.boundary) {
    case BoundaryInterpolation::none:
      options.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_NONE);
      break;
    case BoundaryInterpolation::edge_only:
      options.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_EDGE_ONLY);
      break;
    case BoundaryInterpolation::edge_and_corner:
      options.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER);
      break;
  }
  const bool chaikin = mesh.crease_method == CreaseMethod::chaikin;
  options.SetCreasingMethod(chaikin ? Sdc::Options::CREASE_CHAIKIN : Sdc::Options::CREASE_UNIFORM);
  return options;
}

/// The mesh in the arrays that a TopologyDescriptor points into.
struct FarArrays {
  std::vector<int> face_sizes, edges, corners;
  std::vector<float> edge_sharpness, corner_sharpness;

  explicit FarArrays(const ControlMesh& mesh) {
    for (int face = 0; face < mesh.face_count(); ++face) face_sizes.push_back(mesh.face_size(face));
    for (const SharpEdge& edge : mesh.sharp_edges) {
      edges.insert(edges.end(), {edge.a, edge.b});
      edge_sharpness.push_back(edge.sharpness);
    }
    for (const SharpVertex& corner : mesh.sharp_vertices) {
      corners.push_back(corner.vertex);
      corner_sharpness.push_back(corner.sharpness);
    }
  }
};

std::unique_ptr<Far::TopologyRefiner> make_refiner(const ControlMesh& mesh) {
  const FarArrays arrays(mesh);
  Far::TopologyDescriptor descriptor;
  descriptor.numVertices = static_cast<int>(mesh.positions.size());
  descriptor.numFaces = mesh.face_count();
  descriptor.numVertsPerFace = arrays.face_sizes.data();
  descriptor.vertIndicesPerFace = mesh.face_vertices.data();
  descriptor.numCreases = static_cast<int>(arrays.edge_sharpness.size());
  descriptor.creaseVertexIndexPairs = arrays.edges.data();
  descriptor.creaseWeights = arrays.edge_sharpness.data();
  descriptor.numCorners = static_cast<int>(arrays.corners.size());
  descriptor.cornerVertexIndices = arrays.corners.data();
  descriptor.cornerWeights = arrays.corner_sharpness.data();
  descriptor.numHoles = static_cast<int>(mesh.holes.size());
  descriptor.holeIndices = mesh.holes.data();

  using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  const Factory::Options options(Sdc::SCHEME_LOOP, sdc_options(mesh));
  std::unique_ptr<Far::TopologyRefiner> refiner(Factory::Create(descriptor, options));
  if (!refiner) throw InputError("OpenSubdiv cannot use this mesh for Loop subdivision; it expects triangles");
  return refiner;
}

std::vector<FarPoint> limit_points(const Far::TopologyRefiner& refiner, const ControlMesh& mesh) {
  std::vector<FarPoint> points(mesh.positions.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis)
      points[i].xyz[axis] = static_cast<float>(mesh.positions[i][static_cast<Eigen::Index>(axis)]);

  const Far::PrimvarRefinerReal<float> primvars(refiner);
  for (int level = 1; level <= refiner.GetMaxLevel(); ++level) {
    std::vector<FarPoint> finer(static_cast<std::size_t>(refiner.GetLevel(level).GetNumVertices()));
    primvars.Interpolate(level, points, finer);
    points = std::move(finer);
  }
  std::vector<FarPoint> limits(points.size());
  primvars.Limit(points, limits);
  return limits;
}

}  // namespace

EmbreeTriangles tessellate_loop(const ControlMesh& mesh, int level) {
  const std::unique_ptr<Far::TopologyRefiner> refiner = make_refiner(mesh);
  Far::TopologyRefiner::UniformOptions options(level);
  options.fullTopologyInLastLevel = true;  // the limit masks need it
  refiner->RefineUniform(options);

  EmbreeTriangles result;
  for (const FarPoint& point : limit_points(*refiner, mesh)) result.points.push_back(point.xyz);
  const Far::TopologyLevel& finest = refiner->GetLevel(refiner->GetMaxLevel());
  result.triangles.reserve(static_cast<std::size_t>(finest.GetNumFaces()));
  for (int face = 0; face < finest.GetNumFaces(); ++face) {
    if (finest.IsFaceHole(face)) continue;
    const Far::ConstIndexArray corners = finest.GetFaceVertices(face);
    result.triangles.push_back({static_cast<std::uint32_t>(corners[0]), static_cast<std::uint32_t>(corners[1]),
                                static_cast<std::uint32_t>(corners[2])});
  }
  return result;
}

}  // namespace shaolin
