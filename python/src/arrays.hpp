/// \file
/// Views of NumPy arrays as spans, and of the library's arrays as read-only NumPy arrays.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cstdint>
#include <span>
#include <vector>

namespace powercell::python {

namespace nb = nanobind;
using namespace nb::literals;

// The package checks and converts arrays before they come here, so these accept exact types alone.
template <class T>
using Vector = nb::ndarray<const T, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
template <class T>
using Matrix = nb::ndarray<const T, nb::ndim<2>, nb::c_contig, nb::device::cpu>;

template <class Array>
auto span_of(const Array& array) {
  return std::span(array.data(), array.size());
}

/// As NumPy has indices and offsets: signed, so that differences do not wrap.
template <class T>
struct Shown {
  using Type = T;
};
template <>
struct Shown<std::uint32_t> {
  using Type = std::int32_t;
};
template <>
struct Shown<std::uint64_t> {
  using Type = std::int64_t;
};

/// A read-only array over the values; `owner` keeps them alive.
template <class T>
nb::object view(const T* values, std::vector<std::size_t> shape, nb::handle owner) {
  using Type = typename Shown<T>::Type;
  static const Type none{};  // an empty std::vector may have no address
  const Type* const first = values ? reinterpret_cast<const Type*>(values) : &none;
  return nb::cast(nb::ndarray<nb::numpy, const Type>(first, shape.size(), shape.data(), owner));
}
template <class T>
nb::object view(const std::vector<T>& values, nb::handle owner) {
  return view(values.data(), {values.size()}, owner);
}
/// Rows of `columns` values.
template <class T>
nb::object rows(const std::vector<T>& values, std::size_t columns, nb::handle owner) {
  return view(values.data(), {columns ? values.size() / columns : 0, columns}, owner);
}

/// A read-only array of that shape, which owns the values.
template <class T>
nb::object owned(std::vector<T> values, std::vector<std::size_t> shape) {
  auto* const kept = new std::vector<T>(std::move(values));
  const nb::capsule owner(kept, [](void* p) noexcept { delete static_cast<std::vector<T>*>(p); });
  return view(kept->data(), std::move(shape), owner);
}

/// Rows of integer shifts, one for each of d coordinates; None in a domain that is not periodic.
template <class Result>
nb::object shifts(const Result& result, nb::handle owner, int d = 3) {
  if (result.shift.empty()) return nb::none();
  const auto columns = static_cast<std::size_t>(d);
  const std::int64_t strides[] = {3, 1};
  const std::size_t shape[] = {result.shift.size(), columns};
  return nb::cast(
      nb::ndarray<nb::numpy, const std::int32_t>(result.shift.front().data(), 2, shape, owner, strides));
}

}  // namespace powercell::python
