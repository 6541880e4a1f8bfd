#include "tools/bench/contender.h"

#include <cstdio>

#include "tools/bench/embree_stage.h"

namespace shaolin {
namespace {

class SceneTracer final : public Tracer {
 public:
  SceneTracer(Stage stage, const SceneOptions& options) : scene_(build_scene(stage, options)) {}

  std::optional<Answer> intersect(const Ray& ray) const override { return answer_of(scene_.intersect(ray)); }
  bool occluded(const Ray& ray) const override { return scene_.occluded(ray); }
  std::size_t bytes() const override { return scene_.statistics().bytes; }

 private:
  Scene scene_;
};

class EmbreeTracer final : public Tracer {
 public:
  EmbreeTracer(const Stage& stage, const Contender& contender)
      : scene_(stage, contender.level,
               contender.kind == ContenderKind::triangles ? EmbreeSurface::triangles : EmbreeSurface::subdivision,
               contender.is_robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE),
        level_(contender.level) {}

  std::optional<Answer> intersect(const Ray& ray) const override {
    const auto hit = scene_.intersect(ray);
    if (!hit) return std::nullopt;
    return Answer{hit->t, hit->normal, level_};
  }
  bool occluded(const Ray& ray) const override { return scene_.occluded(ray); }
  std::size_t bytes() const override { return scene_.bytes(); }
  double tessellation_seconds() const override { return scene_.tessellation_seconds(); }

 private:
  EmbreeStage scene_;
  int level_;
};

}  // namespace

std::optional<Answer> answer_of(const std::optional<Hit>& hit) {
  if (!hit) return std::nullopt;
  return Answer{hit->t, hit->sample.normal, hit->level};
}

const char* name_of(ContenderKind kind) {
  constexpr std::array names{"exact", "subdivision", "triangles", "uniform", "chord", "a3"};
  static_assert(names.size() == contender_kinds.size());
  return names[static_cast<std::size_t>(kind)];
}

std::string Contender::method() const {
  switch (kind) {
    case ContenderKind::chord:
      return "ShaoLin";
    case ContenderKind::a3:
      return "A3";
    case ContenderKind::uniform:
      return "Uniform";
    case ContenderKind::triangles:
      return "Embree triangles";
    case ContenderKind::subdivision:
      return "Embree subdivision";
    case ContenderKind::exact:
      break;
  }
  return "ShaoLin exact";
}

std::string Contender::name() const {
  char text[64] = "";
  if (is_adaptive()) std::snprintf(text, sizeof text, ", epsilon %g", epsilon);
  if (is_uniform()) std::snprintf(text, sizeof text, ", level %d", level);
  return method() + text;
}

SceneOptions scene_options(const Contender& contender) {
  SceneOptions options;
  options.chord = contender.chord;
  options.level = contender.level;
  if (contender.kind == ContenderKind::chord) options.method = Method::chord;
  if (contender.kind == ContenderKind::a3) options.method = Method::a3;
  if (contender.kind == ContenderKind::uniform) options.method = Method::uniform;
  return options;
}

std::unique_ptr<Tracer> make_tracer(const Contender& contender, const Stage& stage) {
  if (contender.is_embree()) return std::make_unique<EmbreeTracer>(stage, contender);
  return std::make_unique<SceneTracer>(stage, scene_options(contender));
}

}  // namespace shaolin
