// The exact referee: it agrees with sound answers, and catches planted ones.
#include "schemes/obj.h"
#include "tests/catch.h"
#include "tests/tools/cli_run.h"
#include "tools/validate/exact_hits.h"
#include "tools/validate/exact_triangles.h"
#include "tools/validate/opensubdiv_oracle.h"

namespace shaolin::test {
namespace {

struct RefereedModel {
  explicit RefereedModel(const std::string& file)
      : mesh(read_obj(data_file(file))),
        scheme(default_scheme(mesh)),
        scene(mesh, scheme),
        uniform(mesh, scheme, triangles()),
        exact(mesh, scheme),
        rays(sample_rays(OpenSubdivOracle(mesh, scheme), 40, 7)) {}

  static SceneOptions triangles() {
    SceneOptions options;
    options.method = Method::uniform;
    options.level = 2;
    return options;
  }
  ExactHitFigures hits(const Intersector& ours) const { return check_exact_hits(ours, mesh, exact, rays); }
  ExactTriangleFigures decisions(const Intersector& ours) const {
    return check_exact_triangles(ours, uniform_triangles(mesh, scheme, 2), rays);
  }

  ControlMesh mesh;
  std::string scheme;
  Scene scene, uniform;
  QuadOracle exact;
  std::vector<ProbeRay> rays;
};

/// An intersector whose hits `spoil` has changed, or taken away.
template <class Spoil>
Intersector spoiled(const Scene& scene, Spoil spoil) {
  Intersector ours = Intersector::of(scene);
  ours.intersect = [&scene, spoil](const Ray& ray) {
    std::optional<Hit> hit = scene.intersect(ray);
    spoil(hit);
    return hit;
  };
  return ours;
}

}  // namespace

TEST_CASE("Exact arithmetic confirms certificates", "[tools][exact][sweep]") {
  for (const std::string file : {"torus.obj", "cube_creases.obj", "tetrahedron.obj", "sail.obj"}) {
    CAPTURE(file);
    const RefereedModel subject(file);
    const ExactHitFigures figures = subject.hits(Intersector::of(subject.scene));
    for (const Disagreement& d : figures.disagreements) UNSCOPED_INFO(d.what << ' ' << exact(*d.ray) << ' ' << d.error);
    CHECK(figures.disagreements.empty());
    CHECK(figures.rays == subject.rays.size());
    CHECK(figures.certified > 10);
    CHECK(figures.worst_bound_share <= 1);
    CHECK(figures.worst_bound_share > 1e-6);
    CHECK(figures.worst_position < 1e-11);
  }
}

TEST_CASE("Exact arithmetic catches false certificates", "[tools][exact][sweep]") {
  const RefereedModel subject("cube_creases.obj");
  const std::size_t certified = subject.hits(Intersector::of(subject.scene)).certified;
  const auto caught = [&](const auto& spoil) {
    return subject.hits(spoiled(subject.scene, spoil)).disagreements.size();
  };
  CHECK(caught([](std::optional<Hit>& hit) {
          if (hit) hit->sample.position.x() += 1e-5;
        }) >= certified);
  CHECK(caught([](std::optional<Hit>& hit) {
          if (hit) hit->certificate.error = 1e-40;
        }) == certified);
  CHECK(caught([](std::optional<Hit>& hit) {  // another place of the surface, which the ray does not pass
          if (hit) hit->at.u = 0.5 * hit->at.u + 0.2;
        }) >= certified - 1);
}

TEST_CASE("Exact arithmetic confirms decisions about triangles, and catches wrong ones", "[tools][exact]") {
  for (const std::string file : {"torus.obj", "cube_creases.obj", "tetrahedron.obj", "sail.obj"}) {
    CAPTURE(file);
    const RefereedModel subject(file);
    const ExactTriangleFigures figures = subject.decisions(Intersector::of(subject.uniform));
    for (const Disagreement& d : figures.disagreements)
      UNSCOPED_INFO(d.what << ' ' << exact(*d.ray) << ' ' << d.detail);
    CHECK(figures.disagreements.empty());
    CHECK(figures.hits > 10);
    CHECK(figures.decisions > figures.hits);
    CHECK(figures.worst_t < 1e-12);
    const auto lost = subject.decisions(spoiled(subject.uniform, [](std::optional<Hit>& hit) { hit.reset(); }));
    CHECK(lost.disagreements.size() + lost.excused == figures.hits);
    CHECK(lost.disagreements.size() > 10);
    const auto farther = subject.decisions(spoiled(subject.uniform, [](std::optional<Hit>& hit) {
      if (hit) hit->t *= 1 + 1e-9;
    }));
    CHECK(farther.disagreements.size() + farther.excused >= figures.hits);
    const auto ghosts = subject.decisions(spoiled(subject.uniform, [](std::optional<Hit>& hit) {
      if (!hit) hit.emplace();
    }));
    CHECK(ghosts.disagreements.size() > 5);
    CHECK(ghosts.disagreements.front().what == "ghost triangle");
  }
}

TEST_CASE("validate --exact reports, and refuses plug-ins", "[tools][exact][cli]") {
  const Folder folder;
  const std::string model = data_file("torus.obj");
  const Outcome outcome = folder.run({"validate", model, "--rays", "0", "--evaluations", "10", "--exact", "20"});
  CAPTURE(outcome.text);
  CHECK(outcome.status == 0);
  CHECK(outcome.text.find("Hits in exact arithmetic") != std::string::npos);
  CHECK(outcome.text.find("Triangles in exact arithmetic") != std::string::npos);
  const std::string plugin = environment("SHAOLIN_PLUGINS") + "/libbutterfly.so";
  const Outcome refused = folder.run(
      {"validate", data_file("whale.obj"), "--plugin", plugin, "--rays", "0", "--evaluations", "1", "--exact", "1"});
  CHECK(refused.status == 3);
}

}  // namespace shaolin::test
