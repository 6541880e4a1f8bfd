// Pieces made from the whole at once against splitting step by step.
#include "intersect/pieces.h"

#include "tests/catch.h"
#include "tests/random.h"
#include "tests/random_patches.h"

namespace shaolin {

namespace {

struct Seen {
  int pieces = 0;
  double area = 0;  ///< of the pieces that are not cut further, against the whole's
};

/// Compares a piece, and all that it is cut into, with what Pieces makes of the whole.
template <class Bezier>
void compare(const Bezier& whole, const Bezier& piece, int number, Seen& seen) {
  using Cuts = Pieces<Bezier>;
  ++seen.pieces;
  const Net from(whole), expected(piece);
  std::array<double, 16> made;
  double worst = 0;
  for (const auto coordinate : {&Net::x, &Net::y, &Net::z}) {
    pieces_of<Bezier>.restrict_to(number, from.*coordinate, made);
    for (std::size_t i = 0; i < 16; ++i) worst = std::max(worst, std::abs(made[i] - (expected.*coordinate)[i]));
  }
  CHECK(worst <= 16 * unit_roundoff);
  const SubDomain domain = Cuts::domain(number);
  const Parameter at(0.3, 0.45);
  CHECK((whole.position(domain(at)) - piece.position(at)).norm() <= 32 * unit_roundoff);
  if (!Cuts::can_cut(piece, number)) {
    seen.area += std::abs(domain.scale.prod());
    return;
  }
  const auto cut = Cuts::cut(piece, number);
  for (std::size_t k = 0; k < Cuts::parts; ++k) compare(whole, cut.parts[k], cut.numbers[k], seen);
}

}  // namespace

TEMPLATE_TEST_CASE("Pieces are those of repeated splits, and tile the whole", "[intersect][pieces]", BezierQuad,
                   BezierTriangle) {
  Random random(3);
  for (int i = 0; i < 50; ++i) {
    const auto patch = random_patch<TestType>(random);
    Seen seen;
    compare(patch, patch, 0, seen);
    CHECK(seen.area == 1);
    CHECK(seen.pieces > 4);
    CHECK(seen.pieces <= 31);
  }
}

TEST_CASE("A quad is cut where it bends", "[intersect][pieces]") {
  // A parabola over u, straight along v, and the same turned.
  for (const bool turned : {false, true}) {
    BezierQuad patch;
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t i = 0; i < 4; ++i) {
        const double bend = i == 1 || i == 2 ? 1 : 0;
        patch.b[turned ? 4 * i + j : 4 * j + i] = turned ? Vec3(static_cast<double>(j), static_cast<double>(i), bend)
                                                         : Vec3(static_cast<double>(i), static_cast<double>(j), bend);
      }
    const auto cut = Pieces<BezierQuad>::cut(patch, 0);
    const Parameter half = turned ? Parameter(1, 0.5) : Parameter(0.5, 1);
    for (const int number : cut.numbers) CHECK(Pieces<BezierQuad>::domain(number).scale == half);
    // Twice along one side is the most; a patch that goes on bending there is a patch of its own then.
    const auto again = Pieces<BezierQuad>::cut(cut.parts[0], cut.numbers[0]);
    CHECK(Pieces<BezierQuad>::can_cut(cut.parts[0], cut.numbers[0]));
    CHECK(!Pieces<BezierQuad>::can_cut(again.parts[0], again.numbers[0]));
  }
}

}  // namespace shaolin
