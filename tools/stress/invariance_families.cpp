/// The same surface said otherwise: faces in another order, corners turned, the mesh mirrored. The hits must be the
/// same.
#include <algorithm>
#include <numeric>

#include "tools/stress/family.h"

namespace shaolin::stress {

namespace {

/// A twin of a model, and the way from one to the other.
struct Twin {
  std::unique_ptr<const Subject> subject;
  Eigen::DiagonalMatrix<double, 3> mirror{1, 1, 1};  ///< from the model's space to the twin's
};

/// Faces in a random order, each beginning at a random corner.
Twin permuted(const StressModel& model, const QueriesOf& queries) {
  StressModel twin = model;
  ControlMesh& mesh = twin.mesh;
  mesh.face_offsets = {0};
  mesh.face_vertices.clear();
  std::vector<int> order(static_cast<std::size_t>(model.mesh.face_count()));
  std::iota(order.begin(), order.end(), 0);
  SampleRandom random(1);  // the same permutation whatever the rays
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.index(i)]);
  std::vector<int> place(order.size());
  for (const int face : order) {
    const auto corners = model.mesh.face(face);
    std::vector<int> turned(corners.begin(), corners.end());
    std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(random.index(turned.size())),
                turned.end());
    place[static_cast<std::size_t>(face)] = mesh.face_count();
    mesh.add_face(turned);
  }
  for (int& hole : mesh.holes) hole = place[static_cast<std::size_t>(hole)];
  return {std::make_unique<const Subject>(twin, queries, "faces permuted, corners turned")};
}

Twin mirrored(const StressModel& model, const QueriesOf& queries, Eigen::Index axis) {
  StressModel twin = model;
  for (Vec3& point : twin.mesh.positions) point[axis] = -point[axis];
  Vec3 signs = Vec3::Ones();
  signs[axis] = -1;
  return {std::make_unique<const Subject>(twin, queries, std::string("mirrored in ") + "xyz"[axis]),
          Eigen::DiagonalMatrix<double, 3>(signs)};
}

class TwinStage final : public Stage {
 public:
  TwinStage(std::string family, std::unique_ptr<const Subject> subject, std::vector<Twin> twins)
      : family_(std::move(family)), subject_(std::move(subject)), twins_(std::move(twins)) {}

  void shoot(SampleRandom& random, Tally& tally) const override {
    const Twin& twin = pick(twins_, random);
    const Aim aim = aim_anywhere(*subject_, random);
    Probe probe = probe_at(*subject_, aim, random.direction(), random);
    if (random.one_in(2)) {  // beside it: a line like any other
      probe.ray.origin += 0.1 * subject_->diagonal() * random.direction();
      probe.target.reset();
    }
    Probe moved = probe;
    moved.ray.origin = twin.mirror * probe.ray.origin;
    moved.ray.direction = twin.mirror * probe.ray.direction;
    Check check(*twin.subject, family_, tally);
    check.ray(moved);
    compare(subject_->queries().intersect(probe.ray), twin, moved.ray, check);
  }

 private:
  /// Rays that graze may miss one twin by rounding: at cosines below 1e-3 nothing is claimed of them here. Nor of which
  /// face answers, where sheets coincide: that the hit is there, Check::ray() says.
  void compare(const std::optional<Hit>& ours, const Twin& twin, const Ray& ray, Check& check) const {
    constexpr double grazing = 1e-3;
    const std::optional<Hit> other = twin.subject->queries().intersect(ray);
    const auto cosine = [&](const std::optional<Hit>& hit, const Vec3& direction) {
      return hit ? std::abs(hit->sample.normal.dot(direction)) : 1;
    };
    const Vec3 direction = ray.direction.stableNormalized();
    const double least = std::min(cosine(other, direction), cosine(ours, twin.mirror * direction));
    if ((!ours && !other) || least < grazing) return;
    const double slack = 2 * check.slack(ray, least);
    if (!other || (ours && other->t > ours->t + slack))
      return check.fail(Fault::lost, ray, "the original mesh has " + text(*ours));
    if (!ours || ours->t > other->t + slack) check.fail(Fault::lost, ray, "the original mesh loses " + text(*other));
  }

  std::string family_;
  std::unique_ptr<const Subject> subject_;
  std::vector<Twin> twins_;
};

std::unique_ptr<const Stage> stage_of(const std::string& name, const StressModel& model, const QueriesOf& queries,
                                      std::vector<Twin> twins) {
  auto subject = std::make_unique<const Subject>(model, queries);
  if (subject->sites().pieces.empty()) return nullptr;
  return std::make_unique<TwinStage>(name, std::move(subject), std::move(twins));
}

}  // namespace

std::vector<Family> invariance_families() {
  const auto permute = [](const StressModel& model, const QueriesOf& queries) {
    std::vector<Twin> twins;
    twins.push_back(permuted(model, queries));
    return stage_of("permuted", model, queries, std::move(twins));
  };
  const auto mirror = [](const StressModel& model, const QueriesOf& queries) {
    std::vector<Twin> twins;
    for (const Eigen::Index axis : {0, 1, 2}) twins.push_back(mirrored(model, queries, axis));
    return stage_of("mirrored", model, queries, std::move(twins));
  };
  return {{"permuted", "faces in another order, corners turned: the same hits", permute},
          {"mirrored", "the mesh and the ray mirrored: the same hits", mirror}};
}

}  // namespace shaolin::stress
