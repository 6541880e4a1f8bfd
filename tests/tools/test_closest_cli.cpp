/// `shaolin closest`: columns, both ways to give points, and what is refused.
#include <cmath>

#include "tests/catch.h"
#include "tests/tools/cli_run.h"
#include "tests/tools/cube_text.h"

namespace shaolin::test {
namespace {

const std::string header = "point,found,distance,face,sub,u,v,px,py,pz,nx,ny,nz";

}  // namespace

TEST_CASE("closest writes a row per point, from a file or from the command line", "[tools][cli][closest]") {
  const Folder folder;
  const std::string model = folder.write("cube.obj", cube_text), out = folder / "out.csv", again = folder / "again.csv";
  const std::string points = folder.write("points.csv", "x,y,z\n0.25,0.5,3\n-2,0.1,-0.2\n9,0,0\n");
  const Outcome outcome =
      folder.run({"closest", model, "--scheme", "bilinear", "--points", points, "--radius", "2.5", "-o", out});
  CAPTURE(outcome.text);
  REQUIRE(outcome.status == 0);
  const auto rows = read_rows(out);
  REQUIRE(rows.size() == 4);
  CHECK(read_file(out).find(header + "\n") == 0);
  const std::vector<double> expected{0, 1, 2, 0, 0, 0.625, 0.75, 0.25, 0.5, 1, 0, 0, 1};
  REQUIRE(rows[1].size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) CHECK(std::abs(std::stod(rows[1][i]) - expected[i]) < 1e-15);
  CHECK(rows[2][1] == "1");
  CHECK(rows[2][3] == "3");
  CHECK(rows[3][1] == "0");
  for (std::size_t i = 2; i < rows[3].size(); ++i) CHECK(rows[3][i].empty());

  REQUIRE(folder
              .run({"closest", model, "--scheme", "bilinear", "--point", "0.25,0.5,3", "--point", "-2,0.1,-0.2",
                    "--point", "9,0,0", "--radius", "2.5", "--threads", "1", "-o", again})
              .status == 0);
  CHECK(read_file(again) == read_file(out));
}

TEST_CASE("closest names the instance of a scene", "[tools][cli][closest][scenes]") {
  const Folder folder;
  folder.write("cube.obj", cube_text);
  const std::string out = folder / "out.csv",
                    scene = folder.write("scene.json",
                                         R"({"objects": {"box": {"model": "cube.obj", "scheme": "bilinear"}},
        "instances": [{"object": "box"}, {"object": "box", "transform": {"scale": [1, 2, 1], "translate": [9, 0, 0]}}]})");
  REQUIRE(folder.run({"closest", scene, "--point", "9,5,0", "-o", out}).status == 0);
  const auto rows = read_rows(out);
  REQUIRE(rows.size() == 2);
  CHECK(rows[0].back() == "instance");
  CHECK(rows[1].back() == "1");
  CHECK(std::abs(std::stod(rows[1][2]) - 3) < 1e-14);
}

TEST_CASE("closest refuses bad points with their place", "[tools][cli][closest]") {
  const Folder folder;
  const std::string model = folder.write("cube.obj", cube_text), out = folder / "out.csv";
  for (const std::string row : {"1,2", "1,2,3,4", "1,2,up", "1,,3", "1,nan,3", "1,2,inf"}) {
    const std::string points = folder.write("points.csv", "x,y,z\n1,2,3\n" + row + "\n");
    const Outcome outcome = folder.run({"closest", model, "--points", points, "-o", out});
    CAPTURE(row, outcome.text);
    CHECK(outcome.status == 3);
    CHECK(outcome.text.find(points + ":3:") != std::string::npos);
    CHECK(!std::filesystem::exists(out));
  }
  const std::string points = folder.write("points.csv", "z,y,x\n1,2,3\n");
  CHECK(folder.run({"closest", model, "--points", points, "-o", out}).status == 3);
  for (const std::vector<std::string>& line : {std::vector<std::string>{"closest", model, "-o", out},
                                               {"closest", model, "--point", "1,2,3"},
                                               {"closest", model, "--point", "1,2", "-o", out},
                                               {"closest", model, "--point", "1,2,inf", "-o", out},
                                               {"closest", model, "--point", "1,2,3", "--points", points, "-o", out},
                                               {"closest", model, "--point", "1,2,3", "--radius", "0", "-o", out},
                                               {"closest", model, "--point", "1,2,3", "--radius", "nan", "-o", out},
                                               {"closest", model, "--points", points, "-o", points}}) {
    const Outcome outcome = folder.run(line);
    CAPTURE(line, outcome.text);
    CHECK(outcome.status == 2);
  }
}

}  // namespace shaolin::test
