// Reading and writing OBJ with tag lines: every kind of line, and the round trip.
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <locale>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "schemes/obj.h"
#include "tests/catch.h"
#include "tests/schemes/obj_text.h"

namespace shaolin::obj_text {
namespace {

namespace fs = std::filesystem;

std::vector<int> corners(const ControlMesh& mesh, int face) { return {mesh.face(face).begin(), mesh.face(face).end()}; }

void check_equal(const ControlMesh& a, const ControlMesh& b) {
  CHECK(a.positions == b.positions);
  CHECK(a.face_offsets == b.face_offsets);
  CHECK(a.face_vertices == b.face_vertices);
  REQUIRE(a.sharp_edges.size() == b.sharp_edges.size());
  for (std::size_t i = 0; i < a.sharp_edges.size(); ++i) {
    CHECK(a.sharp_edges[i].a == b.sharp_edges[i].a);
    CHECK(a.sharp_edges[i].b == b.sharp_edges[i].b);
    CHECK(a.sharp_edges[i].sharpness == b.sharp_edges[i].sharpness);
  }
  REQUIRE(a.sharp_vertices.size() == b.sharp_vertices.size());
  for (std::size_t i = 0; i < a.sharp_vertices.size(); ++i) {
    CHECK(a.sharp_vertices[i].vertex == b.sharp_vertices[i].vertex);
    CHECK(a.sharp_vertices[i].sharpness == b.sharp_vertices[i].sharpness);
  }
  CHECK(a.holes == b.holes);
  CHECK(a.boundary == b.boundary);
  CHECK(a.crease_method == b.crease_method);
  CHECK(a.triangle_subdivision == b.triangle_subdivision);
  CHECK(a.cones == b.cones);
  CHECK(a.scheme == b.scheme);
}

ControlMesh write_and_read(const ControlMesh& mesh) {
  std::stringstream stream;
  write_obj(stream, mesh);
  return read_obj(stream, "written.obj");
}

}  // namespace

TEST_CASE("A plain OBJ gives its points and faces, counted from 0", "[schemes][obj]") {
  const ControlMesh mesh = parse(tetrahedron);
  REQUIRE(mesh.positions.size() == 4);
  CHECK(mesh.positions[3] == Vec3(0, 0, 1));
  REQUIRE(mesh.face_count() == 4);
  CHECK(corners(mesh, 1) == std::vector<int>{0, 1, 3});
  CHECK(mesh.all_triangles());
  CHECK(mesh.diagonal() == Approx(std::sqrt(3.0)).epsilon(1e-15));
  CHECK(mesh.boundary == BoundaryInterpolation::edge_and_corner);
  CHECK(mesh.crease_method == CreaseMethod::uniform);
  CHECK(mesh.triangle_subdivision == TriangleSubdivision::catmark);
  CHECK(mesh.scheme.empty());
  CHECK(mesh.warnings.empty());
}

TEST_CASE("Face corners are read in every form that OBJ has", "[schemes][obj]") {
  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\n";
  for (const std::string face : {"f 1 2 3", "f 1/1 2/1 3/1", "f 1//1 2//1 3//1", "f 1/1/1 2/1/1 3/1/1", "f -3 -2 -1",
                                 "f -3/-1/-1 -2/-1/-1 -1/-1/-1", "f 1/ 2/ 3/", "f 1// 2// 3//", "f +1 2 3"}) {
    CAPTURE(face);
    CHECK(corners(parse(points + face + "\n"), 0) == std::vector<int>{0, 1, 2});
  }
}

TEST_CASE("Negative indices count back from where they stand", "[schemes][obj]") {
  const ControlMesh mesh = parse("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -3\nv 0 0 1\nf -1 -2 -3\n");
  CHECK(corners(mesh, 0) == std::vector<int>{2, 1, 0});
  CHECK(corners(mesh, 1) == std::vector<int>{3, 2, 1});
}

TEST_CASE("Faces may stand before their vertices, and tags before both", "[schemes][obj]") {
  const ControlMesh mesh = parse("t crease 2/1/0 0 1 2\nf 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n");
  CHECK(corners(mesh, 0) == std::vector<int>{0, 1, 2});
  CHECK(mesh.sharp_edges.size() == 1);
  CHECK(mesh.warnings.empty());
}

TEST_CASE("Layout does not matter: CRLF, tabs, blanks, comments, continued lines, no last newline", "[schemes][obj]") {
  const ControlMesh expected = parse("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nt corner 1/1/0 0 2\n");
  for (const std::string text : {
           "v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\nt corner 1/1/0 0 2\r\n",
           "v\t0  0 0 \n  v 1 0 0\t\nv 0 1 0\n\n \t \nf 1\t2 3  \nt  corner  1/1/0  0  2",
           "# a comment that ends in \\\nv 0 0 0 # here too\n#t corner 1/1/0 1 2\nv 1 0 0\nv 0 1 0\nf 1 2 3 #\nt "
           "corner "
           "1/1/0 0 2 # sharp",
           "v 0 \\\n0 0\nv 1 0 0\nv 0 1 0\nf 1\\\n 2 \\\r\n  3\nt corner 1/1/0 \\ \n 0 2 \\",
           "\xEF\xBB\xBFv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nt corner 1/1/0 0 2",
       }) {
    CAPTURE(text);
    check_equal(parse(text), expected);
  }
}

TEST_CASE("Numbers are read with exact rounding in every notation", "[schemes][obj]") {
  const auto x = [](const std::string& word) {
    return parse("v " + word + " 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").positions[0].x();
  };
  CHECK(x("0.1") == 0.1);
  CHECK(x("+.5") == 0.5);
  CHECK(x("-1.") == -1.0);
  CHECK(x("1E+3") == 1000.0);
  CHECK(x("9007199254740993") == 9007199254740992.0);
  CHECK(x("2.2250738585072011e-308") == 2.2250738585072011e-308);  // once hung famous parsers
  CHECK(x("5e-324") == std::numeric_limits<double>::denorm_min());
  CHECK(x("1e-400") == 0.0);
  CHECK(x("1.7976931348623157e308") == std::numeric_limits<double>::max());
}

TEST_CASE("Numbers after a vertex's third are parsed and ignored", "[schemes][obj]") {
  const ControlMesh mesh = parse("v 1 2 3 1.0\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0 1 0.1 0.2 0.3\nf 1 2 3\n");
  CHECK(mesh.positions[0] == Vec3(1, 2, 3));
  CHECK(mesh.positions[1] == Vec3(1, 0, 0));
  check_error("v 1 2 3 red\n", 1, {"'red'", "not a number"});
}

TEST_CASE("Statements without a part in the surface are passed over", "[schemes][obj]") {
  const ControlMesh mesh =
      parse("mtllib a.mtl b.mtl\no thing\ng left arm\ns off\ns 1\nusemtl red\nvt 0 0\nvn 0 0 1\nvp 0 0\nl 1 2\np 1\n" +
            tetrahedron);
  CHECK(mesh.face_count() == 4);
  CHECK(mesh.warnings.empty());
}

TEST_CASE("Every supported tag is read", "[schemes][obj]") {
  const ControlMesh mesh = parse(tetrahedron +
                                 "t crease 2/1/0 0 1 2.5\n"
                                 "t crease 3/2/0 1 2 3 1 4\n"
                                 "t crease 3/1/0 0 2 3 inf\n"
                                 "t corner 1/1/0 3 0.7\n"
                                 "t corner 2/2/0 0 1 11 9.5\n"
                                 "t hole 2/0/0 1 3\n"
                                 "t interpolateboundary 1/0/0 2\n"
                                 "t facevaryinginterpolateboundary 1/0/0 1\n"
                                 "t creasemethod 0/0/1 chaikin\n"
                                 "t smoothtriangles 0/0/1 smooth\n"
                                 "t scheme 0/0/1 loop\n");
  REQUIRE(mesh.sharp_edges.size() == 5);
  const std::vector<std::vector<float>> edges{{0, 1, 2.5f}, {1, 2, 1}, {2, 3, 4}, {0, 2, 10}, {2, 3, 10}};
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const SharpEdge& edge = mesh.sharp_edges[i];
    CHECK(std::vector<float>{float(edge.a), float(edge.b), edge.sharpness} == edges[i]);
  }
  REQUIRE(mesh.sharp_vertices.size() == 3);
  CHECK(mesh.sharp_vertices[0].vertex == 3);
  CHECK(mesh.sharp_vertices[0].sharpness == 0.7f);
  CHECK(mesh.sharp_vertices[1].sharpness == infinite_sharpness);
  CHECK(mesh.sharp_vertices[2].sharpness == 9.5f);
  CHECK(mesh.holes == std::vector<int>{1, 3});
  CHECK(mesh.boundary == BoundaryInterpolation::edge_only);
  CHECK(mesh.crease_method == CreaseMethod::chaikin);
  CHECK(mesh.triangle_subdivision == TriangleSubdivision::smooth);
  CHECK(mesh.scheme == "loop");
  CHECK(mesh.warnings.empty());
}

