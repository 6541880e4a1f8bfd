#include "obj.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "errors.h"
#include "mesh_places.h"
#include "obj_words.h"
#include "text.h"

namespace shaolin {

namespace {

/// Statements that say nothing about the surface.
constexpr std::array<std::string_view, 19> passed_over{
    "vt",     "vn", "vp", "g",   "o",     "s",        "mg",       "usemtl",     "mtllib",   "usemap",
    "maplib", "l",  "p",  "lod", "bevel", "c_interp", "d_interp", "shadow_obj", "trace_obj"};

/// With 17 significant digits, which name a double uniquely, however many of them are needed.
std::string in_full(double value) {
  std::array<char, 32> text;
  const auto result = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 17);
  return {text.data(), result.ptr};
}

/// With the fewest digits that name the value uniquely. A float is written as the double that it is: read as a double
/// and then rounded, its own fewest digits could end beside it.
std::string in_short(double value) {
  std::array<char, 32> text;
  const auto result = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), result.ptr};
}

/// A tag line `t name n/m/k` with its n integers, m numbers and k words.
struct Tag {
  std::string_view name;
  std::string counts;
  std::vector<int> integers;
  std::vector<double> numbers;
  std::vector<std::string_view> words;
};

class ObjReader {
 public:
  ObjReader(std::string_view text, const std::string& name) : words_(text) { places_.file = name; }

  ControlMesh read() {
    int last_line = 1;
    for (; !words_.at_end(); words_.end_statement()) {
      last_line = words_.line();
      read_statement();
    }
    if (mesh_.face_count() == 0) {
      throw InputError("the file ends without a face ('f' line), the mesh is empty", places_.file, last_line);
    }
    require_face_indices();
    check(mesh_, places_);
    return std::move(mesh_);
  }
  MeshPlaces& places() { return places_; }

 private:
  [[noreturn]] void fail(const std::string& message) const { throw InputError(message, places_.file, words_.line()); }

  void read_statement() {
    const std::string_view keyword = words_.next();
    if (keyword.empty()) return;
    if (keyword == "v") {
      read_vertex();
    } else if (keyword == "f") {
      read_face();
    } else if (keyword == "t") {
      read_tag();
    } else if (std::find(passed_over.begin(), passed_over.end(), keyword) == passed_over.end()) {
      fail("unknown statement " + quoted(keyword) + ", expected v, f, t or another OBJ statement");
    }
  }

  /// Numbers after the third are a weight or a colour: they must be numbers, and are ignored.
  void read_vertex() {
    Vec3 position = Vec3::Zero();
    int count = 0;
    for (std::string_view word = words_.next(); !word.empty(); word = words_.next(), ++count) {
      const std::optional<double> number = to_number(word);
      if (!number) fail(quoted(word) + " is not a number, expected 'v x y z'");
      if (count >= 3) continue;
      if (!std::isfinite(*number)) fail("coordinate " + quoted(word) + " is not finite");
      position[count] = *number;
    }
    if (count < 3) fail("a vertex with " + std::to_string(count) + " coordinates, expected 3: 'v x y z'");
    mesh_.positions.push_back(position);
    places_.positions.push_back(words_.line());
  }

  void read_face() {
    for (std::string_view word = words_.next(); !word.empty(); word = words_.next()) {
      mesh_.face_vertices.push_back(vertex_of_corner(word));
    }
    const std::size_t corners = mesh_.face_vertices.size() - static_cast<std::size_t>(mesh_.face_offsets.back());
    if (mesh_.face_vertices.size() > std::numeric_limits<int>::max()) fail("too many face corners");
    if (corners < 3) fail("a face with " + std::to_string(corners) + " corners, expected at least 3");
    mesh_.face_offsets.push_back(static_cast<int>(mesh_.face_vertices.size()));
    places_.faces.push_back(words_.line());
  }

  /// The vertex, from 0, of a corner v, v/vt, v//vn or v/vt/vn. A positive index may point forward in the file: whether
  /// it is in range is known at the end.
  int vertex_of_corner(std::string_view word) const {
    const std::size_t slash = word.find('/');
    const std::optional<long long> index = to_integer(word.substr(0, slash));
    if (!index || (slash != std::string_view::npos && !is_texture_and_normal(word.substr(slash + 1)))) {
      fail(quoted(word) + " is not a face corner, expected integers v, v/vt, v//vn or v/vt/vn");
    }
    if (*index == 0) fail("vertex index 0 in corner " + quoted(word) + ", face lines count from 1");
    const auto vertex_count = static_cast<long long>(mesh_.positions.size());
    if (*index < -vertex_count) {
      fail("vertex index in corner " + quoted(word) + " counts back beyond the first of the " +
           std::to_string(vertex_count) + " vertices so far");
    }
    if (*index < 0) return static_cast<int>(vertex_count + *index);
    if (*index > std::numeric_limits<int>::max()) fail("vertex index in corner " + quoted(word) + " is out of range");
    return static_cast<int>(*index - 1);
  }

