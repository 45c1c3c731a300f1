/// A bench's frames as the columns of a flight result.
#pragma once

#include "tools/bench/bench_run.hpp"
#include "tools/bench/regression/flight_result.hpp"

namespace eyepoint::tools {

/// How the run was flown; what the run itself says (OpenGL, terrain, shading) is filled in here.
/// Columns that do not hold for the run (no static mesh, no hashes) are left out.
[[nodiscard]] FlightResult flight_result(const BenchResult& bench, FlightIdentity identity);

}  // namespace eyepoint::tools
