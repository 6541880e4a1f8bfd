#pragma once
/// The topology around a vertex and around a face: what masks and sharpness rules are chosen by.
#include <vector>

namespace shaolin {

/// A face by its vertices and sides in order: side i is the edge from vertex i to the next. Identifiers tell faces, and
/// edges, apart that have the same vertices (two edges join the same vertices beside a triangle vertex of valence 2).
struct FaceSides {
  int id;
  std::vector<int> vertices;
  std::vector<int> sides;
};

/// A vertex with the edges and faces around it, counter-clockwise. Face i lies between spoke i and spoke i + 1.
struct Ring {
  struct Spoke {
    int end;  ///< the vertex at the other end of the edge
    int edge;
    float sharpness;
  };

  int vertex = 0;
  bool closed = true;   ///< as many faces as spokes; else one face fewer (a boundary or a crease)
  float sharpness = 0;  ///< of the vertex
  std::vector<Spoke> spokes;
  std::vector<FaceSides> faces;  ///< each begins at the vertex, then the end of its spoke

  std::vector<float> spoke_sharpness() const {
    std::vector<float> values;
    for (const Spoke& spoke : spokes) values.push_back(spoke.sharpness);
    return values;
  }
};

/// A face and the rings of the vertices that its patch depends on. The first rings belong to the face's corners in
/// order; a ring may be opened along sharp edges so that it holds the faces on this side only.
struct Neighbourhood {
  FaceSides face;
  std::vector<Ring> rings;
};

}  // namespace shaolin
