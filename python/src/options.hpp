/// \file
/// Options of diagrams, by the names that the tool gives them.
#pragma once

#include <limits>
#include <powercell/error.hpp>
#include <powercell/options.hpp>
#include <utility>

#include "python/src/arrays.hpp"

namespace powercell::python {

/// The value that a name stands for. \throw nb::value_error naming the argument and the choices
template <class T>
T chosen(const char* argument, const std::string& name,
         std::initializer_list<std::pair<const char*, T>> choices) {
  std::string all;
  for (const auto& [key, value] : choices) {
    if (name == key) return value;
    all += (all.empty() ? "" : ", ") + std::string(key);
  }
  throw nb::value_error((std::string(argument) + " is '" + name + "'; choose one of " + all).c_str());
}

/// The whole number of a key. \throw nb::value_error naming it, if it is below 0, too large or something else
template <class T>
T whole(const nb::dict& given, const char* key) {
  const nb::object value = given[key];
  try {
    const T number = nb::cast<T>(value);
    if (std::cmp_greater_equal(number, 0)) return number;
  } catch (const nb::cast_error&) {  // said below
  }
  throw nb::value_error((std::string(key) + " is " + nb::repr(value).c_str() + "; a whole number from 0 to " +
                         std::to_string(std::numeric_limits<T>::max()) + " is expected")
                            .c_str());
}

inline Precision precision_of(const std::string& name) {
  return chosen<Precision>(
      "precision", name,
      {{"auto", Precision::automatic}, {"double", Precision::float64}, {"float", Precision::float32}});
}

/// The options of a dictionary, as diagram_options of the package makes it.
inline Options options_of(const nb::dict& given) {
  Options options;
  const auto text = [&](const char* key) { return nb::cast<std::string>(given[key]); };
  options.precision = precision_of(text("precision"));
  options.neighbors = chosen<Neighbors>(
      "neighbors", text("neighbors"),
      {{"auto", Neighbors::automatic}, {"tree", Neighbors::tree}, {"flann", Neighbors::flann}});
  options.decisions = chosen<Decisions>("decisions", text("decisions"),
                                        {{"exact", Decisions::exact}, {"fast", Decisions::fast}});
  options.certify = nb::cast<bool>(given["certify"]);
  options.initial_neighbors = whole<int>(given, "initial_neighbors");
  if (const nb::object eta = given["lift_eta"]; !eta.is_none()) options.lift_eta = nb::cast<double>(eta);
  options.twin_queries = nb::cast<bool>(given["twin_queries"]);
  options.threads = whole<int>(given, "threads");
  options.chunk_pairs = whole<std::uint64_t>(given, "chunk_pairs");
  return options;
}

}  // namespace powercell::python
