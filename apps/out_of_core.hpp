/// \file
/// powercell diagram --memory: a diagram of more seeds than memory holds.
#pragma once

#include <cstdint>
#include <string>

#include "apps/common.hpp"
#include "apps/inputs.hpp"

namespace powercell::app {

struct OutOfCoreArguments {
  const CommonOptions& common;
  const InputArguments& inputs;
  std::string table, walls;  ///< files; one may be empty
  std::uint64_t memory;      ///< bytes
};

/// \return the exit code
/// \throw WrongUsage, Error of the readers and of compute_out_of_core()
int run_out_of_core(const OutOfCoreArguments& arguments);

}  // namespace powercell::app
