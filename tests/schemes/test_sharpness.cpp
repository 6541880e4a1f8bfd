// The sharpness rules against hand-computed values and against OpenSubdiv's own.
#include "schemes/sharpness.h"

#include <opensubdiv/sdc/crease.h>

#include <vector>

#include "tests/catch.h"
#include "tests/random.h"

namespace shaolin {

namespace Sdc = OpenSubdiv::Sdc;

namespace {

VertexRule rule_of(Sdc::Crease::Rule rule) {
  switch (rule) {
    case Sdc::Crease::RULE_SMOOTH:
      return VertexRule::smooth;
    case Sdc::Crease::RULE_DART:
      return VertexRule::dart;
    case Sdc::Crease::RULE_CREASE:
      return VertexRule::crease;
    default:
      return VertexRule::corner;
  }
}

/// Smooth, infinite and everything between, the whole numbers among it.
float some_sharpness(Random& random) {
  switch (random.index(6)) {
    case 0:
      return infinite_sharpness;
    case 1:
      return static_cast<float>(random.index(11));
    case 2:
      return static_cast<float>(random.uniform(0, 9.99));
    default:
      return 0;
  }
}

}  // namespace

TEST_CASE("Sharpness decays by one a level, infinite sharpness stays", "[schemes][sharpness]") {
  CHECK(decayed(0.0f) == 0.0f);
  CHECK(decayed(0.25f) == 0.0f);
  CHECK(decayed(1.0f) == 0.0f);
  CHECK(decayed(1.5f) == 0.5f);
  CHECK(decayed(9.75f) == 8.75f);
  CHECK(decayed(10.0f) == 10.0f);
  CHECK(decayed(1e30f) == 10.0f);
  float sharpness = 9.99f;
  int levels = 0;
  for (; is_sharp(sharpness); ++levels) sharpness = decayed(sharpness);
  CHECK(levels == 10);
}

TEST_CASE("Sharpness classes meet at 0 and 10", "[schemes][sharpness]") {
  CHECK_FALSE(is_sharp(0));
  CHECK(is_sharp(1e-30f));
  CHECK(is_semi_sharp(9.9999f));
  CHECK_FALSE(is_semi_sharp(10));
  CHECK(is_infinite(10));
  CHECK(edge_crease_share(0, decayed(0), decayed(0)) == 0);
  CHECK(edge_crease_share(0.3f, decayed(0.3f), decayed(0.3f)) == 0.3f);
  CHECK(edge_crease_share(1, decayed(1), decayed(1)) == 1);
  CHECK(edge_crease_share(7, decayed(7), decayed(7)) == 1);
}

TEST_CASE("The rule follows the number of sharp edges, a sharp vertex is a corner", "[schemes][sharpness]") {
  const auto rule = [](float vertex, std::vector<float> edges) { return vertex_rule(vertex, edges); };
  CHECK(rule(0, {0, 0, 0}) == VertexRule::smooth);
  CHECK(rule(0, {0, 0.1f, 0}) == VertexRule::dart);
  CHECK(rule(0, {10, 0.1f, 0}) == VertexRule::crease);
  CHECK(rule(0, {1, 2, 3}) == VertexRule::corner);
  CHECK(rule(0, {1, 2, 3, 4, 5}) == VertexRule::corner);
  CHECK(rule(0.5f, {0, 0, 0}) == VertexRule::corner);
}

/// Under uniform decay.
VertexTransition transition(float vertex, const std::vector<float>& edges) {
  std::vector<float> halves;
  for (const float sharpness : edges) halves.push_back(decayed(sharpness));
  return vertex_transition(vertex, edges, halves);
}

TEST_CASE("A transition blends by the mean of the sharpness that ends", "[schemes][sharpness]") {
  SECTION("a crease that ends turns smooth") {
    const std::vector<float> edges{0, 0.25f, 0, 0.75f};
    const VertexTransition t = transition(0, edges);
    CHECK(t.parent == VertexRule::crease);
    CHECK(t.child == VertexRule::smooth);
    CHECK(t.parent_weight == 0.5f);
    CHECK(t.parent_crease == std::array<int, 2>{1, 3});
  }
  SECTION("one end of a crease ends: a dart") {
    const VertexTransition t = transition(0, {0.25f, 3, 0});
    CHECK(t.child == VertexRule::dart);
    CHECK(t.parent_weight == 0.25f);
  }
  SECTION("a corner of three edges turns into a crease of the two that remain") {
    const VertexTransition t = transition(0, {2, 0.5f, 10});
    CHECK(t.parent == VertexRule::corner);
    CHECK(t.child == VertexRule::crease);
    CHECK(t.parent_weight == 0.5f);
    CHECK(t.child_crease == std::array<int, 2>{0, 2});
  }
  SECTION("vertex and edges end together") {
    const VertexTransition t = transition(1.0f, {0.5f, 0, 0});
    CHECK(t.parent == VertexRule::corner);
    CHECK(t.child == VertexRule::smooth);
    CHECK(t.parent_weight == 0.75f);
  }
  SECTION("nothing changes: no blend") {
    const VertexTransition t = transition(0, {10, 0, 5});
    CHECK(t.parent == VertexRule::crease);
    CHECK(t.child == VertexRule::crease);
    CHECK(t.parent_weight == 1);
    CHECK(t.child_crease == t.parent_crease);
  }
}

TEST_CASE("Chaikin's decay is OpenSubdiv's", "[schemes][sharpness]") {
  Sdc::Options options;
  options.SetCreasingMethod(Sdc::Options::CREASE_CHAIKIN);
  const Sdc::Crease osd(options);
  Random random(4);
  int mixed = 0;
  for (int round = 0; round < 20000; ++round) {
    std::vector<float> edges;
    SemiSharpEdges around(CreaseMethod::chaikin), uniform(CreaseMethod::uniform);
    for (int i = 2 + random.index(6); i > 0; --i) edges.push_back(some_sharpness(random));
    for (const float s : edges) around.add(s), uniform.add(s);
    std::vector<float> expected(edges.size());
    osd.SubdivideEdgeSharpnessesAroundVertex(static_cast<int>(edges.size()), edges.data(), expected.data());
    for (std::size_t i = 0; i < edges.size(); ++i) {
      REQUIRE(around.decayed(edges[i]) == Approx(expected[i]).epsilon(1e-6).margin(1e-6));
      REQUIRE(uniform.decayed(edges[i]) == decayed(edges[i]));
      mixed += around.decayed(edges[i]) != uniform.decayed(edges[i]);
    }
  }
  CHECK(mixed > 1000);
}

TEST_CASE("Rules, decay and blend weights are OpenSubdiv's", "[schemes][sharpness]") {
  Sdc::Options options;
  options.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_EDGE_ONLY);
  const Sdc::Crease osd(options);
  Random random(3);
  for (int round = 0; round < 20000; ++round) {
    const int n = 2 + random.index(6);
    const float vertex = random.index(3) ? 0 : some_sharpness(random);
    std::vector<float> edges, child_edges;
    for (int i = 0; i < n; ++i) edges.push_back(some_sharpness(random));
    for (const float s : edges) child_edges.push_back(osd.SubdivideUniformSharpness(s));
    const float child_vertex = osd.SubdivideVertexSharpness(vertex);
    CAPTURE(vertex, edges);
    for (std::size_t i = 0; i < edges.size(); ++i) REQUIRE(decayed(edges[i]) == child_edges[i]);
    REQUIRE(decayed(vertex) == child_vertex);

    const Sdc::Crease::Rule parent = osd.DetermineVertexVertexRule(vertex, n, edges.data());
    const Sdc::Crease::Rule child = osd.DetermineVertexVertexRule(child_vertex, n, child_edges.data());
    const VertexTransition t = vertex_transition(vertex, edges, child_edges);
    REQUIRE(t.parent == rule_of(parent));
    // A smooth parent needs no child rule: both masks are the smooth one.
    if (t.parent == VertexRule::smooth || t.parent == VertexRule::dart) continue;
    REQUIRE(t.child == rule_of(child));
    if (parent == child) {
      REQUIRE(t.parent_weight == 1);
      continue;
    }
    const float weight = osd.ComputeFractionalWeightAtVertex(vertex, child_vertex, n, edges.data(), child_edges.data());
    REQUIRE(t.parent_weight == Approx(weight).epsilon(1e-6));
  }
}

}  // namespace shaolin
