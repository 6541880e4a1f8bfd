#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include "../schemes/errors.h"
#include "../schemes/limit_surface.h"
#include "overlap_search.h"
#include "pair_search.h"
#include "pick_search.h"
#include "scene.h"
#include "sweep_search.h"

namespace shaolin {

namespace {

/// A place of a cell, as the world sees it.
ShapeContact contact_at(const PlacedObject& placed, const SurfaceCell& cell, const CellSample& place) {
  ShapeContact contact;
  contact.at = cell.parameter(place.at);
  contact.sample = *placed.object->surface().evaluate(contact.at);
  // The position stays the cell's own: near u or v = 1 parameters are too coarse to find it again.
  contact.sample.position = place.position;
  placed.placement->to_world(contact.sample);
  contact.level = cell.place().level;
  contact.instance = placed.instance;
  return contact;
}

void check_shape(const Shape& shape) {
  std::visit([](const auto& one) { shaolin::check(one); }, shape);
}

/// Checks all questions, then answers each on its own, in parallel.
template <class Answer, class Question, class Check, class Ask>
std::vector<Answer> for_each(std::span<const Question> questions, const char* what, Check check, Ask ask) {
  for (std::size_t i = 0; i < questions.size(); ++i) {
    try {
      check(questions[i]);
    } catch (const InputError& error) {
      throw InputError(what + (" " + std::to_string(i)) + ": " + error.what());
    }
  }
  constexpr std::size_t grain = 16;  // questions that a thread takes at a time
  std::vector<Answer> answers(questions.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, questions.size(), grain), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) answers[i] = ask(questions[i]);
  });
  return answers;
}

/// The first contact that is found with any object near.
template <class One>
std::optional<ShapeContact> overlap(const One& shape, const Box& scene, const std::vector<PlacedObject>& near,
                                    RayCounters& counters) {
  const QueryFrame frame(bounds(shape), scene);
  const std::unique_ptr<Convex> form = convex(shape, frame);
  const double size = (frame.scale * (bounds(shape).upper - bounds(shape).lower)).maxCoeff();
  for (const PlacedObject& placed : near) {
    const std::unique_ptr<SurfaceCell> root = placed.object->cells();
    if (!root) continue;
    const CellFrame cells(frame, *placed.placement, placed.object->bounds(), size);
    OverlapSearch search(*form, cells, counters);
    search_cells(*root, search, counters);
    if (!search.found()) continue;
    const auto& [cell, place] = *search.found();
    ShapeContact contact = contact_at(placed, *cell, place.own);
    contact.on_shape = frame.to_world(search.probe().on_shape(place.position));
    return contact;
  }
  return {};
}

SweepContact contact_of(const SphereSweep& sweep, double t, const ShapeContact& contact) {
  SweepContact result{t,
                      contact.at,
                      contact.sample,
                      sweep.start + t * sweep.displacement,
                      Vec3::Zero(),
                      contact.level,
                      contact.instance};
  const Vec3& position = result.sample.position;
  const Vec3 way = result.centre - position;
  // What a position may be off by (RayFrame::error) is no way from it.
  const double rounding =
      160 * unit_roundoff * std::max(position.cwiseAbs().maxCoeff(), result.centre.cwiseAbs().maxCoeff());
  result.normal = way.cwiseAbs().maxCoeff() <= rounding ? result.sample.normal : Vec3(way.stableNormalized());
  return result;
}

/// The earliest contact with any object near, of a sphere that is free at its start and moves.
std::optional<SweepContact> first_contact(const SphereSweep& sweep, const Box& scene,
                                          const std::vector<PlacedObject>& near, RayCounters& counters) {
  const Box box = bounds(Capsule{sweep.start, sweep.start + sweep.displacement, sweep.radius});
  const QueryFrame frame(box, scene);
  const SphereSweep framed{frame(sweep.start), frame.scale * sweep.radius, frame.scale * sweep.displacement};
  std::optional<SweepContact> earliest;
  for (const PlacedObject& placed : near) {
    const std::unique_ptr<SurfaceCell> root = placed.object->cells();
    if (!root) continue;
    const CellFrame cells(frame, *placed.placement, placed.object->bounds(), 1);
    SweepSearch search(framed, earliest ? std::optional(earliest->t) : std::nullopt, cells, counters);
    search_cells(*root, search, counters);
    if (const auto& found = search.found())
      earliest = contact_of(sweep, found->t, contact_at(placed, *found->cell, found->place));
  }
  return earliest;
}

/// What a frustum holds of a box that holds all, in the frame of a query.
Polytope polytope(const Frustum& frustum, const Box& all, const QueryFrame& frame) {
  std::vector<HalfSpace> sides;
  for (const HalfSpace& side : frustum.sides) {
    const double length = side.normal.stableNorm();
    const Vec3 normal = side.normal / length;
    sides.push_back({normal, frame.scale * (side.offset / length - normal.dot(frame.centre))});
  }
  for (Eigen::Index i = 0; i < 3; ++i) {
    sides.push_back({Vec3::Unit(i), frame(all.upper)[i]});
    sides.push_back({-Vec3::Unit(i), -frame(all.lower)[i]});
  }
  return Polytope(std::move(sides));
}

/// A box with room around it, so that no side of it is one of the surface.
Box with_margin(const Box& box) { return box.grown(0.125 * (box.upper - box.lower).maxCoeff()); }

