#include "tools/cli/scene_file.h"

#include <limits>
#include <map>
#include <numbers>

#include "schemes/builtin.h"
#include "schemes/text.h"
#include "tools/cli/json_text.h"

namespace shaolin {
namespace {

/// An entry of a list of instances: in the scene, or in a group.
struct Reference {
  JsonNode node;
  std::string object;
  std::optional<std::size_t> material;  ///< an index into Look::materials; empty if it has none of its own
  Affine transform;
};

/// An object that is not dissolved yet: a mesh or a group.
struct Definition {
  std::size_t mesh = 0;  ///< an index into SceneFile::objects, unless it is a group
  bool is_group = false;
  std::vector<Reference> members;
  enum class State { unseen, open, done } state = State::unseen;
};

/// "'a', 'b' or 'c'", of the first few.
template <class Map>
std::string names_of(const Map& map) {
  if (map.empty()) return "none, as there are none";
  std::string names;
  std::size_t left = 8;
  for (const auto& [name, value] : map) {
    if (left-- == 0) return names + ", ...";
    names += (names.empty() ? "" : ", ") + shaolin::quoted(name);
  }
  return names;
}

Affine read_matrix(const JsonNode& node) {
  Affine map;
  const std::vector<JsonNode> rows = node.elements(3);
  for (std::size_t row = 0; row < 3; ++row) {
    const std::vector<JsonNode> numbers = rows[row].elements(4);
    for (std::size_t column = 0; column < 4; ++column)
      map.matrix()(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) = numbers[column].number();
  }
  return map;
}

Eigen::Matrix3d read_rotation(const JsonNode& node) {
  const std::vector<JsonNode> numbers = node.elements(4);
  const Vec3 axis(numbers[0].number(), numbers[1].number(), numbers[2].number());
  if (axis.isZero(0)) node.fail("the axis is zero; expected [ax, ay, az, degrees] with an axis of any other length");
  const double angle = std::remainder(numbers[3].number(), 360) * std::numbers::pi / 180;
  return Eigen::AngleAxisd(angle, axis.stableNormalized()).toRotationMatrix();
}

Affine read_transform(const JsonNode& node) {
  Affine map = Affine::Identity();
  if (node.is_array()) {
    map = read_matrix(node);
  } else {
    node.check_keys({"scale", "rotate", "translate"});
    if (const auto scale = node.find("scale"))
      map.linear() = (scale->is_number() ? Vec3::Constant(scale->number()) : scale->vector()).asDiagonal();
    if (const auto rotate = node.find("rotate")) map.linear() = read_rotation(*rotate) * map.linear();
    if (const auto translate = node.find("translate")) map.translation() = translate->vector();
  }
  try {
    inverse(map);
  } catch (const InputError& error) {
    node.fail(error.what());
  }
  return map;
}

std::string read_scheme(const JsonNode& node) {
  const std::string name = node.text();
  for (const BuiltinScheme& known : builtin_schemes())
    if (name == known.name) return name;
  node.fail("unknown scheme " + shaolin::quoted(name) + "; expected " + builtin_scheme_names());
}

Camera read_camera(const JsonNode& node) {
  node.check_keys({"eye", "target", "fov", "up"});
  Camera camera;
  camera.eye = node.at("eye").vector();
  camera.target = node.at("target").vector();
  if (const auto fov = node.find("fov")) camera.fov = fov->number();
  if (const auto up = node.find("up")) camera.up = up->vector();
  if (const std::string fault = fault_of(camera); !fault.empty()) node.fail(fault);
  return camera;
}

constexpr double infinity = std::numeric_limits<double>::infinity();

PointLight read_light(const JsonNode& node) {
  node.check_keys({"position", "colour"});
  PointLight light{node.at("position").vector(), Vec3::Ones()};
  if (const auto color = node.find("colour")) light.color = color->vector(0, infinity);
  return light;
}

Material read_material(const JsonNode& node) {
  node.check_keys({"colour", "mirror"});
  Material material;
  if (const auto color = node.find("colour")) material.color = color->vector(0, 1);
  if (const auto mirror = node.find("mirror")) material.mirror = mirror->number(0, 1);
  return material;
}

class Reader {
 public:
  Reader(const JsonNode& root, const std::filesystem::path& folder) : root_(root), folder_(folder) {}

  SceneFile read() {
    scene_.file = root_.file();
    root_.check_keys({"scheme", "objects", "materials", "instances", "camera", "lights", "background"});
    read_look();
    if (const auto camera = root_.find("camera")) scene_.camera = read_camera(*camera);
    if (const auto scheme = root_.find("scheme")) default_scheme_ = read_scheme(*scheme);
    for (const auto& [name, node] : root_.at("objects").members()) read_object(name, node);
    const std::vector<Reference> shown = read_references(root_.at("instances"));
    for (auto& [name, definition] : definitions_) check_acyclic(name, definition);
    for (const Reference& reference : shown) add(reference, Affine::Identity(), 0);
    return std::move(scene_);
  }

