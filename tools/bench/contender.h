#pragma once
/// The methods that are compared, each with its parameter, behind one interface.
#include <array>
#include <memory>
#include <optional>
#include <string>

#include "tools/cli/stage.h"

namespace shaolin {

enum class ContenderKind {
  exact,
  subdivision,  ///< Embree's own subdivision geometry
  triangles,    ///< Embree's triangles, those of uniform
  uniform,
  chord,
  a3
};
inline constexpr std::array contender_kinds{ContenderKind::exact,     ContenderKind::subdivision,
                                            ContenderKind::triangles, ContenderKind::uniform,
                                            ContenderKind::chord,     ContenderKind::a3};
const char* name_of(ContenderKind kind);  ///< as --methods takes it: "exact", "subdivision"

/// A method and its parameter.
struct Contender {
  ContenderKind kind = ContenderKind::exact;
  double epsilon = 0;      ///< of chord and a3, as the paper counts it: in units of the scene
  int level = 0;           ///< of uniform, triangles and subdivision
  ChordOptions chord{};    ///< of chord and a3; chord.epsilon is a length
  bool is_robust = false;  ///< of Embree's scenes: RTC_SCENE_FLAG_ROBUST, which costs it time

  bool is_adaptive() const { return kind == ContenderKind::chord || kind == ContenderKind::a3; }
  bool is_uniform() const { return kind == ContenderKind::uniform || is_embree(); }
  bool is_embree() const { return kind == ContenderKind::triangles || kind == ContenderKind::subdivision; }
  double parameter() const { return is_adaptive() ? epsilon : level; }
  std::string method() const;  ///< "ShaoLin", "A3", "Uniform", "Embree triangles", "Embree subdivision",
                               ///< "ShaoLin exact"
  std::string name() const;    ///< with the parameter: "ShaoLin, epsilon 0.01", "Uniform, level 5"
};

/// One ray's answer, in any method's terms.
struct Answer {
  double t = 0;
  Vec3 normal = Vec3::Zero();  ///< unit
  int level = 0;
};

std::optional<Answer> answer_of(const std::optional<Hit>& hit);

/// A scene as a contender sees it. Queries may run concurrently.
class Tracer {
 public:
  virtual ~Tracer() = default;

  virtual std::optional<Answer> intersect(const Ray& ray) const = 0;
  virtual bool occluded(const Ray& ray) const = 0;
  /// Of what was made so far: patches, or triangles with their hierarchy.
  virtual std::size_t bytes() const = 0;
  /// Of its construction: what went into triangles that the method takes and others make.
  virtual double tessellation_seconds() const { return 0; }
};

/// Builds a scene of its own. Throws what its parts throw.
std::unique_ptr<Tracer> make_tracer(const Contender& contender, const Stage& stage);

/// Options of Scene for a contender; not for those of Embree.
SceneOptions scene_options(const Contender& contender);

}  // namespace shaolin
