/// \file
/// What a transport is asked for, checked, and what is reported of it, for seeds in one place and on ranks.
#pragma once

#include <span>
#include <vector>

#include "lib/applications/transport/phases.hpp"

namespace powercell {

/// \throw Error invalid_argument
[[noreturn]] void refuse(const std::string& what);

/// \throw Error invalid_argument
void require_valid(const TransportOptions& options);

/// \param first  number of the first of these seeds in messages
/// \throw Error invalid_argument (sizes; negative, zero or not finite: which seed)
void require_valid_masses(std::span<const double> masses, std::size_t seeds, std::uint64_t first = 0);

/// The mass of the domain.
/// \throw Error invalid_argument
double domain_mass(const TransportOptions& options, const Domain& domain);

/// The target masses of the seeds here.
/// \param masses  of the seeds here; empty where all have equal ones
/// \param seeds   of them
/// \param total   the sum for all seeds
/// \param first   number of the first seed here in messages
/// \throw Error invalid_argument
std::vector<double> target_masses(std::span<const double> masses, std::size_t seeds, double total,
                                  bool rescale, const AllSeeds& all, std::uint64_t first = 0);

/// The rows with the indices `kept`, each of `width` values.
std::vector<double> rows(std::span<const double> values, const std::vector<std::uint32_t>& kept,
                         std::size_t width);

Vector vector_of(std::span<const double> values);

/// Solves for the target masses of the seeds of the evaluator, from `weights`, and fills in what is reported
/// of all of them.
/// \param result  with its tolerance
/// \param tolerance_given  false if that is the default
Iterate solve_and_report(Evaluator& evaluator, const TransportOptions& options, bool tolerance_given,
                         const Vector& target, const Vector& weights, TransportResult& result);

/// Sets the arrays of n seeds in space of d dimensions, of which those with the indices `kept` are not
/// merged.
/// \param at  of these
void fill_arrays(const Iterate& at, const std::vector<std::uint32_t>& kept, std::size_t n, std::size_t d,
                 TransportResult& result);

}  // namespace powercell
