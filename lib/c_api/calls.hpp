/// \file
/// What every function of the C interface is made of: exceptions become statuses, pointers become spans.
#pragma once

#include <powercell/c/base.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <limits>
#include <memory>
#include <new>
#include <powercell/error.hpp>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace powercell::c_api {

/// Keeps the message for pc_last_error() in this thread. If there is no memory for it, the status alone is
/// returned.
POWERCELL_API pc_status fail(pc_status status, const char* message) noexcept;

/// Runs `body` and converts an exception to a status and a message.
template <class Body>
pc_status guarded(Body&& body) noexcept {
  try {
    body();
    return PC_OK;
  } catch (const Error& error) {
    return fail(static_cast<pc_status>(static_cast<int>(error.code()) + 1), error.what());
  } catch (const std::bad_alloc&) {
    return fail(PC_OUT_OF_MEMORY, "out of host memory");
  } catch (const std::length_error&) {
    return fail(PC_OUT_OF_MEMORY, "out of host memory: a count exceeds the largest possible array");
  } catch (const std::exception& error) {
    return fail(PC_INTERNAL, error.what());
  } catch (...) {
    return fail(PC_INTERNAL, "an exception of unknown type");
  }
}

inline void require(bool condition, const char* message) {
  if (!condition) throw Error(ErrorCode::invalid_argument, message);
}

/// What `pointer` points to.
/// \throw Error invalid_argument "NAME is NULL"
template <class T>
T& checked(T* pointer, const char* name) {
  if (!pointer) throw Error(ErrorCode::invalid_argument, std::string(name) + " is NULL");
  return *pointer;
}

/// Where a function writes its result.
template <class T>
T& result_at(T* pointer) {
  return checked(pointer, "the pointer for the result");
}

/// Sets *out only if the object was constructed.
template <class Handle, class... Arguments>
void hand_over(Handle** out, Arguments&&... arguments) {
  result_at(out) = new Handle(std::forward<Arguments>(arguments)...);
}

template <class T>
std::span<const T> view(const T* data, std::size_t size, const char* name) {
  if (!data && size != 0) throw Error(ErrorCode::invalid_argument, std::string(name) + " is NULL");
  return {data, size};
}

/// The same for `count` rows of `columns`. A product that overflows size_t would look like a small array.
template <class T>
std::span<const T> rows_view(const T* data, std::size_t count, std::size_t columns, const char* name) {
  if (count > std::numeric_limits<std::size_t>::max() / sizeof(T) / columns)
    throw Error(ErrorCode::invalid_argument,
                "a count of " + std::to_string(count) + " exceeds the address space");
  return view(data, count * columns, name);
}

/// `size` values, or none for NULL.
template <class T>
std::span<const T> optional_view(const T* data, std::size_t size) {
  return data ? view(data, size, "") : std::span<const T>();
}

/// Copies to an array of the caller, if there is one.
template <class T, class U>
void copy_out(const std::vector<T>& from, U* to) {
  if (to) std::transform(from.begin(), from.end(), to, [](T value) { return static_cast<U>(value); });
}

/// The size of an array that takes two calls: sets *count to what is needed.
/// \throw Error invalid_argument if there is an array and it is shorter
template <class T>
void fit(const T* array, const char* name, std::size_t needed, std::size_t* count) {
  const bool fits = !array || *count >= needed;
  *count = needed;
  if (!fits)
    throw Error(ErrorCode::invalid_argument,
                std::string(name) + " is too short; *count is now the number of entries needed");
}

/// The bits of a C enumeration. A C caller can store any number, which C++ must not read as the enumeration.
template <class Enumeration>
int number_in(const Enumeration& value) {
  static_assert(sizeof(Enumeration) == sizeof(int));
  int number;
  std::memcpy(&number, &value, sizeof number);
  return number;
}

/// The C++ value with the number of a C enumeration, whose values are 0 to `last`.
template <class To, class From>
To value_of(const From& from, From last, const char* name, const char* type) {
  const int number = number_in(from);
  if (number < 0 || number > static_cast<int>(last))
    throw Error(ErrorCode::invalid_argument, std::string(name) + " is not a value of " + type);
  return static_cast<To>(number);
}

/// Calls a function of the caller. Exceptions of one in C++ stop the call as its answer 0 does.
/// \param name  of the function, for the message
template <class Callback>
auto call_back(const char* name, Callback&& callback) {
  const auto stopped = [name](const char* what) {
    return Error(ErrorCode::interrupted, std::string(name) + " threw an exception: " + what);
  };
  try {
    return callback();
  } catch (const std::exception& error) {
    throw stopped(error.what());
  } catch (...) {
    throw stopped("of unknown type");
  }
}

/// \throw Error interrupted if the function of the caller that `name` says has answered 0
inline void require_went_on(int answer, const char* name) {
  if (answer == 0) throw Error(ErrorCode::interrupted, std::string("the computation was stopped by ") + name);
}

}  // namespace powercell::c_api
