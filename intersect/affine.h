#pragma once
/// Affine maps, and what they do to boxes.
#include "box.h"

namespace shaolin {

/// x -> linear() x + translation(); matrix() holds the three rows of four numbers.
using Affine = Eigen::AffineCompact3d;

/// The inverse map. With rows, then columns scaled by powers of two until their largest entries lie in [1/2, 1), the
/// linear part must have a determinant of at least 2^-30 (then six digits of its inverse are right; a plain scale of
/// the axes, however uneven, passes). Throws InputError for less, for a number that is not finite, and where the
/// inverse leaves the range of doubles.
Affine inverse(const Affine& map);

/// A box that holds the images of all points of a box, rounded outward. An empty box stays empty.
Box transformed(const Box& box, const Affine& map);

}  // namespace shaolin
