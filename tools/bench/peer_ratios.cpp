#include "tools/bench/peer_ratios.h"

#include <algorithm>

#include "tools/bench/page_parts.h"

namespace shaolin {

const char* const bar_note =
    "The exact method's time and memory over Embree's, run by run: median (least to most); below 1 the exact method is "
    "the better one. Its error along the ray is in diagonals of the scene.";

namespace {

constexpr std::array bar_levels{3, 5};

std::optional<Spread> time_ratio(const Measurement& exact, const Measurement& peer, Phase phase) {
  if (!exact.is_timed(phase) || !peer.is_timed(phase)) return std::nullopt;
  return ratio(exact, peer, phase);
}

std::optional<Spread> ratio_given_triangles(const Measurement& exact, const Measurement& peer) {
  if (!peer.is_timed(Phase::tessellation)) return std::nullopt;
  std::vector<double> ratios;
  for (std::size_t run = 0; run < peer.times(Phase::cold).size(); ++run)
    ratios.push_back(exact.times(Phase::cold)[run] /
                     (peer.times(Phase::cold)[run] - peer.times(Phase::tessellation)[run]));
  return spread(ratios);
}

std::vector<std::string> header() {
  std::vector<std::string> names{"exact over"};
  names.insert(names.end(), ratio_names.begin(), ratio_names.end());
  names.emplace_back("memory");
  return names;
}

std::vector<std::string> cells_of(const PeerRatios& ratios) {
  std::vector<std::string> cells{ratios.peer.name()};
  for (const auto& time : ratios.times) cells.push_back(time ? to_text(*time) : "");
  cells.push_back(digits(ratios.memory));
  return cells;
}

/// The kind of peer that a scene is raced against.
ContenderKind peer_of(const std::vector<PeerRatios>& all) {
  const bool subdivides =
      std::any_of(all.begin(), all.end(), [](const auto& one) { return one.peer.kind == ContenderKind::subdivision; });
  return subdivides ? ContenderKind::subdivision : ContenderKind::triangles;
}

}  // namespace

std::vector<PeerRatios> ratios_over_peers(const ParetoResult& result) {
  const Measurement& exact = result.measurements.front();
  std::vector<PeerRatios> all;
  for (const Measurement& peer : result.measurements)
    if (peer.contender.is_embree() && peer.is_timed() && exact.is_timed())
      all.push_back({.peer = peer.contender,
                     .times = {time_ratio(exact, peer, Phase::cold), ratio_given_triangles(exact, peer),
                               time_ratio(exact, peer, Phase::camera), time_ratio(exact, peer, Phase::random),
                               time_ratio(exact, peer, Phase::shadow), time_ratio(exact, peer, Phase::ambient)},
                     .memory = static_cast<double>(exact.bytes) / static_cast<double>(peer.bytes)});
  return all;
}

TextTable ratio_table(const ParetoResult& result) {
  TextTable table{.header = header()};
  for (const PeerRatios& one : ratios_over_peers(result)) table.rows.push_back(cells_of(one));
  return table;
}

TextTable bar_table(const std::vector<ParetoResult>& results) {
  TextTable table{.header = header(), .words = 2};
  table.header.insert(table.header.begin(), "scene");
  table.header.emplace_back("exact error, max");
  for (const ParetoResult& result : results) {
    const std::vector<PeerRatios> all = ratios_over_peers(result);
    for (const PeerRatios& one : all) {
      const bool at_bar = std::count(bar_levels.begin(), bar_levels.end(), one.peer.level) > 0;
      if (one.peer.kind != peer_of(all) || !at_bar) continue;
      table.rows.push_back(cells_of(one));
      table.rows.back().insert(table.rows.back().begin(), result.scene);
      table.rows.back().push_back(result.exact.hits > 0 ? digits(result.exact.along.max / result.diagonal, 2) : "");
    }
  }
  return table;
}

}  // namespace shaolin
