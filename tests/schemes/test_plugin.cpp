// Schemes from shared libraries: what is refused, what is handed over, and the masks of the examples.
#include <numeric>

#include "intersect/scene.h"
#include "schemes/builtin.h"
#include "schemes/errors.h"
#include "schemes/limit_surface.h"
#include "schemes/load_plugin.h"
#include "schemes/plugin.h"
#include "tests/models.h"
#include "tests/plugins/plugin_files.h"
#include "tests/schemes/mask_sum.h"

namespace shaolin {

using test::bad_plugin;
using test::example_plugin;
using test::Fault;
using test::Folder;

namespace {

std::string refusal(const std::filesystem::path& file) {
  try {
    load_plugin(file);
  } catch (const InputError& error) {
    CHECK(error.file() == file.string());
    return error.what();
  }
  return "accepted";
}

void check_same(const RingMask& a, const RingMask& b) {
  CHECK(a.vertex == b.vertex);
  CHECK(a.edges == b.edges);
  CHECK(a.diagonals == b.diagonals);
}

/// Masks of a compile-time scheme, through the C struct and without it.
template <Scheme S>
void check_round_trip() {
  const shaolin_plugin plugin = make_plugin<S>("Type");
  CAPTURE(plugin.name);
  CHECK(plugin.version == SHAOLIN_PLUGIN_VERSION);
  CHECK(plugin.name == std::string(S::name));
  CHECK(plugin.has_crease == 1);
  CHECK(plugin.has_closed_limits == 1);
  CHECK(plugin.edge_end == nullptr);
  std::vector<double> values(100);
  shaolin_weights out{values.data(), 100, nullptr, 0};
  for (int n = 3; n < 10; ++n) {
    REQUIRE(plugin.smooth_vertex(n, &out) == 3);
    const VertexMask vertex = S::smooth_vertex(n);
    CHECK((values[0] == vertex.vertex && values[1] == vertex.edge && values[2] == vertex.face));
    const RingMask tangent = S::smooth_tangent(n, 0.5);
    const int expected = tangent.edges.empty() ? 0 : 1 + n * (S::face_kind == FaceKind::quad ? 2 : 1);
    REQUIRE(plugin.smooth_tangent(n, 0.5, &out) == expected);
    if (expected > 0) CHECK(std::equal(tangent.edges.begin(), tangent.edges.end(), values.begin() + 1));
    const RingMask cross = S::crease_cross_tangent(n);
    const int count = plugin.crease_cross_tangent(n, &out);
    CHECK(count == (cross.edges.empty() ? 0 : 2 + n + (S::face_kind == FaceKind::quad ? n : 0)));
  }
}

}  // namespace

TEST_CASE("The C struct says what the scheme says", "[schemes][plugin]") {
  check_round_trip<Loop>();
  check_round_trip<CatmullClark>();
  check_round_trip<Bilinear>();
  // The tangent beside a single quad weighs no diagonal; the struct holds the zero.
  std::vector<double> values(5, 7);
  shaolin_weights out{values.data(), 5, nullptr, 0};
  CHECK(make_plugin<CatmullClark>("").crease_cross_tangent(1, &out) == 4);
  CHECK(values == std::vector<double>{-2, 1, 1, 0, 7});
  // A buffer that is too small is left alone behind its end, and the count says what is missing.
  out.capacity = 2;
  std::fill(values.begin(), values.end(), 7);
  CHECK(make_plugin<CatmullClark>("").smooth_vertex(4, &out) == 3);
  CHECK(values[2] == 7);
}

TEST_CASE("Files that are no plug-ins are refused", "[schemes][plugin]") {
  const Folder folder;
  CHECK_THAT(refusal(folder / "absent.so"), Catch::Contains("no such file"));
  CHECK_THAT(refusal(folder.write("text.so", "not a library\n")), Catch::Contains("expected a shared library"));
  CHECK_THAT(refusal(folder.write("empty.so", "")), Catch::Contains("expected a shared library"));
  CHECK_THAT(refusal(test::data_file("").parent_path()), Catch::Contains("is a directory"));
  CHECK_THAT(refusal(bad_plugin("no_entry")), Catch::Contains("does not export shaolin_scheme_plugin()"));
}

TEST_CASE("A plug-in with a fault is refused with the reason", "[schemes][plugin]") {
  for (const test::FaultMessage& expected : test::fault_messages) {
    const Fault fault(expected.fault);
    CAPTURE(expected.fault);
    CHECK_THAT(refusal(bad_plugin("faulty")), Catch::Contains(expected.message));
  }
  const LoadedPlugin sound = load_plugin(bad_plugin("faulty"));
  CHECK(sound.name == "Faulty");  // the type, for it has no member `name`
  CHECK(sound.masks->smooth_vertex(9).vertex == 1);
}

TEST_CASE("A mask that fails later is an error when it is asked for", "[schemes][plugin]") {
  const Fault fault("late throw");
  const LoadedPlugin plugin = load_plugin(bad_plugin("faulty"));
  CHECK(plugin.masks->smooth_vertex(8).vertex == 1);
  CHECK_THROWS_AS(plugin.masks->smooth_vertex(9), InputError);
  CHECK_THROWS_WITH(plugin.masks->dart_vertex(12),
                    Catch::Contains("smooth_vertex(12)") && Catch::Contains("more than eight is too many"));
}

TEST_CASE("The library stays loaded as long as its masks live", "[schemes][plugin]") {
  std::shared_ptr<const SchemeMasks> masks;
  { masks = load_plugin(example_plugin("kobbelt")).masks; }
  CHECK(masks->edge_end(4, 4).vertex == 9.0 / 16);
}

TEST_CASE("Loop's scheme in plain C gives Loop's surface", "[schemes][plugin]") {
  const LoadedPlugin plain = load_plugin(example_plugin("plain"));
  CHECK(plain.name == "plain");
  CHECK_FALSE(plain.has_crease);
  CHECK(plain.masks->crease().vertex == cubic_crease.vertex);
  CHECK_FALSE(plain.masks->has_closed_limits());
  for (int n = 3; n < 30; ++n)
    CHECK(plain.masks->smooth_vertex(n).edge == Approx(Loop::smooth_vertex(n).edge).epsilon(1e-14));
  const ControlMesh mesh = shaken(poles("loop", 7), 0.2);
  const auto ours = make_limit_surface(mesh, plain.masks), loop = make_limit_surface(mesh, "loop");
  const Scene scene(mesh, plain.masks);
  for (int f = 0; f < mesh.face_count(); ++f) {
    const auto a = ours->evaluate({f, 0, 0.2, 0.3}), b = loop->evaluate({f, 0, 0.2, 0.3});
    CHECK((a->position - b->position).norm() < 1e-13);
    Ray ray;
    ray.origin = b->position + b->normal;
    ray.direction = -b->normal;
    const auto hit = scene.intersect(ray);
    REQUIRE(hit);
    CHECK(hit->t <= 1 + 1e-12);
  }
}

TEST_CASE("The butterfly's masks are the published ones", "[schemes][plugin]") {
  const auto masks = load_plugin(example_plugin("butterfly")).masks;
  CHECK(masks->face_kind() == FaceKind::triangle);
  CHECK(masks->radius() == 2);
  CHECK(masks->basis() == Basis::none);
  const double side = 1.0 / 16, wing = -1.0 / 16;  // both ends give to the sides: 1/8
  check_same(masks->edge_end(6, 6), {0.5, {0, side, wing, 0, wing, side}, {}});
  check_same(masks->edge_end(3, 6), {0.75, {5.0 / 12, -1.0 / 12, -1.0 / 12}, {}});
  check_same(masks->edge_end(4, 6), {0.75, {3.0 / 8, 0, -1.0 / 8, 0}, {}});
  CHECK(masks->edge_end(5, 6).edges[0] == Approx(7.0 / 20).epsilon(1e-15));  // (1/4 + 1 + 1/2) / 5
  CHECK(sum(masks->edge_end(6, 5)) == 0);
  for (int n = 3; n <= 12; ++n) {
    CHECK(masks->smooth_vertex(n).vertex == 1);
    for (int other = 3; other <= 12; ++other) {
      CAPTURE(n, other);
      CHECK(sum(masks->edge_end(n, other)) + sum(masks->edge_end(other, n)) == Approx(1).epsilon(1e-15));
    }
  }
}

TEST_CASE("Kobbelt's masks are the four-point rule, and the same from both sides", "[schemes][plugin]") {
  const auto masks = load_plugin(example_plugin("kobbelt")).masks;
  CHECK(masks->face_kind() == FaceKind::quad);
  check_same(masks->edge_end(4, 7), {9.0 / 16, {0, 0, -1.0 / 16, 0}, {0, 0, 0, 0}});
  check_same(masks->face_corner(4), {81.0 / 256, {0, 0, -9.0 / 256, -9.0 / 256}, {0, 0, 1.0 / 256, 0}});
  for (int n = 3; n <= 12; ++n) {
    CAPTURE(n);
    const auto size = static_cast<std::size_t>(n);
    const RingMask edge = masks->edge_end(n, 4), corner = masks->face_corner(n);
    CHECK(sum(edge) == Approx(0.5).epsilon(1e-15));
    CHECK(sum(corner) == Approx(0.25).epsilon(1e-15));
    for (std::size_t i = 0; i < size; ++i) {
      // An edge's mirror takes spoke i to -i and diagonal i to -1 - i; a face's takes spoke i to 1 - i, diagonal i to
      // -i.
      CHECK(edge.edges[i] == Approx(edge.edges[(size - i) % size]).margin(1e-16));
      CHECK(edge.diagonals[i] == Approx(edge.diagonals[size - 1 - i]).margin(1e-16));
      CHECK(corner.edges[i] == Approx(corner.edges[(size + 1 - i) % size]).margin(1e-16));
      CHECK(corner.diagonals[i] == Approx(corner.diagonals[(size - i) % size]).margin(1e-16));
    }
    // The four-point rule across edge points in the direction of spoke 0 alone gives the same: 9/16 of the edge's half
    // and -1/16 of (9 spoke_-1 - diagonal_-2) / 16.
    for (std::size_t i = 0; i < size; ++i) {
      const double edge_share = i == size - 1 ? -9.0 / 256 : 0, diagonal_share = i == size - 2 ? 1.0 / 256 : 0;
      CHECK(corner.edges[i] == Approx(9.0 / 16 * edge.edges[i] + edge_share).margin(1e-16));
      CHECK(corner.diagonals[i] == Approx(9.0 / 16 * edge.diagonals[i] + diagonal_share).margin(1e-16));
    }
  }
}

TEST_CASE("The toy's slips pass the host", "[schemes][plugin]") {
  const auto masks = load_plugin(example_plugin("toy")).masks;
  const VertexMask three = masks->smooth_vertex(3);
  CHECK(three.vertex + 3 * three.edge > 1.1);
  CHECK(three.edge == Approx(0.201).margin(5e-4));
}

}  // namespace shaolin
