/// `shaolin render`: the files that it writes, and what is in them.
#include <cmath>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/catch.h"
#include "tests/tools/cli_run.h"
#include "tests/tools/exr_image.h"

namespace shaolin::test {
namespace {

/// Width and height of a PNG file, by its first chunk.
std::pair<int, int> png_size(const std::filesystem::path& file) {
  const std::string bytes = read_file(file);
  REQUIRE(bytes.substr(0, 8) == "\x89PNG\r\n\x1a\n");
  const auto number = [&bytes](std::size_t at) {
    int value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes.at(at + i));
    return value;
  };
  return {number(16), number(20)};
}

}  // namespace

TEST_CASE("render writes all files, with all channels", "[tools][cli]") {
  const Folder folder;
  const Outcome outcome =
      folder.run({"render", data_file("cube_creases.obj"), "-o", folder / "out.exr", "--png", folder / "out.png",
                  "--png-level", folder / "level.png", "--size", "96x64", "--camera", "2,2.5,6,0,0,0,35"});
  CAPTURE(outcome.text);
  REQUIRE(outcome.status == 0);
  CHECK(folder.list() == std::set<std::string>{"level.png", "out.exr", "out.png"});
  CHECK(png_size(folder / "out.png") == std::pair(96, 64));
  const auto [level_width, level_height] = png_size(folder / "level.png");
  CHECK((level_width > 96 && level_height >= 64));  // the legend stands beside the image

  const ExrImage image(folder / "out.exr");
  CHECK((image.width == 96 && image.height == 64));
  std::map<std::string, Imf::PixelType> types;
  for (const char* name : {"R", "G", "B", "A", "Z", "N.X", "N.Y", "N.Z", "P.X", "P.Y", "P.Z", "uv.U", "uv.V"})
    types[name] = Imf::FLOAT;
  types["face"] = types["level"] = Imf::UINT;
  CHECK(image.types == types);
}

TEST_CASE("render's channels hold the hits", "[tools][cli]") {
  const Folder folder;
  const Vec3 eye(2, 2.5, 6);
  REQUIRE(folder
              .run({"render", data_file("cube_creases.obj"), "-o", folder / "out.exr", "--size", "96x64", "--camera",
                    "2,2.5,6,0,0,0,35"})
              .status == 0);
  const ExrImage image(folder / "out.exr");
  std::size_t hits = 0, wrong = 0;
  for (std::size_t i = 0; i < image.size(); ++i) {
    if (image.id("face", i) == none) {
      wrong += image.value("A", i) != 0 || image.id("level", i) != none || !std::isinf(image.value("Z", i));
      continue;
    }
    ++hits;
    const Vec3 position = image.vector("P", i), normal = image.vector("N", i);
    const float u = image.value("uv.U", i), v = image.value("uv.V", i);
    wrong += image.value("A", i) != 1 || image.id("face", i) > 5 || image.id("level", i) > 100;
    wrong += std::abs((position - eye).norm() - image.value("Z", i)) > 1e-5;
    wrong += std::abs(normal.norm() - 1) > 1e-6 || normal.dot(position - eye) > 1e-5;  // the cube's faces look outward
    wrong += !(0 <= u && u <= 1 && 0 <= v && v <= 1) || !(image.value("R", i) > 0);
  }
  CHECK(wrong == 0);
  CHECK((hits > image.size() / 20 && hits < image.size() / 2));
}

TEST_CASE("render's statistics add up", "[tools][cli]") {
  const Folder folder;
  REQUIRE(folder
              .run({"render", data_file("cube_creases.obj"), "-o", folder / "out.exr", "--stats", folder / "stats.json",
                    "--size", "96x64"})
              .status == 0);
  const ExrImage image(folder / "out.exr");
  std::size_t hits = 0;
  for (const std::uint32_t face : image.channels.at("face")) hits += face != none;
  const auto stats = nlohmann::json::parse(read_file(folder / "stats.json"));
  CHECK(stats["image"]["width"] == 96);
  CHECK(stats["image"]["height"] == 64);
  CHECK(stats["image"]["pixels_hit"] == hits);
  CHECK(stats["scheme"] == "catmark");
  CHECK(stats["threads"] >= 1);
  CHECK(stats["peak_memory_bytes"] > 1000000);
  const auto& seconds = stats["seconds"];
  double sum = 0;
  for (const char* part : {"load", "build", "render", "write"}) sum += seconds[part].get<double>();
  CHECK(seconds["total"].get<double>() == Approx(sum));
  const auto& counts = stats["statistics"];
  CHECK(counts["rays"] >= image.size());
  CHECK(counts["hits"] >= hits);
  CHECK(counts["faces_never_touched"].get<int>() + counts["faces_touched"].get<int>() == counts["faces"].get<int>());
  for (const char* name : {"patches_split", "hull_tests", "cells", "newton_steps", "bytes"})
    CHECK(counts.contains(name));
}

