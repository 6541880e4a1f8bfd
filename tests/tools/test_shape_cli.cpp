/// `shaolin inside`, `overlap`, `sweep` and `pick`: columns, both ways to give rows, and what is refused.
#include <cmath>

#include "tests/catch.h"
#include "tests/tools/cli_run.h"
#include "tests/tools/cube_text.h"

namespace shaolin::test {
namespace {

const std::string place = "face,sub,u,v,px,py,pz,nx,ny,nz";

/// A folder with the cube, which stays one under the bilinear scheme, and a scene with a second one at (9, 0, 0).
struct Files {
  Folder folder;
  std::string model = folder.write("cube.obj", cube_text), out = folder / "out.csv", again = folder / "again.csv";
  std::string scene = folder.write("scene.json",
                                   R"({"objects": {"box": {"model": "cube.obj", "scheme": "bilinear"}},
        "instances": [{"object": "box"}, {"object": "box", "transform": {"scale": [1, 2, 1], "translate": [9, 0, 0]}}]})");

  /// The rows that a command writes with these arguments after the model; the first are the columns.
  std::vector<std::vector<std::string>> rows(const std::string& command, std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {command, model, "--scheme", "bilinear"});
    arguments.insert(arguments.end(), {"-o", out});
    const Outcome outcome = folder.run(arguments);
    CAPTURE(arguments, outcome.text);
    REQUIRE(outcome.status == 0);
    return read_rows(out);
  }
};

std::string joined(const std::vector<std::string>& fields) {
  std::string text;
  for (const std::string& field : fields) text += (text.empty() ? "" : ",") + field;
  return text;
}

void check_numbers(const std::vector<std::string>& row, const std::vector<double>& expected) {
  REQUIRE(row.size() == expected.size());
  for (std::size_t i = 0; i < row.size(); ++i) {
    CAPTURE(i, row[i]);
    CHECK(std::abs(std::stod(row[i]) - expected[i]) < 1e-14);
  }
}

}  // namespace

