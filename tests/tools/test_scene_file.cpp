/// Scene files: what they mean, and what is said of those that cannot be used.
#include <cmath>

#include "schemes/builtin.h"
#include "schemes/errors.h"
#include "tests/catch.h"
#include "tests/tools/cli_run.h"
#include "tests/tools/cube_text.h"
#include "tools/cli/json_text.h"
#include "tools/cli/scene_file.h"
#include "tools/cli/stage.h"

namespace shaolin::test {
namespace {

/// A scene whose members are these, each a key with its value.
std::string scene_of(const std::string& instances, const std::string& more = "") {
  return R"({"objects": {"cube": {"model": "cube.obj"}}, "instances": [)" + instances + "]" +
         (more.empty() ? "" : ", " + more) + "}";
}

/// What reading says of a scene's text, models included; without the file's name.
std::string complaint(const std::string& text) {
  const Folder folder;
  folder.write("cube.obj", cube_text);
  const std::string file = folder.write("scene.json", text);
  try {
    Stage stage = load_stage({file, {}, {}});
    build_scene(stage);
  } catch (const InputError& error) {
    const std::string what = error.what();
    CHECK(what.find(file + ":") == 0);
    return what.substr(std::min(what.size(), file.size() + 1));
  }
  return "nothing";
}

void check_complaint(const std::string& text, const std::string& expected) {
  const std::string said = complaint(text);
  CAPTURE(text, said, expected);
  CHECK(said.find(expected) != std::string::npos);
}

SceneFile read(const std::string& text) {
  const Folder folder;
  return read_scene_file(folder.write("scene.json", text));
}

/// Of the one instance with that transform.
Affine transform_of(const std::string& transform) {
  return read(scene_of(R"({"object": "cube", "transform": )" + transform + "}")).instances.at(0).transform;
}

}  // namespace

TEST_CASE("A transform scales, turns and moves, in this order", "[tools][scenes]") {
  const Affine map = transform_of(R"({"translate": [1, 2, 3], "rotate": [0, 0, 5, 90], "scale": [2, 3, 4]})");
  CHECK((map * Vec3(1, 0, 0) - Vec3(1, 4, 3)).norm() < 1e-15);
  CHECK((map * Vec3(0, 1, 0) - Vec3(-2, 2, 3)).norm() < 1e-15);
  CHECK((map * Vec3(0, 0, 1) - Vec3(1, 2, 7)).norm() < 1e-15);
  CHECK(transform_of(R"({"scale": -2})").linear() == -2 * Eigen::Matrix3d::Identity());
  CHECK(transform_of("{}").matrix() == Affine::Identity().matrix());
  Eigen::Matrix<double, 3, 4> rows;
  rows << 1, 2, 0, 4, 0, 1, 0, 5, 0, 3, 1, 6;
  CHECK(transform_of("[[1, 2, 0, 4], [0, 1, 0, 5], [0, 3, 1, 6]]").matrix() == rows);
}

TEST_CASE("Groups are dissolved in place, inner materials win", "[tools][scenes]") {
  const SceneFile scene = read(R"({
    "objects": {
      "outer": {"instances": [
        {"object": "pair", "transform": {"translate": [0, 10, 0]}},
        {"object": "b"}]},
      "pair": {"instances": [
        {"object": "a", "material": "red", "transform": {"translate": [1, 0, 0]}},
        {"object": "a", "transform": {"translate": [2, 0, 0]}}]},
      "a": {"model": "a.obj"},
      "b": {"model": "sub/b.obj", "scheme": "loop"}
    },
    "scheme": "bilinear",
    "materials": {"red": {"colour": [1, 0, 0]}, "blue": {"colour": [0, 0, 1], "mirror": 0.5}},
    "instances": [
      {"object": "b"},
      {"object": "outer", "material": "blue", "transform": {"scale": 2}},
      {"object": "pair"}
    ]})");
  REQUIRE(scene.objects.size() == 2);
  CHECK(scene.objects[0].name == "a");
  CHECK(scene.objects[0].scheme == "bilinear");
  CHECK(scene.objects[1].scheme == "loop");
  CHECK(scene.objects[1].model.filename() == "b.obj");
  CHECK(scene.objects[1].model.parent_path().filename() == "sub");
  const std::vector<std::size_t> objects{1, 0, 0, 1, 0, 0};
  const std::vector<Vec3> places{{0, 0, 0}, {2, 20, 0}, {4, 20, 0}, {0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  const Vec3 own = Material().color, red(1, 0, 0), blue(0, 0, 1);
  const std::vector<Vec3> colors{own, red, blue, blue, red, own};
  REQUIRE(scene.instances.size() == objects.size());
  for (std::size_t i = 0; i < objects.size(); ++i) {
    CAPTURE(i);
    CHECK(scene.instances[i].object == objects[i]);
    CHECK(scene.instances[i].transform.translation() == places[i]);
    CHECK(scene.look.material(static_cast<int>(i)).color == colors[i]);
  }
  CHECK(scene.look.material(2).mirror == 0.5);
  CHECK(!scene.camera);
  CHECK(!scene.look.background);
  CHECK(scene.look.lights.empty());
}

TEST_CASE("Camera, lights and background", "[tools][scenes]") {
  const SceneFile scene = read(scene_of("", R"("camera": {"eye": [0, 0, 5], "target": [0, 0, 0], "up": [1, 0, 0]},
    "lights": [{"position": [1, 2, 3]}, {"position": [4, 5, 6], "colour": [2, 0, 0.5]}], "background": [0, 0.5, 1])"));
  REQUIRE(scene.camera);
  CHECK(scene.camera->eye == Vec3(0, 0, 5));
  CHECK(scene.camera->fov == 40);
  CHECK(View(*scene.camera, {10, 10}).up().isApprox(Vec3::UnitX()));
  const Camera again = parse_camera(to_string(*scene.camera));
  CHECK((again.up == Vec3(1, 0, 0) && again.eye == scene.camera->eye));
  REQUIRE(scene.look.lights.size() == 2);
  CHECK(scene.look.lights[0].color == Vec3(1, 1, 1));
  CHECK(scene.look.lights[1].position == Vec3(4, 5, 6));
  CHECK(*scene.look.background == Vec3(0, 0.5, 1));
}

TEST_CASE("A scene's errors name the JSON path", "[tools][scenes]") {
  const std::string one = R"({"object": "cube"})";
  CHECK(complaint(scene_of(one)) == "nothing");
  check_complaint("[]", " /: is an array; expected an object");
  check_complaint(R"({"instances": []})", " /: the key 'objects' is missing");
  check_complaint(R"({"objects": {}})", " /: the key 'instances' is missing");
  check_complaint(R"({"objects": {}, "instances": [{"object": "cube"}]})",
                  " /instances/0/object: unknown object 'cube'; "
                  "expected none, as there are none");
  check_complaint(scene_of(one, R"("light": [])"), " /light: unknown key; expected one of scheme, objects, materials");
  check_complaint(scene_of(one + R"(, {"objekt": "cube"})"),
                  " /instances/1/objekt: unknown key; expected one of object");
  check_complaint(scene_of("{}"), " /instances/0: the key 'object' is missing");
  check_complaint(scene_of("3"), " /instances/0: is a number; expected an object");
  check_complaint(scene_of(R"({"object": 3})"), " /instances/0/object: is a number; expected a string");
  check_complaint(scene_of(R"({"object": "tube"})"), " /instances/0/object: unknown object 'tube'; expected 'cube'");
  check_complaint(scene_of(R"({"object": "cube", "material": "wood"})", R"("materials": {"stone": {}})"),
                  " /instances/0/material: unknown material 'wood'; expected 'stone'");
  check_complaint(scene_of(one, R"("scheme": "doo-sabin")"), " /scheme: unknown scheme 'doo-sabin'; expected ");

  check_complaint(R"({"objects": {"a/b~": 1}, "instances": []})", " /objects/a~1b~0: is a number; expected an object");
  check_complaint(R"({"objects": {"a": {}}, "instances": []})", " /objects/a: has neither 'model' nor 'instances'");
  check_complaint(R"({"objects": {"a": {"model": "cube.obj", "instances": []}}, "instances": []})",
                  " /objects/a/model: unknown key; expected one of instances");
  check_complaint(R"({"objects": {"a": {"model": "none.obj"}}, "instances": []})", " /objects/a/model: ");
  check_complaint(R"({"objects": {"a": {"model": "none.obj"}}, "instances": []})", "none.obj: no such file");
  check_complaint(R"({"objects": {"a": {"model": "scene.json"}}, "instances": []})", "scene.json: is a scene file");
  check_complaint(R"({"objects": {"a": {"model": "cube.obj", "scheme": "loop"}}, "instances": []})",
                  "cube.obj:9: face 0 has 4 corners");
  check_complaint(R"({"objects": {"a": {"model": "cube.obj", "scheme": "lop"}}, "instances": []})",
                  " /objects/a/scheme: unknown scheme 'lop'");
}

TEST_CASE("A scene's numbers are checked where they stand", "[tools][scenes]") {
  const auto material = [](const std::string& text) { return scene_of("", R"("materials": {"m": )" + text + "}"); };
  check_complaint(material(R"({"colour": [0, 1.5, 0]})"),
                  " /materials/m/colour/1: is 1.5; expected a number from 0 to 1");
  check_complaint(material(R"({"colour": [0, 0, -0.1]})"), " /materials/m/colour/2: is -0.1; expected a number from 0");
  check_complaint(material(R"({"colour": [0, 0]})"), " /materials/m/colour: has 2 elements; expected an array of 3");
  check_complaint(material(R"({"colour": "red"})"), " /materials/m/colour: is a string; expected an array of 3");
  check_complaint(material(R"({"colour": [0, null, 0]})"), " /materials/m/colour/1: is null; expected a number");
  check_complaint(material(R"({"color": [0, 0, 0]})"),
                  " /materials/m/color: unknown key; expected one of colour, mirror");
  check_complaint(material(R"({"mirror": 1.01})"), " /materials/m/mirror: is 1.01; expected a number from 0 to 1");
  check_complaint(material(R"({"mirror": true})"), " /materials/m/mirror: is a boolean; expected a number");
  check_complaint(scene_of("", R"("background": [0, 0, -1])"),
                  " /background/2: is -1; expected a number of at least 0");
  check_complaint(scene_of("", R"("lights": [{"colour": [1, 1, 1]}])"), " /lights/0: the key 'position' is missing");
  check_complaint(scene_of("", R"("lights": [{"position": [1, 1, 1], "colour": [-1, 0, 0]}])"),
                  " /lights/0/colour/0: ");

  const auto camera = [](const std::string& text) { return scene_of("", R"("camera": )" + text); };
  check_complaint(camera(R"({"eye": [0, 0, 0]})"), " /camera: the key 'target' is missing");
  check_complaint(camera(R"({"eye": [1, 0, 0], "target": [1, 0, 0]})"), " /camera: the target must lie apart");
  check_complaint(camera(R"({"eye": [1, 0, 0], "target": [0, 0, 0], "fov": 180})"),
                  " /camera: fov, the vertical angle");
  check_complaint(camera(R"({"eye": [1, 0, 0], "target": [0, 0, 0], "up": [0, 0, 0]})"), " /camera: up must be");

  const auto placed = [](const std::string& text) {
    return scene_of(R"({"object": "cube", "transform": )" + text + "}");
  };
  const std::string at = " /instances/0/transform";
  check_complaint(placed("[[1, 0, 0, 0], [0, 1, 0, 0], [0, 1, 0, 0]]"), at + ": the transform is singular");
  check_complaint(placed("[[1, 2, 3, 0], [4, 5, 6, 0], [7, 8, 9, 0]]"), at + ": the transform is singular to rounding");
  check_complaint(placed(R"({"scale": 0})"), at + ": the transform is singular");
  check_complaint(placed(R"({"scale": [1, 0, 1]})"), at + ": the transform is singular");
  check_complaint(placed(R"({"rotate": [0, 0, 0, 90]})"), at + "/rotate: the axis is zero");
  check_complaint(placed(R"({"rotate": [0, 0, 1]})"), at + "/rotate: has 3 elements; expected an array of 4");
  check_complaint(placed(R"({"shear": 1})"), at + "/shear: unknown key; expected one of scale, rotate, translate");
  check_complaint(placed("[[1, 0, 0, 0], [0, 1, 0, 0]]"), at + ": has 2 elements; expected an array of 3");
  check_complaint(placed("[[1, 0, 0, 0], [0, 1, 0], [0, 0, 1, 0]]"), at + "/1: has 3 elements; expected an array of 4");
  check_complaint(placed("7"), at + ": is a number; expected an object");
}

TEST_CASE("Syntax errors have line and column", "[tools][scenes]") {
  check_complaint("{\n  \"objects\": {},\n  \"instances\": [1 2]\n}\n", "3: column 19: syntax error");
  check_complaint("", "1: column 1: syntax error");
  check_complaint("{\"objects\": {}", "1: column 15: syntax error");
  check_complaint("{} // a comment\n", "1: column 4: ");
  check_complaint("\n{\"objects\": {}, \"instances\": [NaN]}", "2: column ");
  check_complaint("{\"objects\": {},\n \"background\": [0, 1e999, 0]}", "2: column ");
  check_complaint("{\"objects\": {},\n \"background\": [0, 1e999, 0]}", "1e999");
  check_complaint("{\"objects\": {\"a\": {\"model\": \"x\", \"model\": \"y\"}}, \"instances\": []}",
                  " /objects/a/model: this key stands twice");
  check_complaint(R"({"instances": [[], {}, {"x": 1, "x": 2}], "objects": {}})",
                  " /instances/2/x: this key stands twice");
}

TEST_CASE("Groups that contain themselves are named", "[tools][scenes]") {
  check_complaint(R"({"objects": {"a": {"instances": [{"object": "a"}]}}, "instances": []})",
                  " /objects/a/instances/0/object: a group contains itself: 'a' > 'a'");
  check_complaint(R"({"objects": {
      "a": {"instances": [{"object": "b"}]},
      "b": {"instances": [{"object": "d"}, {"object": "c"}]},
      "c": {"instances": [{"object": "d"}, {"object": "b"}]},
      "d": {"model": "cube.obj"}}, "instances": []})",
                  " /objects/c/instances/1/object: a group contains itself: 'b' > 'c' > 'b'");
  check_complaint(R"({"objects": {"a": {"instances": [{"object": "lost"}]}}, "instances": []})",
                  " /objects/a/instances/0/object: unknown object 'lost'; expected 'a'");

