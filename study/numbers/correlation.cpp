#include "study/numbers/correlation.hpp"

#include "core/check.hpp"

#include <cmath>

namespace flowslide::study {

std::vector<std::vector<double>> correlation_factor(std::size_t inputs,
                                                    const std::vector<Correlated>& pairs) {
  std::vector<std::vector<double>> r(inputs, std::vector<double>(inputs, 0.0));
  for (std::size_t i = 0; i < inputs; ++i) r[i][i] = 1.0;
  for (const Correlated& p : pairs) {
    validate(p.coefficient > -1.0 && p.coefficient < 1.0,
             "correlation {:g} (it lies between -1 and 1, and at either the two are one input) "
             "give a smaller one",
             p.coefficient);
    r[p.a][p.b] = r[p.b][p.a] = p.coefficient;
  }
  std::vector<std::vector<double>> factor(inputs, std::vector<double>(inputs, 0.0));
  for (std::size_t i = 0; i < inputs; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = r[i][j];
      for (std::size_t k = 0; k < j; ++k) sum -= factor[i][k] * factor[j][k];
      if (i != j) {
        factor[i][j] = sum / factor[j][j];
        continue;
      }
      validate(sum > 1e-12,
               "these correlations contradict each other (no numbers have all of them at once, as "
               "with a and b, b and c alike but a and c opposed) make one of them smaller");
      factor[i][i] = std::sqrt(sum);
    }
  return factor;
}

}  // namespace flowslide::study