 private:
  void read_look() {
    if (const auto materials = root_.find("materials"))
      for (const auto& [name, node] : materials->members()) {
        materials_[name] = scene_.look.materials.size();
        scene_.look.materials.push_back(read_material(node));
      }
    if (const auto lights = root_.find("lights"))
      for (const JsonNode& node : lights->elements()) scene_.look.lights.push_back(read_light(node));
    if (const auto background = root_.find("background")) scene_.look.background = background->vector(0, infinity);
  }

  void read_object(const std::string& name, const JsonNode& node) {
    Definition definition;
    definition.is_group = node.has("instances");
    if (definition.is_group) {
      node.check_keys({"instances"});
      definition.members = read_references(node.at("instances"));
    } else {
      node.check_keys({"model", "scheme"});
      if (!node.has("model")) node.fail("has neither 'model' nor 'instances'; expected one of them");
      definition.mesh = scene_.objects.size();
      const auto scheme = node.find("scheme");
      const JsonNode model = node.at("model");
      scene_.objects.push_back(
          {name, folder_ / model.text(), scheme ? read_scheme(*scheme) : default_scheme_, model.path()});
    }
    definitions_.emplace(name, std::move(definition));
  }

  /// Names are looked up later: an object may stand before those that it is made of.
  std::vector<Reference> read_references(const JsonNode& list) const {
    std::vector<Reference> references;
    for (const JsonNode& node : list.elements()) {
      node.check_keys({"object", "material", "transform"});
      Reference reference{node, node.at("object").text(), std::nullopt, Affine::Identity()};
      if (const auto material = node.find("material")) {
        const auto found = materials_.find(material->text());
        if (found == materials_.end())
          material->fail("unknown material " + shaolin::quoted(material->text()) + "; expected " +
                         names_of(materials_));
        reference.material = found->second;
      }
      if (const auto transform = node.find("transform")) reference.transform = read_transform(*transform);
      references.push_back(std::move(reference));
    }
    return references;
  }

  Definition& definition_of(const Reference& reference) {
    const auto found = definitions_.find(reference.object);
    if (found == definitions_.end())
      reference.node.at("object").fail("unknown object " + shaolin::quoted(reference.object) + "; expected " +
                                       names_of(definitions_));
    return found->second;
  }

  /// Depth first; `trail_` holds the groups that are open.
  void check_acyclic(const std::string& name, Definition& definition) {
    using State = Definition::State;
    if (definition.state == State::done) return;
    definition.state = State::open;
    trail_.push_back(name);
    for (const Reference& member : definition.members) {
      Definition& inner = definition_of(member);
      if (inner.state == State::open) fail_cycle(member);
      if (trail_.size() == most_nested)
        member.node.fail("groups are nested deeper than " + std::to_string(most_nested) + " levels");
      check_acyclic(member.object, inner);
    }
    trail_.pop_back();
    definition.state = State::done;
  }

  [[noreturn]] void fail_cycle(const Reference& last) const {
    std::string cycle;
    bool inside = false;
    for (const std::string& name : trail_) {
      inside = inside || name == last.object;
      if (inside) cycle += shaolin::quoted(name) + " > ";
    }
    last.node.at("object").fail("a group contains itself: " + cycle + shaolin::quoted(last.object));
  }

  void add(const Reference& reference, const Affine& outer, std::size_t outer_material) {
    const Definition& definition = definition_of(reference);
    const Affine transform = outer * reference.transform;
    const std::size_t material = reference.material.value_or(outer_material);
    if (++placed_ > most_instances)
      reference.node.fail("the scene has more than " + std::to_string(most_instances) + " instances, groups included");
    for (const Reference& member : definition.members) add(member, transform, material);
    if (definition.is_group) return;
    try {
      inverse(transform);
    } catch (const InputError& error) {
      reference.node.fail("with the transforms of the groups around it: " + std::string(error.what()));
    }
    scene_.instances.push_back({definition.mesh, transform});
    scene_.look.of_instance.push_back(material);
  }

  /// Far more than anyone nests, far less than the stack holds.
  static constexpr std::size_t most_nested = 256;

  JsonNode root_;
  std::filesystem::path folder_;
  std::string default_scheme_;
  std::map<std::string, std::size_t> materials_;
  std::map<std::string, Definition> definitions_;
  std::vector<std::string> trail_;
  std::size_t placed_ = 0;
  SceneFile scene_;
};

}  // namespace

bool is_scene_file(const std::filesystem::path& file) { return file.extension() == ".json"; }

SceneFile read_scene_file(const std::filesystem::path& file) {
  const std::string name = file.string();
  const Json document = read_json(file);
  return Reader(JsonNode(document, name), file.parent_path()).read();
}

}  // namespace shaolin