TEST_CASE("render's pixels do not depend on the number of threads", "[tools][cli]") {
  const Folder folder;
  const auto render = [&](const std::string& name, const std::string& threads) {
    REQUIRE(folder
                .run({"render", data_file("torus.obj"), "-o", folder / name, "--png-level", folder / (name + ".png"),
                      "--size", "150x100", "--threads", threads})
                .status == 0);
    return ExrImage(folder / name);
  };
  const ExrImage one = render("1.exr", "1"), four = render("4.exr", "4");
  CHECK(one.channels == four.channels);
  CHECK(read_file(folder / "1.exr.png") == read_file(folder / "4.exr.png"));
}

TEST_CASE("the default camera frames the model", "[tools][cli]") {
  const Folder folder;
  for (const std::string size : {"100x100", "160x60", "60x160"}) {
    CAPTURE(size);
    REQUIRE(folder.run({"render", data_file("torus.obj"), "-o", folder / "out.exr", "--size", size}).status == 0);
    const ExrImage image(folder / "out.exr");
    std::size_t hits = 0, border_hits = 0;
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        const bool hit = image.id("face", static_cast<std::size_t>(y) * image.width + x) != none;
        hits += hit;
        border_hits += hit && (x == 0 || y == 0 || x == image.width - 1 || y == image.height - 1);
      }
    }
    CHECK(border_hits == 0);
    const int side = std::min(image.width, image.height);
    CHECK(hits > static_cast<std::size_t>(side) * side / 10);
  }
}

TEST_CASE("A model without a limit surface needs a camera", "[tools][cli][render]") {
  const Folder folder;
  const std::string model = folder.write("hole.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nt hole 1/0/0 0\n");
  const Outcome without = folder.run({"render", model, "-o", folder / "a.exr", "--size", "8x8"});
  CHECK(without.status == 3);
  CHECK(without.text.find("no face has a limit surface") != std::string::npos);
  CHECK(folder.list() == std::set<std::string>{"hole.obj"});
  CHECK(folder.run({"render", model, "-o", folder / "a.exr", "--size", "8x8", "--camera", "0,0,5,0,0,0,30"}).status ==
        0);
}

TEST_CASE("render counts what chords do", "[tools][cli]") {
  const Folder folder;
  const auto counts = [&](const std::vector<std::string>& method) {
    std::vector<std::string> line{"render",  data_file("rook.obj"), "-o", folder / "out.exr", "--size", "40x40",
                                  "--stats", folder / "stats.json"};
    line.insert(line.end(), method.begin(), method.end());
    const Outcome outcome = folder.run(line);
    CAPTURE(outcome.text);
    REQUIRE(outcome.status == 0);
    return nlohmann::json::parse(read_file(folder / "stats.json"))["statistics"];
  };
  const auto chord = counts({"--chord", "0.01"}), a3 = counts({"--a3", "0.01"}), exact = counts({});
  for (const char* name : {"chord_tests", "gap_polygons", "border_areas_hit", "invalid_patches"}) {
    CAPTURE(name);
    CHECK(chord.at(name) > 0);
    CHECK(exact.at(name) == 0);
  }
  CHECK(a3.at("chord_tests") > 0);
  CHECK(a3.at("gap_polygons") == 0);
  CHECK(chord.at("depth_bounds") == 0);
}

TEST_CASE("A memory budget for all objects of a scene costs work, not a pixel", "[tools][cli]") {
  const Folder folder;
  nlohmann::json stats;
  const auto picture = [&](const std::vector<std::string>& more) {
    std::vector<std::string> line{"render",  data_file("scenes/mirrors.json"),
                                  "-o",      folder / "out.exr",
                                  "--size",  "60x40",
                                  "--stats", folder / "stats.json"};
    line.insert(line.end(), more.begin(), more.end());
    const Outcome outcome = folder.run(line);
    CAPTURE(outcome.text);
    REQUIRE(outcome.status == 0);
    stats = nlohmann::json::parse(read_file(folder / "stats.json"))["statistics"];
    return ExrImage(folder / "out.exr");
  };
  const ExrImage all = picture({});
  const auto kept = stats;
  CHECK(kept.at("patches_evicted") == 0);
  const ExrImage some = picture({"--memory-budget", "0.05", "--threads", "2"});
  CHECK(some.channels == all.channels);
  CHECK(stats.at("patches_evicted") > 0);
  CHECK(stats.at("faces_touched") == kept.at("faces_touched"));
  CHECK(stats.at("patches_split") > kept.at("patches_split"));
  CHECK(stats.at("bytes") < kept.at("bytes"));
  const ExrImage much = picture({"--memory-budget", "1e300"});
  CHECK(much.channels == all.channels);
  CHECK(stats.at("patches_evicted") == 0);
}

