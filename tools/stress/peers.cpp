#include "tools/stress/peers.h"

#include <algorithm>
#include <cmath>

#include "schemes/errors.h"
#include "tools/bench/contender.h"
#include "tools/bench/triangle_tree.h"

namespace shaolin::stress {

namespace {

struct Peer {
  std::string name;
  std::function<std::optional<double>(const Ray&)> first;  ///< the t of the closest hit
  bool begins_at_origin = false;                           ///< it takes no other rays
};

/// Empty where the peer cannot be built: half-edges that OpenMesh does not take, creases that Embree does not have.
template <class Make>
void add_if_possible(std::vector<Peer>& peers, Make make) {
  try {
    peers.push_back(make());
  } catch (const InputError&) {  // NOLINT(bugprone-empty-catch): the table's rays show whom it was not asked
  }
}

std::vector<Peer> peers_of(const ControlMesh& mesh, const std::string& scheme, int level) {
  shaolin::Stage stage;
  stage.models.push_back({mesh, scheme, nullptr});
  stage.scene.objects.push_back({"model", {}, scheme, {}});
  stage.scene.instances.push_back({0, Affine::Identity()});
  std::vector<Peer> peers;
  for (const ContenderKind kind : {ContenderKind::triangles, ContenderKind::subdivision}) {
    if (kind == ContenderKind::subdivision && scheme != "catmark") continue;
    add_if_possible(peers, [&] {
      const Contender contender{.kind = kind, .level = level, .is_robust = true};
      return Peer{contender.name(),
                  [tracer = std::shared_ptr<const Tracer>(make_tracer(contender, stage))](
                      const Ray& ray) -> std::optional<double> {
                    const auto answer = tracer->intersect(ray);
                    // In single precision a tiny model may be met at no number: that is no hit.
                    return answer && std::isfinite(answer->t) ? std::optional(answer->t) : std::nullopt;
                  }};
    });
  }
  add_if_possible(peers, [&] {
    const TriangleSoup soup = uniform_triangles(mesh, scheme, level);
    return Peer{"CGAL, level " + std::to_string(level),
                [tree = std::make_shared<const TriangleTree>(soup)](const Ray& ray) { return tree->first(ray); }, true};
  });
  return peers;
}

/// What Embree takes: coordinates below 2^60 or so, a direction that single precision does not take for zero, no
/// beginning behind the origin.
bool is_for_peers(const Ray& ray) {
  constexpr double most = 1e18, least = 1e-30;
  const double length = ray.direction.cwiseAbs().maxCoeff();
  return ray.origin.cwiseAbs().maxCoeff() < most && length < most && length > least && ray.tmin >= 0 &&
         ray.tmin < ray.tmax;
}

}  // namespace

QueriesOf Peers::beside(QueriesOf own, std::string family, std::string scheme) {
  if (scheme != "loop" && scheme != "catmark") return own;
  {
    const std::lock_guard lock(mutex_);
    if (std::find(families_.begin(), families_.end(), family) == families_.end()) families_.push_back(family);
  }
  return [this, own = std::move(own), family = std::move(family), scheme = std::move(scheme)](const Scene& scene) {
    RayQueries queries = own(scene);
    ControlMesh mesh = scene.surface().control_mesh();
    for (Vec3& point : mesh.positions) point = scene.instances().front().transform * point;
    const double far_off = 0.01 * (scene.bounds().upper - scene.bounds().lower).stableNorm();
    queries.intersect = [this, family, far_off, ask = queries.intersect,
                         peers = peers_of(mesh, scheme, level_)](const Ray& ray) {
      std::optional<Hit> hit = ask(ray);
      if (!is_for_peers(ray)) return hit;
      const double room = far_off / ray.direction.stableNorm();
      for (const Peer& peer : peers) {
        if (peer.begins_at_origin && ray.tmin != 0) continue;
        std::optional<double> t = peer.first(ray);
        if (t && *t > ray.tmax) t.reset();
        add(family, peer.name, hit ? std::optional(hit->t) : std::nullopt, t, room);
      }
      return hit;
    };
    return queries;
  };
}

void Peers::add(const std::string& family, const std::string& peer, const std::optional<double>& own,
                const std::optional<double>& theirs, double far_off) {
  const std::lock_guard lock(mutex_);
  Count& count = counts_[{family, peer}];
  ++count.rays;
  count.hits += own.has_value();
  count.lost += own && !theirs;
  count.ghosts += !own && theirs;
  count.astray += own && theirs && !(std::abs(*own - *theirs) <= far_off);
}

TextTable Peers::table() const {
  const std::lock_guard lock(mutex_);
  TextTable table{.header = {"family", "peer", "rays", "hits", "lost", "ghosts", "astray"}, .words = 2};
  std::map<std::string, Count> all;
  const auto add_row = [&](const std::string& family, const std::string& peer, const Count& count) {
    table.rows.push_back({family, peer, std::to_string(count.rays), std::to_string(count.hits),
                          std::to_string(count.lost), std::to_string(count.ghosts), std::to_string(count.astray)});
  };
  for (const std::string& family : families_)
    for (const auto& [key, count] : counts_) {
      if (key.first != family) continue;
      add_row(family, key.second, count);
      Count& sum = all[key.second];
      sum.rays += count.rays;
      sum.hits += count.hits;
      sum.lost += count.lost;
      sum.ghosts += count.ghosts;
      sum.astray += count.astray;
    }
  for (const auto& [peer, count] : all) add_row("all", peer, count);
  return table;
}

}  // namespace shaolin::stress
