/// `render`, `query` and `info` with scene files.
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/catch.h"
#include "tests/tools/cli_run.h"
#include "tests/tools/exr_image.h"

namespace shaolin::test {
namespace {

const std::string plate_text = "v -1 0 -1\nv -1 0 1\nv 1 0 1\nv 1 0 -1\nf 1 2 3 4\n";

/// A path as a JSON string.
std::string json(const std::filesystem::path& path) { return nlohmann::json(path.string()).dump(); }

ExrImage render(const Folder& folder, const std::string& model, const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"render", model, "-o", folder / "out.exr"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Outcome outcome = folder.run(arguments);
  CAPTURE(outcome.text);
  REQUIRE(outcome.status == 0);
  return ExrImage(folder / "out.exr");
}

Vec3 color(const ExrImage& image, std::size_t i) {
  return {image.value("R", i), image.value("G", i), image.value("B", i)};
}

}  // namespace

TEST_CASE("A scene of one instance is the model's picture", "[tools][cli][scenes]") {
  const Folder folder;
  for (const std::string model : {"rook.obj", "whale.obj"}) {
    const std::string scene = folder.write("scene.json", R"({"objects": {"it": {"model": )" + json(data_file(model)) +
                                                             R"(}}, "instances": [{"object": "it"}]})");
    for (const std::vector<std::string>& more :
         {std::vector<std::string>{}, {"--camera", "-5,3.5,6,0.2,0.2,0,30"}, {"--uniform", "3"}}) {
      std::vector<std::string> options{"--size", "60x50"};
      options.insert(options.end(), more.begin(), more.end());
      const ExrImage alone = render(folder, data_file(model), options);
      ExrImage staged = render(folder, scene, options);
      REQUIRE(staged.channels.contains("instance"));
      for (std::size_t i = 0; i < staged.size(); ++i)
        CHECK(staged.id("instance", i) == (staged.id("face", i) == none ? none : 0));
      staged.channels.erase("instance");
      CHECK(alone.channels == staged.channels);
    }
  }
}

// The wall x = 0 reflects; beside it the same picture without a wall, of the world mirrored by it. The picture's up
// lies in the wall, so that the fill light is mirrored, too.
TEST_CASE("What a mirror shows is the mirrored world", "[tools][cli][scenes]") {
  const Folder folder;
  folder.write("plate.obj", plate_text);
  const auto scene = [&](const std::string& name, bool mirror) {
    const std::string side = mirror ? "1" : "-1";
    const std::string wall =
        R"({"object": "plate", "material": "mirror", "transform": {"scale": 20, "rotate": [0, 0, 1, 90]}},)";
    return folder.write(
        name, R"({"objects": {"plate": {"model": "plate.obj"}, "torus": {"model": )" + json(data_file("torus.obj")) +
                  R"(}, "rook": {"model": )" + json(data_file("rook.obj")) +
                  R"(}}, "materials": {"mirror": {"mirror": 1}, "red": {"colour": [0.8, 0.1, 0.1]}}, "instances": [)" +
                  (mirror ? wall : "") + R"({"object": "torus", "transform": [[)" + side + R"(, 0, 0, )" +
                  (mirror ? "3" : "-3") + R"(], [0, 0.8, 0.6, 0], [0, -0.6, 0.8, 0]]},
        {"object": "rook", "material": "red", "transform": [[)" +
                  side + R"(, 0, 0, )" + (mirror ? "2.5" : "-2.5") +
                  R"(], [0, 1, 0, 0], [0, 0, 1, -2]]}],
        "lights": [{"position": [)" +
                  (mirror ? "6" : "-6") + R"(, 9, 3]}],
        "background": [0.2, 0.4, 0.8], "camera": {"eye": [4, 0.5, 8], "target": [-2, 0.5, 0], "fov": 45}})");
  };
  const std::vector<std::string> size{"--size", "120x80"};
  const ExrImage reflected = render(folder, scene("mirror.json", true), size);
  const ExrImage direct = render(folder, scene("direct.json", false), size);
  std::size_t compared = 0, surfaces = 0, differ = 0;
  for (std::size_t i = 0; i < reflected.size(); ++i) {
    if (reflected.id("instance", i) != 0) continue;  // not the wall
    ++compared;
    const Vec3 a = color(reflected, i), b = color(direct, i);
    surfaces += direct.id("face", i) != none;
    differ += !((a - b).norm() < 2e-4);
  }
  CHECK(compared > 5000);
  CHECK(surfaces > 400);
  // Rays start a millionth of the scene off the wall: at outlines and shadows' edges a pixel may fall to the other
  // side.
  CHECK(differ <= 5);
}

TEST_CASE("Two mirrors face to face end after four reflections", "[tools][cli][scenes]") {
  const Folder folder;
  folder.write("plate.obj", plate_text);
  // Looking down at a mirror with another above the eye, at heights 0 and 4.
  const auto picture = [&](const std::string& mirror) {
    const std::string file =
        folder.write("scene.json", R"({"objects": {"plate": {"model": "plate.obj"}}, "materials": {
        "low": {"colour": [0.9, 0, 0], "mirror": )" +
                                       mirror + R"(}, "high": {"colour": [0, 0.9, 0], "mirror": )" + mirror +
                                       R"(}}, "instances": [
        {"object": "plate", "material": "low", "transform": {"scale": 50}},
        {"object": "plate", "material": "high", "transform": {"scale": 50, "translate": [0, 4, 0]}}],
        "lights": [{"position": [0, 2, 0], "colour": [0, 0, 0]}],
        "camera": {"eye": [0, 2, 0], "target": [0, 0, 0.1], "fov": 10}})");
    const ExrImage image = render(folder, file, {"--size", "1x1"});
    CHECK(image.id("instance", 0) == 0);
    return color(image, 0);
  };
  // low, high, low, high, and then low: its own colour.
  const Vec3 own = picture("0"), last = picture("1");
  CHECK(own.x() > 0.05);
  CHECK(own.y() == 0);
  CHECK((last - own).norm() < 1e-6);
  // A share of 1/2 each time: 1/2, 1/8 and 1/16 (the end of the chain, whose own colour is all of it) low, the rest
  // high.
  const Vec3 half = picture("0.5");
  CHECK(half.x() == Approx((0.5 + 0.125 + 0.0625) * own.x()).epsilon(1e-5));
  CHECK(half.y() > 0);
}

TEST_CASE("A scene's pixels do not depend on the number of threads", "[tools][cli][scenes]") {
  const Folder folder;
  const std::string scene = data_file("scenes/mirrors.json");
  const ExrImage one = render(folder, scene, {"--size", "120x80", "--threads", "1"});
  const ExrImage four = render(folder, scene, {"--size", "120x80", "--threads", "4"});
  CHECK(one.channels == four.channels);
  std::set<std::uint32_t> seen(one.channels.at("instance").begin(), one.channels.at("instance").end());
  CHECK(seen == std::set<std::uint32_t>{0, 1, 2, 3, 4, 5, 6, none});
}

TEST_CASE("Materials, lights and background colour the picture", "[tools][cli][scenes]") {
  const Folder folder;
  folder.write("plate.obj", plate_text);
  const std::string head =
      R"({"objects": {"plate": {"model": "plate.obj"}}, "materials": {"m": {"colour": [0.5, 0, 0]}},
    "camera": {"eye": [0, 5, 0], "target": [0, 0, 0], "fov": 40}, )";
  const auto picture = [&](const std::string& rest, const std::vector<std::string>& more) {
    return render(folder, folder.write("scene.json", head + rest + "}"), more);
  };
  const std::string one = R"("instances": [{"object": "plate", "material": "m"}])";
  const std::string lights = R"("lights": [{"position": [0, 90, 0.1], "colour": [1, 1, 1]}])";
  const ExrImage lit =
      picture(one + "," + lights + R"(, "background": [0, 0, 0.25])", {"--size", "64x64", "--png", folder / "a.png"});
  const std::size_t middle = 32 * 64 + 32;
  CHECK(color(lit, 0) == Vec3(0, 0, 0.25));
  CHECK(lit.value("A", 0) == 1);
  CHECK(lit.id("face", 0) == none);
  CHECK(lit.id("instance", middle) == 0);
  // A plate between the light and this one takes all of the light away, and leaves the fill.
  const std::string roof = R"("instances": [{"object": "plate", "material": "m"},
    {"object": "plate", "transform": {"scale": 2, "translate": [0, 8, 0]}}])";
  const ExrImage shaded = picture(roof + "," + lights, {"--size", "64x64"});
  const ExrImage dark =
      picture(one + R"(, "lights": [{"position": [0, 9, 0], "colour": [0, 0, 0]}])", {"--size", "64x64"});
  CHECK(color(shaded, middle) == color(dark, middle));
  // Incidence is 1, and the highlight is colourless: red gets 0.5 more than green.
  const Vec3 light = color(lit, middle) - color(dark, middle);
  CHECK(light.x() - light.y() == Approx(0.5).epsilon(1e-4));
  CHECK(shaded.value("A", 0) == 0);
  CHECK(color(shaded, 0) == Vec3(0, 0, 0));
  // --camera overrules.
  const ExrImage away = picture(one, {"--size", "8x8", "--camera", "0,5,0,0,9,0,30"});
  for (std::size_t i = 0; i < away.size(); ++i) CHECK(away.id("face", i) == none);
}

