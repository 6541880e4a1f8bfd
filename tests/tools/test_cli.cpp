/// The contract of the tool's subcommands: exit statuses, messages, columns, and no file left after a failure.
#include <cmath>

#include "schemes/vec3.h"
#include "tests/catch.h"
#include "tests/tools/cli_run.h"
#include "tests/tools/cube_text.h"

namespace shaolin::test {
namespace {

const std::string hit_header = "ray,hit,t,face,sub,u,v,px,py,pz,nx,ny,nz,certified,residual,error";
const std::string eval_header =
    "face,sub,u,v,px,py,pz,nx,ny,nz,dux,duy,duz,dvx,dvy,dvz,duux,duuy,duuz,duvx,duvy,duvz,dvvx,dvvy,dvvz";

const std::string tetrahedron_text = "v 1 1 1\nv -1 -1 1\nv -1 1 -1\nv 1 -1 -1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

double number(const std::string& field) {
  std::size_t used = 0;
  const double value = std::stod(field, &used);
  REQUIRE(used == field.size());
  return value;
}

Vec3 vector_at(const std::vector<std::string>& row, std::size_t column) {
  return {number(row.at(column)), number(row.at(column + 1)), number(row.at(column + 2))};
}

bool all_empty(const std::vector<std::string>& row, std::size_t from) {
  for (std::size_t i = from; i < row.size(); ++i)
    if (!row[i].empty()) return false;
  return true;
}

/// Runs a command that must fail with status 3, say `place`, and leave the folder as it was.
void check_refused(const Folder& folder, const std::vector<std::string>& arguments, const std::string& place) {
  const auto before = folder.list();
  const Outcome outcome = folder.run(arguments);
  CAPTURE(arguments, place, outcome.text);
  CHECK(outcome.status == 3);
  CHECK(outcome.text.find(place) != std::string::npos);
  CHECK(folder.list() == before);
}

}  // namespace

TEST_CASE("help and version exit with 0", "[tools][cli]") {
  const Folder folder;
  CHECK(folder.run({"--version"}).status == 0);
  CHECK(folder.run({"--help"}).status == 0);
  for (const std::string sub : {"render", "query", "eval", "info"}) {
    const Outcome outcome = folder.run({sub, "--help"});
    CHECK(outcome.status == 0);
    CHECK(outcome.text.find("--scheme") != std::string::npos);
  }
}

TEST_CASE("usage errors exit with 2 and write nothing", "[tools][cli]") {
  const Folder folder;
  const std::string model = data_file("torus.obj"), exr = folder / "out.exr", csv = folder / "out.csv";
  const std::vector<std::vector<std::string>> lines = {
      {},
      {"paint", model},
      {"info"},
      {"info", model, "--frobnicate"},
      {"info", model, model},
      {"info", model, "--scheme", "doo-sabin"},
      {"render", model},
      {"render", model, "-o", exr, "--size", "800"},
      {"render", model, "-o", exr, "--size", "0x10"},
      {"render", model, "-o", exr, "--size", "-5x10"},
      {"render", model, "-o", exr, "--size", "10x10x10"},
      {"render", model, "-o", exr, "--size", "1e2x10"},
      {"render", model, "-o", exr, "--size", "99999x10"},
      {"render", model, "-o", exr, "--camera", "1,2,3"},
      {"render", model, "-o", exr, "--camera", "1,2,3,0,0,0,40,1"},
      {"render", model, "-o", exr, "--camera", "1,2,3,0,0,zero,40"},
      {"render", model, "-o", exr, "--camera", "1,2,nan,0,0,0,40"},
      {"render", model, "-o", exr, "--camera", "1,2,3,1,2,3,40"},
      {"render", model, "-o", exr, "--camera", "1,2,3,0,0,0,0"},
      {"render", model, "-o", exr, "--camera", "1,2,3,0,0,0,180"},
      {"render", model, "-o", exr, "--threads", "-1"},
      {"render", model, "-o", exr, "--threads", "two"},
      {"query", model, "-o", csv},
      {"query", model, "--ray", "0,0,5,0,0"},
      {"query", model, "--ray", "0,0,5,0,0,-1\n0,0,6,0,0,-1"},
      {"query", model, "--ray", "0,0,5,0,0,-1", "--rays", csv},
      {"eval", model, "-o", csv},
      {"eval", model, "--params", csv},
  };
  for (const auto& line : lines) {
    CAPTURE(line);
    CHECK(folder.run(line).status == 2);
  }
  CHECK(folder.list().empty());
}

TEST_CASE("a word that no command knows is named, whatever else is missing", "[tools][cli]") {
  const Folder folder;
  const std::string model = data_file("rook.obj").string();
  for (const char* command : {"query", "overlap", "sweep", "inside", "render"}) {
    const Outcome outcome = folder.run({command, model, "--wrong"});
    INFO(command << ": " << outcome.text);
    CHECK(outcome.status == 2);
    CHECK(outcome.text.find("--wrong") != std::string::npos);
  }
}

TEST_CASE("an output that is another output's file, or an input's, is a usage error", "[tools][cli]") {
  const Folder folder;
  const std::string model = folder.write("cube.obj", cube_text), image = folder / "image",
                    dotted = folder / "./x/../image";
  const std::string rays = folder.write("rays.csv", "0,0,5,0,0,-1\n"), params = folder.write("params.csv", "0,0,0,0\n");
  std::filesystem::create_symlink("rays.csv", folder / "link.csv");
  const auto before = folder.list();
  for (const std::vector<std::string>& line : std::vector<std::vector<std::string>>{
           {"render", model, "--size", "8x8", "-o", image, "--png", image},
           {"render", model, "--size", "8x8", "-o", image, "--png", dotted},
           {"render", model, "--size", "8x8", "-o", image, "--png-level", dotted},
           {"render", model, "--size", "8x8", "-o", folder / "a.exr", "--png", image, "--stats", dotted},
           {"render", model, "--size", "8x8", "-o", model},
           {"query", model, "--rays", rays, "-o", rays},
           {"query", model, "--rays", rays, "-o", folder / "link.csv"},
           {"query", model, "--rays", rays, "-o", model},
           {"eval", model, "--params", params, "-o", folder / "./params.csv"},
           {"validate", model, "--rays", "0", "--evaluations", "1", "--report", model}}) {
    const Outcome outcome = folder.run(line);
    CAPTURE(line, outcome.text);
    CHECK(outcome.status == 2);
    CHECK(outcome.text.find("is the file of") != std::string::npos);
    CHECK(folder.list() == before);
  }
  CHECK(read_file(model) == cube_text);
  CHECK(folder.run({"render", model, "--size", "8x8", "-o", "/dev/null", "--stats", "/dev/null"}).status == 0);
}

TEST_CASE("files that are missing or unusable exit with 3", "[tools][cli]") {
  const Folder folder;
  const std::string torus = data_file("torus.obj"), absent = folder / "absent", csv = folder / "out.csv";
  const std::string rays = folder.write("rays.csv", "0,0,5,0,0,-1\n");
  check_refused(folder, {"info", absent}, absent);
  check_refused(folder, {"render", absent, "-o", folder / "out.exr"}, absent);
  check_refused(folder, {"query", absent, "--rays", rays, "-o", csv}, absent);
  check_refused(folder, {"query", torus, "--rays", absent, "-o", csv}, absent);
  check_refused(folder, {"eval", torus, "--params", absent, "-o", csv}, absent);

  const std::string nowhere = absent + "/out";
  check_refused(folder, {"render", torus, "-o", nowhere + ".exr", "--size", "8x8"}, nowhere);
  check_refused(folder, {"render", torus, "-o", folder / "out.exr", "--png", nowhere, "--size", "8x8"}, nowhere);
  check_refused(folder, {"query", torus, "--rays", rays, "-o", nowhere}, nowhere);

  const std::string broken = folder.write("broken.obj", cube_text + "f 1 2 99\n");
  check_refused(folder, {"render", broken, "-o", folder / "out.exr"}, broken + ":15:");
  const std::string foreign = folder.write("foreign.obj", "t scheme 0/0/1 doo-sabin\n" + cube_text);
  check_refused(folder, {"info", foreign}, foreign + ":1: unknown scheme 'doo-sabin'");
  const std::string mixed = folder.write("mixed.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 2 3 4\n");
  for (const std::string scheme : {"loop", "warren", "linear"})
    check_refused(folder, {"info", mixed, "--scheme", scheme}, mixed + ":6: face 1 has 4 corners; a triangle scheme");
}

TEST_CASE("query refuses bad rows with file and line", "[tools][cli]") {
  const Folder folder;
  const std::string model = data_file("cube_creases.obj"), output = folder / "hits.csv";
  for (const std::string row : {"0,0,5,0,0", "0,0,5,0,0,-1,0", "0,0,5,0,0,-1,0,9,9", "0,0,5,0,down,-1", "0,0,5,0,,-1",
                                "0,0,5,0,0,0", "0,0,5,0,0,nan", "0,0,5,0,0,inf", "0,nan,5,0,0,-1", "inf,0,5,0,0,-1",
                                "0,0,5,0,0,-1,nan,9", "0,0,5,0,0,-1,0,nan"}) {
    const bool limited = std::count(row.begin(), row.end(), ',') == 7;
    const std::string end = limited ? ",0,9\n" : "\n", header = limited ? ",tmin,tmax\n" : "\n";
    const std::string rays =
        folder.write("rays.csv", "ox,oy,oz,dx,dy,dz" + header + "0,0,5,0,0,-1" + end + row + "\n0,0,5,0,0,-1" + end);
    check_refused(folder, {"query", model, "--rays", rays, "-o", output}, rays + ":3:");
    check_refused(folder, {"query", model, "--rays", rays, "-o", output, "--any"}, rays + ":3:");
  }
  const std::string reordered = folder.write("reordered.csv", "\ndx,dy,dz,ox,oy,oz\n0,0,-1,0,0,5\n");
  check_refused(folder, {"query", model, "--rays", reordered, "-o", output}, reordered + ":2: the header is 'dx,");
  const std::string shorter = folder.write("shorter.csv", "ox,oy,oz,dx,dy,dz,tmin,tmax\n0,0,5,0,0,-1\n");
  check_refused(folder, {"query", model, "--rays", shorter, "-o", output},
                shorter + ":2: a row with 6 columns, expected 8 as in the header");
  const std::string longer = folder.write("longer.csv", "ox,oy,oz,dx,dy,dz\n0,0,5,0,0,-1\n0,0,5,0,0,-1,0,1\n");
  check_refused(folder, {"query", model, "--rays", longer, "-o", output},
                longer + ":3: a row with 8 columns, expected 6 as in the header");
}

TEST_CASE("a failing query leaves an older output as it was", "[tools][cli]") {
  const Folder folder;
  const std::string rays = folder.write("rays.csv", "0,0,5,0,0,-1\n0,0,5,0,0,0\n");
  const std::string output = folder.write("hits.csv", "precious\n");
  check_refused(folder, {"query", data_file("cube_creases.obj"), "--rays", rays, "-o", output}, rays + ":2:");
  CHECK(read_file(output) == "precious\n");
}

TEST_CASE("eval refuses bad rows with file and line", "[tools][cli]") {
  const Folder folder;
  const std::string quads = folder.write("cube.obj", cube_text),
                    triangles = folder.write("tetrahedron.obj", tetrahedron_text);
  const std::string output = folder / "out.csv";
  const auto check = [&](const std::string& model, const std::string& row) {
    const std::string params = folder.write("params.csv", "face,sub,u,v\n0,0,0.25,0.5\n" + row + "\n");
    check_refused(folder, {"eval", model, "--params", params, "-o", output}, params + ":3:");
  };
  for (const std::string row : {"0,0,0.5", "0,0,0.5,0.5,0", "0,0,half,0.5", "0,0,,0.5", "0.5,0,0.5,0.5",
                                "0,0.5,0.5,0.5", "nan,0,0.5,0.5", "1e99,0,0.5,0.5", "-1,0,0.5,0.5", "6,0,0.5,0.5",
                                "0,1,0.5,0.5", "0,-1,0.5,0.5", "0,0,1.5,0.5", "0,0,0.5,-0.5", "0,0,nan,0.5"})
    check(quads, row);
  check(triangles, "0,0,0.75,0.75");
}

TEST_CASE("query answers every ray in order", "[tools][cli]") {
  const Folder folder;
  const std::vector<std::string> rows = {
      "0.1,0.2,5,0,0,-1",        // hits
      "9,9,5,0,0,-1",            // passes by
      "0.1,0.2,5,0,0,-2",        // as the first, t is half
      "0.1,0.2,5,0,0,1",         // looks away
      "-5,0.1,0.3,1,0.01,-0.02"  // hits from elsewhere
  };
  std::string text;
  for (const std::string& row : rows) text += row + "\n";
  const std::string model = data_file("cube_creases.obj"), rays = folder.write("rays.csv", text);
  const std::string output = folder / "hits.csv";
  const Outcome outcome = folder.run({"query", model, "--rays", rays, "-o", output});
  CAPTURE(outcome.text);
  REQUIRE(outcome.status == 0);
  CHECK(folder.list() == std::set<std::string>{"hits.csv", "rays.csv"});

  const auto table = read_rows(output);
  REQUIRE(table.size() == 6);
  CHECK(table[0] == split(hit_header, ','));
  for (std::size_t i = 1; i < table.size(); ++i) {
    CAPTURE(i);
    const auto& row = table[i];
    REQUIRE(row.size() == 16);
    CHECK(row[0] == std::to_string(i - 1));
    const bool expected = i != 2 && i != 4;
    CHECK(row[1] == (expected ? "1" : "0"));
    if (!expected) {
      CHECK(all_empty(row, 2));
      continue;
    }
    const auto ray = split(rows[i - 1], ',');
    const Vec3 on_ray = vector_at(ray, 0) + number(row[2]) * vector_at(ray, 3);
    CHECK((vector_at(row, 7) - on_ray).norm() < 1e-11);
    CHECK(vector_at(row, 10).norm() == Approx(1).epsilon(1e-14));
    const double face = number(row[3]);
    CHECK((0 <= face && face < 6 && face == std::floor(face)));
    CHECK(row[4] == "0");
    for (const std::size_t column : {5, 6}) CHECK((0 <= number(row[column]) && number(row[column]) <= 1));
  }
  CHECK(number(table[3][2]) == Approx(number(table[1][2]) / 2).epsilon(1e-12));
}

TEST_CASE("query takes the triangles of a tessellation", "[tools][cli]") {
  const Folder folder;
  const std::string rays = folder.write("rays.csv", "0.1,0.2,5,0,0,-1\n9,9,5,0,0,-1\n");
  const std::string model = data_file("cube_creases.obj");
  std::vector<double> t;
  for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--uniform", "2"}, {"--uniform", "6"}}) {
    std::vector<std::string> arguments{"query", model, "--rays", rays, "-o", folder / "hits.csv"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    REQUIRE(folder.run(arguments).status == 0);
    const auto table = read_rows(folder / "hits.csv");
    REQUIRE(table.size() == 3);
    t.push_back(std::stod(table[1][2]));
    CHECK(table[2][1] == "0");
  }
  CHECK(std::abs(t[1] - t[0]) < 0.05);
  CHECK(std::abs(t[2] - t[0]) < 5e-4);
  CHECK(t[1] != t[0]);
  CHECK(folder.run({"query", model, "--rays", rays, "-o", folder / "no.csv", "--uniform", "0"}).status == 2);
}

TEST_CASE("query writes the same rows under any memory budget", "[tools][cli]") {
  const Folder folder;
  const std::vector<std::string> arguments{"query", data_file("torus.obj"), "--rays", data_file("rays.csv"),
                                           "-o",    folder / "hits.csv"};
  REQUIRE(folder.run(arguments).status == 0);
  const std::string all = read_file(folder / "hits.csv");
  for (const std::string budget : {"100", "0.01", "1e-9"}) {
    std::vector<std::string> with = arguments;
    with.insert(with.end(), {"--memory-budget", budget});
    REQUIRE(folder.run(with).status == 0);
    CHECK(read_file(folder / "hits.csv") == all);
  }
}

TEST_CASE("query keeps to the interval of t", "[tools][cli]") {
  const Folder folder;
  const std::string rays = folder.write("rays.csv",
                                        "ox,oy,oz,dx,dy,dz,tmin,tmax\n"
                                        "0.1,0.2,5,0,0,-1,0,inf\n"
                                        "0.1,0.2,5,0,0,-1,0,1\n"
                                        "0.1,0.2,5,0,0,-1,5,100\n"
                                        "0.1,0.2,5,0,0,-1,100,200\n");
  const std::string model = data_file("cube_creases.obj"), output = folder / "hits.csv";
  REQUIRE(folder.run({"query", model, "--rays", rays, "-o", output}).status == 0);
  const auto table = read_rows(output);
  REQUIRE(table.size() == 5);
  for (std::size_t i = 1; i < 5; ++i) CHECK(table[i].at(1) == (i % 2 == 1 ? "1" : "0"));
  CHECK(number(table[1].at(2)) < 5);  // the front of the cube
  CHECK(number(table[3].at(2)) > 5);  // the back
}

TEST_CASE("query --any fills in ray and hit only", "[tools][cli]") {
  const Folder folder;
  const std::string rays = folder.write("rays.csv", "0.1,0.2,5,0,0,-1\n9,9,5,0,0,-1\n");
  const std::string model = data_file("cube_creases.obj"), output = folder / "hits.csv";
  REQUIRE(folder.run({"query", model, "--rays", rays, "-o", output, "--any", "--threads", "1"}).status == 0);
  CHECK(read_file(output) == hit_header + "\n0,1,,,,,,,,,,,,,,\n1,0,,,,,,,,,,,,,,\n");
}

TEST_CASE("query --all writes a row for each hit, --count how many there are", "[tools][cli]") {
  const Folder folder;
  const std::string rays = folder.write("rays.csv", "0.1,0.2,5,0,0,-2\n9,9,5,0,0,-1\n0.1,0.2,0,0,0,-1\n");
  const std::string model = data_file("cube_creases.obj"), output = folder / "hits.csv";
  REQUIRE(folder.run({"query", model, "--rays", rays, "-o", output, "--all"}).status == 0);
  const auto table = read_rows(output);
  REQUIRE(table.size() == 5);
  CHECK(table[0].back() == "sense");
  const std::vector<std::array<std::string, 3>> expected{
      {"0", "1", "-1"}, {"0", "2", "1"}, {"1", "0", ""}, {"2", "1", "1"}};
  for (std::size_t i = 0; i < expected.size(); ++i)
    CHECK(std::array{table[i + 1].at(0), table[i + 1].at(1), table[i + 1].back()} == expected[i]);
  CHECK(number(table[1].at(2)) < number(table[2].at(2)));
  REQUIRE(folder.run({"query", model, "--rays", rays, "-o", output, "--count"}).status == 0);
  CHECK(read_file(output) == "ray,count\n0,2\n1,0\n2,1\n");
  const std::vector<std::vector<std::string>> others{{"--any"}, {"--count"}, {"--uniform", "2"}, {"--chord", "0.1"}};
  for (const std::vector<std::string>& other : others) {
    std::vector<std::string> arguments{"query", model, "--rays", rays, "-o", output, "--all"};
    arguments.insert(arguments.end(), other.begin(), other.end());
    CHECK(folder.run(arguments).status == 2);
  }
}

TEST_CASE("query gives the same file for any number of threads", "[tools][cli]") {
  const Folder folder;
  std::string text;
  for (int i = 0; i < 2000; ++i) {
    const double a = 0.7 * i, b = 0.013 * i;
    for (const double x : {4 * std::cos(a), 4 * std::sin(a), 3 * std::cos(b), -std::cos(a + 0.1), -std::sin(a + 0.1)})
      text += std::to_string(x) + ",";
    text += std::to_string(-0.75 * std::cos(b)) + "\n";
  }
  const std::string rays = folder.write("rays.csv", text), model = data_file("torus.obj");
  REQUIRE(folder.run({"query", model, "--rays", rays, "-o", folder / "1.csv", "--threads", "1"}).status == 0);
  REQUIRE(folder.run({"query", model, "--rays", rays, "-o", folder / "4.csv", "--threads", "4"}).status == 0);
  CHECK(read_rows(folder / "1.csv").size() == 2001);
  CHECK(read_file(folder / "1.csv") == read_file(folder / "4.csv"));
}

TEST_CASE("eval writes positions, normals and derivatives", "[tools][cli]") {
  constexpr double h = 1e-4;
  const Folder folder;
  const std::string params = folder.write("params.csv",
                                          "face,sub,u,v\n3,0,0.3,0.6\n3,0,0.3001,0.6\n3,0,0.2999,0.6\n"
                                          "3,0,0.3,0.6001\n3,0,0.3,0.5999\n");
  const std::string output = folder / "out.csv";
  REQUIRE(folder.run({"eval", data_file("torus.obj"), "--params", params, "-o", output}).status == 0);
  const auto table = read_rows(output);
  REQUIRE(table.size() == 6);
  CHECK(table[0] == split(eval_header, ','));
  for (const auto& row : table) REQUIRE(row.size() == 25);

  const auto& row = table[1];
  CHECK((number(row[0]) == 3 && number(row[1]) == 0 && number(row[2]) == 0.3 && number(row[3]) == 0.6));
  const Vec3 du = vector_at(row, 10), dv = vector_at(row, 13);
  CHECK((vector_at(row, 7) - du.cross(dv).normalized()).norm() < 1e-12);
  // Central differences between the rows: their error is of the order h^2.
  const auto difference = [&](std::size_t plus, std::size_t minus, std::size_t column) {
    return Vec3((vector_at(table[plus], column) - vector_at(table[minus], column)) / (2 * h));
  };
  CHECK((difference(2, 3, 4) - du).norm() < 1e-7);
  CHECK((difference(4, 5, 4) - dv).norm() < 1e-7);
  CHECK((difference(2, 3, 10) - vector_at(row, 16)).norm() < 1e-7);  // duu
  CHECK((difference(4, 5, 10) - vector_at(row, 19)).norm() < 1e-7);  // duv
  CHECK((difference(4, 5, 13) - vector_at(row, 22)).norm() < 1e-7);  // dvv
}

TEST_CASE("eval at the place of a hit gives the hit", "[tools][cli]") {
  const Folder folder;
  const std::string model = data_file("cube_creases.obj");
  const std::string rays = folder.write("rays.csv", "0.1,0.2,5,0,0,-1\n4,3,2,-4,-3.1,-2.1\n");
  REQUIRE(folder.run({"query", model, "--rays", rays, "-o", folder / "hits.csv"}).status == 0);
  const auto hits = read_rows(folder / "hits.csv");
  REQUIRE(hits.size() == 3);
  std::string places;
  for (const std::size_t i : {1, 2}) {
    REQUIRE(hits[i].at(1) == "1");
    places += hits[i][3] + "," + hits[i][4] + "," + hits[i][5] + "," + hits[i][6] + "\n";
  }
  const std::string params = folder.write("params.csv", places);
  REQUIRE(folder.run({"eval", model, "--params", params, "-o", folder / "out.csv"}).status == 0);
  const auto samples = read_rows(folder / "out.csv");
  REQUIRE(samples.size() == 3);
  for (const std::size_t i : {1, 2}) {
    CHECK((vector_at(samples[i], 4) - vector_at(hits[i], 7)).norm() < 1e-9);
    CHECK((vector_at(samples[i], 7) - vector_at(hits[i], 10)).norm() < 1e-7);
  }
}

TEST_CASE("eval leaves fields empty where there is nothing to say", "[tools][cli]") {
  const Folder folder;
  const std::string model = folder.write("hole.obj", cube_text + "t hole 1/0/0 2\n");
  const std::string params = folder.write("params.csv", "0,0,0.5,0.25\n2,0,0.5,0.25\n0,0,0,0\n");
  const std::string output = folder / "out.csv";
  REQUIRE(folder.run({"eval", model, "--params", params, "-o", output}).status == 0);
  const auto table = read_rows(output);
  REQUIRE(table.size() == 4);
  for (const auto& row : table) REQUIRE(row.size() == 25);
  for (const std::string& field : table[1]) CHECK(!field.empty());
  // A hole: the parameters come back, nothing else.
  CHECK((table[2][0] == "2" && table[2][1] == "0" && number(table[2][2]) == 0.5 && number(table[2][3]) == 0.25));
  CHECK(all_empty(table[2], 4));
  // A vertex of valence 3: position and normal exist, derivatives do not.
  CHECK(vector_at(table[3], 7).norm() == Approx(1).epsilon(1e-14));
  CHECK(all_empty(table[3], 10));
}

TEST_CASE("a normal is empty where the surface has none", "[tools][cli]") {
  // A segment by its vertices, and a point by its positions.
  const Folder folder;
  const std::string model = folder.write("m.obj",
                                         "v 0 0 0\nv 1 0.3 0.2\nv 3 3 3\nv 3 3 3\nv 3 3 3\nv 3 3 3\nf 1 2 2\n"
                                         "f 3 4 5 6\nt scheme 0/0/1 catmark\n");
  const std::string params = folder.write("params.csv", "0,0,0.5,0.25\n0,1,0,0\n1,0,0.5,0.25\n1,0,0,0\n");
  const std::string output = folder / "out.csv", hits = folder / "hits.csv";
  REQUIRE(folder.run({"eval", model, "--params", params, "-o", output}).status == 0);
  const auto table = read_rows(output);
  REQUIRE(table.size() == 5);
  std::string rays;
  for (std::size_t row = 1; row < 5; ++row) {
    CHECK((table[row][7] + table[row][8] + table[row][9]).empty());
    const Vec3 p = vector_at(table[row], 4);
    rays += table[row][4] + ',' + table[row][5] + ',' + std::to_string(p.z() + 5) + ",0,0,-1\n";
  }
  REQUIRE(folder.run({"query", model, "--rays", folder.write("rays.csv", rays), "-o", hits}).status == 0);
  for (const auto& row : read_rows(hits)) {
    REQUIRE(row.size() == 16);
    if (row[0] == "ray") continue;
    CHECK(row[1] == "1");
    CHECK((row[10] + row[11] + row[12]).empty());
    CHECK(row[13] == "0");  // a point, or a segment, has no one crossing
    CHECK(row[15].empty());
  }
}

TEST_CASE("derivatives are numbers as near to a corner as a double can be", "[tools][cli]") {
  const Folder folder;
  const std::string params = folder.write("params.csv", "0,0,1e-308,1e-308\n0,0,5e-324,0\n0,0,1e-200,1e-200\n");
  const std::string output = folder / "out.csv";
  const auto is_number = [](const std::string& field) {
    return !field.empty() && std::isfinite(std::strtod(field.c_str(), nullptr));  // unlike stod, for tiny ones, too
  };
  const auto rows_of = [&](const std::string& model) {
    REQUIRE(folder.run({"eval", model, "--params", params, "-o", output}).status == 0);
    return read_rows(output);
  };
  const auto rows = rows_of(folder.write("cube.obj", cube_text));
  for (std::size_t row = 1; row < rows.size(); ++row)
    for (const std::string& field : rows[row]) CHECK(is_number(field));

  // 1e142 times as large as the face's sides, second derivatives are too large for any double.
  std::string large = cube_text;
  for (std::size_t at = 0; (at = large.find("1 ", at)) < large.find('f'); at += 2) large.insert(at + 1, "e300");
  for (std::size_t at = 0; (at = large.find("1\n", at)) < large.find('f'); at += 2) large.insert(at + 1, "e300");
  const auto emptied = rows_of(folder.write("large.obj", large));
  for (std::size_t row = 1; row < emptied.size(); ++row) {
    for (std::size_t column = 4; column < 16; ++column) CHECK(is_number(emptied[row].at(column)));
    CHECK(all_empty(emptied[row], 16));
  }
}

TEST_CASE("info counts what is in the file", "[tools][cli]") {
  const Folder folder;
  const std::string model =
      folder.write("model.obj", "v 5 5 5\n" + tetrahedron_text.substr(0, tetrahedron_text.find('f')) +
                                    "f 2 4 3\nf 2 3 5\nf 2 5 4\n");
  const Outcome outcome = folder.run({"info", model});
  REQUIRE(outcome.status == 0);
  std::set<std::string> lines;  // with single blanks
  for (const std::string& line : split(outcome.text, '\n')) {
    std::istringstream words(line);
    std::string word, squeezed;
    while (words >> word) squeezed += (squeezed.empty() ? "" : " ") + word;
    lines.insert(squeezed);
  }
  CAPTURE(outcome.text);
  for (const std::string expected :
       {"scheme loop (all faces are triangles)", "triangles 3", "boundary 3", "isolated 1", "on a boundary 3",
        "smooth 1", "crease 3", "parts that they all come to 3", "lower -1 -1 -1", "upper 5 5 5"})
    CHECK(lines.count(expected) == 1);
  CHECK(outcome.text.find("shaolin: warning: ") != std::string::npos);
}

}  // namespace shaolin::test
