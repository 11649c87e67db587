// The C interface: each function calls its C++ counterpart and converts exceptions to a status.
#include <powercell.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <limits>
#include <memory>
#include <new>
#include <powercell/powercell.hpp>
#include <stdexcept>
#include <string>
#include <vector>

struct pc_device {
  powercell::Device device;
};
struct pc_domain {
  powercell::Domain domain;
};
struct pc_diagram {
  powercell::Diagram diagram;
};

namespace {

using powercell::Error;
using powercell::ErrorCode;

static_assert(static_cast<int>(ErrorCode::invalid_argument) + 1 == PC_INVALID_ARGUMENT);
static_assert(static_cast<int>(ErrorCode::no_fp64) + 1 == PC_NO_FP64);
static_assert(static_cast<int>(ErrorCode::internal) + 1 == PC_INTERNAL);
static_assert(static_cast<int>(powercell::SeedStatus::duplicate) == PC_SEED_DUPLICATE);
static_assert(static_cast<int>(powercell::Precision::float32) == PC_FLOAT32);
static_assert(static_cast<int>(powercell::Neighbors::flann) == PC_FLANN);

thread_local std::string last_error;

// Must not throw: if there is no memory for the message, the status alone is returned.
pc_status fail(pc_status status, const char* message) noexcept {
  try {
    last_error = message;
  } catch (...) {
    last_error.clear();
  }
  return status;
}

// Runs `body` and converts an exception to a status and a message.
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

void require(bool condition, const char* message) {
  if (!condition) throw Error(ErrorCode::invalid_argument, message);
}

template <class Handle>
Handle& checked(Handle* handle, const char* message) {
  require(handle != nullptr, message);
  return *handle;
}

// Sets *out only if the object was constructed.
template <class Handle, class... Arguments>
void hand_over(Handle** out, Arguments&&... arguments) {
  *out = new Handle{std::forward<Arguments>(arguments)...};
}

template <class T>
std::span<const T> view(const T* data, std::size_t size, const char* message) {
  require(data != nullptr || size == 0, message);
  return {data, size};
}

// The same for `count` rows of `columns`. A product that overflows size_t would look like a small array.
template <class T>
std::span<const T> rows_view(const T* data, std::size_t count, std::size_t columns, const char* message) {
  if (count > std::numeric_limits<std::size_t>::max() / sizeof(T) / columns)
    throw Error(ErrorCode::invalid_argument,
                "a count of " + std::to_string(count) + " exceeds the address space");
  return view(data, count * columns, message);
}

template <class T, class U>
void copy_out(const std::vector<T>& from, U* to) {
  if (to) std::transform(from.begin(), from.end(), to, [](T value) { return static_cast<U>(value); });
}

powercell::Ring ring(const double* points, std::size_t first, std::size_t last) {
  require(first <= last, "ring_offset must not decrease");
  powercell::Ring result;
  for (std::size_t i = first; i < last; ++i) result.push_back({points[2 * i], points[2 * i + 1]});
  return result;
}

// The bits of a C enumeration. A C caller can store any number, which C++ must not read as the enumeration.
template <class Enumeration>
int number_in(const Enumeration& value) {
  static_assert(sizeof(Enumeration) == sizeof(int));
  int number;
  std::memcpy(&number, &value, sizeof number);
  return number;
}

powercell::Options options_of(const pc_options& from) {
  const int precision = number_in(from.precision), neighbors = number_in(from.neighbors);
  require(precision >= PC_PRECISION_AUTOMATIC && precision <= PC_FLOAT32,
          "options.precision is not a value of pc_precision");
  require(neighbors >= PC_NEIGHBORS_AUTOMATIC && neighbors <= PC_FLANN,
          "options.neighbors is not a value of pc_neighbors");
  const int decisions = number_in(from.decisions);
  require(decisions == PC_DECISIONS_EXACT || decisions == PC_DECISIONS_FAST,
          "options.decisions is not a value of pc_decisions");
  powercell::Options to;
  to.decisions = decisions == PC_DECISIONS_FAST ? powercell::Decisions::fast : powercell::Decisions::exact;
  to.certify = from.certify != 0;
  to.precision = static_cast<powercell::Precision>(precision);
  to.neighbors = static_cast<powercell::Neighbors>(neighbors);
  to.initial_neighbors = from.initial_neighbors;
  to.threads = from.threads;
  to.chunk_pairs = from.chunk_pairs;
  if (from.progress)
    to.progress = [call = from.progress, user = from.progress_user](double fraction) {
      return call(fraction, user) != 0;
    };
  return to;
}

constexpr const char* null_device = "device is NULL";
constexpr const char* null_domain = "domain is NULL";
constexpr const char* null_diagram = "diagram is NULL";
constexpr const char* null_result = "the pointer for the result is NULL";

}  // namespace