TEST_CASE("Mode tags take every value that they have", "[schemes][obj]") {
  const auto with = [](const std::string& tag) { return parse(tetrahedron + "t " + tag + "\n"); };
  CHECK(with("interpolateboundary 1/0/0 0").boundary == BoundaryInterpolation::none);
  CHECK(with("interpolateboundary 1/0/0 1").boundary == BoundaryInterpolation::edge_and_corner);
  CHECK(with("creasemethod 0/0/1 normal").crease_method == CreaseMethod::uniform);
  CHECK(with("smoothtriangles 0/0/1 catmark").triangle_subdivision == TriangleSubdivision::catmark);
  CHECK(with("scheme 0/0/1 my-own_scheme").scheme == "my-own_scheme");
}

TEST_CASE("Sharpness is any number from 0, infinite from 10 on", "[schemes][obj]") {
  const auto sharpness = [](const std::string& word) {
    return parse(tetrahedron + "t corner 1/1/0 0 " + word + "\n").sharp_vertices.at(0).sharpness;
  };
  CHECK(sharpness("0") == 0.0f);
  CHECK(sharpness("9.75") == 9.75f);
  CHECK(sharpness("10") == infinite_sharpness);
  CHECK(sharpness("1e300") == infinite_sharpness);
  CHECK(sharpness("1e400") == infinite_sharpness);
  CHECK(sharpness("inf") == infinite_sharpness);
  check_tag_error("t corner 1/1/0 0 -1.5", {"sharpness -1.5"});
  check_tag_error("t corner 1/1/0 0 nan", {"sharpness nan"});
  check_tag_error("t crease 2/1/0 0 1 -inf", {"sharpness -inf"});
  check_tag_error("t crease 3/2/0 0 1 2 3 nan", {"sharpness nan"});
}

