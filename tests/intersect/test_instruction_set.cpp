// The same crossings by every instruction set that the library was built with and this processor runs.
#include "intersect/instruction_set.h"

#include <cstdlib>
#include <optional>

#include "schemes/errors.h"
#include "tests/catch.h"
#include "tests/intersect/random_rays.h"
#include "tests/models.h"

namespace shaolin {

namespace {

constexpr const char* variable = "SHAOLIN_INSTRUCTION_SET";

/// Asks for an instruction set, or for none, as long as it lives.
class Wanted {
 public:
  explicit Wanted(const std::string& name) : before_(std::getenv(variable) ? std::getenv(variable) : "") {
    setenv(variable, name.c_str(), 1);
  }
  ~Wanted() { setenv(variable, before_.c_str(), 1); }
  Wanted(const Wanted&) = delete;
  Wanted& operator=(const Wanted&) = delete;

 private:
  std::string before_;
};

}  // namespace

TEST_CASE("An instruction set may be asked for by name", "[intersect][instruction_set]") {
  const InstructionSet widest = [] {
    const Wanted any("");
    return instruction_set();
  }();
  {
    const Wanted portable("portable");
    CHECK(instruction_set() == InstructionSet::portable);
  }
  {
    const Wanted same(std::string(name_of(widest)));
    CHECK(instruction_set() == widest);
  }
  for (const std::string name : {"sse9", "AVX2", "portable "}) {
    const Wanted unknown(name);
    CHECK_THROWS_AS(instruction_set(), InputError);
    CHECK_THROWS_AS(make_object(tetrahedron(), "loop"), InputError);
  }
  if (widest == InstructionSet::portable) {
    const Wanted wider("avx2");
    CHECK_THROWS_AS(instruction_set(), InputError);
  }
}

TEST_CASE("Instruction sets give the same crossings, on every model", "[intersect][instruction_set][sweep]") {
  if (const Wanted any(""); instruction_set() == InstructionSet::portable) {
    WARN("there is one instruction set only: nothing to compare");
    return;
  }
  for (const Model& model : all_models()) {
    if (model.scheme != "loop" && model.scheme != "catmark") continue;
    CAPTURE(model.name);
    std::optional<Scene> portable, widest;
    {
      const Wanted none("portable");
      portable.emplace(model.mesh, model.scheme);
    }
    {
      const Wanted all("");
      widest.emplace(model.mesh, model.scheme);
    }
    const double bar = 1e-12 * model.mesh.diagonal();
    for (const Ray& ray : random_rays(portable->bounds(), 1500, 307)) {
      const std::optional<Hit> a = portable->intersect(ray), b = widest->intersect(ray);
      REQUIRE(a.has_value() == b.has_value());
      CHECK(portable->occluded(ray) == widest->occluded(ray));
      CHECK(portable->count(ray) == widest->count(ray));
      if (!a) continue;
      // Where the ray grazes, a position is what rounding leaves of it.
      const double cosine = std::abs(a->sample.normal.dot(ray.direction.normalized()));
      CHECK((a->sample.position - b->sample.position).norm() <= bar / std::max(cosine, 1e-4));
      CHECK(a->certificate.is_certified() == b->certificate.is_certified());
    }
    const Vec3 point = portable->bounds().centre();
    const auto near = portable->closest_point(point), near_too = widest->closest_point(point);
    REQUIRE(near.has_value() == near_too.has_value());
    if (near) CHECK(std::abs(near->distance - near_too->distance) <= bar);
  }
}

}  // namespace shaolin