  /// What follows a corner's first slash: "vt", "/vn" or "vt/vn". Some exporters leave either empty.
  static bool is_texture_and_normal(std::string_view word) {
    const std::size_t slash = word.find('/');
    const std::string_view texture = word.substr(0, slash);
    const std::string_view normal = slash == std::string_view::npos ? std::string_view() : word.substr(slash + 1);
    return (texture.empty() || to_integer(texture)) && (normal.empty() || to_integer(normal));
  }

  /// check() would find these too, but it counts from 0, and face lines count from 1.
  void require_face_indices() const {
    const int vertex_count = static_cast<int>(mesh_.positions.size());
    for (int f = 0; f < mesh_.face_count(); ++f) {
      for (const int v : mesh_.face(f)) {
        if (v < vertex_count) continue;
        throw InputError("vertex index " + std::to_string(v + 1LL) + " is out of range, the file has " +
                             std::to_string(vertex_count) + " vertices (face lines count from 1)",
                         places_.file, places_.faces[static_cast<std::size_t>(f)]);
      }
    }
  }

  struct TagKind {
    std::string_view name;
    std::string_view form;  ///< how a correct line looks
    bool (*fits)(const Tag&);
    void (ObjReader::*apply)(const Tag&);
  };

  static const TagKind* find_tag_kind(std::string_view name);

  [[noreturn]] void fail_cut_short(const Tag& tag, const TagKind& kind, const std::string& why) const {
    fail("tag " + quoted(tag.name) + " is cut short or has wrong counts: " + why + ", expected 't " +
         std::string(kind.form) + "'");
  }

  void read_tag() {
    Tag tag;
    tag.name = words_.next();
    if (tag.name.empty()) fail("a tag line is cut short, expected 't name n/m/k ...'");
    const TagKind* const kind = find_tag_kind(tag.name);
    if (!kind) fail("unknown tag " + quoted(tag.name));
    const std::array<long long, 3> counts = read_counts(tag, *kind);
    const auto argument = [&] {
      const std::string_view word = words_.next();
      if (word.empty())
        fail_cut_short(tag, *kind, "counts " + tag.counts + " announce more arguments than the line has");
      return word;
    };
    for (long long i = 0; i < counts[0]; ++i) tag.integers.push_back(tag_integer(tag, argument()));
    for (long long i = 0; i < counts[1]; ++i) tag.numbers.push_back(tag_number(tag, argument()));
    for (long long i = 0; i < counts[2]; ++i) tag.words.push_back(argument());
    if (const std::string_view word = words_.next(); !word.empty()) {
      fail("tag " + quoted(tag.name) + " has " + quoted(word) + " beyond the arguments that its counts " + tag.counts +
           " announce");
    }
    if (!kind->fits(tag)) fail_cut_short(tag, *kind, "counts are " + tag.counts);
    (this->*kind->apply)(tag);
  }

