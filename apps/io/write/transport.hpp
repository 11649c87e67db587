/// \file
/// Files of a transport: a table of the seeds, and the steps of the solver.
#pragma once

#include <powercell/transport.hpp>
#include <string>

#include "apps/io/maps/frame.hpp"

namespace powercell::io {

/// CSV `seed,x,y[,z],weight,status,target,mass,cx,cy[,cz],second_moment,merged_with`, in input order, after
/// the columns of the seeds' own table (seed_rows.hpp). Numbers read back the same. The centroid of an empty
/// cell and `merged_with` of a seed that is not merged are left empty.
/// \throw Error write_failed
void write_transport_table(const std::string& path, const SeedsView& seeds, const TransportResult& result,
                           const InputView& inputs = {});

/// JSON Lines: one object for each step, with the names of TransportStep.
/// \throw Error write_failed
void write_steps(const std::string& path, const TransportResult& result);

}  // namespace powercell::io
