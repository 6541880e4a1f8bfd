#pragma once
/// A configuration: the topology and sharpness around a face, shared by all patches that look alike.
#include <array>
#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <unordered_map>
#include <vector>

#include "corner_regularity.h"
#include "crease_strips.h"
#include "domain.h"
#include "flat_net.h"
#include "hull_expansion.h"
#include "limit_bound.h"
#include "limit_rows.h"
#include "neighbourhood.h"
#include "net_edges.h"
#include "refinement.h"
#include "regular_layout.h"
#include "scheme.h"
#include "split_program.h"

namespace shaolin {

template <Scheme S>
class ConfigurationTable;

/// Everything about a patch that does not depend on its points. Which masks apply follows from the configuration alone,
/// so each configuration's split is worked out once, when it is first asked for, and shared. Sharpness decays and
/// rings around an irregular vertex repeat, so the set of configurations closes after a few levels.
template <Scheme S>
class Configuration {
 public:
  using Regular = RegularPatch<S::face_kind>;
  using Layout = RegularLayout<Regular>;

  struct Child {
    const Configuration* configuration;
    SplitProgram program;
  };
  /// All children at once.
  struct Split {
    struct Part {
      const Configuration* configuration;
      std::vector<int> points;  ///< which points of the split are the child's
    };
    SplitProgram program;  ///< makes every point that any child has, once
    std::vector<Part> children;
  };

  /// `neighbourhood` is in canonical numbers and has so many vertices.
  Configuration(Neighbourhood neighbourhood, std::size_t vertices, ConfigurationTable<S>& table)
      : neighbourhood_(std::move(neighbourhood)),
        point_count_(static_cast<int>(vertices)),
        layout_(regular_layout<Regular>(basis_of(table.rules().scheme), neighbourhood_)),
        children_(static_cast<std::size_t>(child_count())),
        limit_rows_(static_cast<std::size_t>(corner_count())),
        regularities_(static_cast<std::size_t>(corner_count())),
        table_(table) {}
  ~Configuration() {
    for (const auto& child : children_) delete child.load();
    delete split_.load();
    delete crease_strips_.load();
    for (const auto& rows : limit_rows_) delete rows.load();
    delete hull_expansion_.load();
    delete descents_.load();
    delete flat_net_.load();
    delete net_edges_.load();
    for (const auto& regularity : regularities_) delete regularity.load();
  }
  Configuration(const Configuration&) = delete;
  Configuration& operator=(const Configuration&) = delete;

  const Neighbourhood& neighbourhood() const { return neighbourhood_; }
  const S& scheme() const { return table_.rules().scheme; }
  int point_count() const { return point_count_; }
  int corner_count() const { return neighbourhood_.face.size(); }
  int child_count() const { return S::face_kind == FaceKind::triangle ? 4 : corner_count(); }

  /// What a regular patch is made of; empty for an irregular one.
  const std::optional<Layout>& layout() const { return layout_; }
  bool is_regular() const { return layout_.has_value(); }

  /// The polynomials beside a semi-sharp crease; empty for any other configuration. Thread-safe.
  const std::optional<CreaseStrips>& crease_strips() const {
    return once(crease_strips_, [&]() -> std::optional<CreaseStrips> {
      if (S::face_kind != FaceKind::quad || basis_of(scheme()) != Basis::spline ||
          table_.rules().creases != CreaseMethod::uniform)
        return {};
      return shaolin::crease_strips(neighbourhood_);
    });
  }

  /// The share of the control points' extent by which the limit patch may leave their hull: none where all masks are
  /// convex combinations, else see hull_expansion.h (Chaikin's rule) and limit_bound.h (negative masks). Found when
  /// first asked for. Thread-safe.
  double hull_expansion() const {
    return once(hull_expansion_, [&] {
      if (is_regular()) return 0.0;
      return table_.is_convex() ? shaolin::hull_expansion(table_.rules(), neighbourhood_) : limit_hull_expansion(*this);
    });
  }

  /// What limit_hull_expansion() reads; none from a polynomial patch, which lies in its hull. Thread-safe.
  const std::vector<std::pair<const Configuration*, Descent>>& descents() const {
    return once(descents_, [&] { return is_regular() ? Descents() : descents_from(*this); });
  }

