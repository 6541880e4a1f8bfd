/// Peers under stress: rays aimed at a closed surface from outside, at vertices, edges and faces, with the surface far
/// away, tiny and huge. Ours on the limit surface, Embree 3 in its robust mode and CGAL's AABB tree on a tessellation.
///
/// An executable of its own, for CGAL's AABB tree is GPL.
#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <iostream>

#include "schemes/errors.h"
#include "schemes/obj.h"
#include "tools/bench/embree_subdivision.h"
#include "tools/bench/tessellation.h"
#include "tools/bench/text_table.h"
#include "tools/bench/thread_stopwatch.h"
#include "tools/cli/command.h"
#include "tools/stress/aim.h"

namespace shaolin {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Triangles = CGAL::Surface_mesh<Point>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_face_graph_triangle_primitive<Triangles>>>;

struct Options {
  std::vector<std::filesystem::path> models;
  std::size_t rays = 1000, points = 1000;
  int level = 4;
};

/// A distance along the ray in units of its direction, or empty.
using Party = std::function<std::optional<double>(const Ray&)>;

/// Embree on the tessellation of a Loop surface, or its own geometry of a Catmull-Clark surface; robust mode.
class RobustEmbree {
 public:
  RobustEmbree(const stress::StressModel& model, int level) : device_(rtcNewDevice("threads=1")) {
    scene_.reset(rtcNewScene(device_.get()));
    rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
    const EmbreeGeometry geometry = model.scheme == "loop"
                                        ? embree_geometry(device_.get(), tessellate_loop(model.mesh, level))
                                        : embree_subdivision(device_.get(), model.mesh, level);
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometry(scene_.get(), geometry.get());
    rtcCommitScene(scene_.get());
  }
  std::optional<double> operator()(const Ray& ray) const {
    const RTCRayHit found = embree_intersect(scene_.get(), ray);
    if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    return found.ray.tfar;
  }

 private:
  EmbreeDevice device_;
  EmbreeHandle<RTCSceneTy> scene_;
};

/// CGAL's tree over the tessellation of a Loop surface, whose points are single precision; in doubles.
class CgalTree {
 public:
  CgalTree(const ControlMesh& mesh, int level) {
    const EmbreeTriangles triangles = tessellate_loop(mesh, level);
    std::vector<Triangles::Vertex_index> vertices;
    for (const auto& p : triangles.points) vertices.push_back(mesh_.add_vertex({p[0], p[1], p[2]}));
    for (const auto& t : triangles.triangles) mesh_.add_face(vertices[t[0]], vertices[t[1]], vertices[t[2]]);
    tree_.insert(faces(mesh_).first, faces(mesh_).second, mesh_);
    tree_.build();
    tree_.accelerate_distance_queries();
  }
  CgalTree(const CgalTree&) = delete;
  CgalTree& operator=(const CgalTree&) = delete;

  std::optional<double> operator()(const Ray& ray) const {
    const Vec3 &o = ray.origin, &d = ray.direction;
    const Kernel::Ray_3 query(Point(o.x(), o.y(), o.z()), Kernel::Vector_3(d.x(), d.y(), d.z()));
    const auto found = tree_.first_intersection(query);
    if (!found) return {};
    const Point* const p = boost::get<Point>(&found->first);
    if (!p) return std::nullopt;
    return (Vec3(p->x(), p->y(), p->z()) - o).dot(d) / d.squaredNorm();
  }
  double distance(const Vec3& p) const { return std::sqrt(tree_.squared_distance(Point(p.x(), p.y(), p.z()))); }
  std::size_t size() const { return tree_.size(); }

 private:
  Triangles mesh_;
  Tree tree_;
};

/// Rays at points that they cross at more than 0.1 rad: they cannot miss.
std::vector<stress::Probe> certain_probes(const stress::Subject& subject, std::size_t count) {
  Random random(1);
  std::vector<stress::Probe> probes;
  while (probes.size() < count) {
    const stress::Aim aim = stress::aim_anywhere(subject, random);
    const stress::Probe probe = stress::probe_at(subject, aim, random.direction(), random);
    if (probe.target->is_crossed && probe.target->cosine > 0.1) probes.push_back(probe);
  }
  return probes;
}

/// Misses, and the median of the distance along the ray from the truth (a nearer hit is the exact method's), in
/// diagonals.
std::vector<std::string> cells_of(const Party& party, const stress::Subject& subject,
                                  const std::vector<stress::Probe>& probes) {
  std::size_t missed = 0;
  std::vector<double> errors;
  for (const stress::Probe& probe : probes) {
    const auto t = party(probe.ray);
    const auto exact = subject.queries().intersect(probe.ray);
    missed += !t;
    const double truth = exact && exact->t < probe.target->t ? exact->t : probe.target->t;
    if (t) errors.push_back(std::abs(*t - truth) * probe.ray.direction.norm() / subject.diagonal());
  }
  char text[32] = "-";
  if (!errors.empty()) {
    std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2), errors.end());
    std::snprintf(text, sizeof text, "%.1e", errors[errors.size() / 2]);
  }
  return {std::to_string(missed), text};
}

