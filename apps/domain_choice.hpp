/// \file
/// The options that say what the domain is: --kind, --periodic and --solid, beside --domain.
#pragma once

#include <string>

#include "apps/io/read/domain.hpp"

namespace CLI {
class App;
}

namespace powercell::app {

struct DomainArguments {
  std::string domain, kind, periodic;
  bool solid = false;
};

/// Adds the options without --domain, which commands describe in their own words.
void add_domain_options(CLI::App& command, DomainArguments& arguments);

/// \throw Error as io::read_domain()
/// \throw WrongUsage for options that contradict each other
io::DomainArrays read_domain_arrays(const DomainArguments& arguments);

}  // namespace powercell::app