TEST_CASE("Faces of 10,000 corners load, on one line and on many", "[schemes][obj]") {
  constexpr int n = 10000;
  std::string points, one_line = "f", continued = "f";
  for (int i = 0; i < n; ++i) {
    points += "v " + std::to_string(i) + " 0 1\n";
    one_line += ' ' + std::to_string(i + 1);
    continued.append(" \\\n").append(std::to_string(i + 1));
  }
  for (const std::string& face : {one_line, continued}) {
    const ControlMesh mesh = parse(points + face + "\n");
    REQUIRE(mesh.face_count() == 1);
    CHECK(mesh.face_size(0) == n);
    CHECK(mesh.face(0)[n - 1] == n - 1);
    CHECK(mesh.warnings.empty());
  }
}

TEST_CASE("What is written is read back bit for bit", "[schemes][obj]") {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(-300, 300), mantissa(-1, 1), sharpness(0, 10);
  ControlMesh mesh;
  for (int i = 0; i < 200; ++i) {
    Vec3 p;
    for (double& x : p) x = mantissa(random) * std::pow(10, exponent(random));
    mesh.positions.push_back(p);
  }
  for (int f = 0; f < 100; ++f) {
    std::vector<int> face(3 + random() % 5);
    for (int& v : face) v = static_cast<int>(random() % 200);
    mesh.add_face(face);
    mesh.sharp_edges.push_back({face[0], face[1], static_cast<float>(sharpness(random))});
    mesh.sharp_vertices.push_back({face[2], static_cast<float>(std::pow(sharpness(random), 20) * 1e-20)});
  }
  mesh.holes = {3, 1, 4};
  mesh.cones = {2, 0};
  mesh.boundary = BoundaryInterpolation::none;
  mesh.crease_method = CreaseMethod::chaikin;
  mesh.triangle_subdivision = TriangleSubdivision::smooth;
  mesh.scheme = "catmark";
  check_equal(write_and_read(mesh), mesh);
  check_equal(write_and_read(parse(tetrahedron)), parse(tetrahedron));
}

TEST_CASE("A stream's locale does not reach the numbers", "[schemes][obj]") {
  struct Grouping : std::numpunct<char> {
    char do_thousands_sep() const override { return '.'; }
    char do_decimal_point() const override { return ','; }
    std::string do_grouping() const override { return "\3"; }
  };
  ControlMesh mesh;
  for (int i = 0; i < 2000; ++i) mesh.positions.push_back(Vec3(i + 0.5, 0, 0));
  for (int i = 0; i < 1998; ++i) mesh.add_face(std::vector<int>{i, i + 1, i + 2});
  mesh.sharp_edges = {{1500, 1501, 2.5f}};
  std::stringstream stream;
  stream.imbue(std::locale(stream.getloc(), new Grouping));
  write_obj(stream, mesh);
  check_equal(read_obj(stream, "written.obj"), mesh);
}

TEST_CASE("The shapes beside the checkout load, with the counts that a line count gives", "[schemes][obj]") {
  const char* const folder = std::getenv("SHAOLIN_SHAPES");
  if (!folder) return;
  int files = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".obj") continue;
    CAPTURE(entry.path().filename().string());
    ++files;
    if (entry.path().stem().string().find("hedit") != std::string::npos) {
      check_contains(message_of_file(entry.path()), "not supported");
      continue;
    }
    const ControlMesh mesh = read_obj(entry.path());
    std::ifstream stream(entry.path());
    std::vector<Vec3> points;
    std::size_t faces = 0, creases = 0, crease_corners = 0;
    for (std::string line; std::getline(stream, line);) {
      std::istringstream words(line);
      std::string keyword, tag;
      words >> keyword;
      Vec3 p;
      if (keyword == "v" && words >> p.x() >> p.y() >> p.z()) points.push_back(p);
      if (keyword == "f") ++faces;
      if (keyword != "t" || !(words >> tag)) continue;
      creases += tag == "crease";
      crease_corners += tag == "corner";
    }
    CHECK(mesh.positions == points);
    CHECK(static_cast<std::size_t>(mesh.face_count()) == faces);
    CHECK(mesh.sharp_edges.size() == creases);
    CHECK(mesh.sharp_vertices.size() == crease_corners);
    check_equal(write_and_read(mesh), mesh);
  }
  CHECK(files > 0);
}

}  // namespace shaolin::obj_text