stress::StressModel moved(stress::StressModel model, double scale, double shift) {
  for (Vec3& point : model.mesh.positions) point = scale * point + shift * Vec3(0.7, -1, 0.4);
  return model;
}

void degrade(const stress::StressModel& model, const Options& options, TextTable& table) {
  const bool loop = model.scheme == "loop";
  for (const auto& [scale, shift] : std::initializer_list<std::pair<double, double>>{
           {1, 0}, {1, 1e3}, {1, 1e6}, {1, 1e9}, {1e-12, 0}, {1e-6, 0}, {1e6, 0}, {1e12, 0}}) {
    const stress::Subject subject(moved(model, scale, shift), stress::RayQueries::of);
    const auto probes = certain_probes(subject, options.rays);
    char where[48];
    std::snprintf(where, sizeof where, "scale %g, shift %g", scale, shift);
    std::vector<std::string> row{model.name, where};
    const auto add = [&](const std::vector<std::string>& cells) { row.insert(row.end(), cells.begin(), cells.end()); };
    add(cells_of(
        [&](const Ray& ray) {
          const auto hit = subject.queries().intersect(ray);
          return hit ? std::optional(hit->t) : std::nullopt;
        },
        subject, probes));
    const RobustEmbree embree(moved(model, scale, shift), options.level);
    add(cells_of(std::cref(embree), subject, probes));
    if (loop) {
      const CgalTree tree(moved(model, scale, shift).mesh, options.level);
      add(cells_of(std::cref(tree), subject, probes));
    } else {
      add({"-", "-"});
    }
    table.rows.push_back(row);
  }
}

/// Closest points of a Loop surface: how far the tree's distances are off, and both sides' queries a second.
void closest(const stress::StressModel& model, const Options& options, TextTable& table) {
  const stress::Subject subject(model, stress::RayQueries::of);
  const Scene scene(model.mesh, model.scheme);
  const CgalTree tree(model.mesh, options.level);
  Random random(2);
  std::vector<Vec3> points;
  const Box box = subject.box().expanded(0.25);
  for (std::size_t i = 0; i < options.points; ++i) points.push_back(random.inside(box.lower, box.upper));
  for (const Vec3& p : points) scene.closest_point(p);  // what queries refine is there then
  std::vector<double> ours, theirs;
  ThreadStopwatch stopwatch;
  for (const Vec3& p : points) ours.push_back(scene.closest_point(p)->distance);
  const double our_seconds = stopwatch.lap();
  for (const Vec3& p : points) theirs.push_back(tree.distance(p));
  const double their_seconds = stopwatch.lap();
  double worst = 0;
  for (std::size_t i = 0; i < points.size(); ++i) worst = std::max(worst, std::abs(ours[i] - theirs[i]));
  char text[3][32];
  std::snprintf(text[0], sizeof text[0], "%.0f", static_cast<double>(points.size()) / our_seconds);
  std::snprintf(text[1], sizeof text[1], "%.0f", static_cast<double>(points.size()) / their_seconds);
  std::snprintf(text[2], sizeof text[2], "%.1e", worst / subject.diagonal());
  table.rows.push_back({model.name, std::to_string(tree.size()), text[0], text[1], text[2]});
}

int compare(const Options& options) {
  TextTable rays{
      {"model", "where", "ours missed", "ours error", "Embree missed", "Embree error", "CGAL missed", "CGAL error"},
      {},
      2};
  TextTable points{{"model", "triangles", "ours per s", "CGAL per s", "greatest difference"}, {}, 1};
  for (const auto& file : options.models) {
    stress::StressModel model{file.stem().string(), read_obj(file), {}};
    model.scheme = default_scheme(model.mesh);
    degrade(model, options, rays);
    if (model.scheme == "loop") closest(model, options, points);
  }
  write_markdown(std::cout, rays);
  std::cout << '\n';
  write_markdown(std::cout, points);
  return exit_done;
}

}  // namespace
}  // namespace shaolin

int main(int argc, char** argv) {
  shaolin::Options options;
  CLI::App app("Rays and closest points of ours, Embree and CGAL's AABB tree on closed surfaces, moved and scaled");
  app.add_option("MODEL", options.models, "OBJ files of closed meshes")->required();
  app.add_option("--rays", options.rays, "At each model and place")->capture_default_str();
  app.add_option("--points", options.points, "Whose closest point is asked for")->capture_default_str();
  app.add_option("--level", options.level, "Of the peers' tessellations")
      ->check(CLI::Range(1, 8))
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    return shaolin::compare(options);
  } catch (const std::exception& error) {
    std::cerr << "error: " << error.what() << '\n';
    return shaolin::exit_bad_input;
  }
}