  /// The counts n/m/k of integers, numbers and words.
  std::array<long long, 3> read_counts(Tag& tag, const TagKind& kind) {
    const std::string_view word = words_.next();
    if (word.empty()) fail_cut_short(tag, kind, "no counts n/m/k");
    std::array<long long, 3> counts{};
    std::string_view rest = word;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t slash = i < 2 ? rest.find('/') : rest.size();
      const std::optional<long long> count = to_integer(rest.substr(0, slash));
      if (slash == std::string_view::npos || !count || *count < 0)
        fail_cut_short(tag, kind, quoted(word) + " where counts belong");
      counts[i] = *count;
      rest.remove_prefix(std::min(slash + 1, rest.size()));
    }
    tag.counts = quoted(word);
    return counts;
  }

  int tag_integer(const Tag& tag, std::string_view word) const {
    const std::optional<long long> value = to_integer(word);
    if (!value) fail("tag " + quoted(tag.name) + ": " + quoted(word) + " is not an integer");
    if (*value < std::numeric_limits<int>::min() || *value > std::numeric_limits<int>::max()) {
      fail("tag " + quoted(tag.name) + ": " + quoted(word) + " is out of range");
    }
    return static_cast<int>(*value);
  }

  double tag_number(const Tag& tag, std::string_view word) const {
    const std::optional<double> value = to_number(word);
    if (!value) fail("tag " + quoted(tag.name) + ": " + quoted(word) + " is not a number");
    return *value;
  }

  /// The sharpness of the tag's i-th element: one value may stand for all.
  float sharpness(const Tag& tag, std::size_t i) const {
    const double value = tag.numbers[tag.numbers.size() == 1 ? 0 : i];
    if (std::isnan(value) || value < 0) {
      fail("tag " + quoted(tag.name) + ": sharpness " + in_short(value) + ", expected a number from 0");
    }
    return static_cast<float>(std::min<double>(value, infinite_sharpness));
  }

  void apply_crease(const Tag& tag) {
    for (std::size_t i = 0; i + 1 < tag.integers.size(); ++i) {
      mesh_.sharp_edges.push_back({tag.integers[i], tag.integers[i + 1], sharpness(tag, i)});
      places_.sharp_edges.push_back(words_.line());
    }
  }

  void apply_corner(const Tag& tag) {
    for (std::size_t i = 0; i < tag.integers.size(); ++i) {
      mesh_.sharp_vertices.push_back({tag.integers[i], sharpness(tag, i)});
      places_.sharp_vertices.push_back(words_.line());
    }
  }

  void apply_cone(const Tag& tag) {
    mesh_.cones.insert(mesh_.cones.end(), tag.integers.begin(), tag.integers.end());
    places_.cones.insert(places_.cones.end(), tag.integers.size(), words_.line());
  }

  void apply_hole(const Tag& tag) {
    mesh_.holes.insert(mesh_.holes.end(), tag.integers.begin(), tag.integers.end());
    places_.holes.insert(places_.holes.end(), tag.integers.size(), words_.line());
  }

  void apply_boundary(const Tag& tag) {
    const int mode = tag.integers[0];
    if (mode < 0 || mode > 2) {
      fail("tag 'interpolateboundary': mode " + std::to_string(mode) +
           ", expected 0 (none), 1 (edge and corner) or 2 (edge only)");
    }
    mesh_.boundary = static_cast<BoundaryInterpolation>(mode);
  }

  /// True if the tag's word is `second`, false if it is `first`; anything else is an error.
  bool is_second(const Tag& tag, std::string_view first, std::string_view second) const {
    const std::string_view word = tag.words[0];
    if (word != first && word != second) {
      fail("tag " + quoted(tag.name) + ": " + quoted(word) + ", expected " + std::string(first) + " or " +
           std::string(second));
    }
    return word == second;
  }

  void apply_crease_method(const Tag& tag) {
    mesh_.crease_method = is_second(tag, "normal", "chaikin") ? CreaseMethod::chaikin : CreaseMethod::uniform;
  }

  void apply_smooth_triangles(const Tag& tag) {
    mesh_.triangle_subdivision =
        is_second(tag, "catmark", "smooth") ? TriangleSubdivision::smooth : TriangleSubdivision::catmark;
  }

  void apply_scheme(const Tag& tag) {
    mesh_.scheme = tag.words[0];
    places_.scheme = words_.line();
  }

  /// Face-varying data (texture coordinates) has no part in the surface.
  void accept_without_effect(const Tag&) {}

  void refuse_unsupported(const Tag& tag) { fail("tag " + quoted(tag.name) + " is not supported yet"); }

  Words words_;
  ControlMesh mesh_;
  MeshPlaces places_;
};

bool has_counts(const Tag& tag, std::size_t integers, std::size_t numbers, std::size_t words) {
  return tag.integers.size() == integers && tag.numbers.size() == numbers && tag.words.size() == words;
}

/// `elements` with one sharpness for all, or one for each.
bool has_sharpness_for(const Tag& tag, std::size_t elements) {
  return elements > 0 && tag.words.empty() && (tag.numbers.size() == 1 || tag.numbers.size() == elements);
}

bool is_crease(const Tag& tag) { return !tag.integers.empty() && has_sharpness_for(tag, tag.integers.size() - 1); }
bool is_corner(const Tag& tag) { return has_sharpness_for(tag, tag.integers.size()); }
bool is_list(const Tag& tag) { return has_counts(tag, std::max<std::size_t>(tag.integers.size(), 1), 0, 0); }
bool is_one_integer(const Tag& tag) { return has_counts(tag, 1, 0, 0); }
bool is_one_word(const Tag& tag) { return has_counts(tag, 0, 0, 1); }
bool is_anything(const Tag&) { return true; }

