// What is checked of a mesh, from a file or made in memory, and what it is warned of.
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "schemes/control_mesh.h"
#include "schemes/errors.h"
#include "tests/catch.h"
#include "tests/schemes/obj_text.h"

namespace shaolin::obj_text {

TEST_CASE("The diagonal is that of the points' box", "[schemes][control_mesh]") {
  ControlMesh mesh;
  CHECK(mesh.diagonal() == 0);
  mesh.positions = {Vec3(-1, 2, 3), Vec3(1, -1, 9), Vec3(0, 0, 5)};
  CHECK(mesh.diagonal() == 7);
}

TEST_CASE("A mesh is all triangles only if every face is one", "[schemes][control_mesh]") {
  CHECK(parse(tetrahedron).all_triangles());
  CHECK_FALSE(parse(tetrahedron + "f 1 2 3 4\n").all_triangles());
}

TEST_CASE("What is odd but usable is a warning with file and line", "[schemes][control_mesh]") {
  const ControlMesh isolated = parse("v 9 9 9\n" + std::string("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 8 8 8\nf 2 3 4\n"));
  REQUIRE(isolated.warnings.size() == 1);
  CHECK(isolated.warnings[0] == "m.obj:1: isolated vertices: 2, the first is vertex 0 (counted from 0)");

  const ControlMesh repeated = parse(tetrahedron + "f 1 2 3 2\n");
  REQUIRE(repeated.warnings.size() == 1);
  CHECK(repeated.warnings[0] == "m.obj:9: face 4 repeats vertex 1 (counted from 0)");

  const ControlMesh crease = parse("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nt crease 2/1/0 0 2 1\n" +
                                   std::string("t crease 2/1/0 1 0 1\nt crease 2/1/0 3 0 1\nt crease 2/1/0 1 1 1\n"));
  CHECK(crease.sharp_edges.size() == 4);
  REQUIRE(crease.warnings.size() == 2);
  CHECK(crease.warnings[0] == "m.obj:6: crease 0 2 lies on no edge of any face, it has no effect");
  check_starts(crease.warnings[1], "m.obj:9: crease 1 1 ");
}

TEST_CASE("Neighbours that are wound against each other are named", "[schemes][control_mesh]") {
  const std::string points = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\n";
  CHECK(parse(points + "f 1 2 3 4\nf 2 5 6 3\n").warnings.empty());
  const ControlMesh opposed = parse(points + "v 1 0 1\nf 1 2 3 4\nf 3 6 5 2\nf 2 3 7\n");
  CHECK(opposed.warnings.empty());  // three faces at the edge: it is no matter of winding
  const ControlMesh pair = parse(points + "f 1 2 3 4\nf 2 3 6 5\n");
  REQUIRE(pair.warnings.size() == 1);
  CHECK(pair.warnings[0] ==
        "m.obj:8: faces 0 and 1 are wound against each other: both lead from vertex 1 to vertex 2 (counted from 0); "
        "the surface is cut along that edge");
}

TEST_CASE("Warnings of one kind end with a count", "[schemes][control_mesh]") {
  std::string text = tetrahedron;
  for (int i = 0; i < 25; ++i) text += "f 1 2 1 3\n";
  const ControlMesh mesh = parse(text);
  REQUIRE(mesh.warnings.size() == 11);
  CHECK(mesh.warnings[10] == "m.obj: and 15 more faces that repeat a vertex");
}

TEST_CASE("Checking a mesh again adds no warning twice", "[schemes][control_mesh]") {
  ControlMesh mesh = parse(tetrahedron + "v 5 5 5\nf 1 2 3 2\nt crease 2/1/0 0 4 1\n");
  REQUIRE(mesh.warnings.size() == 3);
  check(mesh);
  CHECK(mesh.warnings.size() == 3);
  mesh.warnings.clear();
  check(mesh);
  CHECK(mesh.warnings.size() == 3);
}

TEST_CASE("A mesh made in memory is checked element by element", "[schemes][control_mesh]") {
  const auto message = [](auto change) -> std::string {
    ControlMesh mesh = parse(tetrahedron);
    change(mesh);
    try {
      check(mesh);
    } catch (const InputError& error) {
      return error.what();
    }
    return "(no error)";
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(message([](ControlMesh&) {}) == "(no error)");
  check_starts(message([&](ControlMesh& m) { m.positions[2].y() = nan; }), "vertex 2 ");
  check_starts(message([](ControlMesh& m) { m.face_vertices[5] = 4; }), "face 1: vertex 4 ");
  check_starts(message([](ControlMesh& m) { m.face_vertices[5] = -1; }), "face 1: vertex -1 ");
  check_starts(message([](ControlMesh& m) { m.face_offsets[1] = 4; }), "face 1 has 2 corners");
  check_starts(message([](ControlMesh& m) { m.face_offsets[1] = 90; }), "face 0 has 90 corners");
  check_contains(message([](ControlMesh& m) { m.face_offsets.back() = 11; }), "offsets");
  check_contains(message([](ControlMesh& m) { m.face_offsets = {0}, m.face_vertices.clear(); }), "empty");
  check_contains(message([](ControlMesh& m) { m.face_offsets.clear(), m.face_vertices.clear(); }), "empty");
  check_contains(message([](ControlMesh& m) { m.positions.clear(); }), "the mesh has none");
  check_starts(message([](ControlMesh& m) { m.sharp_edges = {{0, 4, 1}}; }), "crease: vertex 4 ");
  check_starts(message([](ControlMesh& m) { m.sharp_edges = {{0, 1, -1}}; }), "crease: sharpness ");
  check_starts(message([&](ControlMesh& m) { m.sharp_vertices = {{0, float(nan)}}; }), "corner: sharpness ");
  check_starts(message([](ControlMesh& m) { m.holes = {4}; }), "hole: face 4 ");
}

}  // namespace shaolin::obj_text
