/// \file
/// How exactly a device divides and takes roots, measured from the results of the kernels `arithmetic_...` of
/// kernels/base/self_test.cl.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace powercell::cl {

constexpr std::uint32_t accuracy_items = 1024;

/// What the proofs of cells allow for, in units in the last place (docs/mathematics.md (87), (88)): as much
/// as OpenCL does in single precision.
constexpr double most_quotient_error = 2.5, most_root_error = 3;

/// The largest error of an operation, in units in the last place of the exact result.
struct WorstResult {
  double units = 0;  ///< infinite if the result is no number, or 0 where it must not be
  double a = 0, b = 0, got = 0, right = 0;
};

struct Accuracy {
  WorstResult quotient;    ///< a / b
  WorstResult reciprocal;  ///< 1 / b
  WorstResult root;        ///< sqrt(b)
  bool flushes = false;    ///< a result below the least normal number came out as 0
};

/// 3 per item: a, b > 0, 0. T is float or double. Random numbers, quotients and roots next to a tie of
/// rounding, exponents up to those that the proofs rely on (REAL_LEAST of kernels/base/real.cl, and its
/// inverse), and quotients below the least normal number.
template <class T>
std::vector<T> accuracy_operands();
/// \param results  `arithmetic_results` for each item
template <class T>
Accuracy measure_accuracy(std::span<const T> operands, std::span<const T> results);

/// Says what exceeds the proofs, and whether that looks like an emulation of double precision; empty if
/// nothing does.
/// \param is_double  precision of the results
std::string accuracy_fault(const Accuracy& accuracy, bool is_double);
/// A line for the log.
std::string describe(const Accuracy& accuracy, bool is_double);

/// Computes known results on the host.
/// \return what is wrong, and for which numbers; empty if all are right
std::string host_arithmetic_fault();

}  // namespace powercell::cl
