#pragma once
/// Wavefront OBJ with OpenSubdiv's tag lines.
#include <filesystem>
#include <iosfwd>

#include "control_mesh.h"
#include "mesh_places.h"

namespace shaolin {

/// Reads `v` and `f` lines (v, v/vt, v//vn, v/vt/vn; negative indices count back) and the tag lines
///
///     t crease 2/1/0 a b s          t corner 1/1/0 v s             t hole n/0/0 f...
///     t interpolateboundary 1/0/0 m t creasemethod 0/0/1 normal|chaikin
///     t smoothtriangles 0/0/1 smooth|catmark                       t scheme 0/0/1 loop|catmark|...
///     t facevaryinginterpolateboundary 1/0/0 m (accepted, no effect on positions)
///     t cone n/0/0 v...             (ours, see ControlMesh::cones)
///     t vertexedit ..., t edgeedit ..., t faceedit ... (an error that says that they are not supported yet)
///
/// whose indices count from 0. Other OBJ statements (vt, vn, g, o, s, usemtl, mtllib, comments) are passed over.
/// Returns a checked mesh (see check()). Throws InputError with file and line for everything that is malformed:
/// unreadable file, words where numbers belong, NaN or infinite coordinates, indices out of range, fewer than three
/// corners, tags cut short, unknown tags, negative or NaN sharpness, an empty mesh. O(file size).
ControlMesh read_obj(const std::filesystem::path& file);

/// The same, and where everything stands in the file: for messages of later checks.
ControlMesh read_obj(const std::filesystem::path& file, MeshPlaces& places);

/// The same from a stream; `name` stands for the file in messages.
ControlMesh read_obj(std::istream& stream, const std::string& name);

/// Writes what read_obj() reads back to the same mesh, points with 17 significant digits.
void write_obj(std::ostream& stream, const ControlMesh& mesh);

}  // namespace shaolin
