// The conformance kit: the built-in schemes pass, and each slip that published code has made is caught by the check
// that is named here.
#include "tools/conformance/conformance.h"

#include <cmath>
#include <numbers>
#include <set>
#include <sstream>

#include "schemes/builtin.h"
#include "tests/catch.h"
#include "tests/tools/cli_run.h"
#include "tools/conformance/report.h"

namespace shaolin {

namespace {

/// The checks that fail.
std::set<std::string> failures(const ConformanceReport& report) {
  std::set<std::string> names;
  for (const CheckResult& check : report.checks)
    if (check.verdict == Verdict::fail) names.insert(check.name);
  return names;
}

template <Scheme S>
std::set<std::string> failures_of() {
  return failures(check_conformance("mutant", std::make_shared<MasksOf<S>>()));
}

/// Averages the two face points only; a cube's edge lands wrong.
struct EdgeOfFacePoints : CatmullClark {
  static EdgeMask smooth_edge() { return {0, 0.5}; }
};

/// The limit weights that belong to the edge rule (3/8, 5/8).
struct WrongCreaseLimit : Loop {
  static constexpr CreaseMask crease{3.0 / 4, 1.0 / 8, 3.0 / 5, 1.0 / 5};
};

/// A square root where Loop squares: 0.201 instead of 3/16 at valence 3.
struct RootOfSquare : LoopMasks<RootOfSquare> {
  static constexpr Smoothness smoothness = Loop::smoothness;
  static double neighbour_weight(int n) {
    return (5.0 / 8 - std::sqrt(3 + 2 * std::cos(2 * std::numbers::pi / n)) / 64) / n;
  }
};

/// Pins a dart like a corner.
template <class Base>
struct PinnedDart : Base {
  static VertexMask dart_vertex(int) { return {1, 0, 0}; }
};

struct SumNotOne : Loop {
  static EdgeMask smooth_edge() { return {3.0 / 8, 0.1251}; }
};

struct SecondHarmonic : CatmullClark {
  static RingMask smooth_tangent(int n, double first) { return CatmullClark::smooth_tangent(n, 2 * first + 0.3); }
};

struct VertexLimit : CatmullClark {
  static LimitMask smooth_limit(int) { return {1, 0, 0}; }
};

/// Sums to one, and leaves the hull: bounds follow, the named splines do not.
struct NegativeSides : Loop {
  static EdgeMask smooth_edge() { return {0.75, -0.25}; }
};

/// Keeps the ring's mean where it is: the limit depends on how often it was refined.
struct NeverConverges : Loop {
  static VertexMask smooth_vertex(int n) { return {-0.25, 1.25 / n, 0}; }
};

struct ClaimsTangents : Bilinear {
  static constexpr Smoothness smoothness = smooth_surface;
};

}  // namespace

TEST_CASE("The built-in schemes pass every check", "[tools][conformance]") {
  for (const BuiltinScheme& scheme : builtin_schemes()) {
    CAPTURE(scheme.name);
    const ConformanceReport report = check_conformance(scheme.name, builtin_masks(scheme.name));
    CHECK(failures(report).empty());
    CHECK(report.passed());
    CHECK(report.checks.size() >= 18);
    const bool smooth = builtin_masks(scheme.name)->smoothness().smooth >= 1;
    CHECK(report.maps.size() == (smooth ? 10u : 0u));
    for (const CharacteristicMap& map : report.maps) CHECK(map.is_injective());
  }
}

TEST_CASE("Known defects of published rules are findings", "[tools][conformance]") {
  for (const std::string name : {"loop", "catmark"}) {
    const ConformanceReport report = check_conformance(name, builtin_masks(name));
    const auto crease = std::find_if(report.checks.begin(), report.checks.end(),
                                     [](const CheckResult& c) { return c.name == "spectrum, crease"; });
    REQUIRE(crease != report.checks.end());
    CHECK(crease->verdict == Verdict::finding);
    CHECK(!crease->note.empty());
  }
}

TEST_CASE("Each slip is caught by its check", "[tools][conformance][sweep]") {
  CHECK(failures_of<EdgeOfFacePoints>().count("regular basis") == 1);
  CHECK(failures_of<WrongCreaseLimit>().count("crease is its curve") == 1);
  CHECK(failures_of<WrongCreaseLimit>().count("limit masks") == 1);
  CHECK(RootOfSquare::smooth_vertex(3).edge == Approx(0.201).epsilon(1e-3));
  CHECK(failures_of<RootOfSquare>() == std::set<std::string>{"mean mode"});
  CHECK(failures_of<PinnedDart<Loop>>().count("spectrum, dart") == 1);
  CHECK(failures_of<PinnedDart<CatmullClark>>().count("spectrum, dart") == 1);
  CHECK(failures_of<SumNotOne>().count("weights sum to one") == 1);
  CHECK(failures_of<SecondHarmonic>() == std::set<std::string>{"tangent masks"});
  CHECK(failures_of<VertexLimit>().count("limit masks") == 1);
  CHECK(failures_of<NegativeSides>().count("regular basis") == 1);
  CHECK(failures_of<NeverConverges>().empty() == false);
  CHECK(failures_of<ClaimsTangents>().count("spectrum, smooth") == 1);
}

TEST_CASE("Eigenvalues are the literature's", "[tools][conformance]") {
  for (const std::string name : {"loop", "catmark"}) {
    const ConformanceReport report = check_conformance(name, builtin_masks(name));
    for (const SpectrumRow& row : report.spectra) {
      if (row.kind != StarKind::smooth) continue;
      CAPTURE(name, row.faces);
      const double angle = 2 * std::numbers::pi / row.faces, c = std::cos(angle);
      const double expected =
          name == "loop" ? 3.0 / 8 + c / 4 : (5 + c + std::cos(angle / 2) * std::sqrt(18 + 2 * c)) / 16;
      CHECK(row.moduli[0] == Approx(1).epsilon(1e-10));
      CHECK(row.moduli[1] == Approx(expected).epsilon(1e-10));
      CHECK(row.moduli[2] == Approx(expected).epsilon(1e-10));
    }
  }
}

TEST_CASE("shaolin scheme lists, shows and checks", "[tools][conformance]") {
  const test::Folder folder;
  const test::Outcome list = folder.run({"scheme", "list"});
  CHECK(list.status == 0);
  for (const BuiltinScheme& scheme : builtin_schemes()) CHECK(list.text.find(scheme.name) != std::string::npos);

  const test::Outcome show = folder.run({"scheme", "show", "loop"});
  CHECK(show.status == 0);
  CHECK(show.text.find("0.18750000") != std::string::npos);  // 3/16 at valence 3
  CHECK(show.text.find("0.250000") != std::string::npos);    // its subdominant eigenvalue

  const test::Outcome check = folder.run({"scheme", "check", "catmark", "--report", (folder / "report").string()});
  CHECK(check.status == 0);
  CHECK(check.text.find("limit masks") != std::string::npos);
  CHECK(check.text.find("PASS") != std::string::npos);
  const std::string page = test::read_file(folder / "report/catmark.html");
  CHECK(page.find("<svg") != std::string::npos);
  CHECK(page.find("valence 12") != std::string::npos);
  CHECK(page.find("nan") == std::string::npos);

  const test::Outcome few = folder.run({"scheme", "check", "loop", "--valence", "3"});
  CHECK(few.status == 0);
  CHECK(few.text.find("smooth of 3 faces") != std::string::npos);
  CHECK(few.text.find("smooth of 4 faces") == std::string::npos);

  CHECK(folder.run({"scheme"}).status == 2);
  CHECK(folder.run({"scheme", "check", "loop", "--valence", "2"}).status == 2);
  CHECK(folder.run({"scheme", "check", "doo-sabin"}).status == 2);
  folder.write("file", "");
  CHECK(folder.run({"scheme", "check", "loop", "--report", (folder / "file").string()}).status == 3);
}

}  // namespace shaolin
