#pragma once
/// Vectors as three fields of a table.
#include "schemes/vec3.h"
#include "tools/cli/csv.h"

namespace shaolin {

inline void write_vector(CsvWriter& writer, const Vec3& vector) {
  for (int axis = 0; axis < 3; ++axis) writer.field(vector[axis]);
}

/// Empty fields where no double can hold the derivative.
inline void write_derivative(CsvWriter& writer, const Vec3& derivative) {
  if (derivative.allFinite())
    write_vector(writer, derivative);
  else
    writer.empty(3);
}

/// Empty fields where the surface has no normal: it is zero then.
inline void write_normal(CsvWriter& writer, const Vec3& normal) {
  if (normal.isZero(0))
    writer.empty(3);
  else
    write_vector(writer, normal);
}

}  // namespace shaolin
