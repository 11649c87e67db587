#include "apps/ranks/ranks.hpp"

#include <fmt/format.h>

#include <array>
#include <powercell/error.hpp>

#include "apps/common.hpp"

namespace powercell::app {
namespace {

constexpr int wrong_usage = -1;  // beside the codes of Error

struct Failure {
  int code = 0;
  std::string what;
};

Failure failure_of(const std::exception_ptr& thrown) {
  try {
    std::rethrow_exception(thrown);
  } catch (const WrongUsage& error) {
    return {wrong_usage, error.what()};
  } catch (const Error& error) {
    return {static_cast<int>(error.code()), error.what()};
  } catch (const std::bad_alloc&) {
    return {static_cast<int>(ErrorCode::internal), "out of memory; more ranks or fewer seeds may fit"};
  } catch (const std::exception& error) {
    return {static_cast<int>(ErrorCode::internal), error.what()};
  }
}

template <class T>
T sum_of_all(T value, MPI_Datatype type) {
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, type, MPI_SUM, MPI_COMM_WORLD);
  return value;
}

}  // namespace

std::uint64_t Ranks::sum(std::uint64_t value) const {
  return sum_of_all(value, MPI_UINT64_T);
}

double Ranks::sum(double value) const {
  return sum_of_all(value, MPI_DOUBLE);
}

int Ranks::on_this_machine() const {
  MPI_Comm machine = MPI_COMM_NULL;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  int count = 1;
  MPI_Comm_size(machine, &count);
  MPI_Comm_free(&machine);
  return count;
}

void Ranks::agree(const std::exception_ptr& thrown) const {
  int first = thrown ? rank() : size();
  MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
  if (first == size()) return;
  const std::uint64_t failed = sum(std::uint64_t{thrown != nullptr});
  Failure failure;
  if (rank() == first) failure = failure_of(thrown);
  std::array<int, 2> numbers{failure.code, static_cast<int>(failure.what.size())};
  MPI_Bcast(numbers.data(), 2, MPI_INT, first, MPI_COMM_WORLD);
  failure.what.resize(static_cast<std::size_t>(numbers[1]));
  MPI_Bcast(failure.what.data(), numbers[1], MPI_CHAR, first, MPI_COMM_WORLD);
  if (numbers[0] == wrong_usage) throw WrongUsage(failure.what);
  // What all ranks say needs no rank that says it, nor what the first one alone does.
  const bool named = first > 0 || (failed > 1 && failed < static_cast<std::uint64_t>(size()));
  throw Error(static_cast<ErrorCode>(numbers[0]),
              named ? fmt::format("rank {}: {}", first, failure.what) : failure.what);
}

}  // namespace powercell::app