const ObjReader::TagKind* ObjReader::find_tag_kind(std::string_view name) {
  static constexpr std::array<TagKind, 12> kinds{{
      {"crease", "crease 2/1/0 a b sharpness", is_crease, &ObjReader::apply_crease},
      {"corner", "corner 1/1/0 vertex sharpness", is_corner, &ObjReader::apply_corner},
      {"hole", "hole n/0/0 face...", is_list, &ObjReader::apply_hole},
      {"interpolateboundary", "interpolateboundary 1/0/0 mode", is_one_integer, &ObjReader::apply_boundary},
      {"facevaryinginterpolateboundary", "facevaryinginterpolateboundary 1/0/0 mode", is_one_integer,
       &ObjReader::accept_without_effect},
      {"creasemethod", "creasemethod 0/0/1 normal|chaikin", is_one_word, &ObjReader::apply_crease_method},
      {"smoothtriangles", "smoothtriangles 0/0/1 smooth|catmark", is_one_word, &ObjReader::apply_smooth_triangles},
      {"scheme", "scheme 0/0/1 name", is_one_word, &ObjReader::apply_scheme},
      {"cone", "cone n/0/0 vertex...", is_list, &ObjReader::apply_cone},
      {"vertexedit", "vertexedit n/m/k ...", is_anything, &ObjReader::refuse_unsupported},
      {"edgeedit", "edgeedit n/m/k ...", is_anything, &ObjReader::refuse_unsupported},
      {"faceedit", "faceedit n/m/k ...", is_anything, &ObjReader::refuse_unsupported},
  }};
  const auto kind = std::find_if(kinds.begin(), kinds.end(), [&](const TagKind& k) { return k.name == name; });
  return kind == kinds.end() ? nullptr : &*kind;
}

std::string tag_lines(const ControlMesh& mesh) {
  std::string text;
  if (!mesh.scheme.empty()) text += "t scheme 0/0/1 " + mesh.scheme + '\n';
  text += "t interpolateboundary 1/0/0 " + std::to_string(static_cast<int>(mesh.boundary)) + '\n';
  if (mesh.crease_method == CreaseMethod::chaikin) text += "t creasemethod 0/0/1 chaikin\n";
  if (mesh.triangle_subdivision == TriangleSubdivision::smooth) text += "t smoothtriangles 0/0/1 smooth\n";
  for (const SharpEdge& edge : mesh.sharp_edges) {
    text += "t crease 2/1/0 " + std::to_string(edge.a) + ' ' + std::to_string(edge.b) + ' ' + in_short(edge.sharpness) +
            '\n';
  }
  for (const SharpVertex& corner : mesh.sharp_vertices) {
    text += "t corner 1/1/0 " + std::to_string(corner.vertex) + ' ' + in_short(corner.sharpness) + '\n';
  }
  for (const int vertex : mesh.cones) text += "t cone 1/0/0 " + std::to_string(vertex) + '\n';
  for (const int face : mesh.holes) text += "t hole 1/0/0 " + std::to_string(face) + '\n';
  return text;
}

}  // namespace

ControlMesh read_obj(const std::filesystem::path& file) {
  MeshPlaces places;
  return read_obj(file, places);
}

ControlMesh read_obj(const std::filesystem::path& file, MeshPlaces& places) {
  const std::string text = read_text_file(file);
  ObjReader reader(text, file.string());
  ControlMesh mesh = reader.read();
  places = std::move(reader.places());
  return mesh;
}

ControlMesh read_obj(std::istream& stream, const std::string& name) {
  return ObjReader(read_text(stream, name), name).read();
}

void write_obj(std::ostream& stream, const ControlMesh& mesh) {
  // A string, not the stream, takes the numbers: a stream's locale could put separators between their digits.
  std::string text;
  for (const Vec3& p : mesh.positions) {
    text += "v " + in_full(p.x()) + ' ' + in_full(p.y()) + ' ' + in_full(p.z()) + '\n';
  }
  for (int f = 0; f < mesh.face_count(); ++f) {
    text += 'f';
    for (const int v : mesh.face(f)) text += ' ' + std::to_string(v + 1);
    text += '\n';
  }
  stream << text << tag_lines(mesh);
}

}  // namespace shaolin
