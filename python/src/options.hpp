/// \file
/// Options of diagrams, by the names that the tool gives them.
#pragma once

#include <powercell/error.hpp>
#include <powercell/options.hpp>

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

/// The options of a dictionary with the keys precision, neighbors, decisions, certify, threads, chunk_pairs.
inline Options options_of(const nb::dict& given) {
  Options options;
  const auto text = [&](const char* key) { return nb::cast<std::string>(given[key]); };
  options.precision = chosen<Precision>(
      "precision", text("precision"),
      {{"auto", Precision::automatic}, {"double", Precision::float64}, {"float", Precision::float32}});
  options.neighbors = chosen<Neighbors>(
      "neighbors", text("neighbors"),
      {{"auto", Neighbors::automatic}, {"tree", Neighbors::tree}, {"flann", Neighbors::flann}});
  options.decisions = chosen<Decisions>("decisions", text("decisions"),
                                        {{"exact", Decisions::exact}, {"fast", Decisions::fast}});
  options.certify = nb::cast<bool>(given["certify"]);
  options.threads = nb::cast<int>(given["threads"]);
  options.chunk_pairs = nb::cast<std::uint64_t>(given["chunk_pairs"]);
  return options;
}

}  // namespace powercell::python
