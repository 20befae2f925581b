#pragma once

#include <array>
#include <cstddef>

namespace lobelight {

using Matrix3 = std::array<std::array<double, 3>, 3>;

// Makes the leading `size` × `size` part of the symmetric matrix `a` diagonal by Jacobi's rotations
// (Golub and Van Loan, Matrix Computations, 8.5): its diagonal becomes the eigenvalues, in no
// order, and the columns of `vectors` the eigenvectors. Elements off the diagonal count as 0 up to
// `negligible` plus `relative` times the diagonal elements beside them.
void diagonalise(Matrix3& a, Matrix3& vectors, std::size_t size, double relative,
                 double negligible);

}  // namespace lobelight