TEST_CASE("Chord faces are shaded on the side and in the light of the surface", "[tools][cli]") {
  const Folder folder;
  const auto picture = [&](const std::vector<std::string>& method) {
    std::vector<std::string> arguments{"render", data_file("rook.obj"), "-o", folder / "out.exr", "--size", "96x96"};
    arguments.insert(arguments.end(), method.begin(), method.end());
    REQUIRE(folder.run(arguments).status == 0);
    return ExrImage(folder / "out.exr");
  };
  const ExrImage exact = picture({}), chords = picture({"--chord", "0.01"});
  std::size_t alike = 0, lit_otherwise = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    if (exact.id("face", i) == none || chords.id("face", i) == none) continue;
    if (exact.vector("N", i).dot(chords.vector("N", i)) < 0.985) continue;  // 10 degrees; creases are smeared
    ++alike;
    lit_otherwise += std::abs(exact.value("G", i) - chords.value("G", i)) > 0.1;
  }
  CHECK(alike > 1500);
  CHECK(lit_otherwise < 15);  // on the edges of shadows
}

TEST_CASE("render says what is wrong with a tolerance or a budget", "[tools][cli]") {
  const Folder folder;
  const auto refused = [&](const std::vector<std::string>& method, const std::string& why) {
    std::vector<std::string> line{"render", data_file("rook.obj"), "-o", folder / "out.exr", "--size", "8x8"};
    line.insert(line.end(), method.begin(), method.end());
    const Outcome outcome = folder.run(line);
    CAPTURE(method, outcome.text);
    CHECK(outcome.status == 2);
    CHECK(outcome.text.find(why) != std::string::npos);
    CHECK(folder.list().empty());
  };
  for (const std::string value : {"nan", "0", "-1", "inf", "abc"})
    for (const std::string method : {"--chord", "--a3"})
      refused({method, value}, "'" + value + "' is not a number above 0");
  refused({"--chord", "1", "--min-size", "nan"}, "'nan' is not a number from 0 on");
  refused({"--chord", "1", "--min-size", "3", "--max-size", "2"}, "--max-size: is smaller than --min-size");
  refused({"--min-size", "3"}, "--min-size and --max-size need --chord or --a3");
  refused({"--uniform", "3", "--max-size", "3"}, "--min-size and --max-size need --chord or --a3");
  refused({"--chord", "1", "--a3", "1"}, "excludes");
  for (const std::string value : {"nan", "0", "-1", "inf", "abc"})
    refused({"--memory-budget", value}, "'" + value + "' is not a number above 0");
  refused({"--memory-budget", "1", "--uniform", "3"}, "excludes");
  const Outcome fine =
      folder.run({"render", data_file("rook.obj"), "-o", folder / "out.exr", "--size", "8x8", "--chord", "0.01",
                  "--min-size", "30"});  // more than the largest size that nobody gave
  CAPTURE(fine.text);
  CHECK(fine.status == 0);
}

TEST_CASE("render does not write a picture under another format's name", "[tools][cli]") {
  const Folder folder;
  const auto refused = [&](const std::vector<std::string>& outputs, const std::string& why) {
    std::vector<std::string> line{"render", data_file("torus.obj"), "--size", "8x8"};
    line.insert(line.end(), outputs.begin(), outputs.end());
    const Outcome outcome = folder.run(line);
    CAPTURE(outcome.text);
    CHECK(outcome.status == 2);
    CHECK(outcome.text.find(why) != std::string::npos);
    CHECK(folder.list().empty());
  };
  refused({"-o", folder / "a.PNG"}, "a.PNG' would be an OpenEXR file; see --png");
  refused({"-o", folder / "a.exr", "--png", folder / "b.exr"}, "b.exr' would be a PNG file; see -o");
  refused({"-o", folder / "a.exr", "--png-level", folder / "b.exr"}, "b.exr' would be a PNG file; see -o");
}

}  // namespace shaolin::test
