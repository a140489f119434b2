// Dual numbers: derivatives by the chain rule on values, with nothing in common with the symbolic rules but calculus.
// Dual<Dual<double>> carries second derivatives.
#pragma once

#include <cmath>

namespace spacetime::symbolic {

template <class T>
struct Dual {
  T v{}, d{};
  Dual() = default;
  explicit Dual(double value) : v(value), d(0.0) {}
  Dual(T value, T derivative) : v(value), d(derivative) {}
};

inline double value_of(double x) { return x; }
template <class T>
double value_of(const Dual<T>& x) {
  return value_of(x.v);
}

template <class T>
bool operator<(const Dual<T>& x, const Dual<T>& y) {
  return value_of(x) < value_of(y);
}
template <class T>
bool operator==(const Dual<T>& x, const Dual<T>& y) {
  return value_of(x) == value_of(y);
}
template <class T>
Dual<T> operator-(const Dual<T>& x) {
  return {-x.v, -x.d};
}
template <class T>
Dual<T> operator+(const Dual<T>& x, const Dual<T>& y) {
  return {x.v + y.v, x.d + y.d};
}
template <class T>
Dual<T> operator-(const Dual<T>& x, const Dual<T>& y) {
  return {x.v - y.v, x.d - y.d};
}
template <class T>
Dual<T> operator*(const Dual<T>& x, const Dual<T>& y) {
  return {x.v * y.v, x.v * y.d + x.d * y.v};
}
template <class T>
Dual<T> operator/(const Dual<T>& x, const Dual<T>& y) {
  return {x.v / y.v, (x.d * y.v - x.v * y.d) / (y.v * y.v)};
}

template <class T>
Dual<T> sqrt(const Dual<T>& x) {
  using std::sqrt;
  return {sqrt(x.v), x.d / (T(2.0) * sqrt(x.v))};
}
template <class T>
Dual<T> sin(const Dual<T>& x) {
  using std::cos, std::sin;
  return {sin(x.v), x.d * cos(x.v)};
}
template <class T>
Dual<T> cos(const Dual<T>& x) {
  using std::cos, std::sin;
  return {cos(x.v), -(x.d * sin(x.v))};
}
template <class T>
Dual<T> tan(const Dual<T>& x) {
  using std::cos, std::tan;
  return {tan(x.v), x.d / (cos(x.v) * cos(x.v))};
}
template <class T>
Dual<T> asin(const Dual<T>& x) {
  using std::asin, std::sqrt;
  return {asin(x.v), x.d / sqrt(T(1.0) - x.v * x.v)};
}
template <class T>
Dual<T> acos(const Dual<T>& x) {
  using std::acos, std::sqrt;
  return {acos(x.v), -(x.d / sqrt(T(1.0) - x.v * x.v))};
}
template <class T>
Dual<T> atan(const Dual<T>& x) {
  using std::atan;
  return {atan(x.v), x.d / (T(1.0) + x.v * x.v)};
}
template <class T>
Dual<T> atan2(const Dual<T>& y, const Dual<T>& x) {
  using std::atan2;
  return {atan2(y.v, x.v), (y.d * x.v - y.v * x.d) / (x.v * x.v + y.v * y.v)};
}
template <class T>
Dual<T> sinh(const Dual<T>& x) {
  using std::cosh, std::sinh;
  return {sinh(x.v), x.d * cosh(x.v)};
}
template <class T>
Dual<T> cosh(const Dual<T>& x) {
  using std::cosh, std::sinh;
  return {cosh(x.v), x.d * sinh(x.v)};
}
template <class T>
Dual<T> tanh(const Dual<T>& x) {
  using std::cosh, std::tanh;
  return {tanh(x.v), x.d / (cosh(x.v) * cosh(x.v))};
}
template <class T>
Dual<T> exp(const Dual<T>& x) {
  using std::exp;
  return {exp(x.v), x.d * exp(x.v)};
}
template <class T>
Dual<T> log(const Dual<T>& x) {
  using std::log;
  return {log(x.v), x.d / x.v};
}
// The exponent's derivative counts only where the base has a logarithm.
template <class T>
Dual<T> pow(const Dual<T>& x, const Dual<T>& y) {
  using std::log, std::pow;
  T d = x.d * y.v * pow(x.v, y.v - T(1.0));
  if (value_of(x) > 0) d = d + y.d * log(x.v) * pow(x.v, y.v);
  return {pow(x.v, y.v), d};
}

}  // namespace spacetime::symbolic