TEST_CASE("inside tells which points are, and how far", "[tools][cli][shapes]") {
  const Files files;
  const auto rows = files.rows("inside", {"--point", "0.25,0.5,0", "--point", "3,0,0"});
  REQUIRE(rows.size() == 3);
  CHECK(joined(rows[0]) == "point,inside,signed_distance");
  check_numbers(rows[1], {0, 1, -0.5});
  check_numbers(rows[2], {1, 0, 2});
  const std::string points = files.folder.write("points.csv", "x,y,z\n0.25,0.5,0\n3,0,0\n");
  REQUIRE(
      files.folder.run({"inside", files.model, "--scheme", "bilinear", "--points", points, "-o", files.again}).status ==
      0);
  CHECK(read_file(files.again) == read_file(files.out));

  const std::string sheet = files.folder.write("sheet.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
  const Outcome open = files.folder.run({"inside", sheet, "--point", "0,0,0", "-o", files.out});
  CHECK(open.status == 3);
  CHECK(open.text.find("--point:1:") != std::string::npos);
}

TEST_CASE("overlap gives a point of the surface and the shape, for each kind of shape", "[tools][cli][shapes]") {
  const Files files;
  const auto spheres = files.rows("overlap", {"--sphere", "0.25,0.5,3,2.5", "--sphere", "9,9,9,1"});
  REQUIRE(spheres.size() == 3);
  CHECK(joined(spheres[0]) == "shape,overlaps," + place + ",sx,sy,sz");
  check_numbers(spheres[1], {0, 1, 0, 0, 0.625, 0.75, 0.25, 0.5, 1, 0, 0, 1, 0.25, 0.5, 1});
  CHECK(joined(spheres[2]) == "1,0" + std::string(13, ','));

  const auto boxes = files.rows(
      "overlap", {"--box", "0,0,2,0.5,0.5,1", "--box", "0,0,2,0.5,0.5,0.5", "--box", "0,0,2,1,1,0.75,1,0,0,45"});
  REQUIRE(boxes.size() == 4);
  CHECK(boxes[1][1] == "1");
  CHECK(boxes[2][1] == "0");
  CHECK(boxes[3][1] == "1");  // turned, it reaches down by 1.75 / sqrt(2)
  const auto capsules = files.rows("overlap", {"--capsule", "0,0,3,0,0,1.5,0.5", "--capsule", "0,0,3,0,0,1.5,0.4"});
  REQUIRE(capsules.size() == 3);
  CHECK(capsules[1][1] == "1");
  CHECK(capsules[2][1] == "0");
  const auto triangles =
      files.rows("overlap", {"--triangle", "0,0,0,3,0,0,0,0,0.5", "--triangle", "0,0,0,0.5,0,0,0,0,0.5"});
  REQUIRE(triangles.size() == 3);
  CHECK(triangles[1][1] == "1");
  CHECK(triangles[2][1] == "0");

  REQUIRE(files.folder.run({"overlap", files.scene, "--sphere", "9,5,0,4", "-o", files.out}).status == 0);
  const auto rows = read_rows(files.out);
  CHECK(rows[0].back() == "instance");
  CHECK(rows[1].back() == "1");
}

TEST_CASE("sweep gives the time and the place of the first contact", "[tools][cli][shapes]") {
  const Files files;
  const auto rows = files.rows(
      "sweep", {"--sphere", "0.25,0.5,4,0,0,-4,1", "--sphere", "0,0,4,0,0,-1,1", "--sphere", "0,0,1.5,0,0,1,1"});
  REQUIRE(rows.size() == 4);
  CHECK(joined(rows[0]) == "sphere,hit,t," + place + ",cx,cy,cz");
  check_numbers(rows[1], {0, 1, 0.5, 0, 0, 0.625, 0.75, 0.25, 0.5, 1, 0, 0, 1, 0.25, 0.5, 2});
  CHECK(joined(rows[2]) == std::string("1,0").append(14, ','));
  CHECK(rows[3][2] == "0");
  REQUIRE(files.folder.run({"sweep", files.scene, "--sphere", "9,5,0,0,-4,0,1", "-o", files.out}).status == 0);
  const auto scene = read_rows(files.out);
  CHECK(scene[0].back() == "instance");
  CHECK(scene[1].back() == "1");
  CHECK(std::abs(std::stod(scene[1][2]) - 0.5) < 1e-14);
}

TEST_CASE("pick lists the faces in rectangles and regions", "[tools][cli][shapes]") {
  const Files files;
  const auto rows = files.rows("pick", {"--camera", "0,0,9,0,0,0,40", "--size", "100x100", "--rectangle", "49,49,51,51",
                                        "--rectangle", "0,0,10,10"});
  // Through the middle, the front and the back.
  REQUIRE(rows.size() == 3);
  CHECK(joined(rows[0]) == "pick,face");
  CHECK(joined(rows[1]) == "0,0");
  CHECK(joined(rows[2]) == "0,1");
  const auto region = files.rows("pick", {"--side", "1,0,0,-1"});
  CHECK(region.size() == 1 + 5);  // all but the one at x = 1, by their edges
  const std::string sides = files.folder.write("sides.csv", "nx,ny,nz,offset\n1,0,0,0.5\n-1,0,0,0.5\n0,0,-1,-1\n");
  const auto strip = files.rows("pick", {"--sides", sides});
  CHECK(strip.size() == 1 + 3);
  REQUIRE(files.folder.run({"pick", files.scene, "--side", "-1,0,0,-10", "-o", files.out}).status == 0);
  const auto scene = read_rows(files.out);
  CHECK(joined(scene[0]) == "pick,face,instance");
  for (std::size_t i = 1; i < scene.size(); ++i) CHECK(scene[i].back() == "1");
}

TEST_CASE("Queries with shapes refuse bad rows with their place", "[tools][cli][shapes]") {
  const Files files;
  const auto refused = [&](const std::string& command, const std::string& option, const std::string& good,
                           const std::string& bad) {
    const std::string rows = files.folder.write("rows.csv", good + "\n" + bad + "\n");
    const Outcome outcome = files.folder.run({command, files.model, option, rows, "-o", files.out});
    CAPTURE(command, bad, outcome.text);
    CHECK(outcome.status == 3);
    CHECK(outcome.text.find(rows + ":2:") != std::string::npos);
    CHECK(!std::filesystem::exists(files.out));
  };
  for (const std::string bad : {"1,2", "1,2,nan", "1,2,up"}) refused("inside", "--points", "1,2,3", bad);
  for (const std::string bad : {"0,0,0,0", "0,0,0,-1", "0,0,0,nan", "0,0,0"})
    refused("overlap", "--spheres", "1,2,3,4", bad);
  for (const std::string bad : {"0,0,0,1,-1,1", "0,0,0,1,1,1,1", "0,0,0,1,1,1,0,0,0,30", "0,0,0,1,1,1,0,0,inf,30"})
    refused("overlap", "--boxes", "0,0,0,1,1,1", bad);
  refused("overlap", "--capsules", "0,0,0,1,1,1,1", "0,0,0,1,1,1,0");
  refused("overlap", "--triangles", "0,0,0,1,1,1,1,0,0", "0,0,0,1,1,1,1,0,nan");
  for (const std::string bad : {"0,0,0,1,1,1,0", "0,0,0,1,inf,1,1"})
    refused("sweep", "--spheres", "0,0,9,1,1,1,1", bad);
  for (const std::string bad : {"5,0,4,10", "0,0,900,10", "-1,0,4,10", "0,nan,4,10"})
    refused("pick", "--rectangles", "0,0,4,10", bad);
  for (const std::string bad : {"0,0,0,1", "1,0,0,nan"}) refused("pick", "--sides", "1,0,0,1", bad);
}

TEST_CASE("Queries with shapes know their usage", "[tools][cli][shapes]") {
  const Files files;
  const std::string rows = files.folder.write("rows.csv", "1,2,3,4\n");
  for (const std::vector<std::string>& line :
       {std::vector<std::string>{"inside", files.model, "-o", files.out},
        {"inside", files.model, "--point", "1,2", "-o", files.out},
        {"inside", files.model, "--point", "1,2,3"},
        {"overlap", files.model, "-o", files.out},
        {"overlap", files.model, "--sphere", "1,2,3,4", "--triangle", "1,2,3,4,5,6,7,8,9", "-o", files.out},
        {"overlap", files.model, "--sphere", "1,2,3,4", "--spheres", rows, "-o", files.out},
        {"overlap", files.model, "--box", "1,2,3,4", "-o", files.out},
        {"overlap", files.model, "--spheres", rows, "-o", rows},
        {"sweep", files.model, "--sphere", "1,2,3,4", "-o", files.out},
        {"sweep", files.model, "-o", files.out},
        {"pick", files.model, "-o", files.out},
        {"pick", files.model, "--side", "1,2,3,4", "--size", "9x9", "-o", files.out},
        {"pick", files.model, "--side", "1,2,3,4", "--rectangle", "1,2,3,4", "-o", files.out},
        {"pick", files.model, "--rectangle", "1,2,3,4", "--size", "big", "-o", files.out}}) {
    const Outcome outcome = files.folder.run(line);
    CAPTURE(line, outcome.text);
    CHECK(outcome.status == 2);
  }
}

TEST_CASE("Every query's command keeps to a memory budget, and says so", "[tools][cli]") {
  const Folder folder;
  const std::string points = folder.write("points.csv", "0.1,0.2,0.3\n0.8,0.1,0\n2,2,2\n-0.9,0.2,0.1\n");
  const std::string spheres = folder.write("spheres.csv", "0.1,0.2,0.3,1\n2,2,2,0.1\n");
  const std::string sweeps = folder.write("sweeps.csv", "0.1,0.2,3,0,0,-4,0.1\n3,0.1,0,-3,0,0,0.2\n");
  const std::string rectangles = folder.write("rectangles.csv", "300,200,420,360\n");
  const std::string model = data_file("rook.obj"), output = folder / "answers.csv";
  for (std::vector<std::string> command :
       std::vector<std::vector<std::string>>{{"closest", model, "--points", points},
                                             {"inside", model, "--points", points},
                                             {"overlap", model, "--spheres", spheres},
                                             {"sweep", model, "--spheres", sweeps},
                                             {"pick", model, "--rectangles", rectangles}}) {
    CAPTURE(command.front());
    command.insert(command.end(), {"-o", output});
    const auto plain = folder.run(command);
    REQUIRE(plain.status == 0);
    CHECK(plain.text.find("memory budget") == std::string::npos);
    const std::string all = read_file(output);
    command.insert(command.end(), {"--memory-budget", "0.001"});
    const auto kept = folder.run(command);
    REQUIRE(kept.status == 0);
    CHECK(read_file(output) == all);
    // A tree is held at least while a query is in it; all of them are more than that.
    const std::size_t at = kept.text.find("memory budget: ");
    REQUIRE(at != std::string::npos);
    CHECK(kept.text.find(" of 1049 bytes held, ", at) != std::string::npos);
    CHECK(kept.text.find(", 0 patches dropped", at) == std::string::npos);
  }
}

}  // namespace shaolin::test
