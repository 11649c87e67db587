/// \file
/// What holds for every diagram, checked from the public results and the seeds alone.
#pragma once

#include <powercell/diagram.hpp>

#include "tests/fuzz/input.hpp"

namespace powercell::fuzz {

/// How far the planes of the cells may be off, as in verify(): unit roundoff times the lengths that enter.
/// Bisectors that pass the domain by are not counted. Infinity where rounding leaves nothing sure.
double plane_error(const Domain& domain, const SeedsView& seeds, Precision precision);

/// What the sum of the masses may be off by, as a part of the domain's measure, with so many walls moved by
/// `error`, each as large as the domain's size allows: of a domain far longer than wide that may be more than
/// all.
double sum_doubt(const Domain& domain, std::size_t walls, double error);

/// Sizes and statuses, masses not negative, the sum of the masses. \param error plane_error of the seeds
void check_measures(const Measures& measures, const Domain& domain, const SeedsView& seeds, double error);
/// Rows ascending and symmetric, no hidden seed in them.
void check_adjacency(const Adjacency& adjacency, const Measures& measures);
/// Offsets and indices in range; the middle of each piece belongs to its seed, by trying all of them.
void check_cells(const Cells& cells, const Domain& domain, const SeedsView& seeds, double error);
/// Corners are seeds that have a cell, no simplex twice.
void check_dual(const Dual& dual, const Measures& measures);
/// Offsets and indices in range.
void check_joined(const JoinedCells& joined, std::size_t seeds);

/// The device that all targets share, never freed: drivers end in no sure order.
const Device& shared_device();

}  // namespace powercell::fuzz
