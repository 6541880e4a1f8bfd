// `shaolin stress --peers`: the same rays asked of Embree and CGAL, and counted where they differ.
#include "tests/catch.h"
#include "tests/tools/cli_run.h"
#include "tools/stress/meshes.h"
#include "tools/stress/run.h"

namespace shaolin::stress {

using test::data_file;
using test::Folder;
using test::read_rows;

namespace {

struct PeerRow {
  std::string family, peer;
  std::size_t rays, hits, lost, ghosts, astray;
};

std::vector<PeerRow> rows_of(const Peers& peers) {
  std::vector<PeerRow> rows;
  for (const auto& row : peers.table().rows) {
    const auto number = [&](std::size_t i) { return static_cast<std::size_t>(std::stoull(row[i])); };
    rows.push_back({row[0], row[1], number(2), number(3), number(4), number(5), number(6)});
  }
  return rows;
}

std::vector<PeerRow> run_beside(const QueriesOf& queries_of) {
  Peers peers(4);
  run({.models = {sound_models().front()},
       .families = {"lines", "vertices"},
       .rays = 128,
       .queries_of = queries_of,
       .peers = &peers});
  return rows_of(peers);
}

}  // namespace

TEST_CASE("Peers agree on most rays of a closed smooth body", "[tools][stress]") {
  const std::vector<PeerRow> rows = run_beside(RayQueries::of);
  std::size_t families = 0;
  for (const PeerRow& row : rows) {
    CAPTURE(row.family, row.peer);
    if (row.peer.find("CGAL") == std::string::npos) CHECK(row.rays >= 128);
    CHECK(row.lost + row.ghosts + row.astray <= row.rays / 4);
    families += row.family == "lines";
  }
  CHECK(families >= 2);
}

TEST_CASE("Embree is asked in its robust mode", "[tools][stress]") {
  // From inside of a sphere far away its triangles lose 14 of 256 such rays without it.
  Peers peers(3);
  run({.families = {"watertight"}, .rays = 128, .peers = &peers});
  std::size_t rays = 0;
  for (const PeerRow& row : rows_of(peers)) {
    if (row.peer.find("Embree triangles") == std::string::npos || row.family == "all") continue;
    rays += row.rays;
    CHECK(row.lost == 0);
  }
  CHECK(rays >= 128);
}

TEST_CASE("Peers are counted against answers that are lost, made up or far off", "[tools][stress]") {
  const auto spoilt = [](auto spoil) -> QueriesOf {
    return [spoil](const Scene& scene) {
      RayQueries queries = RayQueries::of(scene);
      queries.intersect = [&scene, spoil](const Ray& ray) {
        std::optional<Hit> hit = scene.intersect(ray);
        spoil(hit);
        return hit;
      };
      return queries;
    };
  };
  for (const PeerRow& row : run_beside(spoilt([](std::optional<Hit>& hit) { hit.reset(); }))) {
    CAPTURE(row.family, row.peer);
    CHECK(row.hits == 0);
    CHECK(row.lost == 0);
    if (row.rays > 0) CHECK(row.ghosts > row.rays / 4);
  }
  for (const PeerRow& row : run_beside(spoilt([](std::optional<Hit>& hit) {
         if (hit) hit->t += 1;
       }))) {
    CAPTURE(row.family, row.peer);
    if (row.rays > 0) CHECK(row.astray > row.rays / 4);
  }
  for (const PeerRow& row : run_beside(spoilt([](std::optional<Hit>& hit) { hit.emplace(); }))) {
    CAPTURE(row.family, row.peer);
    CHECK(row.hits == row.rays);
    CHECK(row.ghosts == 0);
  }
}

TEST_CASE("stress --peers prints and writes what peers made of the rays", "[tools][stress][cli]") {
  const Folder folder;
  const test::Outcome outcome = folder.run({"stress", data_file("torus.obj"), "--rays", "16", "--family", "vertices",
                                            "--peers", "3", "--report", folder / "report"});
  CHECK(outcome.status == 0);
  CHECK(outcome.text.find("CGAL, level 3") != std::string::npos);
  CHECK(read_rows(folder / "report/peers.csv").size() >= 3);
  CHECK(folder.run({"stress", "--peers", "0"}).status == 2);
}

}  // namespace shaolin::stress
