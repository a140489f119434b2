// Vectors and matrices of expressions.
#pragma once

#include "symbolic/graph.h"

namespace spacetime::symbolic {

using Vector3 = std::array<Expr, 3>;
using Matrix3 = std::array<Vector3, 3>;  // rows

Vector3 add(Graph& graph, const Vector3& x, const Vector3& y);
Vector3 subtract(Graph& graph, const Vector3& x, const Vector3& y);
Vector3 scale(Graph& graph, Expr factor, const Vector3& x);
Expr dot(Graph& graph, const Vector3& x, const Vector3& y);
Vector3 cross(Graph& graph, const Vector3& x, const Vector3& y);
Vector3 normalised(Graph& graph, const Vector3& x);

Matrix3 identity(Graph& graph);
Matrix3 outer(Graph& graph, const Vector3& x, const Vector3& y);  // x y^T
Matrix3 add(Graph& graph, const Matrix3& m, const Matrix3& n);
Matrix3 subtract(Graph& graph, const Matrix3& m, const Matrix3& n);
Matrix3 scale(Graph& graph, Expr factor, const Matrix3& m);
Vector3 multiply(Graph& graph, const Matrix3& m, const Vector3& x);
Matrix3 multiply(Graph& graph, const Matrix3& m, const Matrix3& n);
Matrix3 transpose(const Matrix3& m);
Vector3 column(const Matrix3& m, int j);

// The turn by an angle about a unit vector: u u^T + cos (1 - u u^T) + sin [u]x (Rodrigues).
Matrix3 turn(Graph& graph, const Vector3& axis, Expr angle);

}  // namespace spacetime::symbolic
