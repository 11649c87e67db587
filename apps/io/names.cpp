#include "apps/io/names.hpp"

namespace powercell::io {
namespace {

constexpr DomainKind kinds[] = {DomainKind::polygon, DomainKind::surface, DomainKind::volume};
constexpr SeedStatus statuses[] = {SeedStatus::ok, SeedStatus::hidden, SeedStatus::duplicate};

template <class Value, std::size_t n>
std::optional<Value> find(const Value (&values)[n], std::string_view wanted) {
  for (const Value value : values)
    if (wanted == name(value)) return value;
  return std::nullopt;
}

}  // namespace

const char* name(DomainKind kind) {
  return kind == DomainKind::polygon ? "polygon" : kind == DomainKind::surface ? "surface" : "volume";
}

const char* name(SeedStatus status) {
  return status == SeedStatus::ok ? "ok" : status == SeedStatus::hidden ? "hidden" : "duplicate";
}

std::optional<DomainKind> domain_kind(std::string_view name) {
  return find(kinds, name);
}

std::optional<SeedStatus> seed_status(std::string_view name) {
  return find(statuses, name);
}

}  // namespace powercell::io
