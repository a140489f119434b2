#include "symbolic/vector.h"

namespace spacetime::symbolic {

Vector3 add(Graph& graph, const Vector3& x, const Vector3& y) {
  return {graph.add(x[0], y[0]), graph.add(x[1], y[1]), graph.add(x[2], y[2])};
}

Vector3 subtract(Graph& graph, const Vector3& x, const Vector3& y) {
  return {graph.subtract(x[0], y[0]), graph.subtract(x[1], y[1]), graph.subtract(x[2], y[2])};
}

Vector3 scale(Graph& graph, Expr factor, const Vector3& x) {
  return {graph.multiply(factor, x[0]), graph.multiply(factor, x[1]), graph.multiply(factor, x[2])};
}

Expr dot(Graph& graph, const Vector3& x, const Vector3& y) {
  Expr sum;
  for (int k = 0; k < 3; ++k) sum = graph.add(sum, graph.multiply(x[k], y[k]));
  return sum;
}

Vector3 cross(Graph& graph, const Vector3& x, const Vector3& y) {
  Vector3 result;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    result[k] = graph.subtract(graph.multiply(x[i], y[j]), graph.multiply(x[j], y[i]));
  }
  return result;
}

Vector3 normalised(Graph& graph, const Vector3& x) {
  const Expr length = graph.square_root(dot(graph, x, x));
  return {graph.divide(x[0], length), graph.divide(x[1], length), graph.divide(x[2], length)};
}

Matrix3 identity(Graph& graph) {
  const Expr zero, one = graph.number(1);
  return {Vector3{one, zero, zero}, Vector3{zero, one, zero}, Vector3{zero, zero, one}};
}

Matrix3 outer(Graph& graph, const Vector3& x, const Vector3& y) {
  return {scale(graph, x[0], y), scale(graph, x[1], y), scale(graph, x[2], y)};
}

Matrix3 add(Graph& graph, const Matrix3& m, const Matrix3& n) {
  return {add(graph, m[0], n[0]), add(graph, m[1], n[1]), add(graph, m[2], n[2])};
}

Matrix3 subtract(Graph& graph, const Matrix3& m, const Matrix3& n) {
  return {subtract(graph, m[0], n[0]), subtract(graph, m[1], n[1]), subtract(graph, m[2], n[2])};
}

Matrix3 scale(Graph& graph, Expr factor, const Matrix3& m) {
  return {scale(graph, factor, m[0]), scale(graph, factor, m[1]), scale(graph, factor, m[2])};
}

Vector3 multiply(Graph& graph, const Matrix3& m, const Vector3& x) {
  return {dot(graph, m[0], x), dot(graph, m[1], x), dot(graph, m[2], x)};
}

Matrix3 multiply(Graph& graph, const Matrix3& m, const Matrix3& n) {
  const auto columns = transpose(n);
  Matrix3 result;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) result[i][j] = dot(graph, m[i], columns[j]);
  }
  return result;
}

Matrix3 transpose(const Matrix3& m) { return {column(m, 0), column(m, 1), column(m, 2)}; }

Vector3 column(const Matrix3& m, int j) { return {m[0][j], m[1][j], m[2][j]}; }

Matrix3 turn(Graph& graph, const Vector3& axis, Expr angle) {
  const auto along = outer(graph, axis, axis);
  const auto& u = axis;
  const auto minus = [&](Expr e) { return graph.negate(e); };
  const Expr zero;
  const Matrix3 across{Vector3{zero, minus(u[2]), u[1]}, Vector3{u[2], zero, minus(u[0])},
                       Vector3{minus(u[1]), u[0], zero}};
  const auto turning = add(graph, scale(graph, graph.cosine(angle), subtract(graph, identity(graph), along)),
                           scale(graph, graph.sine(angle), across));
  return add(graph, along, turning);
}

}  // namespace spacetime::symbolic