  /// See flat_net.h; empty for polynomial patches, for irregular ones beside them and where the lattice is irregular.
  /// Thread-safe.
  const std::optional<FlatNet>& flat_net() const {
    return once(flat_net_, [&]() -> std::optional<FlatNet> {
      if (basis_of(scheme()) != Basis::none || corner_count() != Domain<S::face_kind>::corner_count) return {};
      std::vector<Eigen::MatrixXd> splits;
      for (int k = 0; k < child_count(); ++k) {
        if (child(k).configuration != this) return {};
        splits.push_back(matrix_of(child(k).program, point_count_));
      }
      return shaolin::flat_net<S::face_kind>(splits);
    });
  }

  /// Child k's configuration and the program that makes its points. Thread-safe.
  const Child& child(int k) const {
    return once(children_[static_cast<std::size_t>(k)], [&] { return table_.child(*this, k); });
  }

  /// The same children, whose nets overlap, by one program: 18 points in place of 4 x 12 for a regular triangle, 25 in
  /// place of 4 x 16 for a quad. The same points to the last bit. Thread-safe.
  const Split& split() const {
    return once(split_, [&] { return table_.split(*this); });
  }

  /// The limit masks at corner k over the patch's points, derived from the split when first asked for. Empty unless the
  /// split at that corner leads to this configuration again (split first), or if there is no limit. Thread-safe.
  const std::optional<LimitRows>& derived_limit(int k) const {
    return once(limit_rows_[static_cast<std::size_t>(k)], [&]() -> std::optional<LimitRows> {
      if (corner_count() != Domain<S::face_kind>::corner_count || child(k).configuration != this) return {};
      return limit_rows(matrix_of(child(k).program, point_count_), neighbourhood_.rings[static_cast<std::size_t>(k)]);
    });
  }

  /// The edges of the control net, of all faces that have a say in the patch. Thread-safe.
  const std::vector<std::array<int, 2>>& net_edges() const {
    return once(net_edges_, [&] {
      const bool own_only = basis_of(scheme()) == Basis::linear;
      return shaolin::net_edges(neighbourhood_, own_only);
    });
  }

  /// See corner_regularity.h. Empty unless the split at corner k leads to this configuration again and all others to
  /// regular ones. Thread-safe.
  const std::optional<CornerRegularity>& corner_regularity(int k) const {
    return once(regularities_[static_cast<std::size_t>(k)], [&] { return find_corner_regularity(k); });
  }

 private:
  std::optional<CornerRegularity> find_corner_regularity(int k) const {
    constexpr int most_points = 150;  // 100 powers of a matrix of that size take 0.1 s
    if (is_regular() || point_count_ > most_points) return {};
    const std::optional<LimitRows>& rows = derived_limit(k);
    if (!rows) return {};
    std::vector<RingChild> children;
    for (int i = 0; i < child_count(); ++i) {
      const Child& child = this->child(i);
      RingChild& as_matrix = children.emplace_back(RingChild{matrix_of(child.program, point_count_), {}});
      if (i == k) continue;
      if (!child.configuration->is_regular()) return {};
      as_matrix.bezier = bezier_matrix(*child.configuration->layout(), child.configuration->point_count());
    }
    return shaolin::corner_regularity<Regular>(children, k, *rows);
  }

  /// What `slot` holds, made now if nobody made it before.
  template <class Value, class Make>
  static const Value& once(std::atomic<Value*>& slot, Make make) {
    if (const Value* known = slot.load(std::memory_order_acquire)) return *known;
    auto made = std::make_unique<Value>(make());
    Value* expected = nullptr;
    if (slot.compare_exchange_strong(expected, made.get(), std::memory_order_acq_rel)) return *made.release();
    return *expected;
  }

  Neighbourhood neighbourhood_;
  int point_count_;
  std::optional<Layout> layout_;
  using Descents = std::vector<std::pair<const Configuration*, Descent>>;
  mutable std::atomic<std::optional<CreaseStrips>*> crease_strips_{nullptr};
  mutable std::atomic<double*> hull_expansion_{nullptr};
  mutable std::atomic<Descents*> descents_{nullptr};
  mutable std::atomic<std::optional<FlatNet>*> flat_net_{nullptr};
  mutable std::atomic<std::vector<std::array<int, 2>>*> net_edges_{nullptr};
  mutable std::vector<std::atomic<Child*>> children_;
  mutable std::atomic<Split*> split_{nullptr};
  mutable std::vector<std::atomic<std::optional<LimitRows>*>> limit_rows_;
  mutable std::vector<std::atomic<std::optional<CornerRegularity>*>> regularities_;
  ConfigurationTable<S>& table_;
};

/// All configurations of a surface, each once.
template <Scheme S>
class ConfigurationTable {
 public:
  /// `is_convex`: all masks that the mesh needs are convex combinations (but for Chaikin's rule).
  explicit ConfigurationTable(Rules<S> rules = {}, bool is_convex = true)
      : rules_(std::move(rules)), is_convex_(is_convex) {}

