// `shaolin validate`: it passes on sound models, and it catches what is planted.
#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>

#include "schemes/obj.h"
#include "tests/catch.h"
#include "tests/tools/cli_run.h"
#include "tools/validate/check_evaluations.h"
#include "tools/validate/check_rays.h"
#include "tools/validate/opensubdiv_oracle.h"

namespace shaolin::test {
namespace {

/// A model with everything that it is held against.
struct ValidatedModel {
  explicit ValidatedModel(const std::string& file)
      : mesh(read_obj(data_file(file))),
        oracle(mesh, default_scheme(mesh)),
        scene(mesh, default_scheme(mesh)),
        dense(oracle, 4),
        evaluator(Evaluator::of(scene.surface())),
        intersector(Intersector::of(scene)) {}

  EvaluationReport evaluations(std::size_t count = 400) const {
    return check_evaluations(evaluator, oracle, sample_parameters(oracle, count, 7));
  }
  RayReport rays(std::size_t count = 300) const {
    return check_rays(intersector, oracle, &dense, sample_rays(oracle, count, 7));
  }

  ControlMesh mesh;
  OpenSubdivOracle oracle;
  Scene scene;
  DenseCheck dense;
  Evaluator evaluator;      ///< to be replaced by a faulty one
  Intersector intersector;  ///< the same
};

std::size_t count_of(const std::vector<Disagreement>& disagreements, const std::string& what) {
  return static_cast<std::size_t>(std::count_if(disagreements.begin(), disagreements.end(), [&](const Disagreement& d) {
    return d.what.compare(0, what.size(), what) == 0;
  }));
}

/// Replaces the evaluator by one whose samples `spoil` has changed.
template <typename Spoil>
void spoil_samples(ValidatedModel& subject, Spoil spoil) {
  subject.evaluator.evaluate = [sound = subject.evaluator.evaluate, spoil](const SurfaceParameter& at) {
    std::optional<LimitSample> sample = sound(at);
    if (sample) spoil(*sample);
    return sample;
  };
}

/// Replaces the closest hits by what `spoil` makes of them: a changed hit, or none. Any-hit follows.
template <typename Spoil>
void spoil_hits(ValidatedModel& subject, Spoil spoil) {
  subject.intersector.intersect = [sound = subject.intersector.intersect, spoil](const Ray& ray) {
    std::optional<Hit> hit = sound(ray);
    return hit ? spoil(ray, *hit) : hit;
  };
  subject.intersector.occluded = [closest = subject.intersector.intersect](const Ray& ray) {
    return closest(ray).has_value();
  };
}

const char* const models[] = {"torus.obj", "cube_creases.obj", "tetrahedron.obj"};

}  // namespace

TEST_CASE("validate passes on sound models", "[tools][validate]") {
  for (const std::string model : models) {
    INFO(model);
    const Folder folder;
    const Outcome outcome = folder.run(
        {"validate", data_file(model), "--rays", "600", "--evaluations", "500", "--report", folder / "report.json"});
    INFO(outcome.text);
    CHECK(outcome.status == 0);
    const auto report = nlohmann::json::parse(read_file(folder / "report.json"));
    CHECK(report["passed"] == true);
    CHECK(report["disagreements"].empty());
    CHECK(report["evaluations"]["position"]["count"] == 500);
    CHECK(report["evaluations"]["position"]["max"] <= 1e-10);
    for (const char* kind : {"camera", "incoherent", "grazing"}) CHECK(report["rays"][kind]["rays"] == 200);
    CHECK(report["rays"]["aimed"]["rays"] == 60);
    CHECK(report["rays"]["all"]["hits"] > 200);
    CHECK(folder.list() == std::set<std::string>{"report.json"});
  }
}

TEST_CASE("validate holds conical vertices against plain refinement", "[tools][validate][sweep]") {
  const Folder folder;
  const std::string octahedron =
      "v 0 0 1\nv 1.1 0 0\nv 0 1 0.1\nv -1 0.1 0\nv 0 -1 0\nv 0 0.1 -1\nf 1 2 3\nf 1 3 4\nf 1 4 5\nf 1 5 2\nf 6 3 2\n"
      "f 6 4 3\nf 6 5 4\nf 6 2 5\nt cone 2/0/0 0 5\n";
  const std::string model = folder.write("cone.obj", octahedron);
  const std::string smooth = folder.write("smooth.obj", octahedron + "t smoothtriangles 0/0/1 smooth\n");
  for (const auto& [file, scheme] : {std::pair(model, "loop"), std::pair(model, "catmark"),
                                     std::pair(smooth, "catmark"), std::pair(model, "bilinear")}) {
    const Outcome outcome = folder.run({"validate", file, "--scheme", scheme, "--evaluations", "60", "--rays", "60"});
    CAPTURE(file, scheme, outcome.text);
    CHECK(outcome.status == 0);
    CHECK(outcome.text.find("plain refinement by the masks (good to 1e-13") != std::string::npos);
  }
}

TEST_CASE("validate at full size", "[tools][validate][sweep]") {
  for (const std::string model : models) {
    INFO(model);
    const Folder folder;
    const Outcome outcome = folder.run({"validate", data_file(model)});
    INFO(outcome.text);
    CHECK(outcome.status == 0);
  }
}

TEST_CASE("validate refuses bad input and leaves no report", "[tools][validate]") {
  const Folder folder;
  const Outcome missing = folder.run({"validate", folder / "missing.obj", "--report", folder / "report.json"});
  CHECK(missing.status == 3);
  CHECK(missing.text.find("missing.obj") != std::string::npos);
  CHECK(folder.run({"validate", folder.write("word.obj", "v 0 zero 0\n"), "--report", folder / "r.json"}).status == 3);
  CHECK(folder.run({"validate", data_file("torus.obj"), "--report", folder / "no/folder.json"}).status == 3);
  CHECK(folder.run({"validate", data_file("torus.obj"), "--rays", "-5"}).status == 2);
  CHECK(folder.list() == std::set<std::string>{"word.obj"});
}

TEST_CASE("validate's figures depend on the seed alone", "[tools][validate]") {
  const Folder folder;
  const auto figures = [&](const std::string& seed, const std::string& threads) {
    folder.run({"validate", data_file("tetrahedron.obj"), "--rays", "90", "--evaluations", "200", "--seed", seed,
                "--threads", threads, "--report", folder / "report.json"});
    auto report = nlohmann::json::parse(read_file(folder / "report.json"));
    report.erase("seconds");
    return report;
  };
  CHECK(figures("3", "1") == figures("3", "2"));
  CHECK(figures("3", "1")["rays"] != figures("4", "1")["rays"]);
}

TEST_CASE("a wrong position is caught", "[tools][validate]") {
  ValidatedModel subject("cube_creases.obj");
  REQUIRE(subject.evaluations().passed());
  const double diagonal = subject.oracle.diagonal();
  SECTION("off by 1e-9 of the diagonal") {
    spoil_samples(subject, [=](LimitSample& sample) { sample.position.x() += 1e-9 * diagonal; });
    const EvaluationReport report = subject.evaluations();
    CHECK(count_of(report.disagreements, "position") == 400);
    CHECK(report.positions.summary.max == Approx(1e-9).epsilon(1e-5));
  }
  SECTION("off by 1e-13 everywhere: only the median tells") {
    spoil_samples(subject, [=](LimitSample& sample) { sample.position.y() += 1e-13 * diagonal; });
    const EvaluationReport report = subject.evaluations();
    CHECK(report.disagreements.empty());
    CHECK_FALSE(report.median_passes());
    CHECK_FALSE(report.passed());
  }
  SECTION("not a number") {
    spoil_samples(subject, [](LimitSample& sample) { sample.position.z() = std::nan(""); });
    const EvaluationReport report = subject.evaluations();
    CHECK(count_of(report.disagreements, "position") == 400);
    CHECK(std::isinf(report.positions.summary.max));
  }
}

TEST_CASE("a wrong normal is caught", "[tools][validate]") {
  ValidatedModel subject("tetrahedron.obj");
  SECTION("turned by 1e-6 rad") {
    spoil_samples(subject, [](LimitSample& sample) {
      sample.normal = (sample.normal + 1e-6 * sample.normal.unitOrthogonal()).normalized();
    });
  }
  SECTION("flipped") {
    spoil_samples(subject, [](LimitSample& sample) { sample.normal = -sample.normal; });
  }
  SECTION("not unit") {
    spoil_samples(subject, [](LimitSample& sample) { sample.normal *= 1 + 1e-6; });
  }
  SECTION("not a number") {
    spoil_samples(subject, [](LimitSample& sample) { sample.normal.setConstant(std::nan("")); });
  }
  const EvaluationReport report = subject.evaluations();
  CHECK(count_of(report.disagreements, "normal") == 400);
  CHECK(count_of(report.disagreements, "position") == 0);
}

TEST_CASE("wrong derivatives are caught", "[tools][validate]") {
  ValidatedModel subject("torus.obj");
  SECTION("per another unit of u") {
    spoil_samples(subject, [](LimitSample& sample) { sample.derivatives->du *= 2; });
  }
  SECTION("a second derivative of the wrong sign") {
    spoil_samples(subject, [](LimitSample& sample) { sample.derivatives->dvv *= -1; });
  }
  SECTION("none") {
    spoil_samples(subject, [](LimitSample& sample) { sample.derivatives.reset(); });
  }
  const EvaluationReport report = subject.evaluations();
  // Close to corners, second derivatives carry more rounding, and are allowed it.
  CHECK(count_of(report.disagreements, "derivatives") >= 360);
}

TEST_CASE("a face with a limit surface too many or too few is caught", "[tools][validate]") {
  ValidatedModel subject("hole.obj");
  const EvaluationReport sound = subject.evaluations();
  REQUIRE(sound.passed());
  REQUIRE(sound.faces_without_limit == 1);
  SECTION("a value in the hole") {
    subject.evaluator.evaluate = [](const SurfaceParameter&) { return LimitSample{}; };
    CHECK(count_of(subject.evaluations(0).disagreements, "evaluation") == 1);
  }
  SECTION("the hole has a limit") {
    subject.evaluator.has_limit = [](int) { return true; };
    CHECK(count_of(subject.evaluations(0).disagreements, "has_limit") == 1);
  }
  SECTION("nothing anywhere") {
    subject.evaluator.evaluate = [](const SurfaceParameter&) { return std::nullopt; };
    const EvaluationReport report = subject.evaluations(100);
    CHECK(count_of(report.disagreements, "evaluation") ==
          100 + static_cast<std::size_t>(sound.faces - sound.faces_without_limit));
  }
  SECTION("subs that a quad does not have") {
    subject.evaluator.sub_count = [](int) { return 4; };
    CHECK(count_of(subject.evaluations(0).disagreements, "sub_count") == static_cast<std::size_t>(sound.faces));
  }
}

TEST_CASE("lost hits are caught", "[tools][validate]") {
  ValidatedModel subject("torus.obj");
  const RayReport sound = subject.rays();
  REQUIRE(sound.passed());
  REQUIRE(sound.total().hits > 150);
  SECTION("near edges of patches") {
    spoil_hits(subject, [](const Ray&, const Hit& hit) {
      const double nearest = std::min({hit.at.u, 1 - hit.at.u, hit.at.v, 1 - hit.at.v});
      return nearest < 1e-6 ? std::optional<Hit>() : hit;
    });
    const RayReport report = subject.rays();
    CHECK(report.by_kind[3].lost >= 15);  // of 30 that are aimed at edges and vertices
    CHECK(report.total().lost == count_of(report.disagreements, "lost hit"));
  }
  SECTION("all of them") {
    spoil_hits(subject, [](const Ray&, const Hit&) { return std::optional<Hit>(); });
    const RayReport report = subject.rays();
    CHECK(report.total().lost + report.total().undecided >= sound.total().hits);
    CHECK(report.total().lost >= sound.total().hits * 9 / 10);
  }
  SECTION("for a farther one") {
    spoil_hits(subject, [&scene = subject.scene](Ray ray, const Hit& hit) -> std::optional<Hit> {
      ray.tmin = hit.t * (1 + 1e-6);
      const std::optional<Hit> next = scene.intersect(ray);
      return next ? next : hit;
    });
    const RayReport report = subject.rays();
    CHECK(count_of(report.disagreements, "lost hit: a farther one") >= 50);
    CHECK(report.total().ghosts == 0);
  }
}

TEST_CASE("ghost hits are caught", "[tools][validate]") {
  ValidatedModel subject("tetrahedron.obj");
  const RayReport sound = subject.rays();
  REQUIRE(sound.passed());
  const double diagonal = subject.oracle.diagonal();
  SECTION("beside the surface") {
    spoil_hits(subject, [=](const Ray& ray, Hit hit) -> std::optional<Hit> {
      const double step = 1e-8 * diagonal / ray.direction.norm();
      hit.t += step;
      hit.sample.position += step * ray.direction;
      return hit;
    });
    CHECK(count_of(subject.rays().disagreements, "ghost hit: off the surface") == sound.total().hits);
  }
  SECTION("beside the ray") {
    spoil_hits(subject, [=](const Ray& ray, Hit hit) -> std::optional<Hit> {
      hit.t += 1e-10 * (hit.t + diagonal / ray.direction.norm());
      return hit;
    });
    CHECK(count_of(subject.rays().disagreements, "ghost hit: off the ray") == sound.total().hits);
  }
  SECTION("outside the interval") {
    subject.intersector.intersect = [&scene = subject.scene](Ray ray) {
      ray.tmin = -std::numeric_limits<double>::infinity();
      ray.tmax = -ray.tmin;
      return scene.intersect(ray);
    };
    CHECK(count_of(subject.rays().disagreements, "ghost hit: interval") > 0);
  }
}

TEST_CASE("a hit's wrong normal and a wrong any-hit answer are caught", "[tools][validate]") {
  ValidatedModel subject("torus.obj");
  const std::size_t hits = subject.rays().total().hits;
  SECTION("towards the ray") {
    spoil_hits(subject, [](const Ray& ray, Hit hit) -> std::optional<Hit> {
      if (hit.sample.normal.dot(ray.direction) > 0) hit.sample.normal *= -1;
      return hit;
    });
    const RayReport report = subject.rays();
    CHECK(count_of(report.disagreements, "normal of a hit") > 10);
    CHECK(report.total().wrong_normals == report.disagreements.size());
  }
  SECTION("never occluded") {
    subject.intersector.occluded = [](const Ray&) { return false; };
    CHECK(subject.rays().total().wrong_occluded == hits);
  }
}

TEST_CASE("sampled parameters lie in the domain and crowd towards corners", "[tools][validate]") {
  for (const std::string model : {"torus.obj", "loop_torus.obj"}) {
    INFO(model);
    const ControlMesh mesh = read_obj(data_file(model));
    const OpenSubdivOracle oracle(mesh, default_scheme(mesh));
    const auto parameters = sample_parameters(oracle, 8000, 5);
    REQUIRE(parameters.size() == 8000);
    std::size_t near = 0, at_corner = 0, hairs = 0;
    for (const SurfaceParameter& at : parameters) {
      REQUIRE((at.u >= 0 && at.u <= 1 && at.v >= 0 && at.v <= 1));
      if (oracle.triangular()) REQUIRE(at.u + at.v <= 1);
      const double distance = oracle.triangular() ? 1 - std::max({1 - at.u - at.v, at.u, at.v})
                                                  : std::max(std::min(at.u, 1 - at.u), std::min(at.v, 1 - at.v));
      near += distance < 1e-4;
      at_corner += distance == 0;
      hairs += distance > 0 && distance < 0.9e-8;
    }
    // Of 2000: the corners, what is closer than 1e-8, and half the rest. Where 1 - distance rounds to 1, v alone is
    // small, and zero on some sides.
    CHECK(near == Approx(2000 * (2 + 14 * 0.5) / 16).margin(120));
    CHECK(at_corner >= 85);
    CHECK(hairs >= 30);
  }
}

TEST_CASE("sampled rays are of the kinds that they are named", "[tools][validate]") {
  const ControlMesh mesh = read_obj(data_file("torus.obj"));
  const OpenSubdivOracle oracle(mesh, "catmark");
  const auto rays = sample_rays(oracle, 3000, 5);
  REQUIRE(rays.size() == 3300);
  std::array<std::size_t, 4> counts{};
  const DenseCheck dense(oracle, 3);
  double least = 1, most = 0;
  for (const ProbeRay& probe : rays) {
    ++counts[static_cast<std::size_t>(probe.kind)];
    REQUIRE(probe.ray.direction.norm() > 0);
    REQUIRE(probe.target.has_value() == (probe.kind == RayKind::grazing || probe.kind == RayKind::aimed));
    if (probe.kind != RayKind::grazing) continue;
    const double slack = 1e-6 / probe.ray.direction.norm();
    const auto hit = dense.closest(probe.ray.origin, probe.ray.direction, *probe.target - slack, *probe.target + slack);
    if (!hit) continue;  // not every tangent is found on so coarse a grid
    const double tilt = std::asin(std::abs(hit->sample.normal.dot(probe.ray.direction.normalized())));
    least = std::min(least, tilt), most = std::max(most, tilt);
  }
  CHECK(counts == std::array<std::size_t, 4>{1000, 1000, 1000, 300});
  CHECK(least < 2e-4);
  CHECK(most == Approx(0.1).margin(0.01));
}

TEST_CASE("order statistics are nearest ranks", "[tools][validate]") {
  std::vector<double> errors(200);
  std::iota(errors.begin(), errors.end(), 1.0);
  std::swap(errors[3], errors[199]);
  const ErrorSummary summary = summarize(errors);
  CHECK(summary.count == 200);
  CHECK(summary.median == 100);
  CHECK(summary.p99 == 198);
  CHECK(summary.max == 200);
  CHECK(summary.worst == 3);
  CHECK(summarize({}).count == 0);
  const std::vector<double> with_nan{1, std::nan(""), 2};
  CHECK(std::isinf(summarize(with_nan).max));
  CHECK(summarize(with_nan).worst == 1);
}

TEST_CASE("a normal is undetermined where rounding of the derivatives turns it", "[tools][validate]") {
  Derivatives d{Vec3::UnitX(), Vec3::UnitY(), {}, {}, {}};
  CHECK(normal_uncertainty(d) == Approx(32 * 0x1p-53));
  d.dv = {1, 1e-6, 0};
  CHECK(normal_uncertainty(d) == Approx(32 * 0x1p-53 * 1e6));
  d.dv = {1, 1e-9, 0};
  CHECK(normal_uncertainty(d) > 1e-7);
  CHECK_FALSE(has_determined_normal({Vec3::Zero(), Vec3::UnitZ(), d}));
  d.dv = d.du;
  CHECK(std::isinf(normal_uncertainty(d)));
  CHECK_FALSE(has_determined_normal({Vec3::Zero(), Vec3::Zero(), {}}));
  CHECK(has_determined_normal({Vec3::Zero(), Vec3::UnitZ(), {}}));
}

}  // namespace shaolin::test
