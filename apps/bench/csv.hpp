/// \file
/// The figures of a benchmark as a table for other programs.
#pragma once

#include <string>

#include "apps/bench/record.hpp"

namespace powercell::app {

/// CSV `device,name,figure,domain,precision,size,value,unit,scatter,runs`, a row for each figure: `measures`
/// and `adjacency` of a row (its size in seeds), `copied`, `operations`, `launch`, `transfer`, and
/// `to_device` and `to_host` (their size in bytes). The scatter is a share of the value. What a figure does
/// not have is empty. Numbers read back the same.
/// \throw Error write_failed
void write_csv(const std::string& path, const BenchRecord& record);

}  // namespace powercell::app
