#include <cstdio>
#include <string_view>
#include <vector>

#include <omp.h>

/// Does the detector see what it should? "racy" sums without a reduction; "sound" does the same
/// work rightly, and hands values from thread to thread over a barrier.
int main(int argc, char** argv) {
  const bool racy = argc == 2 && std::string_view(argv[1]) == "racy";
  constexpr int n = 1000;
  std::vector<double> x(n), y(n);
  double sum = 0.0;
#pragma omp parallel num_threads(4)
  {
#pragma omp for schedule(static)
    for (int i = 0; i < n; ++i) x[i] = i;
#pragma omp for schedule(static)
    for (int i = 0; i < n; ++i) y[i] = x[n - 1 - i];
    if (racy) {
#pragma omp for schedule(static)
      for (int i = 0; i < n; ++i) sum += y[i];
    } else {
#pragma omp for schedule(static) reduction(+ : sum)
      for (int i = 0; i < n; ++i) sum += y[i];
    }
  }
  std::printf("%g\n", sum);
  return 0;
}