extern "C" {

const char* pc_version(void) {
  return powercell::version();
}

const char* pc_status_name(pc_status status) {
  const int number = number_in(status);
  if (number == PC_OK) return "ok";
  if (number == PC_OUT_OF_MEMORY) return "out_of_memory";
  if (number < PC_OK || number > PC_OUT_OF_MEMORY) return "unknown";
  return powercell::name(static_cast<ErrorCode>(number - 1));
}

const char* pc_last_error(void) {
  return last_error.c_str();
}

pc_status pc_set_log(pc_log_sink sink, pc_log_level most, void* user) {
  return guarded([&] {
    const int level = number_in(most);
    require(level == PC_LOG_INFO || level == PC_LOG_DETAIL, "most is not a value of pc_log_level");
    if (!sink) return powercell::set_log({});
    powercell::set_log(
        [sink, user](powercell::LogLevel of, std::string_view line) {
          sink(of == powercell::LogLevel::info ? PC_LOG_INFO : PC_LOG_DETAIL, std::string(line).c_str(),
               user);
        },
        level == PC_LOG_INFO ? powercell::LogLevel::info : powercell::LogLevel::detail);
  });
}

pc_status pc_device_create(const char* selector, pc_device** device) {
  return guarded([&] {
    require(device != nullptr, null_result);
    hand_over(device, powercell::Device::choose(selector ? selector : ""));
  });
}

void pc_device_destroy(pc_device* device) {
  delete device;
}

const char* pc_device_name(const pc_device* device) {
  return device ? device->device.info().name.c_str() : nullptr;
}

pc_status pc_domain_polygon(const double* points, const size_t* ring_offset, const size_t* part_offset,
                            size_t parts, pc_domain** domain) {
  return guarded([&] {
    require(domain != nullptr, null_result);
    require(points && ring_offset && part_offset, "points, ring_offset and part_offset must not be NULL");
    std::vector<powercell::PolygonPart> polygon(parts);
    for (size_t p = 0; p < parts; ++p) {
      require(part_offset[p] < part_offset[p + 1], "each part needs at least its outer ring");
      for (size_t r = part_offset[p]; r < part_offset[p + 1]; ++r) {
        powercell::Ring next = ring(points, ring_offset[r], ring_offset[r + 1]);
        if (r == part_offset[p])
          polygon[p].outer = std::move(next);
        else
          polygon[p].holes.push_back(std::move(next));
      }
    }
    hand_over(domain, powercell::Domain::polygon(polygon));
  });
}

pc_status pc_domain_surface(const double* vertices, size_t vertex_count, const uint32_t* triangles,
                            size_t triangle_count, pc_domain** domain) {
  return guarded([&] {
    require(domain != nullptr, null_result);
    hand_over(domain,
              powercell::Domain::surface(rows_view(vertices, vertex_count, 3, "vertices is NULL"),
                                         rows_view(triangles, triangle_count, 3, "triangles is NULL")));
  });
}

pc_status pc_domain_solid(const double* vertices, size_t vertex_count, const uint32_t* triangles,
                          size_t triangle_count, pc_domain** domain) {
  return guarded([&] {
    require(domain != nullptr, null_result);
    hand_over(domain, powercell::Domain::solid(rows_view(vertices, vertex_count, 3, "vertices is NULL"),
                                               rows_view(triangles, triangle_count, 3, "triangles is NULL")));
  });
}

pc_status pc_domain_volume(const double* vertices, size_t vertex_count, const uint32_t* tetrahedra,
                           size_t tetrahedron_count, pc_domain** domain) {
  return guarded([&] {
    require(domain != nullptr, null_result);
    hand_over(domain,
              powercell::Domain::volume(rows_view(vertices, vertex_count, 3, "vertices is NULL"),
                                        rows_view(tetrahedra, tetrahedron_count, 4, "tetrahedra is NULL")));
  });
}

pc_status pc_domain_box(const double* low, const double* high, int dimension, pc_domain** domain) {
  return guarded([&] {
    require(domain != nullptr, null_result);
    require(dimension == 2 || dimension == 3, "dimension must be 2 or 3");
    const auto d = static_cast<std::size_t>(dimension);
    hand_over(domain, powercell::Domain::box(view(low, d, "low is NULL"), view(high, d, "high is NULL")));
  });
}

void pc_domain_destroy(pc_domain* domain) {
  delete domain;
}

pc_status pc_domain_measure(const pc_domain* domain, double* measure) {
  return guarded([&] {
    require(measure != nullptr, null_result);
    *measure = checked(domain, null_domain).domain.measure();
  });
}

void pc_options_init(pc_options* options) {
  if (options) *options = pc_options{};
}

pc_status pc_diagram_create(const pc_device* device, const pc_domain* domain, const pc_options* options,
                            pc_diagram** diagram) {
  return guarded([&] {
    require(diagram != nullptr, null_result);
    hand_over(diagram,
              powercell::Diagram(checked(device, null_device).device, checked(domain, null_domain).domain,
                                 options ? options_of(*options) : powercell::Options{}));
  });
}

void pc_diagram_destroy(pc_diagram* diagram) {
  delete diagram;
}

pc_status pc_diagram_set_seeds(pc_diagram* diagram, const double* positions, const double* weights,
                               size_t count) {
  return guarded([&] {
    powercell::Diagram& target = checked(diagram, null_diagram).diagram;
    const int dimension = target.domain().dimension();
    target.set_seeds({dimension,
                      rows_view(positions, count, static_cast<std::size_t>(dimension), "positions is NULL"),
                      view(weights, weights ? count : 0, "")});
  });
}

pc_status pc_diagram_set_weights(pc_diagram* diagram, const double* weights, size_t count) {
  return guarded(
      [&] { checked(diagram, null_diagram).diagram.set_weights(view(weights, count, "weights is NULL")); });
}

pc_status pc_diagram_size(const pc_diagram* diagram, size_t* count) {
  return guarded([&] {
    require(count != nullptr, null_result);
    *count = checked(diagram, null_diagram).diagram.size();
  });
}

pc_status pc_diagram_measures(pc_diagram* diagram, double* mass, double* centroid, double* second_moment,
                              uint8_t* status) {
  return guarded([&] {
    const powercell::Measures& measures = checked(diagram, null_diagram).diagram.measures();
    copy_out(measures.mass, mass);
    copy_out(measures.centroid, centroid);
    copy_out(measures.second_moment, second_moment);
    copy_out(measures.status, status);
  });
}

pc_status pc_diagram_adjacency(pc_diagram* diagram, uint64_t* offset, uint32_t* neighbor, double* wall,
                               size_t* count) {
  return guarded([&] {
    require(count != nullptr, "count is NULL");
    require(neighbor || !wall, "wall needs neighbor: pass both, or NULL for wall");
    const powercell::Adjacency& adjacency = checked(diagram, null_diagram).diagram.adjacency();
    const std::size_t needed = adjacency.neighbor.size();
    const bool fits = !neighbor || *count >= needed;
    *count = needed;
    require(fits, "neighbor is too short; *count is now the number of entries needed");
    copy_out(adjacency.offset, offset);
    copy_out(adjacency.neighbor, neighbor);
    copy_out(adjacency.wall, wall);
  });
}

pc_status pc_diagram_dual(pc_diagram* diagram, int* corners, uint32_t* simplices, size_t* count) {
  return guarded([&] {
    require(count != nullptr && corners != nullptr, "corners and count must not be NULL");
    const powercell::Dual& dual = checked(diagram, null_diagram).diagram.dual();
    const bool fits = !simplices || *count >= dual.size();
    *corners = dual.corners;
    *count = dual.size();
    require(fits, "simplices is too short; *count is now the number of rows needed");
    copy_out(dual.simplices, simplices);
  });
}

}  // extern "C"