TEST_CASE("query names the instance of a scene's hits", "[tools][cli][scenes]") {
  const Folder folder;
  folder.write("plate.obj", plate_text);
  const std::string scene = folder.write("scene.json", R"({"objects": {
    "plate": {"model": "plate.obj"},
    "row": {"instances": [{"object": "plate"}, {"object": "plate", "transform": {"translate": [3, 0, 0]}}]}},
    "instances": [{"object": "row"}, {"object": "row", "transform": {"translate": [0, 1, 6], "scale": [1, -1, 1]}}]})");
  const std::string rays =
      folder.write("rays.csv", "0.5,5,0.25,0,-1,0\n3.5,5,0.25,0,-2,0\n0,5,6,0,-1,0\n3,5,6,0,-1,0\n9,5,9,0,-1,0\n");
  REQUIRE(folder.run({"query", scene, "--rays", rays, "-o", folder / "out.csv"}).status == 0);
  const auto table = read_rows(folder / "out.csv");
  REQUIRE(table.size() == 6);
  CHECK(table[0].back() == "instance");
  const std::vector<std::string> t{"5", "2.5", "4", "4"}, normal{"1", "1", "-1", "-1"};
  for (std::size_t i = 0; i < 4; ++i) {
    CAPTURE(i);
    REQUIRE(table[i + 1].size() == 17);
    CHECK(table[i + 1][2] == t[i]);
    CHECK(table[i + 1][11] == normal[i]);
    CHECK(table[i + 1][16] == std::to_string(i));
  }
  CHECK(table[5] == split("4,0,,,,,,,,,,,,,,,", ','));

  REQUIRE(folder.run({"query", scene, "--rays", rays, "-o", folder / "any.csv", "--any"}).status == 0);
  CHECK(read_rows(folder / "any.csv")[1] == split("0,1,,,,,,,,,,,,,,,", ','));
  REQUIRE(folder.run({"query", scene, "--rays", rays, "-o", folder / "out.csv", "--uniform", "2"}).status == 0);
  CHECK(read_rows(folder / "out.csv")[4].back() == "3");
}

