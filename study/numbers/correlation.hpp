#pragma once
#include <cstddef>
#include <vector>

namespace flowslide::study {

/// Correlation of the normal scores of two inputs.
struct Correlated {
  std::size_t a = 0, b = 0;
  double coefficient = 0.0;
};

/// Lower triangle L with L L^T = R, row by row; R is 1 on the diagonal and the given coefficients
/// beside it. InputError if no numbers can be correlated so.
std::vector<std::vector<double>> correlation_factor(std::size_t inputs,
                                                    const std::vector<Correlated>& pairs);

}  // namespace flowslide::study
