#include "tools/bench/peer_ratios.h"
#include "tools/cli/json_text.h"

namespace shaolin {
namespace {

Json to_json(const Quantiles& of) { return {{"median", of.median}, {"p99", of.p99}, {"max", of.max}}; }

Json to_json(const Spread& of) { return {{"median", of.median}, {"least", of.least}, {"most", of.most}}; }

Json to_json(const HitFigures& errors) {
  return {{"rays", errors.rays}, {"hits", errors.hits}, {"lost", errors.lost}, {"ghosts", errors.ghosts}};
}

Json to_json(const ErrorFigures& errors, bool has_band) {
  Json json = to_json(static_cast<const HitFigures&>(errors));
  json.update({{"distance", to_json(errors.distance)}, {"normal", to_json(errors.normal)}});
  if (has_band)
    json.update({{"farther", errors.farther},
                 {"nearer", errors.nearer},
                 {"lost_outside", errors.lost_outside},
                 {"ghosts_outside", errors.ghosts_outside}});
  return json;
}

Json to_json(const Measurement& one) {
  Json json{{"method", one.contender.method()}};
  if (one.contender.is_adaptive()) json["epsilon"] = one.contender.epsilon;
  if (one.contender.is_uniform()) json["level"] = one.contender.level;
  json["estimated"] = one.estimated;
  json["bytes"] = one.bytes;
  if (one.estimated) return json;
  if (!one.fault.empty()) json["fault"] = one.fault;
  if (one.is_timed()) json["peak_bytes"] = one.peak_bytes;
  for (const Phase phase : phases)
    if (one.is_timed(phase)) {
      json["seconds"][name_of(phase)] = to_json(spread(one.times(phase)));
      json["seconds"][name_of(phase)]["runs"] = one.times(phase);
    }
  json["errors"] = {{"picture", to_json(one.errors, one.contender.is_adaptive())},
                    {"random", to_json(one.random_errors, one.contender.is_adaptive())},
                    {"ambient", to_json(one.ambient_errors)}};
  json["occluded_differs"] = one.occluded_differs;
  return json;
}

Json to_json(const PeerRatios& ratios) {
  Json json{{"method", ratios.peer.method()}, {"level", ratios.peer.level}};
  for (std::size_t i = 0; i < ratio_names.size(); ++i)
    if (ratios.times[i]) json[ratio_names[i]] = to_json(*ratios.times[i]);
  json["memory"] = ratios.memory;
  return json;
}

Json to_json(const ParetoResult& result) {
  Json json{{"scene", result.scene},
            {"unit", result.unit},
            {"max_size", result.max_size},
            {"diagonal", result.diagonal},
            {"rays",
             {{"primary", result.primary},
              {"shadow", result.shadow},
              {"random", result.random},
              {"ambient", result.ambient}}}};
  if (!result.left_out.empty()) json["embree_subdivision_left_out"] = result.left_out;
  json["measurements"] = Json::array();
  for (const Measurement& one : result.measurements) json["measurements"].push_back(to_json(one));
  json["exact_over_peers"] = Json::array();
  for (const PeerRatios& one : ratios_over_peers(result)) json["exact_over_peers"].push_back(to_json(one));
  json["exact"] = {{"hits", result.exact.hits},
                   {"position", to_json(result.exact.position)},
                   {"across", to_json(result.exact.across)},
                   {"along", to_json(result.exact.along)}};
  return json;
}

}  // namespace

void write_pareto_json(std::ostream& out, const std::vector<ParetoResult>& results, const ParetoOptions& options) {
  Json json{{"size", {options.size.width, options.size.height}},
            {"runs", options.measure.runs},
            {"threads", 1},
            {"min_size", options.min_size},
            {"scenes", Json::array()}};
  for (const ParetoResult& result : results) json["scenes"].push_back(to_json(result));
  out << json.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
}

}  // namespace shaolin