/// A point that two placed surfaces have in common.
std::optional<SurfaceContact> common_point(const PlacedObject& a, const Box& box_a, const PlacedObject& b,
                                           const Box& box_b, RayCounters& counters) {
  const std::unique_ptr<SurfaceCell> root_a = a.object->cells(), root_b = b.object->cells();
  if (!root_a || !root_b) return {};
  const QueryFrame frame(box_a, box_b);
  const CellFrame frame_a(frame, *a.placement, a.object->bounds(), 0);
  const CellFrame frame_b(frame, *b.placement, b.object->bounds(), 0);
  const auto found = PairSearch(frame_a, frame_b, counters).run(*root_a, *root_b);
  if (!found) return {};
  SurfaceContact contact{contact_at(a, *found->a, found->on_a.own), contact_at(b, *found->b, found->on_b.own)};
  contact.own.on_shape = contact.other.sample.position;
  contact.other.on_shape = contact.own.sample.position;
  return contact;
}

/// Boxes that have no point in common, by what the bounds are good to.
bool are_apart(const Box& a, const Box& b) {
  return (a.lower.array() > b.upper.array()).any() || (b.lower.array() > a.upper.array()).any();
}

Box world_box(const PlacedObject& placed) {
  const Box own = placed.object->bounds();
  return placed.placement->is_identity() ? own : transformed(own, placed.placement->to_world());
}

}  // namespace

std::optional<ShapeContact> Scene::overlaps(const Shape& shape) const {
  check_shape(shape);
  if (const auto* sphere = std::get_if<Sphere>(&shape)) {
    const std::optional<ClosestPoint> closest = closest_point(sphere->centre, sphere->radius);
    if (!closest) return {};
    return ShapeContact{closest->at, closest->sample, closest->sample.position, closest->level, closest->instance};
  }
  RayCounters counters;
  std::optional<ShapeContact> contact;
  std::visit(
      [&](const auto& one) {
        const Box box = shaolin::bounds(one);
        const double radius = 0.5 * (box.upper - box.lower).stableNorm();
        contact = overlap(one, bounds(), objects_near(box.centre(), radius * (1 + 1e-12)), counters);
      },
      shape);
  count_shape(counters);
  return contact;
}

std::vector<std::optional<ShapeContact>> Scene::overlaps(std::span<const Shape> shapes) const {
  return for_each<std::optional<ShapeContact>>(shapes, "shape", check_shape,
                                               [this](const Shape& one) { return overlaps(one); });
}

std::optional<SweepContact> Scene::sweep(const SphereSweep& sweep) const {
  shaolin::check(sweep);
  RayCounters counters;
  std::optional<SweepContact> contact;
  if (const std::optional<ClosestPoint> at_start = closest_point(sweep.start, sweep.radius)) {
    contact = contact_of(sweep, 0, {at_start->at, at_start->sample, {}, at_start->level, at_start->instance});
  } else if (!sweep.displacement.isZero(0)) {
    const Vec3 middle = sweep.start + 0.5 * sweep.displacement;
    const double radius = sweep.radius + 0.5 * sweep.displacement.stableNorm();
    contact = first_contact(sweep, bounds(), objects_near(middle, radius * (1 + 1e-12)), counters);
  }
  count_shape(counters);
  return contact;
}

std::vector<std::optional<SweepContact>> Scene::sweep(std::span<const SphereSweep> sweeps) const {
  return for_each<std::optional<SweepContact>>(
      sweeps, "sweep", [](const SphereSweep& one) { shaolin::check(one); },
      [this](const SphereSweep& one) { return sweep(one); });
}

std::optional<SurfaceContact> Scene::overlaps(const Scene& other) const {
  RayCounters counters;
  std::optional<SurfaceContact> contact;
  const auto radius_of = [](const Box& box) { return 0.5 * (box.upper - box.lower).stableNorm() * (1 + 1e-12); };
  const Box all = other.bounds();
  if (!(all.lower.array() > all.upper.array()).any()) {
    for (const PlacedObject& a : objects_near(all.centre(), radius_of(all))) {
      const Box box_a = world_box(a);
      for (const PlacedObject& b : other.objects_near(box_a.centre(), radius_of(box_a))) {
        const Box box_b = world_box(b);
        if (!contact && !are_apart(box_a, box_b)) contact = common_point(a, box_a, b, box_b, counters);
      }
    }
  }
  count_shape(counters);
  return contact;
}

std::vector<PickedFace> Scene::pick(const Frustum& frustum) const {
  shaolin::check(frustum);
  std::vector<PickedFace> picked;
  if ((bounds().lower.array() > bounds().upper.array()).any()) return picked;
  RayCounters counters;
  const Box all = with_margin(bounds());
  const QueryFrame frame(all, all);
  if (const Polytope shape = polytope(frustum, all, frame); !shape.is_empty()) {
    const double radius = 0.5 * (all.upper - all.lower).stableNorm();
    for (const PlacedObject& placed : objects_near(all.centre(), radius)) {
      const std::unique_ptr<SurfaceCell> root = placed.object->cells();
      if (!root) continue;
      const CellFrame cells(frame, *placed.placement, placed.object->bounds(), 1);
      PickSearch search(shape, cells, counters);
      search_cells(*root, search, counters);
      for (const int face : search.faces()) picked.push_back({placed.instance, face});
    }
  }
  std::sort(picked.begin(), picked.end());
  count_shape(counters);
  return picked;
}

}  // namespace shaolin
