#pragma once
/// A place on a surface as ten fields of a table: face,sub,u,v,px,py,pz,nx,ny,nz.
#include "schemes/limit_sample.h"
#include "tools/cli/csv_vector.h"

namespace shaolin {

inline constexpr const char* place_columns = "face,sub,u,v,px,py,pz,nx,ny,nz";

/// The normal's fields are empty where the surface has none.
inline void write_place(CsvWriter& writer, const SurfaceParameter& at, const LimitSample& sample) {
  writer.field(at.face).field(at.sub).field(at.u).field(at.v);
  write_vector(writer, sample.position);
  write_normal(writer, sample.normal);
}

}  // namespace shaolin
