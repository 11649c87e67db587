/// \file
/// The whole C++ interface except opencl.hpp and mpi.hpp.
#pragma once

#include <powercell/communicator.hpp>
#include <powercell/density.hpp>
#include <powercell/device.hpp>
#include <powercell/device_rates.hpp>
#include <powercell/device_settings.hpp>
#include <powercell/diagram.hpp>
#include <powercell/distributed.hpp>
#include <powercell/distributed_transport.hpp>
#include <powercell/domain.hpp>
#include <powercell/error.hpp>
#include <powercell/log.hpp>
#include <powercell/options.hpp>
#include <powercell/out_of_core.hpp>
#include <powercell/point_sets.hpp>
#include <powercell/remeshing.hpp>
#include <powercell/repair.hpp>
#include <powercell/results.hpp>
#include <powercell/sampling.hpp>
#include <powercell/seeds.hpp>
#include <powercell/transport.hpp>
#include <powercell/treemap.hpp>
#include <powercell/triangulation.hpp>
#include <powercell/verify.hpp>
#include <powercell/version.hpp>
