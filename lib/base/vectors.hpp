/// \file
/// Points and directions in space as arrays of three numbers.
#pragma once

#include <array>
#include <cmath>
#include <concepts>

namespace powercell {

template <std::floating_point T>
using Vector3 = std::array<T, 3>;

template <std::floating_point T>
Vector3<T> operator+(const Vector3<T>& a, const Vector3<T>& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
template <std::floating_point T>
Vector3<T> operator-(const Vector3<T>& a, const Vector3<T>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
template <std::floating_point T>
Vector3<T> operator*(std::type_identity_t<T> s, const Vector3<T>& a) {
  return {s * a[0], s * a[1], s * a[2]};
}
template <std::floating_point T>
T dot(const Vector3<T>& a, const Vector3<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <std::floating_point T>
Vector3<T> cross(const Vector3<T>& a, const Vector3<T>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <std::floating_point T>
T norm(const Vector3<T>& a) {
  return std::sqrt(dot(a, a));
}

/// a - b for rows of three coordinates, subtracted in T.
template <std::floating_point T>
Vector3<T> difference(const double* a, const double* b) {
  return {T{a[0]} - b[0], T{a[1]} - b[1], T{a[2]} - b[2]};
}

}  // namespace powercell