TEST_CASE("info counts a scene's faces once and over its instances", "[tools][cli][scenes]") {
  const Folder folder;
  folder.write("plate.obj", plate_text);
  const std::string scene =
      folder.write("scene.json", R"({"objects": {"plate": {"model": "plate.obj"}, "torus": {"model": )" +
                                     json(data_file("torus.obj")) +
                                     R"(}, "unused": {"model": "plate.obj"},
    "row": {"instances": [{"object": "plate"}, {"object": "torus"}, {"object": "torus"}]}},
    "instances": [{"object": "row"}, {"object": "torus"}, {"object": "row"}]})");
  const Outcome outcome = folder.run({"info", scene});
  CAPTURE(outcome.text);
  REQUIRE(outcome.status == 0);
  const auto number_after = [&](const std::string& name) {
    const std::size_t at = outcome.text.find("  " + name + " ");
    REQUIRE(at != std::string::npos);
    return std::stoi(outcome.text.substr(at + 2 + name.size()));
  };
  CHECK(number_after("objects") == 3);
  CHECK(number_after("objects that are shown") == 2);
  CHECK(number_after("instances") == 7);
  CHECK(number_after("distinct, of objects that are shown") == 97);
  CHECK(number_after("over all instances") == 2 + 5 * 96);
  CHECK(outcome.text.find("torus                    catmark            96         96          5") != std::string::npos);
  CHECK(outcome.text.find("unused                   catmark             1          1          0") != std::string::npos);
}

