/// \file
/// Files of a transport: a table of the seeds, and the steps of the solver.
#pragma once

#include <powercell/transport.hpp>
#include <string>

namespace powercell::io {

/// CSV `seed,x,y[,z],weight,status,target,mass,cx,cy[,cz],second_moment,merged_with`, in input order, every
/// number such that it reads back the same. The centroid is left empty where the cell is empty, `merged_with`
/// where the seed is not merged. \throw Error write_failed
void write_transport_table(const std::string& path, const SeedsView& seeds, const TransportResult& result);

/// One JSON object a line for each step, with the names of TransportStep. \throw Error write_failed
void write_steps(const std::string& path, const TransportResult& result);

}  // namespace powercell::io