  // Each level ten times the one before: 10^12 instances, even if the innermost group is empty.
  for (const std::string innermost : {R"({"model": "cube.obj"})", R"({"instances": []})"}) {
    std::string objects = R"("g0": )" + innermost;
    for (int level = 1; level <= 12; ++level) {
      const std::string inner = R"({"object": "g)" + std::to_string(level - 1) + "\"}";
      objects += ", \"g" + std::to_string(level) + R"(": {"instances": [)" + inner;
      for (int i = 1; i < 10; ++i) objects += ", " + inner;
      objects += "]}";
    }
    check_complaint(R"({"objects": {)" + objects + R"(}, "instances": [{"object": "g12"}]})",
                    ": the scene has more than 10000000 instances");
  }

  std::string chain = R"("g0": {"model": "cube.obj"})";
  for (int level = 1; level <= 5000; ++level)
    chain +=
        ", \"g" + std::to_string(level) + R"(": {"instances": [{"object": "g)" + std::to_string(level - 1) + "\"}]}";
  check_complaint(R"({"objects": {)" + chain + R"(}, "instances": []})", ": groups are nested deeper than 256 levels");
}

TEST_CASE("The scenes of data/ can be used", "[tools][scenes]") {
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(data_file("scenes"))) {
    if (!is_scene_file(entry.path()) || entry.path().filename() == "schema.json") continue;
    CAPTURE(entry.path());
    Stage stage = load_stage({entry.path(), {}, {}});
    CHECK(stage.is_scene);
    const std::size_t count = stage.scene.instances.size();
    CHECK(count > 0);
    CHECK(stage.scene.look.of_instance.size() == count);
    CHECK(build_scene(stage).instances().size() == count);
    ++scenes;
  }
  CHECK(scenes > 0);
}

TEST_CASE("The JSON Schema knows our schemes", "[tools][scenes]") {
  const Json schema = read_json(data_file("scenes/schema.json"));
  std::set<std::string> ours;
  for (const BuiltinScheme& scheme : builtin_schemes()) ours.insert(scheme.name);
  CHECK(schema["$defs"]["scheme"]["enum"].get<std::set<std::string>>() == ours);
}

TEST_CASE("Transforms that are singular together are refused", "[tools][scenes]") {
  std::string objects = R"("g0": {"model": "cube.obj"})";
  for (int level = 1; level <= 4; ++level)
    objects += ", \"g" + std::to_string(level) + R"(": {"instances": [{"object": "g)" + std::to_string(level - 1) +
               R"(", "transform": {"scale": 1e-90}}]})";
  check_complaint(R"({"objects": {)" + objects + R"(}, "instances": [{"object": "g4"}]})",
                  " /objects/g1/instances/0: with the transforms of the groups around it: the transform is singular");
}

}  // namespace shaolin::test