TEST_CASE("--scheme is for all objects of a scene", "[tools][cli][scenes]") {
  const Folder folder;
  folder.write("plate.obj", plate_text);
  const std::string scene = folder.write(
      "scene.json", R"({"scheme": "catmark", "objects": {"plate": {"model": "plate.obj", "scheme": "catmark"}},
    "instances": [{"object": "plate"}]})");
  CHECK(folder.run({"info", scene, "--scheme", "bilinear"}).text.find("plate                    bilinear") !=
        std::string::npos);
  const Outcome loop = folder.run({"info", scene, "--scheme", "loop"});
  CHECK(loop.status == 3);
  CHECK(loop.text.find("/objects/plate/model: ") != std::string::npos);
}

TEST_CASE("Scenes that cannot be used exit with 3 and leave nothing", "[tools][cli][scenes]") {
  const Folder folder;
  const std::string scene =
      folder.write("scene.json", R"({"objects": {"plate": {"model": "no.obj"}}, "instances": [{"object": "plate"}]})");
  const std::string rays = folder.write("rays.csv", "0,0,5,0,0,-1\n");
  const auto before = folder.list();
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"info", scene},
                                                    {"render", scene, "-o", folder / "out.exr", "--size", "8x8"},
                                                    {"query", scene, "--rays", rays, "-o", folder / "out.csv"}}) {
    const Outcome outcome = folder.run(arguments);
    CAPTURE(arguments, outcome.text);
    CHECK(outcome.status == 3);
    CHECK(outcome.text.find(scene + ": /objects/plate/model: ") != std::string::npos);
  }
  const std::string empty = folder.write("empty.json", R"({"objects": {}, "instances": []})");
  const Outcome nothing = folder.run({"render", empty, "-o", folder / "out.exr", "--size", "8x8"});
  CHECK(nothing.status == 3);
  CHECK(nothing.text.find("nothing to frame") != std::string::npos);
  const Outcome eval = folder.run({"eval", empty, "--params", rays, "-o", folder / "out.csv"});
  CHECK(eval.status == 3);
  CHECK(eval.text.find("is a scene file; expected a model") != std::string::npos);
  std::filesystem::remove(empty);
  CHECK(folder.list() == before);
}

TEST_CASE("Pictures by chords look like the exact one", "[tools][cli][scenes]") {
  // With shadows and mirrors, whose rays start on chord faces and must not meet their neighbours.
  const Folder folder;
  for (const std::string scene : {"frogship.json", "mirrors.json"}) {
    const std::string file = data_file("scenes/" + scene);
    const std::vector<std::string> size{"--size", "96x72"};
    const ExrImage exact = render(folder, file, size);
    for (const std::string method : {"--chord", "--a3"}) {
      const ExrImage chords =
          render(folder, file, {"--size", "96x72", method, "0.002", "--min-size", "0.25", "--max-size", "4"});
      CAPTURE(scene, method);
      REQUIRE(chords.size() == exact.size());
      std::size_t differ = 0;
      double sum = 0;
      for (std::size_t i = 0; i < exact.size(); ++i) {
        const double difference = (color(chords, i) - color(exact, i)).norm();
        sum += difference;
        differ += difference > 0.05;
      }
      CHECK(sum / static_cast<double>(exact.size()) < 4e-3);
      CHECK(differ < exact.size() / 50);  // outlines of things and of shadows
    }
  }
}

}  // namespace shaolin::test