  const Rules<S>& rules() const { return rules_; }
  bool is_convex() const { return is_convex_; }

  /// The configuration of a neighbourhood, and the neighbourhood's vertices in the order of the patch's points.
  struct Match {
    const Configuration<S>* configuration;
    std::vector<int> vertices;
  };
  Match match(Neighbourhood neighbourhood) {
    drop_beyond_creases(neighbourhood);
    turn_to_face(neighbourhood);
    CanonicalForm form = canonical_form(neighbourhood);
    const std::lock_guard lock(mutex_);
    auto at = configurations_.find(form.key);
    if (at == configurations_.end()) {
      form.key.shrink_to_fit();
      auto made = std::make_unique<Configuration<S>>(in_canonical_numbers(neighbourhood), form.vertices.size(), *this);
      at = configurations_.emplace(std::move(form.key), std::move(made)).first;
    }
    return {at->second.get(), std::move(form.vertices)};
  }

  /// The configuration of plain faces (plain_face.h) whose corners have these valences; null until it is kept.
  const Configuration<S>* plain(const std::array<int, 4>& valences) const {
    const std::lock_guard lock(mutex_);
    const auto at = plain_.find(valences);
    return at == plain_.end() ? nullptr : at->second;
  }
  void keep_plain(const std::array<int, 4>& valences, const Configuration<S>* configuration) {
    const std::lock_guard lock(mutex_);
    plain_.emplace(valences, configuration);
  }

  typename Configuration<S>::Child child(const Configuration<S>& parent, int k) {
    Refinement refinement(parent.neighbourhood(), S::face_kind, rules_.creases);
    const Match match = this->match(refinement.child(k, rules_.radius()));
    std::vector<RefinedVertex> wanted;
    wanted.reserve(match.vertices.size());
    for (const int vertex : match.vertices) wanted.push_back(refinement.vertices()[static_cast<std::size_t>(vertex)]);
    return {match.configuration, SplitProgram::compile<S>(rules_, parent.neighbourhood(), wanted)};
  }

  typename Configuration<S>::Split split(const Configuration<S>& parent) {
    Refinement refinement(parent.neighbourhood(), S::face_kind, rules_.creases);
    typename Configuration<S>::Split split;
    std::vector<RefinedVertex> wanted;
    std::vector<int> numbers;  // among those wanted, of the refinement's vertices
    for (int k = 0; k < parent.child_count(); ++k) {
      Match match = this->match(refinement.child(k, rules_.radius()));
      numbers.resize(refinement.vertices().size(), -1);
      for (int& vertex : match.vertices) {
        int& number = numbers[static_cast<std::size_t>(vertex)];
        if (number < 0) {
          number = static_cast<int>(wanted.size());
          wanted.push_back(refinement.vertices()[static_cast<std::size_t>(vertex)]);
        }
        vertex = number;
      }
      split.children.push_back({match.configuration, std::move(match.vertices)});
    }
    split.program = SplitProgram::compile<S>(rules_, parent.neighbourhood(), wanted);
    return split;
  }

  std::size_t size() const {
    const std::lock_guard lock(mutex_);
    return configurations_.size();
  }

 private:
  struct KeyHash {
    /// FNV-1a over the words of the key.
    std::size_t operator()(const std::vector<int>& key) const {
      std::size_t hash = 14695981039346656037u;
      for (const int word : key) hash = (hash ^ static_cast<std::size_t>(word)) * 1099511628211u;
      return hash;
    }
  };

  Rules<S> rules_;
  bool is_convex_;
  mutable std::mutex mutex_;
  std::unordered_map<std::vector<int>, std::unique_ptr<Configuration<S>>, KeyHash> configurations_;
  std::map<std::array<int, 4>, const Configuration<S>*> plain_;  ///< by the valences of the corners
};

}  // namespace shaolin
